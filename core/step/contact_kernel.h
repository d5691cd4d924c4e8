// Included once by each of kernels_{sse2,avx2,avx512}.cpp, which name the instruction set and the pack's width.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include <utility>

#include "core/laws/contact.h"
#include "core/laws/pack.h"
#include "core/laws/transpose.h"
#include "core/step/kernels.h"
#include "core/step/motion_kernel.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

constexpr int kWidth = PASTEFIT_WIDTH;
using Real = Pack<kWidth>;
using Vector = BasicVec3<Real>;

/// One grain per lane.
struct Grains {
  Vector position, velocity, spin;
  Real radius, damping_rate, inverse_mass;
};

/// Rows of the lanes' grains, turned into packs.
PASTEFIT_INLINE Grains gather(const KernelTask& task, const std::int32_t* index) {
  Real columns[8];
  read_rows<kWidth, 8>([&](int lane) { return &task.motion[index[lane]].position.x; }, columns);
  Grains g;
  g.position = {columns[0], columns[1], columns[2]};
  g.radius = columns[3];
  g.velocity = {columns[4], columns[5], columns[6]};
  g.damping_rate = columns[7];
  read_quads([&](int lane) { return &task.spin[index[lane]].velocity.x; }, g.spin.x, g.spin.y, g.spin.z,
             g.inverse_mass);
  return g;
}

/// Where the lanes' grains are.
struct Place {
  Vector position;
  Real radius;
};

PASTEFIT_INLINE Place locate(const KernelTask& task, const std::int32_t* index) {
  Place p;
  read_quads([&](int lane) { return &task.motion[index[lane]].position.x; }, p.position.x, p.position.y, p.position.z,
             p.radius);
  return p;
}

PASTEFIT_INLINE Vector load(const double (&rows)[3][kBatch], int lane) {
  return {Real::load(rows[0] + lane), Real::load(rows[1] + lane), Real::load(rows[2] + lane)};
}

PASTEFIT_INLINE void store(double (&rows)[3][kBatch], int lane, const Vector& v) {
  v.x.store(rows[0] + lane);
  v.y.store(rows[1] + lane);
  v.z.store(rows[2] + lane);
}

/// Adds column l of the eight packs to the loads of the l-th pair, one pair after the other: two lanes may name the
/// same grain, and the order of the sums is part of the contract of determinism.
PASTEFIT_INLINE void add_rows(Load* load, const std::int32_t* i, const std::int32_t* j, const Real (&on_i)[8],
                              const Real (&on_j)[8]) {
  for (int block = 0; block < 8; block += kWidth) {
    Real part_i[kWidth], part_j[kWidth];
    for (int k = 0; k < kWidth; ++k) {
      part_i[k] = on_i[block + k];
      part_j[k] = on_j[block + k];
    }
    square(part_i);
    square(part_j);
    for (int lane = 0; lane < kWidth; ++lane) {
      double* row_i = &load[i[lane]].force.x + block;
      (Real::load(row_i) + part_i[lane]).store(row_i);
      double* row_j = &load[j[lane]].force.x + block;
      (Real::load(row_j) + part_j[lane]).store(row_j);
    }
  }
}

/// The energies of a kernel's contacts, in the lanes of `EnergySums`, kept in registers until all are counted.
class Tally {
 public:
  PASTEFIT_INLINE void count(EnergySums::Kind kind, int lane, Real value) {
    Real& lanes = sum_[kind][lane / kWidth];
    lanes = lanes + value;
  }
  PASTEFIT_INLINE void count(Energies energies, int lane, const Action<Real>& action) {
    if (energies == Energies::none) return;
    count(EnergySums::normal_damping, lane, action.heat_normal);
    count(EnergySums::sliding, lane, action.heat_sliding);
    count(EnergySums::rolling, lane, action.heat_rolling);
    count(EnergySums::bridges, lane, action.heat_bridge);
    count(EnergySums::stored, lane, action.stored);
  }
  PASTEFIT_INLINE void add_to(EnergySums& energy) const {
    for (int kind = 0; kind < EnergySums::kinds; ++kind)
      for (int part = 0; part < 8 / kWidth; ++part) {
        double* lanes = energy.lane[kind] + part * kWidth;
        (Real::load(lanes) + sum_[kind][part]).store(lanes);
      }
  }

