"""A mould full of grains at rest is lifted at constant speed."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene import *

v = values()
surface = material(v)
add_grains(v, surface)
O.bodies.append(wall(0.0, axis=2, sense=1, material=surface))
mould = O.bodies.append(ymport.stl(v['mould'], material=surface))
lift = TranslationEngine(translationAxis=(0, 0, 1), velocity=v['lift_speed'], ids=mould, dead=True)
set_engines(v, [lift])
O.run(int(v['warm_steps']), True)
lift.dead = False
timed(v['steps'])
