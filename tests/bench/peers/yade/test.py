"""Both steps of the slump test: lift of the mould, rise of the plate about its hinge, and drop.

The plate's motion is prescribed: a steady rise, then the free fall of the bare plate in four parts of constant angular
velocity.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene import *

v = values()
surface = material(v)
add_grains(v, surface)
plate = O.bodies.append(ymport.stl(v['plate'], material=surface))
O.bodies.append(wall(-v['ground_depth'], axis=2, sense=1, material=surface))
mould = O.bodies.append(ymport.stl(v['mould'], material=surface))
lift = TranslationEngine(translationAxis=(0, 0, 1), velocity=v['lift_speed'], ids=mould, dead=True)
turn = RotationEngine(rotationAxis=(0, -1, 0), rotateAroundZero=True, zeroPoint=(-v['hinge'], 0, 0), ids=plate,
                      angularVelocity=0, dead=True)
set_engines(v, [lift, turn])


def run(steps):
    O.run(int(v[steps]), True)


def stop(bodies):
    for i in bodies:
        O.bodies[i].state.vel = O.bodies[i].state.angVel = (0, 0, 0)


def read(step):
    # Some grains stick to the lifted mould and are no part of the heap.
    tops = [b.state.pos[2] + b.shape.radius for b in O.bodies if isinstance(b.shape, Sphere)]
    top = max(z for z in tops if z <= v['height'])
    print('%s.height_mm %.6f' % (step, 1000 * top), flush=True)


run('relax_steps')
lift.dead = False
run('lift_steps')
lift.dead = True
stop(mould)
run('rest_steps')
read('step1')

turn.dead = False
turn.angularVelocity = 2 * math.pi / v['raise_period']
run('raise_steps')
turn.dead = True
stop(plate)
run('raised_steps')
turn.dead = False
for part in '1234':
    turn.angularVelocity = -2 * math.pi / v['fall_period_' + part]
    run('fall_quarter_steps')
turn.dead = True
stop(plate)
run('rest_steps')
read('step2')
