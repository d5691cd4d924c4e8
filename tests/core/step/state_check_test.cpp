#include "core/step/state_check.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/random.h"
#include "core/step/kernels.h"
#include "core/step/run_checkpoint.h"
#include "core/step/state.h"
#include "tests/core/apparatus/soft_granules.h"

namespace pastefit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Grains with bridges in a mould, few enough for a test of a second.
SlumpTest heap() {
  SlumpTest test;
  test.grains.radius_m = 0.02;
  test.lift_velocity_m_s = 0.3;
  const double r = test.grains.radius_m, c = 2000 * r * r;
  test.contact.youngs_modulus_pa = 5e6;
  test.contact.bridge = {
      BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / (0.8 * r), c, -0.8 * r, 0.2 * r, 0, 0, 0};
  return test;
}

/// The world of a heap whose mould is being lifted.
World world_in_the_midst() {
  RunOptions options;
  std::optional<World> world;
  int seen = 0;
  options.pulse = [&](const Snapshot& snapshot) {
    if (snapshot.phase == "step1.lift" && ++seen == 3) world = *snapshot.world;
    return !world;
  };
  (void)simulate(heap(), options);
  return world.value();
}

using Forge = std::function<void(World&)>;

struct Forgery {
  const char* name;
  Forge forge;
};

ContactList& contacts_of(World& world) {
  return world.pairs.blocks.at(0).contacts;
}

BridgeList& bridges_of(World& world) {
  return world.pairs.blocks.at(0).bridges;
}

Wall& mould_of(World& world) {
  return *std::ranges::find_if(world.walls, [](const Wall& wall) { return std::holds_alternative<Shell>(wall.shape); });
}

/// The first list of contacts with a wall that has two at least.
WallContacts& touching_of(World& world) {
  for (WallContacts& touching : world.pairs.blocks.at(0).walls)
    if (touching.count > 1) return touching;
  throw std::logic_error("nothing touches a wall");
}

