#include <cmath>
#include <numbers>

#include "calibrate/base/text.h"
#include "calibrate/exports/export.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/exports/parameter_table.h"
#include "calibrate/store/program.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

/// How a script uses the module.
constexpr const char* kUse =
    R"PY(SI units. In a script of your own, beside this file, with the walls of WALLS in their order:

    from material import *
    grain, *walls = materials()           # appended to the scene; density GRAIN_DENSITY, mean radius RADIUS
    ip2, law2 = laws(grain, *walls)       # for the InteractionLoop
    attraction = Attraction(ids, radii)   # of the grains; attraction.act() in every step after the InteractionLoop
    O.dt = TIME_STEP                      # or less
)PY";

/// What follows the numbers in the module: the same for every card.
constexpr const char* kModule = R"PY(

def bridge(overlap):
    """Attraction of a living bridge between two grains of the mean radius; overlap <= 0, numpy array."""
    if SHAPE == 'polynomial':
        return (A * overlap + B) * overlap + C
    if SHAPE == 'linear':
        return C * (1 + overlap / RUPTURE_GAP)
    if SHAPE == 'exponential':
        return C * np.exp(3 * overlap / RUPTURE_GAP)
    if SHAPE == 'capillary':
        gap = -overlap * sqrt(RADIUS / LIQUID_VOLUME)
        return C / (1 + 1.05 * gap + 2.5 * gap * gap)
    return 0 * overlap


class Attraction:
    """The attraction of grains: cohesion and DMT's 4 pi gamma R* in overlap, bridges across gaps with their memory.

    Yade's own DMT has one surface energy for all contacts, those on walls too.

    Run `act` once a step, after the interaction loop and before the integrator."""

    def __init__(self, ids, radii):
        self.ids = list(ids)
        self.radii = np.asarray(radii, dtype=float)
        self.alive = np.empty(0, dtype=np.int64)
        self.reach = 2 * self.radii.max() + RUPTURE_GAP * self.radii.max() / RADIUS
        self.skin = 0.2 * RADIUS
        self.listed_at = None

    def positions(self):
        return np.array([O.bodies[i].state.pos for i in self.ids])

    def pairs(self, x):
        """Pairs within reach, from a list that is kept until something has moved by half of the skin."""
        if self.listed_at is None or np.abs(x - self.listed_at).max() > 0.25 * self.skin:
            self.listed_at = x
            self.listed = neighbours(x, self.reach + self.skin)
        return self.listed

    def act(self):
        x = self.positions()
        first, second = self.pairs(x)
        apart = x[second] - x[first]
        distance = np.sqrt((apart * apart).sum(axis=1))
        overlap = self.radii[first] + self.radii[second] - distance
        size = 2 * self.radii[first] * self.radii[second] / (self.radii[first] + self.radii[second]) / RADIUS
        code = first * np.int64(len(x)) + second
        formed = (-overlap <= FORMATION_GAP * size) | np.isin(code, self.alive)
        living = formed & (-overlap <= RUPTURE_GAP * size)
        self.alive = code[living]
        left = np.maximum(1 - overlap / (PASSAGE * size), 0)
        pull = np.where(overlap > 0, (COHESION + TOUCH_EXCESS * left) * size**2 + 2 * pi * SURFACE_ENERGY * RADIUS * size,
                        np.where(living, size**2 * bridge(np.minimum(overlap, 0) / size), 0))
        force = (pull / distance)[:, None] * apart
        total = np.zeros_like(x)
        np.add.at(total, first, force)
        np.add.at(total, second, -force)
        for i in np.flatnonzero((total != 0).any(axis=1)):
            O.forces.addF(self.ids[i], Vector3(*total[i]))


def neighbours(x, reach):
    """Pairs of points nearer to each other than `reach`, by cells of that size."""
    cell = np.floor((x - x.min(axis=0)) / reach).astype(np.int64)
    across = cell.max(axis=0) + 3
    key = ((cell[:, 0] + 1) * across[1] + cell[:, 1] + 1) * across[2] + cell[:, 2] + 1
    order = np.argsort(key, kind='stable')
    ordered = key[order]
    firsts, seconds = [], []
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            for dz in (-1, 0, 1):
                wanted = key + (dx * across[1] + dy) * across[2] + dz
                begin = np.searchsorted(ordered, wanted, 'left')
                count = np.searchsorted(ordered, wanted, 'right') - begin
                one = np.repeat(np.arange(len(x)), count)
                within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
                other = order[np.repeat(begin, count) + within]
                keep = one < other
                firsts.append(one[keep])
                seconds.append(other[keep])
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    near = ((x[first] - x[second])**2).sum(axis=1) < reach * reach
    return first[near], second[near]


