#include "tests/bench/speed/roofline.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "calibrate/base/machine.h"
#include "core/laws/contact.h"
#include "core/step/kernels.h"
#include "tests/bench/speed/measure.h"
#include "tests/bench/speed/scene.h"

namespace pastefit {

namespace {

volatile double sink;  // keeps what is measured from being optimised away

/// A number that counts what is done with it. Its value is of no interest.
struct Counted {
  double v = 1;
  Counted() = default;
  Counted(double value) : v(value) {}
  inline static int simple = 0, roots = 0, divisions = 0;
  static Counted done(double value) {
    ++simple;
    return Counted(value);
  }
  friend Counted operator+(Counted a, Counted b) { return done(a.v + b.v); }
  friend Counted operator-(Counted a, Counted b) { return done(a.v - b.v); }
  friend Counted operator*(Counted a, Counted b) { return done(a.v * b.v); }
  friend Counted operator-(Counted a) { return done(-a.v); }
  friend Counted operator/(Counted a, Counted b) {
    ++divisions;
    return Counted(a.v / b.v);
  }
  friend bool operator<(Counted a, Counted b) { return ++simple, a.v < b.v; }
  friend bool operator>(Counted a, Counted b) { return ++simple, a.v > b.v; }
  friend bool operator<=(Counted a, Counted b) { return ++simple, a.v <= b.v; }
  friend bool operator>=(Counted a, Counted b) { return ++simple, a.v >= b.v; }
  friend Counted select(bool mask, Counted yes, Counted no) { return done(mask ? yes.v : no.v); }
  friend Counted fused(Counted a, Counted b, Counted c) { return done(a.v * b.v + c.v); }
  friend Counted larger(Counted a, Counted b) { return done(std::max(a.v, b.v)); }
  friend Counted smaller(Counted a, Counted b) { return done(std::min(a.v, b.v)); }
  friend Counted square_root(Counted a) {
    ++roots;
    return Counted(std::sqrt(std::max(a.v, 0.0)));
  }
};

/// What the pair kernel does besides the law: from two grains to their kinematics, and from a contact force to two
/// loads.
void count_geometry() {
  using Vector = BasicVec3<Counted>;
  const Vector p{}, v{}, w{};
  const Counted r(1.0);
  const Vector between = p - p;
  const Counted square = dot(between, between), reach = r + r;
  const Counted distance = square_root(larger(square, r));
  const Vector normal = (Counted(1.0) / distance) * between;
  const Counted overlap = (reach * reach - square) / (reach + distance);
  const Counted half_depth = Counted(0.5) * larger(overlap, Counted(0.0));
  const Counted lever_a = r - half_depth, lever_b = r - half_depth;
  const Vector velocity = v - v + cross(lever_a * w + lever_b * w, normal);
  const Vector spin = w - w;
  const Counted twist = Counted(0.5) * dot(w + w, normal), damping = r + r;
  const Vector force = velocity - twist * normal, turning = cross(normal, force);
  const Vector torque_a = lever_a * turning + spin, torque_b = lever_b * turning - spin;
  Counted sums = damping;
  for (int k = 0; k < 16; ++k) sums = sums + torque_a.x;  // both loads
  for (int k = 0; k < 5; ++k) sums = sums + torque_b.x;   // energies
  const Vector on_other{-force.x, -force.y, -force.z};
  sink = sums.v + on_other.x.v;
}

volatile float unknown = 1;  // to the compiler, which else computes constant chains itself, or equal ones once

// Peaks: as many independent chains as hide the latency of an operation, in registers.
#define PASTEFIT_PEAKS(name, options, type, set, add, mul, root, div, store)   \
  __attribute__((target(options))) double name##_simple(std::int64_t rounds) { \
    type x[16];                                                                \
    for (type & chain : x) chain = set(unknown);                               \
    const type factor = set(0.999F * unknown), term = set(0.002F * unknown);   \
    for (std::int64_t n = 0; n < rounds; ++n)                                  \
      for (type & chain : x) chain = add(mul(chain, factor), term);            \
    for (int k = 1; k < 16; ++k) x[0] = add(x[0], x[k]);                       \
    float out[16];                                                             \
    store(out, x[0]);                                                          \
    return out[0];                                                             \
  }                                                                            \
  __attribute__((target(options))) double name##_roots(std::int64_t rounds) {  \
    type x[8];                                                                 \
    for (type & chain : x) chain = set(2.0F * unknown);                        \
    const type top = set(3.0F * unknown);                                      \
    for (std::int64_t n = 0; n < rounds; ++n)                                  \
      for (int k = 0; k < 8; ++k) x[k] = k < 5 ? root(x[k]) : div(top, x[k]);  \
    for (int k = 1; k < 8; ++k) x[0] = add(x[0], x[k]);                        \
    float out[16];                                                             \
    store(out, x[0]);                                                          \
    return out[0];                                                             \
  }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in GCC's own header (GCC bug 105593)
