// Included once by each of kernels_{four_lanes,avx2,avx512}.cpp, which name the instruction set and the pack's width.
// Everything here lives in that namespace or is inlined: see core/laws/pack.h.

#include <utility>

#include "core/laws/contact.h"
#include "core/laws/pack.h"
#include "core/laws/transpose.h"
#include "core/step/kernels.h"
#include "core/step/list_kernel.h"
#include "core/step/motion_kernel.h"
#include "core/step/nearest_kernel.h"

namespace pastefit::PASTEFIT_ISA {

namespace {

constexpr int kWidth = PASTEFIT_WIDTH, kHalf = kWidth / 2;
using Real = Singles<kWidth>;
using Vector = BasicVec3<Real>;

/// Memory rows of the lanes' grains.
class Lanes {
 public:
  PASTEFIT_INLINE explicit Lanes(const std::int32_t* grain) {
    *reinterpret_cast<Integers*>(offset_) = *reinterpret_cast<const Integers*>(grain) * kRow;
  }
  PASTEFIT_INLINE const Motion& motion(const KernelTask& task, int lane) const {
    return *reinterpret_cast<const Motion*>(reinterpret_cast<const char*>(task.motion) + 2 * offset(lane));
  }
  PASTEFIT_INLINE Load& load(const KernelTask& task, int lane) const {
    return *reinterpret_cast<Load*>(reinterpret_cast<char*>(task.load) + offset(lane));
  }