def materials():
    """Grains, then each wall of WALLS, appended to the scene."""
    return [O.materials.append(FrictMat(young=E, poisson=nu, density=density, frictionAngle=atan(friction)))
            for E, nu, density, friction in MATERIALS]


def laws(grains, *walls):
    """Ip2 and Law2 of Hertz-Mindlin with damping, friction and rolling, without attraction.

    Takes what `materials` returns."""
    def by_pair(values):
        return MatchMaker(matches=tuple((grains, other, value) for other, value in zip((grains, *walls), values)))
    ip2 = Ip2_FrictMat_FrictMat_MindlinPhys(en=by_pair(RESTITUTION), krot=KROT, ktwist=0.0, eta=ETA,
                                            frictAngle=by_pair([atan(f) for f in FRICTION]))
    return ip2, Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=ETA > 0)
)PY";

constexpr const char* kSlump = R"PY(# The slump test, step 1. In this folder:   yade -n -x slump.py
# Writes filled.dump and heap.dump (id x y z radius), prints the highest grain.
import os, sys
sys.path.insert(0, os.getcwd())
from material import *

MOULD_BASE_RADIUS, MOULD_TOP_RADIUS, MOULD_HEIGHT = @MOULD_BASE_RADIUS, @MOULD_TOP_RADIUS, @MOULD_HEIGHT
LIFT_VELOCITY, REST_TIME = @LIFT_VELOCITY, 2

grain, mould_material, table_material = materials()
rows = np.loadtxt('grains.csv', delimiter=',', skiprows=1)
ids = [O.bodies.append(sphere(Vector3(*row[:3]), row[3], material=grain)) for row in rows]
O.bodies.append(wall(0.0, axis=2, sense=1, material=table_material))
sectors, bands = 96, 4
def corner(i, k):
    share = k / bands
    radius = MOULD_BASE_RADIUS + share * (MOULD_TOP_RADIUS - MOULD_BASE_RADIUS)
    return Vector3(radius * cos(2 * pi * i / sectors), radius * sin(2 * pi * i / sectors), share * MOULD_HEIGHT)
mould = []
for i in range(sectors):
    for k in range(bands):
        for triangle in ((corner(i, k), corner(i + 1, k), corner(i + 1, k + 1)),
                         (corner(i, k), corner(i + 1, k + 1), corner(i, k + 1))):
            mould.append(O.bodies.append(facet(triangle, material=mould_material, fixed=True)))
ip2, law2 = laws(grain, mould_material, table_material)
attraction = Attraction(ids, rows[:, 3])
lift = TranslationEngine(translationAxis=(0, 0, 1), velocity=LIFT_VELOCITY, ids=mould, dead=True)

def drag():
    for i in ids:
        state = O.bodies[i].state
        O.forces.addF(i, -40 * state.mass * state.vel)

relax = PyRunner(command='drag()', iterPeriod=1, initRun=True)
O.engines = [ForceResetter(),
             InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * RADIUS),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                             [ip2], [law2]),
             PyRunner(command='attraction.act()', iterPeriod=1, initRun=True), relax, lift,
             NewtonIntegrator(damping=0.0, gravity=(0, 0, -9.81))]
O.dt = TIME_STEP

def dump(name):
    with open(name, 'w') as out:
        out.write('ITEM: NUMBER OF ATOMS\n%d\nITEM: ATOMS id x y z radius\n' % len(ids))
        for number, (i, row) in enumerate(zip(ids, rows), 1):
            out.write('%d %.9g %.9g %.9g %.9g\n' % (number, *O.bodies[i].state.pos, row[3]))

O.run(int(0.25 / O.dt), True)
relax.dead = True
dump('filled.dump')
lift.dead = False
O.run(int(MOULD_HEIGHT / LIFT_VELOCITY / O.dt), True)
lift.dead = True
for i in mould:
    O.bodies.erase(i)
O.run(int(REST_TIME / O.dt), True)
dump('heap.dump')
print('highest grain centre %.9g m' % max(O.bodies[i].state.pos[2] for i in ids))
)PY";

