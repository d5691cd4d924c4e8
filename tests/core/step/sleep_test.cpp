#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/random.h"
#include "core/step/stepper.h"

using namespace pastefit;

namespace {

constexpr double kRadius = 0.01;
constexpr int kAcross = 5, kLayers = 6;
constexpr double kSide = kAcross * 2.2 * kRadius;
constexpr std::size_t kFloor = 0;

ContactModel material(bool sticky) {
  ContactModel model;
  model.youngs_modulus_pa = 2e6;
  model.restitution = 0.3;
  model.friction = 0.5;
  model.rolling_friction = 0.1;
  if (sticky) {
    const double c = 2000 * kRadius * kRadius;
    model.bridge = {BridgeShape::polynomial,
                    BridgeFormation::film,
                    0,
                    c / (0.8 * kRadius),
                    c,
                    -0.8 * kRadius,
                    0.2 * kRadius,
                    0,
                    0,
                    0};
  }
  return model;
}

/// Grains that fall into a box; with a stepper of its own.
struct Bed {
  World world;
  StepOptions options;
  std::unique_ptr<Stepper> stepper;

  explicit Bed(bool sticky) {
    const RandomStream jitter(1, "bed");
    std::vector<Vec3> centres;
    for (std::uint64_t n = 0; n < kAcross * kAcross * kLayers; ++n) {
      const auto x = static_cast<double>(n % kAcross), y = static_cast<double>(n / kAcross % kAcross);
      const auto z = static_cast<double>(n / (kAcross * kAcross));
      const auto nudge = [&](std::uint64_t k) { return jitter.uniform(3 * n + k, -0.1, 0.1); };
      centres.push_back(kRadius * Vec3{1.1 + 2.2 * x + nudge(0), 1.1 + 2.2 * y + nudge(1), 1.2 + 2.2 * z + nudge(2)});
    }
    world.particles = make_particles(centres, std::vector<double>(centres.size(), kRadius), 2500);
    const ContactModel model = material(sticky);
    set_contact_model(world, model, kRadius);
    for (const Plane& side : {Plane{}, Plane{{}, {1, 0, 0}}, Plane{{kSide, 0, 0}, {-1, 0, 0}}, Plane{{}, {0, 1, 0}},
                              Plane{{0, kSide, 0}, {0, -1, 0}}}) {
      Wall wall;
      wall.shape = side;
      wall.pair = wall_pair(model, {2e6, 0.3, 0.3, 0.5, 0.1, 0}, kRadius);
      world.walls.push_back(wall);
    }
  }

  /// Goes on from the world as it is, contacts with their memory included.
  void start(bool sleep) {
    options.sleep = sleep;
    stepper = std::make_unique<Stepper>(world, options);
  }
  void run(double duration) {
    const double end = world.time + duration;
    while (world.time < end) REQUIRE_FALSE(stepper->step({}));
  }
  /// The energy balance of this very moment, but for the steps to its next look.
  const EnergyBalance& looked_at() {
    do REQUIRE_FALSE(stepper->step({}));
    while (world.step % Stepper::kLedgerInterval != 1);
    return stepper->energy_balance();
  }
  /// Runs until all grains sleep, for `longest` at most.
  bool fall_asleep(double longest) {
    const double end = world.time + longest;
    while (world.time < end && stepper->sleeping() < world.particles.count()) REQUIRE_FALSE(stepper->step({}));
    return stepper->sleeping() == world.particles.count();
  }

  std::vector<Vec3> places() const {
    std::vector<Vec3> places(world.particles.count());
    for (std::int32_t i = 0; i < world.particles.count(); ++i)
      places[world.particles.identity[i]] = world.particles.motion[i].position;
    return places;
  }
  double mean_height() const {
    double sum = 0;
    for (const Vec3& place : places()) sum += place.z;
    return sum / world.particles.count();
  }
  double weight() const {
    double sum = 0;
    for (std::int32_t i = 0; i < world.particles.count(); ++i) sum += world.particles.mass(i) * world.gravity;
    return sum;
  }
};

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

/// A bed in which nothing moves any more, all of it asleep if so asked.
Bed settled(bool sticky, bool sleep) {
  Bed bed(sticky);
  bed.start(false);
  bed.run(8);
  bed.start(sleep);
  if (sleep) REQUIRE(bed.fall_asleep(12));
  return bed;
}

/// How far a contact that carries one weight gives way under the fifth of a weight that a sleeper may have left over.
double give_of_a_sleeper(const Bed& bed) {
  const double weight = bed.world.particles.mass(0) * bed.world.gravity;
  const double overlap = std::pow(weight / (bed.world.grain_pair.hertz * std::sqrt(0.5 * kRadius)), 2.0 / 3);
  return 0.2 * overlap * 2 / 3;
}

/// What the pairs of the lists remember, by identity.
std::map<std::pair<std::int32_t, std::int32_t>, Contact> memory_of(const World& world) {
  std::map<std::pair<std::int32_t, std::int32_t>, Contact> memory;
  for (const Block& block : world.pairs.blocks)
    for (std::int32_t k = 0; k < block.contacts.count; ++k) {
      const std::int32_t i = block.contacts.first(k), j = block.contacts.second(k);
      if (i == j) continue;  // padding
      const std::int32_t a = world.particles.identity[i], b = world.particles.identity[j];
      const Contact contact = block.contacts.contact(k);
      memory[std::minmax(a, b)] = a < b ? contact : contact.turned();
    }
  return memory;
}

struct Mean {
  double value = 0, error = 0;
};
Mean mean_of(const std::vector<double>& values) {
  Mean mean;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean.value += v / n;
  for (const double v : values) mean.error += (v - mean.value) * (v - mean.value);
  mean.error = std::sqrt(mean.error / (n - 1) / n);
  return mean;
}

}  // namespace

