"""Shared by the decks. pastefit-bench passes pairs of name and value as arguments; numbers become numbers."""
import math
import sys
import time

import numpy
from yade import *
from yade import ymport
from yade.utils import *


def values():
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    return {name: value(text) for name, text in zip(sys.argv[1::2], sys.argv[2::2])}


def material(v):
    return O.materials.append(FrictMat(young=v['youngs_modulus'], poisson=v['poissons_ratio'], density=v['density'],
                                       frictionAngle=math.atan(v['friction'])))


def add_grains(v, material):
    """Grains of the file, in its order: lines of id, type, diameter, density, x, y, z after the word Atoms."""
    lines = open(v['grains']).read().split('Atoms', 1)[1].split('\n')
    table = numpy.array([line.split() for line in lines if line.strip()], dtype=float)
    O.bodies.append([sphere(tuple(row[4:7]), row[2] / 2, material=material) for row in table])


def set_engines(v, moving=()):
    """Hertz-Mindlin with rolling moments; if surface_energy > 0 adhesion (DMT), at walls too: it is one number."""
    adhesive = v['surface_energy'] > 0
    law = dict(en=v['restitution'], krot=v['roll_stiffness'], ktwist=0.0, eta=v['roll_limit'])
    if adhesive:
        law['gamma'] = v['surface_energy']
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()], verletDist=v['skin']),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                        [Ip2_FrictMat_FrictMat_MindlinPhys(**law)],
                        [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True, includeAdhesion=adhesive)]),
        *moving,
        NewtonIntegrator(damping=0.0, gravity=(0, 0, -v['gravity'])),
    ]
    O.dt = v['step']


def timed(steps):
    """Runs the steps and prints the processor seconds they took, as pastefit-bench reads it."""
    start = time.process_time()
    O.run(int(steps), True)
    print('Loop seconds %.6f' % (time.process_time() - start), flush=True)
