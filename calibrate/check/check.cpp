#include "calibrate/check/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <future>
#include <limits>
#include <utility>
#include <vector>

#include "calibrate/base/machine.h"
#include "calibrate/base/statistics.h"
#include "calibrate/base/text.h"
#include "calibrate/base/worker_pool.h"
#include "calibrate/store/program.h"
#include "calibrate/study/parameters.h"
#include "calibrate/verify/force_curve.h"

namespace pastefit {

namespace {

/// Compares the attraction of two grains of the mean radius, slowly pulled apart in the engine, with the formula of the
/// card's law, at five gaps within the rupture distance and one beyond it. The band is 1e-6 of the force at touch, the
/// error of interpolation between two steps of the pull; there is no noise.
std::vector<CheckedReading> check_law(const Material& material, const CheckEngine& engine) {
  const double radius = material.grains.radius_m;
  const GrainPair pair{radius, radius, radius};
  const double reach = bridge_gaps(material.contact, pair).rupture_m;
  const double at_touch = attraction_n(material.contact, pair, 0);
  if (!(reach > 0) || !(at_touch > 0)) return {};

  constexpr int kSteps = 20'000;
  Impact pull;
  pull.contact = material.contact;
  pull.density_kg_m3 = material.bulk_density_kg_m3;
  pull.reference_radius_m = radius;
  pull.grains.resize(2);
  for (auto& grain : pull.grains) {
    grain.radius_m = radius;
    grain.held = true;
  }
  const double start = -1e-3 * radius;  // in overlap, so that a bridge forms by any rule
  pull.duration_s = 1;
  pull.grains[1].centre_m = {2 * radius + start, 0, 0};
  pull.grains[1].velocity_m_s = {1.05 * reach - start, 0, 0};
  pull.step = ImpactStep::fixed;
  pull.step_s = pull.duration_s / kSteps;
  const std::vector<double> shares{0.02, 0.25, 0.5, 0.75, 0.98, 1.02};
  for (const double share : shares) pull.pull_gaps_m.push_back(share * reach);

  const auto outcome = engine.meet(pull);
  std::vector<CheckedReading> readings;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto name = "pull" + std::to_string(i) + "_n";
    const auto got = outcome.readings.find(name);
    readings.push_back(
        {format("law.attraction_n at %.2f d_c", shares[i]), attraction_n(material.contact, pair, -pull.pull_gaps_m[i]),
         got && !outcome.failure ? *got : std::numeric_limits<double>::infinity(), 1e-6 * at_touch, 1, 1});
  }
  return readings;
}

constexpr std::size_t kQuickPackings = 2;

/// True if checks compare the reading (`ReadingKind::checked`).
bool is_checked(const Test& test, const std::string& name) {
  const auto kinds = reading_kinds(test);
  const ReadingKind* kind = find_kind(kinds, name);
  return kind && kind->checked;
}

/// Expected reading of a card: from its single runs, or from mean and deviation if it has none.
struct Promise {
  std::string name;
  Sample sample;
};

std::vector<Promise> promises_of(const CardTest& test) {
  std::vector<Promise> out;
  if (test.baseline.runs.empty()) {
    for (const auto& reading : test.readings)
      if (is_checked(test.test, reading.name)) out.push_back({reading.name, reading.simulated});
    return out;
  }
  for (const auto& [name, value] : test.baseline.runs[0].readings.all())
    if (is_checked(test.test, name)) out.push_back({name, sample_of(column_of(test.baseline.runs, name))});
  return out;
}

std::vector<std::uint64_t> packings_of(const Card& card, const CardTest& test) {
  if (test.baseline.runs.empty()) return card.confirmation.packings;
  std::vector<std::uint64_t> out;
  for (const auto& run : test.baseline.runs) out.push_back(run.packing);
  return out;
}

/// Packings of the test with the most.
std::vector<std::uint64_t> packings_of(const Card& card) {
  std::vector<std::uint64_t> most;
  for (const auto& test : card.tests)
    if (auto packings = packings_of(card, test); packings.size() > most.size()) most = std::move(packings);
  return most;
}

/// Program of the card's readings.
std::string program_of(const Card& card) {
  for (const auto& test : card.tests)
    if (!test.baseline.runs.empty()) return test.baseline.program;
  return card.provenance.program;
}

/// The packings that are simulated.
std::vector<std::uint64_t> asked(std::vector<std::uint64_t> packings, const CheckOptions& options) {
  if (options.quick && packings.size() > kQuickPackings) packings.resize(kQuickPackings);
  return packings;
}

SameBits compare_bits(const std::vector<Baseline::Run>& before, const std::vector<Baseline::Run>& now) {
  if (before.empty()) return SameBits::not_comparable;
  for (std::size_t i = 0; i < now.size(); ++i)
    for (const auto& [name, value] : before[i].readings.all()) {
      const auto again = now[i].readings.find(name);
      if (!again || std::bit_cast<std::uint64_t>(*again) != std::bit_cast<std::uint64_t>(value)) return SameBits::other;
    }
  return SameBits::same;
}

/// Surface of this name in a test of the card; empty if there is none.
std::optional<WallContact> surface_of(const Card& card, std::string_view name) {
  for (const CardTest& of_card : card.tests) {
    Test test = of_card.test;
    for (const Surface& surface : surfaces_of(test))
      if (surface.name == name) return surface.contact;
  }
  return std::nullopt;
}

CardCheck failed(CardCheck out, const std::string& reason) {
  out.reason = reason;
  out.verdict = CheckVerdict::disagrees;
  return out;
}

void judge(CardCheck& out, const CheckOptions& options) {
  const auto wrong = std::ranges::count_if(out.readings, [](const auto& reading) { return !reading.agrees(); });
  const bool bits_matter = out.same_program || options.bits;
  if (wrong > 0)
    out.reason +=
        format("%ld of %zu readings lie outside their noise band. ", static_cast<long>(wrong), out.readings.size());
  if (out.bits == SameBits::other && out.same_program)
    out.reason += "The same program on the same type of machine must give the same bits; it did not. ";
  else if (out.bits == SameBits::other)
    out.reason += "The bits differ, because another program or machine made the card. ";
  const bool agrees = wrong == 0 && !(bits_matter && out.bits == SameBits::other);
  out.verdict = agrees ? CheckVerdict::agrees : CheckVerdict::disagrees;
}

}  // namespace