TEST_CASE("a settled bed sleeps wholly, stays where it is, and weighs on its floor what it weighs") {
  for (const bool sticky : {false, true}) {
    Bed bed = settled(sticky, true), awake = settled(sticky, false);
    const std::vector<Vec3> before = bed.places();
    bed.run(0.5);
    awake.run(0.5);
    INFO((sticky ? "sticky, differs by " : "dry, differs by ")
         << largest_distance(bed.places(), awake.places()) / kRadius << " R");
    CHECK(bed.stepper->sleeping() == bed.world.particles.count());
    // What holds a sleeper up is its weight in 24 bits: the rest moves it by g dt t.
    const double drift = kGravity * bed.stepper->time_step() * 0.5 / (1 << 24);
    CHECK(largest_distance(bed.places(), before) <= drift);
    CHECK(drift < 1e-6 * kRadius);
    CHECK(largest_distance(bed.places(), awake.places()) < kLayers * give_of_a_sleeper(bed));
    const double carried = -bed.world.walls[kFloor].force.z;
    CHECK(carried == Approx(-awake.world.walls[kFloor].force.z).epsilon(0.01));
    CHECK(bed.stepper->energy_balance().dissipation_sleep > 0);
    CHECK(std::fabs(bed.looked_at().error()) < 1e-3 * bed.weight() * kRadius);
  }
}

TEST_CASE("pairs wake with exactly the memory they fell asleep with") {
  for (const bool sticky : {false, true}) {
    Bed bed = settled(sticky, true);
    const auto before = memory_of(bed.world);
    bed.stepper->forget_lists();  // wakes all and sorts them anew
    bed.run(1e-9);
    CHECK(bed.stepper->sleeping() == 0);
    const auto after = memory_of(bed.world);
    int touching = 0;
    for (const auto& [pair, memory] : before) {
      if (memory.sqrt_contact_radius == 0) continue;
      ++touching;
      REQUIRE(after.contains(pair));
      const Contact& now = after.at(pair);
      CHECK(now.bridge == memory.bridge);
      CHECK(now.sqrt_contact_radius == Approx(memory.sqrt_contact_radius));
      for (int c = 0; c < 3; ++c) {
        CHECK(now.slip[c] == Approx(memory.slip[c]).margin(1e-9 * kRadius));
        CHECK(now.roll[c] == Approx(memory.roll[c]).margin(1e-9));
      }
    }
    CHECK(touching > bed.world.particles.count());
  }
}

TEST_CASE("a grain that falls on a sleeping bed wakes what it reaches, and all ends as if none had slept") {
  std::vector<Vec3> places[2];
  double give = 0;
  for (const bool sleep : {false, true}) {
    Bed bed = settled(true, false);
    give = give_of_a_sleeper(bed);
    auto& motion = bed.world.particles.motion;
    const auto top = std::max_element(motion.begin(), motion.begin() + bed.world.particles.count(),
                                      [](const Motion& a, const Motion& b) { return a.position.z < b.position.z; });
    top->position.z += 15 * kRadius;
    bed.start(sleep);
    bed.run(0.15);
    const std::int64_t before = bed.stepper->sleeping();
    std::int64_t fewest = before;
    for (int n = 0; n < 1000; ++n) {
      bed.run(0.005);
      fewest = std::min(fewest, bed.stepper->sleeping());
    }
    places[sleep] = bed.places();
    const EnergyBalance& energy_balance = bed.looked_at();
    CHECK(std::fabs(energy_balance.error()) < 3e-3 * energy_balance.put_in());
    if (!sleep) continue;
    INFO(before << " slept before, at least " << fewest << " then, " << bed.stepper->sleeping() << " at the end");
    CHECK(before > bed.world.particles.count() / 2);
    CHECK(fewest < before / 2);
    CHECK(bed.stepper->sleeping() == bed.world.particles.count());
  }
  INFO("differs by " << largest_distance(places[0], places[1]) / give << " gives");
  CHECK(largest_distance(places[0], places[1]) < kLayers * give);
}