 private:
  using Integers = LaneTypes<float, kWidth>::Mask;
  static constexpr int kRow = sizeof(Load);
  static_assert(sizeof(Motion) == 2 * kRow);
  /// Read again at each use: a compiler that keeps all offsets in registers runs out of them, and computes and stores
  /// each (5 % of a slump).
  PASTEFIT_INLINE std::uint64_t offset(int lane) const {
    return static_cast<const volatile std::uint32_t&>(offset_[lane]);
  }
  alignas(4 * kWidth) std::uint32_t offset_[kWidth];  ///< in the array of loads, for up to 67 million grains [bytes]
};

/// Relative positions of the lanes' pairs. Positions and their differences are doubles; the differences are then
/// rounded. The overlap d = r - s is small beside r and s, and is computed from exact squares as (r^2 - s^2)/(r + s).
struct Pairing {
  Vector between;  ///< from centre to centre
  Real distance, inverse_distance, overlap;
  Real reach;  ///< sum of the radii
};

PASTEFIT_INLINE Pairing pairing(const KernelTask& task, const Lanes& i, const Lanes& j) {
  using Half = Doubles<kHalf>;
  BasicVec3<Half> between[2];
  Half reach[2], square[2], beyond[2];
  for (int half = 0; half < 2; ++half) {
    const auto row_of = [&](const Lanes& lanes) {
      return [&](int lane) { return &lanes.motion(task, half * kHalf + lane).position.x; };
    };
    Half columns[4];
    read_differences(row_of(i), row_of(j), columns);
    between[half] = task.domain.shortest(BasicVec3<Half>{columns[0], columns[1], columns[2]});
    reach[half] = columns[3];
    square[half] = dot(between[half], between[half]);
    beyond[half] = reach[half] * reach[half] - square[half];  // exactly 0 at touch
  }
  Pairing p;
  p.between = {narrow(between[0].x, between[1].x), narrow(between[0].y, between[1].y),
               narrow(between[0].z, between[1].z)};
  p.reach = narrow(reach[0], reach[1]);
  p.distance = square_root(larger(narrow(square[0], square[1]), Real(detail::kFloor)));
  const Real both = p.reach + p.distance, inverse = Real(1.0) / (p.distance * both);
  p.inverse_distance = inverse * both;
  p.overlap = narrow(beyond[0], beyond[1]) * (inverse * p.distance);
  return p;
}

/// A vector and the number stored next to it.
struct Quad {
  Vector vector;
  Real beside;
};

PASTEFIT_INLINE Quad velocities(const KernelTask& task, const Lanes& grains) {
  Real columns[4];
  read_quads<kWidth>([&](int lane) { return grains.motion(task, lane).velocity; }, columns);
  return {{columns[0], columns[1], columns[2]}, columns[3]};
}
PASTEFIT_INLINE Quad spins(const KernelTask& task, const Lanes& grains) {
  Real columns[4];
  read_quads<kWidth>([&](int lane) { return grains.motion(task, lane).spin; }, columns);
  return {{columns[0], columns[1], columns[2]}, columns[3]};
}

PASTEFIT_INLINE Vector load(const float (&rows)[3][kBatch], int lane) {
  return {Real::load(rows[0] + lane), Real::load(rows[1] + lane), Real::load(rows[2] + lane)};
}

PASTEFIT_INLINE void store(float (&rows)[3][kBatch], int lane, const Vector& v) {
  v.x.store(rows[0] + lane);
  v.y.store(rows[1] + lane);
  v.z.store(rows[2] + lane);
}

/// Adds to the loads of the pairs, one pair after the other, for eight first grains and then for their partners: two
/// lanes may have the same grain, and the order of the sums is part of the determinism contract.
PASTEFIT_INLINE void add_loads(const KernelTask& task, const Lanes& i, const Lanes& j, const Vector& force,
                               Real damping, const Vector& torque_i, const Vector& torque_j, Real stiffness) {
  Columns<kWidth> on_i{{force.x, force.y, force.z, damping}, {torque_i.x, torque_i.y, torque_i.z, stiffness}};
  Columns<kWidth> on_j{{-force.x, -force.y, -force.z, damping}, {torque_j.x, torque_j.y, torque_j.z, stiffness}};
  on_i.turn();
  on_j.turn();
  const auto row_of = [&](const Lanes& grains) { return [&](int lane) { return grains.load(task, lane).force; }; };
  on_i.add_to<0>(row_of(i));
  on_j.add_to<0>(row_of(j));
  if constexpr (kWidth > 8) {
    on_i.add_to<8>(row_of(i));
    on_j.add_to<8>(row_of(j));
  }
}

/// Sums the energies of a kernel's contacts in the lanes of `EnergySums`, in registers until the end.
class Tally {
 public:
  PASTEFIT_INLINE void count(EnergySums::Kind kind, int lane, Real value) {
    Doubles<kHalf>* const lanes = sum_[kind] + lane % EnergySums::kLanes / kHalf;
    Doubles<kHalf>& second = kWidth <= EnergySums::kLanes ? lanes[1] : lanes[0];
    lanes[0] = lanes[0] + widened<0>(value);
    second = second + widened<1>(value);
  }
  template <bool viscous, bool yields>
  PASTEFIT_INLINE void count(Energies energies, int lane, const ContactForce<Real>& contact_force) {
    if (energies == Energies::none) return;
    count(EnergySums::normal_damping, lane, contact_force.dissipation_normal);
    count(EnergySums::sliding, lane, contact_force.dissipation_sliding);
    count(EnergySums::rolling, lane, contact_force.dissipation_rolling);
    count(EnergySums::bridges, lane, contact_force.dissipation_bridge);
    count(EnergySums::stored, lane, contact_force.stored);
    if constexpr (viscous) count(EnergySums::viscous, lane, contact_force.dissipation_viscous);
    if constexpr (yields) count(EnergySums::plastic, lane, contact_force.dissipation_plastic);
  }
  PASTEFIT_INLINE void add_to(EnergySums& energy) const {
    for (int kind = 0; kind < EnergySums::kinds; ++kind)
      for (int part = 0; part < EnergySums::kLanes / kHalf; ++part) {
        double* lanes = energy.lane[kind] + part * kHalf;
        (Doubles<kHalf>::load(lanes) + sum_[kind][part]).store(lanes);
      }
  }