constexpr const char* kTwoGrains = R"PY(# Force of two grains against their distance.   yade -n -x two_grains.py
# The second is pulled from an overlap out beyond rupture, and pushed back; prints "apart r F", then "back r F",
# repulsion positive.
import os, sys
sys.path.insert(0, os.getcwd())
from material import *

grain, *wall_materials = materials()
nearest, farthest, distances = @NEAREST, @FARTHEST, 240
ids = [O.bodies.append(sphere((x, 0, 0), RADIUS, material=grain, fixed=True)) for x in (0, nearest)]
ip2, law2 = laws(grain, *wall_materials)
attraction = Attraction(ids, [RADIUS, RADIUS])
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.1 * RADIUS),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [ip2], [law2]),
             PyRunner(command='attraction.act()', iterPeriod=1, initRun=True),
             NewtonIntegrator(damping=0.0)]
O.dt = 1e-12
for way, order in (('apart', range(distances + 1)), ('back', range(distances, -1, -1))):
  for n in order:
    O.bodies[ids[1]].state.pos = Vector3(nearest + n * (farthest - nearest) / distances, 0, 0)
    O.run(1, True)
    print(way + ' %.17g %.17g' % (O.bodies[ids[1]].state.pos[0], O.forces.f(ids[1])[0]))
)PY";

/// `contact` is what is written, with the law that stands in for the card's.
std::string module_of(const ExportScene& scene, const ContactModel& contact) {
  const auto& bridge = contact.bridge;
  const double radius = scene.radius_m();
  const GrainPair pair = scene.mean_pair();
  const auto gaps = bridge_gaps(contact, pair);
  const PairConstants constants = grain_pair(contact, radius);
  const bool rolls = contact.rolling != RollingModel::none && contact.rolling_friction > 0;
  const double lever = rolling_spring_lever(contact.rolling, contact.rolling_friction) * pair.effective_radius_m();
  const auto walls = walls_of(scene.test);

  std::string out =
      "\"\"\"Written by " + program_identity() + " for Yade.\n\n" + kUse + "\"\"\"\n" + deck_comment(scene.title);
  out +=
      "from math import atan, cos, pi, sin, sqrt\n\nimport numpy as np\nfrom yade import *\nfrom yade import utils\n";
  out += "from yade.utils import facet, sphere, wall\nfrom yade.wrapper import *\nfrom yade.minieigenHP import *\n\n";
  const auto number = [&](const char* name, double value) { out += std::string(name) + " = " + exact(value) + "\n"; };
  out += "SHAPE = '" + word_of(bridge.shape, bridge_shapes) + "'\n";
  number("RADIUS", radius);
  number("A", bridge.a_n_m2);
  number("B", bridge.b_n_m);
  number("C", attraction_at_touch(bridge, radius));
  number("LIQUID_VOLUME", bridge.liquid_volume_m3);
  number("SURFACE_ENERGY", contact.surface_energy_j_m2);
  number("COHESION", cohesion_n(contact, pair));
  number("TOUCH_EXCESS", touch_excess_n(contact, pair));
  number("PASSAGE", kPassage * radius);
  number("FORMATION_GAP", gaps.formation_m);
  number("RUPTURE_GAP", gaps.rupture_m);
  out += "WALLS = [";
  for (const auto& wall : walls) out += "'" + wall.name + "', ";
  out += "]\n# of the grains, then of each wall: Young's modulus, Poisson's ratio, density, friction\n";
  out += "MATERIALS = [(" + exact(contact.youngs_modulus_pa) + ", " + exact(contact.poissons_ratio) + ", " +
         exact(scene.grain_density_kg_m3) + ", " + exact(contact.friction) + "),\n";
  for (const auto& [name, wall] : walls)
    out += "             (" + exact(wall.youngs_modulus_pa) + ", " + exact(wall.poissons_ratio) + ", 2500, " +
           exact(wall.friction) + "),  # " + name + "\n";
  std::string restitution = "RESTITUTION = [" + exact(contact.restitution),
              friction = "FRICTION = [" + exact(contact.friction);
  for (const auto& [name, wall] : walls) {
    restitution += ", " + exact(wall.restitution);
    friction += ", " + exact(wall.friction);
  }
  out += "            ]\n" + restitution + "]\n" + friction + "]\n";
  out += "# rolling: stiffness over the shear stiffness [m^2], largest moment over the normal force [m]\n";
  number("KROT", rolls ? 2.25 * lever * lever / constants.tangential_ratio : 0);
  number("ETA", rolls ? contact.rolling_friction * pair.effective_radius_m() : 0);
  out += "# longest time step; density of a grain, " + grain_density_in_words(scene) + "\n";
  number("TIME_STEP", deck_time_step_s(scene));
  number("GRAIN_DENSITY", scene.grain_density_kg_m3);
  return out + kModule;
}