PASTEFIT_PEAKS(avx512, "avx512f", __m512, _mm512_set1_ps, _mm512_add_ps, _mm512_mul_ps, _mm512_sqrt_ps, _mm512_div_ps,
               _mm512_storeu_ps)
#pragma GCC diagnostic pop
PASTEFIT_PEAKS(avx2, "avx2", __m256, _mm256_set1_ps, _mm256_add_ps, _mm256_mul_ps, _mm256_sqrt_ps, _mm256_div_ps,
               _mm256_storeu_ps)
PASTEFIT_PEAKS(sse2, "sse2", __m128, _mm_set1_ps, _mm_add_ps, _mm_mul_ps, _mm_sqrt_ps, _mm_div_ps, _mm_storeu_ps)
#undef PASTEFIT_PEAKS

constexpr double kAnyCore = 1e12;  // operations per second: more than one core does

/// Operations per second of a loop, the best of a few runs. Throws if it was optimised away.
double rate(double (*loop)(std::int64_t), std::int64_t rounds, double operations_per_round) {
  double best = 0;
  for (int n = 0; n < 5; ++n) {
    const double start = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    sink = loop(rounds);
    best = std::max(best, operations_per_round * static_cast<double>(rounds) /
                              (processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - start));
  }
  if (!(best < kAnyCore)) throw std::runtime_error("a loop that measures the machine was optimised away");
  return best;
}

double triad_bytes_per_second() {
  constexpr std::size_t kLength = 1 << 25;  // 256 MiB a column
  std::vector<double> a(kLength, 0.0), b(kLength, 1.0), c(kLength, 2.0);
  double best = 0;
  for (int n = 0; n < 5; ++n) {
    const double start = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    for (std::size_t k = 0; k < kLength; ++k) a[k] = b[k] + 3.0 * c[k];
    best = std::max(best, 3 * sizeof(double) * static_cast<double>(kLength) /
                              (processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - start));
    sink = a[kLength / 2];
  }
  return best;
}

}  // namespace

MachineLimits measure_machine() {
  MachineLimits m;
  const KernelTable& kernels = kernels_of_this_processor();
  m.lanes = &kernels == &four_lanes::kernels ? 4 : &kernels == &avx2::kernels ? 8 : 16;
  const auto simple = m.lanes == 16 ? avx512_simple : m.lanes == 8 ? avx2_simple : sse2_simple;
  const auto roots = m.lanes == 16 ? avx512_roots : m.lanes == 8 ? avx2_roots : sse2_roots;
  m.instruction_set = kernels.instruction_set;
  m.gflop_s = 1e-9 * rate(simple, 10'000'000, 32.0 * m.lanes);
  m.roots_gop_s = 1e-9 * rate(roots, 1'000'000, 8.0 * m.lanes);
  m.triad_gb_s = 1e-9 * triad_bytes_per_second();
  return m;
}