 private:
  Doubles<kHalf> sum_[EnergySums::kinds][EnergySums::kLanes / kHalf];
};

/// Reads the history of a batch; `roll` only if the rolling law uses it.
template <class Rolling>
PASTEFIT_INLINE ContactHistory<Real> recall(const ContactBatch& c, int lane) {
  ContactHistory<Real> history;
  history.slip = load(c.slip, lane);
  if constexpr (Rolling::remembers) history.roll = load(c.roll, lane);
  history.sqrt_contact_radius = Real::load(c.sqrt_contact_radius + lane);
  history.damper = Real::load(c.damper + lane);
  history.drag = Real::load(c.drag + lane);
  history.bond = Real::load(c.bond + lane);
  return history;
}

template <class Normal, class Attraction, class Rolling>
PASTEFIT_INLINE void remember(ContactBatch& c, int lane, const ContactHistory<Real>& history) {
  store(c.slip, lane, history.slip);
  if constexpr (Rolling::remembers) store(c.roll, lane, history.roll);
  history.sqrt_contact_radius.store(c.sqrt_contact_radius + lane);
  history.damper.store(c.damper + lane);
  history.drag.store(c.drag + lane);
  if constexpr (Attraction::present || Normal::yields) history.bond.store(c.bond + lane);
}

/// Kinematics of a pair, and lever arms of tangential forces: to the middle of the overlap and, in a viscous liquid, to
/// the middle of a gap.
struct Encounter {
  ContactKinematics<Real> kinematics;
  Real lever_a, lever_b;
};

template <bool viscous>
PASTEFIT_INLINE Encounter encounter(const KernelTask& task, const Lanes& i, const Lanes& j, const Pairing& p,
                                    const ContactBatch& c, int lane) {
  const Quad velocity_a = velocities(task, i), velocity_b = velocities(task, j);
  const Quad spin_a = spins(task, i), spin_b = spins(task, j);
  const Real radius_a = spin_a.beside, radius_b = spin_b.beside;

  ContactKinematics<Real> kinematics;
  kinematics.normal = p.inverse_distance * p.between;
  kinematics.overlap = p.overlap;
  const Real half_depth = Real(0.5) * (viscous ? kinematics.overlap : larger(kinematics.overlap, Real(0.0)));
  const Real lever_a = radius_a - half_depth, lever_b = radius_b - half_depth;
  kinematics.velocity = velocity_a.vector - velocity_b.vector +
                        cross(fused(lever_a, spin_a.vector, lever_b * spin_b.vector), kinematics.normal);
  kinematics.spin = spin_a.vector - spin_b.vector;
  kinematics.twist = Real(0.5) * dot(spin_a.vector + spin_b.vector, kinematics.normal);
  kinematics.smaller_radius = smaller(radius_a, radius_b);
  kinematics.sqrt_radius = Real::load(c.sqrt_radius + lane);
  kinematics.sqrt_mass = Real::load(c.sqrt_mass + lane);
  kinematics.inverse_mass = Real(1.0) / (kinematics.sqrt_mass * kinematics.sqrt_mass);
  kinematics.neighbour_damping = velocity_a.beside + velocity_b.beside;
  return {kinematics, lever_a, lever_b};
}

template <class Normal, class Attraction, class Rolling, bool viscous>
PASTEFIT_INLINE void act_on_pairs(const KernelTask& task, const ConstantsOf<Real>& pair, Real dt, const Lanes& i,
                                  const Lanes& j, const Pairing& p, ContactBatch& c, int lane, Tally& tally) {
  const auto [kinematics, lever_a, lever_b] = encounter<viscous>(task, i, j, p, c, lane);
  ContactHistory<Real> history = recall<Rolling>(c, lane);
  const ContactForce<Real> contact_force =
      act<Normal, Attraction, Rolling, viscous>(pair, kinematics, history, dt, task.energies);
  remember<Normal, Attraction, Rolling>(c, lane, history);
  tally.count<viscous, Normal::yields>(task.energies, lane, contact_force);

  const Vector force = fused(-contact_force.normal_force, kinematics.normal, contact_force.tangential_force);
  const Vector turning = cross(kinematics.normal, contact_force.tangential_force);
  const Vector torque_a = fused(lever_a, turning, contact_force.moment);
  const Vector torque_b = fused(lever_b, turning, -contact_force.moment);
  add_loads(task, i, j, force, contact_force.damping, torque_a, torque_b, contact_force.stiffness);
}

/// Pairs without contact: attraction along the line of centres.
template <class Attraction, class Batch>
PASTEFIT_INLINE void attract_pairs(const KernelTask& task, const ConstantsOf<Real>& pair, Real scale, const Lanes& i,
                                   const Lanes& j, const Pairing& p, Batch& c, int lane, Tally& tally) {
  const Real zero(0.0);
  const Real overlap = p.overlap;
  Real alive = Real::load(c.bond + lane);
  Real spent;
  const Pull<Real> pull = bridge_pull<Attraction>(pair, overlap, scale, alive, spent);
  alive.store(c.bond + lane);
  if (task.energies != Energies::none) tally.count(EnergySums::bridges, lane, spent);
  if (task.energies == Energies::all)
    tally.count(EnergySums::stored, lane, -alive * Attraction::work(pair, smaller(overlap, zero), scale));
  // Same expression as the normal of a contact times the force: the bits do not depend on the list of the pair.
  const Vector force = pull.force * (p.inverse_distance * p.between), none{zero, zero, zero};
  add_loads(task, i, j, force, zero, none, none, pull.slope);
}

/// Pairs without contact in a viscous liquid: attraction, and lubrication as the only damper, with its history.
template <class Attraction>
PASTEFIT_INLINE void lubricate_pairs(const KernelTask& task, const ConstantsOf<Real>& pair, Real dt, const Lanes& i,
                                     const Lanes& j, const Pairing& p, ContactBatch& c, int lane, Tally& tally) {
  const Real zero(0.0);
  const auto [kinematics, lever_a, lever_b] = encounter<true>(task, i, j, p, c, lane);
  const Real radius = kinematics.sqrt_radius * kinematics.sqrt_radius, scale = pair.size_per_radius * radius;
  ContactHistory<Real> history;
  history.bond = Real::load(c.bond + lane);
  history.damper = Real::load(c.damper + lane);
  const Real before = Real::load(c.drag + lane);
  history.drag = zero;
  ContactForce<Real> contact_force;
  const Pull<Real> pull =
      bridge_pull<Attraction>(pair, p.overlap, scale, history.bond, contact_force.dissipation_bridge);
  const Real approach = dot(kinematics.velocity, kinematics.normal);
  contact_force.normal_force = -pull.force;
  contact_force.tangential_force = {zero, zero, zero};
  contact_force.damping = zero;
  contact_force.dissipation_normal = Real(0.5) * dt * history.damper * approach;
  history.damper = zero;
  const Lubrication<Real> liquid = lubrication(pair, p.overlap, radius, scale, history.bond, kinematics.inverse_mass,
                                               kinematics.neighbour_damping, dt);
  const bool counted = task.energies != Energies::none;
  lubricate(liquid, kinematics, approach, zero, before, dt, counted, history, contact_force);
  history.bond.store(c.bond + lane);
  tally.count(EnergySums::bridges, lane, contact_force.dissipation_bridge);
  if (counted) {
    history.damper.store(c.damper + lane);
    history.drag.store(c.drag + lane);
    tally.count(EnergySums::normal_damping, lane, contact_force.dissipation_normal);
    tally.count(EnergySums::viscous, lane, contact_force.dissipation_viscous);
  }
  if (task.energies == Energies::all)
    tally.count(EnergySums::stored, lane, -history.bond * Attraction::work(pair, smaller(p.overlap, zero), scale));

  const Vector force = fused(-contact_force.normal_force, kinematics.normal, contact_force.tangential_force);
  const Vector turning = cross(kinematics.normal, contact_force.tangential_force);
  add_loads(task, i, j, force, contact_force.damping, lever_a * turning, lever_b * turning, pull.slope);
}

/// True if a pair of the lanes is in contact, or was in contact at the last step and must reset its history. Otherwise
/// the pairs have neither force nor history.
PASTEFIT_INLINE bool some_touch(const Pairing& p, const ContactBatch& c, int lane) {
  return any(p.overlap > Real(0.0)) || any(Real::load(c.sqrt_contact_radius + lane) > Real(0.0));
}

constexpr int kAhead = 2;        // batches; 5 to 10 % in a bed too large for the caches
constexpr int kGrainsAhead = 1;  // batches; a quarter to a third more

PASTEFIT_INLINE void fetch(const ContactBatch* batch) {
  for (std::size_t line = 0; line < sizeof(ContactBatch); line += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(batch) + line, 1);
}

/// Second grains of a batch are scattered in memory; the first ones are those of the batch before, or next to them.
/// Pairs that only may touch mostly need positions alone.
PASTEFIT_INLINE void fetch_grains(const KernelTask& task, const ContactBatch& batch, bool whole) {
  for (const std::int32_t j : batch.j) {
    __builtin_prefetch(task.motion + j);
    if (whole) __builtin_prefetch(task.load + j, 1);
  }
}

/// Prefetches the next batches and their grains.
PASTEFIT_INLINE void fetch_ahead(const KernelTask& task, std::int32_t k) {
  fetch(task.contacts + k + kAhead);
  const std::int32_t soon = k + kGrainsAhead;
  if (soon < task.stretch.end) fetch_grains(task, task.contacts[soon], soon < task.stretch.near);
}

template <class Normal, class Attraction, class Rolling, bool viscous>
void pair_kernel(const KernelTask& task) {
  const ConstantsOf<Real> pair = in_lanes<Real>(task.pair);
  const Real dt(task.dt);
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k) {
    ContactBatch& batch = task.contacts[k];
    if (task.fetches_ahead) fetch_ahead(task, k);
    for (int lane = 0; lane < kBatch; lane += kWidth) {
      const Lanes i(batch.i + lane), j(batch.j + lane);
      const Pairing p = pairing(task, i, j);
      if (k < task.stretch.near || some_touch(p, batch, lane)) {
        act_on_pairs<Normal, Attraction, Rolling, viscous>(task, pair, dt, i, j, p, batch, lane, tally);
      } else {
        if constexpr (viscous) lubricate_pairs<Attraction>(task, pair, dt, i, j, p, batch, lane, tally);
        if constexpr (Attraction::present && !viscous) {
          const Real sqrt_radius = Real::load(batch.sqrt_radius + lane);
          attract_pairs<Attraction>(task, pair, pair.size_per_radius * (sqrt_radius * sqrt_radius), i, j, p, batch,
                                    lane, tally);
        }
      }
    }
  }
  tally.add_to(*task.energy);
}

template <class Attraction>
void bridge_kernel(const KernelTask& task) {
  const ConstantsOf<Real> pair = in_lanes<Real>(task.pair);
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k)
    for (int lane = 0; lane < kBatch; lane += kWidth) {
      BridgeBatch& batch = task.bridges[k];
      const Lanes i(batch.i + lane), j(batch.j + lane);
      attract_pairs<Attraction>(task, pair, Real::load(batch.size_scale + lane), i, j, pairing(task, i, j), batch, lane,
                                tally);
    }
  tally.add_to(*task.energy);
}