std::vector<Outcome> outcomes_of(const Test& test, const std::vector<std::uint64_t>& packings,
                                 const CheckEngine& engine, int threads) {
  std::vector<Outcome> outcomes(packings.size());
  WorkerPool pool(threads > 0 ? threads : processors());
  std::vector<std::shared_future<void>> done;
  for (std::size_t i = 0; i < packings.size(); ++i)
    done.push_back(pool.submit([&, i] {
      Test one = test;
      specimen_of(one).packing_seed = packings[i];
      RunOptions options;
      options.packing = engine.prepare(one, {});
      outcomes[i] = engine.run(one, options);
    }));
  for (const auto& one : done) one.get();  // rethrows exceptions of the engine
  return outcomes;
}

Fault failure_in(std::uint64_t packing, const Failure& failure, const std::string& heading) {
  return {heading + "packing " + std::to_string(packing),
          "failed (" + std::string(name_of(failure.reason)) + " in " + failure.phase + ")", failure.message};
}

Result<std::vector<Baseline::Run>> baseline_runs(const Test& test, const std::string& heading,
                                                 const std::vector<std::uint64_t>& packings, const CheckEngine& engine,
                                                 int threads) {
  std::vector<Outcome> outcomes = outcomes_of(test, packings, engine, threads);
  std::vector<Baseline::Run> runs;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (const auto& failure = outcomes[i].failure) return failure_in(packings[i], *failure, heading);
    runs.push_back({packings[i], std::move(outcomes[i].readings)});
  }
  return runs;
}

CheckEngine CheckEngine::ours() {
  CheckEngine engine;
  engine.program = program_identity();
  engine.machine = machine_type();
  return engine;
}

