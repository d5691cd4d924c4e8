"""Written by @program@ for Yade.

SI units. In a script of your own, beside this file, with the walls of WALLS in their order:

    from material import *
    grain, *walls = materials()           # appended to the scene; density GRAIN_DENSITY, mean radius RADIUS
    ip2, law2 = laws(grain, *walls)       # for the InteractionLoop
    attraction = Attraction(ids, radii)   # of the grains; attraction.act() in every step after the InteractionLoop
    O.dt = TIME_STEP                      # or less
"""
@title@
from math import atan, cos, pi, sin, sqrt

import numpy as np
from yade import *
from yade import utils
from yade.utils import facet, sphere, wall
from yade.wrapper import *
from yade.minieigenHP import *

SHAPE = '@shape@'
RADIUS = @radius@
A = @a@
B = @b@
C = @c@
LIQUID_VOLUME = @liquid_volume@
SURFACE_ENERGY = @surface_energy@
COHESION = @cohesion@
TOUCH_EXCESS = @touch_excess@
PASSAGE = @passage@
FORMATION_GAP = @formation_gap@
RUPTURE_GAP = @rupture_gap@
WALLS = [@walls@]
# of the grains, then of each wall: Young's modulus, Poisson's ratio, density, friction
MATERIALS = [@materials@
            ]
RESTITUTION = [@restitution@]
FRICTION = [@friction@]
# rolling: stiffness over the shear stiffness [m^2], largest moment over the normal force [m]
KROT = @krot@
ETA = @eta@
# longest time step; density of a grain, @density@
TIME_STEP = @time_step@
GRAIN_DENSITY = @grain_density@


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