template <class Normal, class Attraction, class Rolling, bool viscous>
void wall_kernel(const KernelTask& task) {
  const ConstantsOf<Real> pair = in_lanes<Real>(task.pair);
  const Real dt(task.dt);
  Tally tally;
  for (std::int32_t k = task.stretch.begin; k < task.stretch.end; ++k)
    for (int lane = 0; lane < kBatch; lane += kWidth) {
      ContactBatch& c = task.contacts[k];
      WallBatch& w = task.wall[k];
      const Lanes i(c.i + lane);
      const Quad velocity = velocities(task, i), spin = spins(task, i);
      const Real radius = spin.beside;
      ContactKinematics<Real> kinematics;
      kinematics.normal = load(w.normal, lane);
      kinematics.overlap = Real::load(w.overlap + lane);
      const Real lever = radius - (viscous ? kinematics.overlap : larger(kinematics.overlap, Real(0.0)));
      kinematics.velocity =
          velocity.vector - load(w.wall_velocity, lane) + cross(lever * spin.vector, kinematics.normal);
      kinematics.spin = spin.vector;
      kinematics.twist = Real(0.5) * dot(spin.vector, kinematics.normal);
      kinematics.smaller_radius = radius;
      kinematics.sqrt_radius = Real::load(c.sqrt_radius + lane);
      kinematics.sqrt_mass = Real::load(c.sqrt_mass + lane);
      kinematics.inverse_mass = Real(1.0) / (kinematics.sqrt_mass * kinematics.sqrt_mass);
      kinematics.neighbour_damping = velocity.beside;

      ContactHistory<Real> history = recall<Rolling>(c, lane);
      const ContactForce<Real> contact_force =
          act<Normal, Attraction, Rolling, viscous>(pair, kinematics, history, dt, task.energies);
      remember<Normal, Attraction, Rolling>(c, lane, history);
      tally.count<viscous, Normal::yields>(task.energies, lane, contact_force);

      store(w.force, lane, contact_force.tangential_force - contact_force.normal_force * kinematics.normal);
      store(w.moment, lane, lever * cross(kinematics.normal, contact_force.tangential_force) + contact_force.moment);
      contact_force.damping.store(w.damping + lane);
      contact_force.stiffness.store(w.stiffness + lane);
    }
  tally.add_to(*task.energy);
}

}  // namespace

