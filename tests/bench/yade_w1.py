"""W1 in YADE: what a step of the same bonded block costs there.

    mergel bench --particles 50000 --write-block block.txt
    yade -n -x -j1 tests/bench/yade_w1.py block.txt [STEPS [REPEAT]]

The spheres, masses, velocities, bonds and the step are those of `mergel bench`; the bonds are
CohFrictPhys with bending and twisting moment, of the same mean stiffness, and do not break.
Two things are left out because YADE has no equal of them: the far-field contact that acts
across a gap, beside bonds too, and the yield surface. YADE does less here.
"""
import resource
import statistics
import sys
import time

from math import pi

from yade import utils

block = sys.argv[1]
steps = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
repeat = int(sys.argv[3]) if len(sys.argv) > 3 else 5

unit = 0.1e-3                      # mean diameter [m]
E, kappa, rho = 22.5e9, 2.4, 2556  # of the bond in W1
lambda_b = 1 / 3                   # bond radius over radius of the particle
out_of_reach = 1e15                # strength [Pa]

# YADE: k_n = young R, k_s = poisson k_n, k_b = alphaKr R^2 k_s, k_t = alphaKtw R^2 k_s;
# W1:   k_n = E pi (lambda_b R)^2/(2 R), k_s = k_n/kappa, k_b = k_n (lambda_b R)^2/4,
#       k_t = k_s (lambda_b R)^2/2.
material = CohFrictMat(young=E * pi * lambda_b**2 / 2, poisson=1 / kappa, density=rho,
                       frictionAngle=0.29, isCohesive=True, momentRotationLaw=True,
                       normalCohesion=out_of_reach, shearCohesion=out_of_reach,
                       alphaKr=kappa * lambda_b**2 / 4, alphaKtw=lambda_b**2 / 2,
                       etaRoll=-1, etaTwist=-1, fragile=True)
O.materials.append(material)

bonding = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()], [bonding],
                    [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
    NewtonIntegrator(damping=0.0),
]

with open(block) as lines:
    n, n_bonds, dt = next(lines).split()
    n, n_bonds, O.dt = int(n), int(n_bonds), float(dt)
    for _ in range(n):
        x, y, z, R, m, *v = map(float, next(lines).split())
        body = utils.sphere((x, y, z), R, material=material)
        body.state.mass = m  # the ends are heavy
        body.state.inertia = 0.4 * m * R * R * Vector3(1, 1, 1)
        body.state.vel = Vector3(*v)
        O.bodies.append(body)
    for _ in range(n_bonds):
        bond = utils.createInteraction(*map(int, next(lines).split()))
        bond.phys.unp = bond.geom.penetrationDepth  # no force at the present gap
bonding.setCohesionOnNewContacts = False

O.run(20, True)
blocks = []
for _ in range(repeat):
    start = time.perf_counter()
    O.run(steps // repeat, True)
    blocks.append(1e9 * (time.perf_counter() - start) / (n * (steps // repeat)))

alive = sum(1 for i in O.interactions if i.isReal and not i.phys.cohesionBroken)
memory = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / n
print("W1 in YADE: %d particles, %d steps" % (n, repeat * (steps // repeat)))
print("  time per particle-step  %.0f ns (%.0f to %.0f)" %
      (statistics.median(blocks), min(blocks), max(blocks)))
print("  time per bond-step      %.0f ns" % (statistics.median(blocks) * n / n_bonds))
print("  bonds                   %d of %d alive, %.2f a particle" % (alive, n_bonds, alive / n))
print("  real interactions       %d" % O.interactions.countReal())
print("  peak memory             %.0f byte a particle" % memory)
assert alive == n_bonds, "bonds broke: this is not W1"