std::string_view name_of(CheckVerdict verdict) {
  constexpr std::array<std::string_view, 3> kNames{"agrees", "disagrees", "not checked"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string_view name_of(SameBits bits) {
  constexpr std::array<std::string_view, 3> kNames{"same", "not comparable", "other"};
  return kNames[static_cast<std::size_t>(bits)];
}

bool CheckedReading::agrees() const {
  return lie_within(band, got, expected);
}

Test with_material_of(const Card& card, Test test) {
  Specimen& specimen = specimen_of(test);
  const GrainSizes& grains = card.material.grains;
  const auto has_that_size = [](const CardTest& of_card) { return !why_of_that_size(of_card.test).empty(); };
  if (why_of_that_size(test).empty() && std::ranges::none_of(card.tests, has_that_size)) specimen.grains = grains;
  test = with_contact_of(std::move(test), values_of(card.material));
  specimen.contact = enlarged(card.material.contact, specimen.grains.radius_m / grains.radius_m);
  for (const Surface& surface : surfaces_of(test))
    surface.contact = surface_of(card, surface.name).value_or(surface.contact);
  return test;
}

int simulations_to_check(const Card& card, const CheckOptions& options) {
  std::size_t count = 0;
  for (const auto& test : card.tests) count += asked(packings_of(card, test), options).size();
  return static_cast<int>(count);
}

int simulations_to_check_against(const Card& card, const CheckOptions& options) {
  return static_cast<int>(std::max(asked(packings_of(card), options).size(), kQuickPackings));
}

CardCheck check(const Card& card, const CheckOptions& options, const CheckEngine& engine) {
  CardCheck out;
  out.card = title_of(card);
  out.false_alarm = options.false_alarm;
  out.same_program = std::ranges::all_of(card.tests, [&](const CardTest& test) {
    return test.baseline.program == engine.program && test.baseline.machine == engine.machine;
  });
  std::size_t promised = 0;
  for (const auto& test : card.tests) {
    const auto promises = promises_of(test);
    if (packings_of(card, test).size() < 2 || promises.empty()) {
      out.reason = heading_of(test) +
                   "The card has the readings of fewer than two packings, so their noise is unknown; use --rebaseline.";
      return out;
    }
    promised += promises.size();
  }
  const double share = options.false_alarm / static_cast<double>(promised);
  SameBits bits = SameBits::same;  // the worst of all tests
  for (const auto& test : card.tests) {
    const auto packings = asked(packings_of(card, test), options);
    const auto now = baseline_runs(test.test, heading_of(test), packings, engine, options.threads);
    out.simulations += static_cast<int>(packings.size());
    if (!now.ok()) return failed(std::move(out), message_of(now.faults()));
    for (const auto& [name, before] : promises_of(test)) {
      const auto again = sample_of(column_of(now.value(), name));
      if (again.count == 0)
        return failed(std::move(out), "The engine does not give the reading " + reading_name(test, name) + ".");
      out.readings.push_back({reading_name(test, name), before.mean, again.mean, band_of(before, again, share),
                              before.count, again.count});
    }
    bits = std::max(bits, compare_bits(test.baseline.runs, now.value()));
  }
  for (auto& reading : check_law(card.material, engine)) out.readings.push_back(std::move(reading));
  out.bits = bits;
  judge(out, options);
  return out;
}

CardCheck check_against(const Card& card, const Lab& lab, const CheckOptions& options, const CheckEngine& engine) {
  CardCheck out;
  out.card = title_of(card);
  out.false_alarm = options.false_alarm;
  Test test = with_material_of(card, lab.test);
  if (const auto faults = validate(test); !faults.empty()) {
    out.reason = "The card's grains do not fit the test of this laboratory file: " + message_of(faults);
    return out;
  }
  auto packings = asked(packings_of(card), options);
  if (packings.size() < 2) packings = {specimen_of(test).packing_seed, specimen_of(test).packing_seed + 1};
  const auto now = baseline_runs(test, "", packings, engine, options.threads);
  out.simulations = static_cast<int>(packings.size());
  if (!now.ok()) return failed(std::move(out), message_of(now.faults()));
  const auto runs = accepted(test, now.value());
  const double share = options.false_alarm / static_cast<double>(lab.measurements.size());
  for (const auto& measurement : lab.measurements) {
    const auto read = sample_of(column_of(runs, measurement.reading));
    if (read.count == 0) continue;
    const Sample measured{measurement.repeats, measurement.value, measurement.standard_deviation};
    out.readings.push_back({measurement.reading, measured.mean, read.mean, unequal_band_of(measured, read, share),
                            measured.count, read.count});
  }
  judge(out, options);
  return out;
}

Result<Card> rebaselined(Card card, const std::string& why, int count, const CheckOptions& options,
                         const CheckEngine& engine) {
  auto packings = packings_of(card);
  std::uint64_t fresh = 1;
  const auto taken = [&](std::uint64_t seed) {
    return std::ranges::count(packings, seed) + std::ranges::count(card.search.packings, seed) > 0;
  };
  while (packings.size() < std::max<std::size_t>(static_cast<std::size_t>(std::max(count, 0)), 2)) {
    while (taken(fresh)) ++fresh;
    packings.push_back(fresh);
  }
  Rebaseline change{why, program_of(card), engine.program, {}};
  for (CardTest& test : card.tests) {
    auto now = baseline_runs(test.test, heading_of(test), packings, engine, options.threads);
    if (!now.ok())
      return Fault{card.title, "has no new baseline: " + message_of(now.faults()), "calibrate the material again"};
    for (const auto& [name, before] : promises_of(test))
      change.moved.push_back({reading_name(test, name), before.mean, sample_of(column_of(now.value(), name)).mean});
    test.baseline = {engine.program, engine.machine, std::move(now).value()};
  }
  card.rebaselined.push_back(std::move(change));
  return card;
}

}  // namespace pastefit