ContactCost cost_of_contact(bool cohesive) {
  Counted::simple = Counted::roots = Counted::divisions = 0;
  count_geometry();
  const ContactKinematics<Counted> kinematics{};
  ContactHistory<Counted> history{};
  const auto pair = in_lanes<Counted>(grain_pair(scene_material(cohesive), kSceneRadius));
  if (cohesive)
    act<Hertz, PolynomialAttraction, SpringDashpotRolling, false>(pair, kinematics, history, Counted(kSceneStep),
                                                                  Energies::dissipation);
  else
    act<Hertz, NoAttraction, SpringDashpotRolling, false>(pair, kinematics, history, Counted(kSceneStep),
                                                          Energies::dissipation);
  ContactCost cost;
  cost.additions_multiplications = Counted::simple;
  cost.roots_divisions = Counted::roots + Counted::divisions;
  // Columns of Contacts: two indices, three constants, and the history, which goes back too.
  cost.bytes_streamed = 2 * sizeof(std::int32_t) + 3 * sizeof(float) + 2 * sizeof(ContactHistory<float>);
  cost.bytes_gathered = 2 * (sizeof(Motion) + 2 * sizeof(Load));
  return cost;
}

double Roofline::share_of_limit() const {
  return std::max({memory_ns, arithmetic_ns, roots_ns}) / contact_ns;
}

Roofline measure_roofline() {
  Roofline r;
  r.scene = "box-100k";
  const SceneResult box = measure(r.scene, {.energy_balance = true});
  if (!box.ours().measured()) throw std::runtime_error(box.ours().problem);
  double contacts = 0;
  for (const auto& [name, value] : box.ours().notes)
    if (name == "contacts_per_grain") contacts = value;
  r.machine = measure_machine();
  r.cost = cost_of_contact(false);
  r.contact_ns = 1e9 / (box.particle_steps_per_s(box.ours()) * contacts);
  r.memory_ns = r.cost.bytes_streamed / r.machine.triad_gb_s;
  r.arithmetic_ns = r.cost.additions_multiplications / r.machine.gflop_s;
  r.roots_ns = r.cost.roots_divisions / r.machine.roots_gop_s;
  return r;
}

std::string table_of(const Roofline& r) {
  char text[1400];
  std::snprintf(text, sizeof text,
                "\n### roofline, %s, one core, %s\n\n| a listed contact | count | machine | ns at the limit |\n"
                "|---|---:|---:|---:|\n"
                "| additions, multiplications, comparisons | %d | %.1f Gop/s | %.2f |\n"
                "| square roots, divisions | %d | %.2f Gop/s | %.2f |\n"
                "| bytes streamed | %.0f | %.1f GB/s (triad) | %.2f |\n"
                "| bytes gathered (in cache) | %.0f | | |\n"
                "| measured, all of a step over its contacts | | | %.2f |\n\nOf the highest limit: %.0f %%\n",
                r.scene.c_str(), r.machine.instruction_set.c_str(), r.cost.additions_multiplications, r.machine.gflop_s,
                r.arithmetic_ns, r.cost.roots_divisions, r.machine.roots_gop_s, r.roots_ns, r.cost.bytes_streamed,
                r.machine.triad_gb_s, r.memory_ns, r.cost.bytes_gathered, r.contact_ns, 100 * r.share_of_limit());
  return text;
}

nlohmann::ordered_json json_of(const Roofline& r) {
  return {{"scene", r.scene},
          {"instruction_set", r.machine.instruction_set},
          {"triad_gb_s", r.machine.triad_gb_s},
          {"gflop_s", r.machine.gflop_s},
          {"roots_gop_s", r.machine.roots_gop_s},
          {"operations_per_contact", r.cost.additions_multiplications},
          {"roots_per_contact", r.cost.roots_divisions},
          {"bytes_per_contact", r.cost.bytes_streamed},
          {"bytes_gathered_per_contact", r.cost.bytes_gathered},
          {"contact_ns", r.contact_ns},
          {"memory_ns", r.memory_ns},
          {"arithmetic_ns", r.arithmetic_ns},
          {"roots_ns", r.roots_ns},
          {"share_of_limit", r.share_of_limit()}};
}

}  // namespace pastefit