 private:
  Real sum_[EnergySums::kinds][8 / kWidth];
};

/// What a batch remembers, in and out; roll only where the rolling law has memory.
template <class Rolling>
PASTEFIT_INLINE Memory<Real> recall(const ContactBatch& c, int lane) {
  Memory<Real> memory;
  memory.slip = load(c.slip, lane);
  if constexpr (Rolling::remembers) memory.roll = load(c.roll, lane);
  memory.root_contact_radius = Real::load(c.root_contact_radius + lane);
  memory.damper = Real::load(c.damper + lane);
  memory.drag = Real::load(c.drag + lane);
  memory.bridge = Real::load(c.bridge + lane);
  return memory;
}

template <class Attraction, class Rolling>
PASTEFIT_INLINE void remember(ContactBatch& c, int lane, const Memory<Real>& memory) {
  store(c.slip, lane, memory.slip);
  if constexpr (Rolling::remembers) store(c.roll, lane, memory.roll);
  memory.root_contact_radius.store(c.root_contact_radius + lane);
  memory.damper.store(c.damper + lane);
  memory.drag.store(c.drag + lane);
  if constexpr (Attraction::present) memory.bridge.store(c.bridge + lane);
}

template <class Normal, class Attraction, class Rolling>
PASTEFIT_INLINE void act_on_pairs(const KernelTask& task, const PairConstants& pair, Real dt, ContactBatch& c, int lane,
                                  Tally& tally) {
  const Grains a = gather(task, c.i + lane), b = gather(task, c.j + lane);
  const Vector between = task.domain.way(a.position, b.position);
  const Real square = larger(dot(between, between), Real(1e-200));
  const Real distance = square_root(square);

  Meeting<Real> meeting;
  meeting.normal = (Real(1.0) / distance) * between;
  meeting.overlap = a.radius + b.radius - distance;
  const Real half_depth = Real(0.5) * larger(meeting.overlap, Real(0.0));
  const Real lever_a = a.radius - half_depth, lever_b = b.radius - half_depth;
  meeting.velocity = a.velocity - b.velocity + cross(fused(lever_a, a.spin, lever_b * b.spin), meeting.normal);
  meeting.spin = a.spin - b.spin;
  meeting.twist = Real(0.5) * dot(a.spin + b.spin, meeting.normal);
  meeting.smaller_radius = smaller(a.radius, b.radius);
  meeting.root_radius = Real::load(c.root_radius + lane);
  meeting.root_mass = Real::load(c.root_mass + lane);
  meeting.inverse_mass = a.inverse_mass + b.inverse_mass;
  meeting.neighbour_damping = a.damping_rate + b.damping_rate;

  Memory<Real> memory = recall<Rolling>(c, lane);
  const Action<Real> action = act<Normal, Attraction, Rolling>(pair, meeting, memory, dt, task.energies);
  remember<Attraction, Rolling>(c, lane, memory);
  tally.count(task.energies, lane, action);

  const Vector force = fused(-action.push, meeting.normal, action.traction);
  const Vector turning = cross(meeting.normal, action.traction);
  const Vector torque_a = fused(lever_a, turning, action.moment);
  const Vector torque_b = fused(lever_b, turning, -action.moment);
  const Real on_a[8] = {force.x,    force.y,    force.z,    action.damping,
                        torque_a.x, torque_a.y, torque_a.z, action.stiffness};
  const Real on_b[8] = {-force.x,   -force.y,   -force.z,   action.damping,
                        torque_b.x, torque_b.y, torque_b.z, action.stiffness};
  add_rows(task.load, c.i + lane, c.j + lane, on_a, on_b);
}