TEST_CASE("a wall that moves wakes the bed on it and carries it along") {
  for (const bool sticky : {false, true}) {
    double rise[2] = {}, error[2] = {};
    for (const bool sleep : {false, true}) {
      Bed bed = settled(sticky, sleep);
      (void)bed.looked_at();  // the balance starts before the wall does
      const double before = bed.mean_height();
      bed.world.walls[kFloor].velocity = {0, 0, 0.02};
      bed.run(0.1);
      rise[sleep] = bed.mean_height() - before;
      const EnergyBalance& energy_balance = bed.looked_at();
      error[sleep] = energy_balance.error() / energy_balance.put_in();
      CHECK(bed.stepper->sleeping() == 0);
    }
    INFO((sticky ? "sticky" : "dry"));
    CHECK(rise[0] > 0.75 * 0.1 * 0.02);  // the sides hold some of it back
    CHECK(rise[1] == Approx(rise[0]).epsilon(0.01));
    // The wall's speed jumps, which costs the balance some thousandths, asleep or not.
    CHECK(error[1] == Approx(error[0]).margin(5e-4));
  }
}

TEST_CASE("a grain that lands wakes the sleepers it hits and leaves those it does not reach") {
  // A row of pairs of grains, one on the other, on a floor; a grain falls on the first pair.
  World world;
  std::vector<Vec3> centres;
  for (int n = 0; n < 20; ++n)
    for (int layer = 0; layer < 2; ++layer) centres.push_back({3 * n * kRadius, 0, (1 + 1.999 * layer) * kRadius});
  centres.push_back({0, 0, 16 * kRadius});
  world.particles = make_particles(centres, std::vector<double>(centres.size(), kRadius), 2500);
  ContactModel model = material(false);
  model.rolling_friction = 0.5;
  set_contact_model(world, model, kRadius);
  world.walls.resize(1);
  world.walls[0].pair = wall_pair(model, {2e6, 0.3, 0.3, 0.5, 0.5, 0}, kRadius);
  StepOptions options;
  options.sleep = true;
  options.fixed_step_s = 5e-5;
  Stepper stepper(world, options);
  std::int64_t most = 0, fewest_after = 40;
  for (int n = 0; n < 6000; ++n) {
    REQUIRE_FALSE(stepper.step({}));
    most = std::max(most, stepper.sleeping());
    if (most == 40) fewest_after = std::min(fewest_after, stepper.sleeping());
  }
  CHECK(most >= 40);
  CHECK(fewest_after == 38);
  CHECK(std::fabs(stepper.energy_balance().error()) < 1e-3 * stepper.energy_balance().put_in());
}

TEST_CASE("a two-step slump test reads the same with sleep and without, dry and as paste", "[campaign]") {
  for (const double strength_pa : {0.0, 1000.0}) {
    std::vector<double> changes[3];
    double asleep = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      SlumpTest test;
      test.grains.radius_m = 0.014;
      test.packing_seed = seed;
      test.lift_velocity_m_s = 0.2;
      test.drop = DropPlate{};
      test.contact.friction = 0.3;
      const double r = test.grains.radius_m, c = strength_pa * r * r;
      if (c > 0)
        test.contact.bridge = {
            BridgeShape::polynomial, BridgeFormation::film, 0, c / (0.8 * r), c, -0.8 * r, 0.4 * r, 0, 0, 0};
      RunOptions options;
      options.packing = fill_mould(test);
      const Outcome awake = simulate(test, options);
      options.steps.sleep = true;
      const Outcome sleeping = simulate(test, options);
      REQUIRE_FALSE(awake.failure);
      REQUIRE_FALSE(sleeping.failure);
      CHECK(awake.run.asleep_share == 0);
      asleep += sleeping.run.asleep_share;
      CHECK(std::fabs(sleeping.run.energy_error.value()) < 2 * std::fabs(awake.run.energy_error.value()) + 1e-4);
      const char* names[] = {"step1.height_mm", "step2.height_mm", "step2.plateau_sag_mm"};
      for (int k = 0; k < 3; ++k)
        changes[k].push_back(*sleeping.observables.find(names[k]) - *awake.observables.find(names[k]));
    }
    CHECK(asleep > 0);
    for (const auto& change : changes) {
      const Mean mean = mean_of(change);
      INFO("strength " << strength_pa << " Pa: " << mean.value << " +- " << mean.error << " mm");
      CHECK(std::fabs(mean.value) < 3 * mean.error + 0.5);
    }
  }
}