/// A script with its numbers in place of their names with @.
std::string with_numbers(std::string script, std::initializer_list<std::pair<std::string, double>> numbers) {
  for (const auto& [name, value] : numbers) {
    const auto at = script.find("@" + name);
    script.replace(at, name.size() + 1, exact(value));
  }
  return script;
}

std::string slump_script(const SlumpTest& test) {
  return with_numbers(kSlump, {{"MOULD_BASE_RADIUS", test.mould.base_radius_m},
                               {"MOULD_TOP_RADIUS", test.mould.top_radius_m},
                               {"MOULD_HEIGHT", test.mould.height_m},
                               {"LIFT_VELOCITY", test.lift_velocity_m_s}});
}

std::string two_grains_script(const ExportScene& scene, const ContactModel& contact) {
  const Distances distances = two_grain_distances(contact, scene.radius_m());
  return with_numbers(kTwoGrains, {{"NEAREST", distances.nearest_m}, {"FARTHEST", distances.farthest_m}});
}

}  // namespace

Result<Export> export_yade(const ExportScene& scene) {
  const ContactModel& card = scene.contact();
  KnownLaws known{"Yade's Mindlin law",
                  {NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt, NormalLaw::sjkr},
                  kAllRolling,
                  kAllAttractions};
  if (card.normal == NormalLaw::jkr) known.attraction = {BridgeShape::none};  // as its DMT, which has none beside it
  Faults faults = unknown_laws(card, known);
  for (const auto& [name, wall] : walls_of(scene.test))
    if (wall.cohesion_factor > 0)
      faults.push_back({"test." + name + "_wall.cohesion_factor",
                        "is not 0, but the module attracts grains to grains only",
                        "calibrate with " + name + "_cohesion_factor 0"});
  if (!faults.empty()) return faults;

  const double radius = scene.radius_m();
  const ContactModel contact = with_nearest_law(card, NormalLaw::dmt, radius);
  const Sticking sticking = sticking_of(contact, 0.5 * radius);
  Export out;
  out.notes = differences_of_sticking(scene, contact, "Yade", sticking.load_n);
  if (sticking.pull_off_n > 0 || contact.bridge.shape != BridgeShape::none)
    out.notes.push_back(
        "The attraction, with formation, memory and rupture of bridges, runs in Python at every step: slow. It suits "
        "thousands of grains, not millions.");
  const double pull = sticking.pull_off_n + cohesion_n(contact, scene.mean_pair());
  if (contact.normal == card.normal && contact.friction_basis != FrictionBasis::elastic && pull > 0)
    out.notes.push_back(
        format("Yade's friction is that of the elastic force; on the card, of the total one. A contact that only its "
               "attraction (%.3g N) presses together holds %.3g N in Yade, %.3g N on the card.",
               pull, contact.friction * pull, contact.friction * held_normal_force_n(contact, sticking)));
  if (contact.rolling != RollingModel::none && contact.rolling_friction > 0)
    out.notes.push_back(
        "Rolling: the spring and the largest moment are those of two mean grains, on walls too; there is "
        "no dashpot.");
  const double weight = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * scene.grain_density_kg_m3 * kGravity;
  if (const auto note = note_of_constant_torque(scene, 10 * weight); !note.empty()) out.notes.push_back(note);
  out.files = {{"material.py", module_of(scene, contact)}, {"two_grains.py", two_grains_script(scene, contact)}};
  if (contact.normal != card.normal) out.files.push_back(sticking_curves(scene, contact, "yade"));
  if (const SlumpTest* test = scene.slump()) {
    if (test->drop) out.notes.push_back("The script runs step 1. The drop of the plate, step 2, is not part of it.");
    out.files.push_back({"slump.py", slump_script(*test)});
    out.files.push_back(grains_csv(scene));
  }
  if (contact.normal != card.normal)
    out.own_law = R"("contact": {"normal": "dmt", "attraction": "none"}, with "adhesion_pa" free)";
  out.instructions = "yade -n -x SCRIPT, which is slump.py or two_grains.py\n";
  if (scene.slump()) out.heap = "heap.dump";
  return out;
}

}  // namespace pastefit