/// Pairs that do not touch: attraction along the line of centres.
template <class Attraction, class Batch>
PASTEFIT_INLINE void attract_pairs(const KernelTask& task, const PairConstants& pair, Real scale, Batch& c, int lane,
                                   Tally& tally) {
  const Real zero(0.0);
  const Place a = locate(task, c.i + lane), b = locate(task, c.j + lane);
  const Vector between = task.domain.way(a.position, b.position);
  const Real distance = square_root(larger(dot(between, between), Real(1e-200)));
  const Real overlap = a.radius + b.radius - distance;
  Real alive = Real::load(c.bridge + lane);
  Real spent;
  const Pull<Real> pull = bridge_pull<Attraction>(pair, overlap, scale, alive, spent);
  alive.store(c.bridge + lane);
  tally.count(EnergySums::bridges, lane, spent);
  if (task.energies == Energies::all)
    tally.count(EnergySums::stored, lane, -alive * Attraction::work(pair, smaller(overlap, zero), scale));
  const Vector force = (pull.force / distance) * between;
  const Real on_a[8] = {force.x, force.y, force.z, zero, zero, zero, zero, pull.slope};
  const Real on_b[8] = {-force.x, -force.y, -force.z, zero, zero, zero, zero, pull.slope};
  add_rows(task.load, c.i + lane, c.j + lane, on_a, on_b);
}

/// Whether a pair of the batch touches, or did so at the last step and has yet to forget it. Where none does, a contact
/// exerts nothing and has nothing to remember.
PASTEFIT_INLINE bool some_touch(const KernelTask& task, const ContactBatch& c) {
  bool touch = false;
  for (int lane = 0; lane < kBatch; lane += kWidth) {
    const Place a = locate(task, c.i + lane), b = locate(task, c.j + lane);
    const Vector between = task.domain.way(a.position, b.position);
    const Real reach = a.radius + b.radius;
    touch |= any(dot(between, between) < reach * reach) || any(Real::load(c.root_contact_radius + lane) > Real(0.0));
  }
  return touch;
}

constexpr int kAhead = 2;        // batches; 5 to 10 % in a bed too large for the caches
constexpr int kGrainsAhead = 1;  // batches; a quarter to a third more

PASTEFIT_INLINE void fetch(const ContactBatch* batch) {
  for (std::size_t line = 0; line < sizeof(ContactBatch); line += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(batch) + line, 1);
}

/// The second grains of a batch lie scattered; the first ones are those of the batch before, or next to them. Of pairs
/// that may touch mostly the places are looked at.
PASTEFIT_INLINE void fetch_grains(const KernelTask& task, const ContactBatch& batch, bool whole) {
  for (const std::int32_t j : batch.j) {
    __builtin_prefetch(task.motion + j);
    if (!whole) continue;
    __builtin_prefetch(task.spin + j);
    __builtin_prefetch(task.load + j, 1);
  }
}

template <class Normal, class Attraction, class Rolling>
void pair_kernel(const KernelTask& task) {
  const PairConstants pair = task.pair;
  const Real dt(task.dt);
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k) {
    ContactBatch& batch = task.contacts[k];
    fetch(task.contacts + k + kAhead);
    const std::int32_t soon = k + kGrainsAhead;
    if (soon < task.stretch.end) fetch_grains(task, task.contacts[soon], soon < task.stretch.near);
    if (k < task.stretch.near || some_touch(task, batch)) {
      for (int lane = 0; lane < kBatch; lane += kWidth)
        act_on_pairs<Normal, Attraction, Rolling>(task, pair, dt, batch, lane, tally);
    } else if constexpr (Attraction::present) {
      for (int lane = 0; lane < kBatch; lane += kWidth) {
        const Real root_radius = Real::load(batch.root_radius + lane);
        attract_pairs<Attraction>(task, pair, Real(pair.size_per_radius) * root_radius * root_radius, batch, lane,
                                  tally);
      }
    }
  }
  tally.add_to(*task.energy);
}

