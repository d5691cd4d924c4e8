"""Grains at rest in an open box."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene import *

v = values()
surface = material(v)
add_grains(v, surface)
for place, axis, sense in ((0.0, 2, 1), (0.0, 0, 1), (v['length'], 0, -1), (0.0, 1, 1), (v['width'], 1, -1)):
    O.bodies.append(wall(place, axis=axis, sense=sense, material=surface))
set_engines(v)
O.run(int(v['warm_steps']), True)
timed(v['steps'])