namespace {

/// Kernels of all valid combinations of laws, in the order of `combination`; null for the others.
template <std::size_t at>
struct LawTriple {
  using Normal = Law<NormalLaws, at / (Attractions::size * RollingLaws::size)>;
  using Attraction = Law<Attractions, at / RollingLaws::size % Attractions::size>;
  using Rolling = Law<RollingLaws, at % RollingLaws::size>;
  /// A viscous liquid needs a bridge.
  template <bool viscous>
  static constexpr bool is_compiled = go_together(Normal{}, Attraction{}) && (Attraction::present || !viscous);

  template <bool viscous>
  static constexpr Kernel pair() {
    if constexpr (is_compiled<viscous>) return pair_kernel<Normal, Attraction, Rolling, viscous>;
    return nullptr;
  }
  template <bool viscous>
  static constexpr Kernel wall() {
    if constexpr (is_compiled<viscous>) return wall_kernel<Normal, Attraction, Rolling, viscous>;
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
  return {{LawTriple<at>::template pair<false>()...},
          {LawTriple<at>::template wall<false>()...},
          {LawTriple<at>::template pair<true>()...},
          {LawTriple<at>::template wall<true>()...},
          {bridge_kernel_of<Attraction>()...},
          {find_on_wall<Plane>, find_on_wall<Plate>, find_on_wall<Shell>, find_on_wall<Ribs>},
          find_near,
          find_nearness,
          move_grains,
          PASTEFIT_ISA_NAME};
}

}  // namespace

constinit const KernelTable kernels = table_of(std::make_index_sequence<kCombinations>{}, Attractions{});

}  // namespace pastefit::PASTEFIT_ISA