template <class Attraction>
void bridge_kernel(const KernelTask& task) {
  const PairConstants pair = task.pair;
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k)
    for (int lane = 0; lane < kBatch; lane += kWidth)
      attract_pairs<Attraction>(task, pair, Real::load(task.bridges[k].size_scale + lane), task.bridges[k], lane,
                                tally);
  tally.add_to(*task.energy);
}

template <class Normal, class Attraction, class Rolling>
void wall_kernel(const KernelTask& task) {
  const PairConstants pair = task.pair;
  const Real dt(task.dt);
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k)
    for (int lane = 0; lane < kBatch; lane += kWidth) {
      ContactBatch& c = task.contacts[k];
      WallBatch& w = task.wall[k];
      const Grains a = gather(task, c.i + lane);
      Meeting<Real> meeting;
      meeting.normal = load(w.normal, lane);
      meeting.overlap = Real::load(w.overlap + lane);
      const Real lever = a.radius - larger(meeting.overlap, Real(0.0));
      meeting.velocity = a.velocity - load(w.wall_velocity, lane) + cross(lever * a.spin, meeting.normal);
      meeting.spin = a.spin;
      meeting.twist = Real(0.5) * dot(a.spin, meeting.normal);
      meeting.smaller_radius = a.radius;
      meeting.root_radius = Real::load(c.root_radius + lane);
      meeting.root_mass = Real::load(c.root_mass + lane);
      meeting.inverse_mass = a.inverse_mass;
      meeting.neighbour_damping = a.damping_rate;

      Memory<Real> memory = recall<Rolling>(c, lane);
      const Action<Real> action = act<Normal, Attraction, Rolling>(pair, meeting, memory, dt, task.energies);
      remember<Attraction, Rolling>(c, lane, memory);
      tally.count(task.energies, lane, action);

      store(w.force, lane, action.traction - action.push * meeting.normal);
      store(w.moment, lane, lever * cross(meeting.normal, action.traction) + action.moment);
      action.damping.store(w.damping + lane);
      action.stiffness.store(w.stiffness + lane);
    }
  tally.add_to(*task.energy);
}

}  // namespace

namespace {

/// Kernels of all combinations of laws that go together, in the order of `combination`; of others none.
template <std::size_t at>
struct LawTriple {
  using Normal = Law<NormalLaws, at / (Attractions::size * RollingLaws::size)>;
  using Attraction = Law<Attractions, at / RollingLaws::size % Attractions::size>;
  using Rolling = Law<RollingLaws, at % RollingLaws::size>;
  static constexpr Kernel pair() {
    if constexpr (go_together(Normal{}, Attraction{})) return pair_kernel<Normal, Attraction, Rolling>;
    return nullptr;
  }
  static constexpr Kernel wall() {
    if constexpr (go_together(Normal{}, Attraction{})) return wall_kernel<Normal, Attraction, Rolling>;
    return nullptr;
  }
};

template <class Attraction>
constexpr Kernel bridge_kernel_of() {
  if constexpr (Attraction::present) return bridge_kernel<Attraction>;
  return nullptr;
}

template <std::size_t... at, class... Attraction>
constexpr KernelTable table_of(std::index_sequence<at...>, TypeList<Attraction...>) {
  return {{LawTriple<at>::pair()...},
          {LawTriple<at>::wall()...},
          {bridge_kernel_of<Attraction>()...},
          move_grains,
          PASTEFIT_ISA_NAME};
}

}  // namespace

constinit const KernelTable kernels = table_of(std::make_index_sequence<kCombinations>{}, Attractions{});

}  // namespace pastefit::PASTEFIT_ISA
