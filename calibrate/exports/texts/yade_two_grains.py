# Force of two grains against their distance.   yade -n -x two_grains.py
# The second is pulled from an overlap out beyond rupture, and pushed back; prints "apart r F", then "back r F",
# repulsion positive.
import os, sys
sys.path.insert(0, os.getcwd())
from material import *

grain, *wall_materials = materials()
nearest, farthest, distances = @nearest@, @farthest@, 240
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
