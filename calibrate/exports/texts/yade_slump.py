# The slump test, step 1. In this folder:   yade -n -x slump.py
# Writes filled.dump and heap.dump (id x y z radius), prints the highest grain.
import os, sys
sys.path.insert(0, os.getcwd())
from material import *

MOULD_BASE_RADIUS, MOULD_TOP_RADIUS, MOULD_HEIGHT = @mould_base_radius@, @mould_top_radius@, @mould_height@
LIFT_VELOCITY, REST_TIME = @lift_velocity@, 2

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