std::vector<Forgery> forgeries() {
  return {
      {"a grain that stands twice", [](World& w) { w.particles.identity[1] = w.particles.identity[0]; }},
      {"a grain below the first", [](World& w) { w.particles.identity[0] = -1; }},
      {"a grain beyond the last", [](World& w) { w.particles.identity[0] = w.particles.count(); }},
      {"a grain too few", [](World& w) { w.particles.identity.pop_back(); }},
      {"a grain too many", [](World& w) { w.particles.identity.push_back(w.particles.count()); }},
      {"no motion of the last grains", [](World& w) { w.particles.motion.resize(3); }},
      {"more velocities than grains", [](World& w) { w.particles.velocity.emplace_back(); }},
      {"no loads", [](World& w) { w.particles.load.clear(); }},
      {"a grain of another size", [](World& w) { w.particles.motion[2].radius *= 2; }},
      {"a grain below any size", [](World& w) { w.particles.motion[2].radius = -1; }},
      {"a grain without mass", [](World& w) { w.particles.velocity[2].inverse_mass = 0; }},
      {"a grain of another inertia", [](World& w) { w.particles.velocity[2].inverse_inertia *= 3; }},
      {"a grain nowhere", [](World& w) { w.particles.motion[2].position.x = kNan; }},
      {"a grain on the moon", [](World& w) { w.particles.motion[2].position.z = 3.8e8; }},
      {"a grain faster than light", [](World& w) { w.particles.velocity[2].linear.x = 1e9; }},
      {"a grain with no speed", [](World& w) { w.particles.velocity[2].linear.x = kNan; }},
      {"a grain with no spin", [](World& w) { w.particles.velocity[2].angular.y = kNan; }},
      {"a grain with no rounded speed", [](World& w) { w.particles.motion[2].velocity[0] = std::nanf(""); }},
      {"a load without end", [](World& w) { w.particles.load[2].force[1] = INFINITY; }},
      {"a wall of another kind", [](World& w) { mould_of(w).shape = Ribs{}; }},
      {"a wall of another size", [](World& w) { std::get<Shell>(mould_of(w).shape).base_radius *= 2; }},
      {"a wall nowhere", [](World& w) { std::get<Shell>(mould_of(w).shape).base.x = kNan; }},
      {"a wall faster than any", [](World& w) { mould_of(w).velocity.z = 1e5; }},
      {"a wall with no force on it", [](World& w) { mould_of(w).force.z = kNan; }},
      {"no blocks", [](World& w) { w.pairs.blocks.clear(); }},
      {"a block that ends beyond the grains", [](World& w) { w.pairs.blocks.back().grains_end += 1; }},
      {"a block that begins elsewhere", [](World& w) { w.pairs.blocks.front().grains = 1; }},
      {"more blocks than dummies", [](World& w) { w.pairs.blocks.resize(w.pairs.blocks.size() + 1); }},
      {"a contact of a grain beyond the last", [](World& w) { contacts_of(w).batches[0].i[0] = 1'000'000; }},
      {"a contact of a grain below the first", [](World& w) { contacts_of(w).batches[0].j[0] = -5; }},
      {"a contact of a grain with itself", [](World& w) { contacts_of(w).batches[0].j[0] = contacts_of(w).first(0); }},
      {"more contacts than there is room for", [](World& w) { contacts_of(w).count = 1'000'000 * kBatch; }},
      {"fewer contacts than none", [](World& w) { contacts_of(w).count = -kBatch; }},
      {"a stretch of half a batch", [](World& w) { contacts_of(w).near += 1; }},
      {"stretches out of order", [](World& w) { contacts_of(w).near = contacts_of(w).count + kBatch; }},
      {"a contact without slip", [](World& w) { contacts_of(w).batches[0].slip[1][0] = std::nanf(""); }},
      {"a contact without a damper", [](World& w) { contacts_of(w).batches[0].damper[0] = INFINITY; }},
      {"a bridge to a grain beyond the last", [](World& w) { bridges_of(w).batches[0].j[0] = 1'000'000; }},
      {"a bridge without size", [](World& w) { bridges_of(w).batches[0].size_scale[0] = std::nanf(""); }},
      {"more bridges than there is room for", [](World& w) { bridges_of(w).count = 1'000'000 * kBatch; }},
      {"no candidates", [](World& w) { w.pairs.blocks[0].candidates.clear(); }},
      {"a candidate beyond the last grain",
       [](World& w) {
         bool first = true;
         w.pairs.blocks[0].candidates.each(0, [&](NeighbourList::Pair& pair, std::int32_t) {
           if (std::exchange(first, false)) pair = NeighbourList::Pair(500'000'000);
         });
       }},
      {"candidates in no list that there is",
       [](World& w) {
         w.pairs.blocks[0].candidates.each(
             0, [](NeighbourList::Pair& pair, std::int32_t) { pair.keep(NeighbourList::kinds); });
       }},
      {"more candidates kept than the lists have",
       [](World& w) {
         w.pairs.blocks[0].candidates.each(
             0, [](NeighbourList::Pair& pair, std::int32_t) { pair.keep(NeighbourList::touching); });
       }},
      {"a wall that touches more than it lists", [](World& w) { touching_of(w).count = 1'000'000; }},
      {"a wall that touches a grain beyond the last",
       [](World& w) { touching_of(w).contacts.batches[0].i[0] = 1'000'000; }},
      {"a wall's list out of order",
       [](World& w) { touching_of(w).contacts.batches[0].i[1] = touching_of(w).contacts.first(0); }},
      {"lists of another number of walls", [](World& w) { w.pairs.blocks[0].walls.pop_back(); }}};
}

void check(const Fixtures& fixtures, const World& world) {
  fixtures.check(world);
  check_pairs(world, true);
}

TEST_CASE("a world that was forged is refused, in whatever it is not that of the run") {
  const World world = world_in_the_midst();
  const Fixtures fixtures(world);
  REQUIRE_NOTHROW(check(fixtures, world));
  REQUIRE(world.walls.size() > 1);
  CHECK(forgeries().size() >= 24);
  for (const Forgery& forgery : forgeries()) {
    INFO(forgery.name);
    World forged = world;
    forgery.forge(forged);
    CHECK_THROWS_AS(check(fixtures, forged), BadState);
  }
}

/// The state of a heap whose mould is being lifted, as bytes.
std::string state_in_the_midst() {
  RunOptions options;
  std::string kept;
  int lifting = 0;
  options.checkpoint =
      std::make_shared<RunCheckpoint>([&] { return lifting == 2; }, [&](const std::string& state) { kept = state; });
  options.pulse = [&](const Snapshot& snapshot) {
    if (snapshot.phase == "step1.lift") ++lifting;
    return lifting < 3;
  };
  (void)simulate(heap(), options);
  REQUIRE(kept.size() > 10'000);
  return kept;
}

enum class Answer { refused, failed, went_on };

/// What comes of a run that goes on from these bytes, for a moment.
template <class Test>
Answer answer_of(const Test& test, const std::string& state, RunOptions options) {
  int seen = 0;
  options.pulse = [&](const Snapshot&) { return ++seen < 3; };
  try {
    options.checkpoint = std::make_shared<RunCheckpoint>([] { return false; }, [](const std::string&) {}, state);
    const Outcome outcome = simulate(test, options);
    if (!options.checkpoint->is_told()) return Answer::refused;
    return outcome.failure && outcome.failure->reason != FailureReason::stopped ? Answer::failed : Answer::went_on;
  } catch (const BadState&) {
    return Answer::refused;
  }
}

Answer answer_to(const std::string& state) {
  return answer_of(heap(), state, {});
}

TEST_CASE("a state that lacks something, or has more than the run, is refused") {
  const std::string state = state_in_the_midst();
  REQUIRE(answer_to(state) == Answer::went_on);
  CHECK(answer_to(state + "x") == Answer::refused);
  for (const double share : {0.001, 0.1, 0.5, 0.9, 0.999})
    CHECK(answer_to(state.substr(0, static_cast<std::size_t>(share * static_cast<double>(state.size())))) ==
          Answer::refused);
  // The number of waits that have ended stands first.
  for (const std::uint64_t waits : {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::string forged = state;
    std::memcpy(forged.data(), &waits, sizeof waits);
    CHECK(answer_to(forged) == Answer::refused);
  }
}

TEST_CASE("whatever word of a state is forged, the run refuses it, fails with a reason, or goes on") {
  const std::uint64_t words[] = {0,
                                 1,
                                 ~std::uint64_t{0},
                                 std::uint64_t{1} << 63,
                                 0x7ff8000000000000,   // not a number
                                 0x7ff0000000000000,   // infinite
                                 0x7fefffffffffffff,   // the largest
                                 0xc1cdcd6500000000,   // -1e9
                                 0x7fc000007fc00000,   // two of single precision that are none
                                 0x7fffffff7fffffff};  // two whole numbers, the largest
  const std::string state = state_in_the_midst();
  const RandomStream random(1, "forged states");
  int refused = 0;
  constexpr int kForged = 120;
  for (std::uint64_t k = 0; k < kForged; ++k) {
    // Half of them near the end, where the counters are and not the many grains.
    const std::size_t reach = k % 2 == 0 ? state.size() - 8 : std::min<std::size_t>(state.size() - 8, 2000);
    const std::size_t place = state.size() - 8 - random.bits(2 * k) % reach / 4 * 4;
    std::string forged = state;
    std::memcpy(forged.data() + place, &words[random.bits(2 * k + 1) % std::size(words)], 8);
    INFO("word " << k << " at " << place);
    if (answer_to(forged) == Answer::refused) ++refused;
  }
  CHECK(refused >= 24);  // many a word may be anything: a load, a speed, a place
}

/// The state of a run after so many pulses, as bytes.
template <class Test>
std::string state_after(const Test& test, int pulses, RunOptions options) {
  std::string kept;
  int seen = 0;
  options.checkpoint =
      std::make_shared<RunCheckpoint>([&] { return seen == pulses; }, [&](const std::string& now) { kept = now; });
  options.pulse = [&](const Snapshot&) { return ++seen <= pulses; };
  (void)simulate(test, options);
  return kept;
}

/// Forges every stretch of a state by each of the numbers that none can be.
template <class Test>
void check_stretches(const Test& test, int pulses) {
  constexpr std::size_t kStretch = 512;
  const std::uint64_t words[] = {0x7ff8000000000000,   // not a number
                                 0x7ff0000000000000,   // infinite
                                 0x7f7f7f7f7f7f7f7f};  // 1.4e306 in double, 3.4e38 in single precision
  for (const KernelTable* kernels : kernels_this_processor_runs()) {
    RunOptions options;
    options.steps.kernels = kernels;
    const std::string state = state_after(test, pulses, options);
    INFO(kernels->instruction_set << ", after " << pulses << " pulses, " << state.size() << " bytes");
    REQUIRE(state.size() > 10'000);
    REQUIRE(answer_of(test, state, options) == Answer::went_on);
    for (const std::uint64_t word : words)
      for (std::size_t place = 0; place + kStretch <= state.size(); place += kStretch) {
        std::string forged = state;
        for (std::size_t k = 0; k < kStretch; k += sizeof word)
          std::memcpy(forged.data() + place + k, &word, sizeof word);
        INFO(std::hex << word << std::dec << " at " << place);
        CHECK(answer_of(test, forged, options) == Answer::refused);
      }
  }
}

TEST_CASE("a stretch of impossible numbers is refused wherever in a state of a heap it stands") {
  check_stretches(heap(), 3);
}

TEST_CASE("a stretch of impossible numbers is refused wherever in a state of a pellet it stands") {
  for (const int pulses : {10, 60}) check_stretches(small_pellet(1.0), pulses);
}

TEST_CASE("a stretch of impossible numbers is refused wherever in a state of a shear cell it stands") {
  for (const int pulses : {10, 60}) check_stretches(small_cell(0.5), pulses);
}

}  // namespace
}  // namespace pastefit
