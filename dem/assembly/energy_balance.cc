#include "dem/assembly/energy_balance.h"

namespace mergel::dem {

EnergyBook energy_book(const Rock& rock, double dt)
{
  EnergyBook e;
  Particles now = rock.particles;
  KickWork work = rock.work;
  kick(now, rock.motion, 0.5 * dt, work);
  EnergySum kinetic = kinetic_energy_sum(now), walls, mirror;
  PairEnergy pairs =
      pair_energy(rock.material, rock.cell, rock.particles, rock.bonds, rock.contacts);
  for (const Mirror& m : rock.mirrors) mirror += m.energy;
  for (const PlaneWall& w : rock.planes) walls += w.contacts.energy();
  for (const Wall& w : rock.walls) walls += w.energy();
  for (const PileWall& w : rock.piles) walls += w.contacts.energy();
  PairLosses losses = rock.losses;
  ExactReduction sums;
  for (EnergySum* s :
       {&kinetic, &pairs.bonds, &pairs.contacts, &walls, &mirror, &work.gravity,
        &work.damping, &work.lock, &losses.slip, &losses.plastic, &losses.residue})
    sums.add(*s);
  sums.run(rock.comm);
  e.kinetic = kinetic.value();
  e.bonds = pairs.bonds.value();
  e.contacts = pairs.contacts.value();
  e.mirror = mirror.value();
  e.walls = walls.value();

  const WallPower power = wall_power(rock);
  e.gravity = work.gravity.value();
  e.wall_work = rock.wall_work.value() + 0.5 * dt * power.walls;
  e.pile_work = rock.pile_work.value() + 0.5 * dt * power.pile;
  e.cell_work = rock.cell_work.value() + 0.5 * dt * cell_power(rock);

  e.slip = losses.slip.value();
  e.plastic = losses.plastic.value();
  e.residue = losses.residue.value();
  e.lock = work.lock.value();
  e.damping = work.damping.value();
  return e;
}

double unexplained(const EnergyBook& now, const EnergyBook& start)
{
  return (now.stored() - start.stored()) - (now.put_in() - start.put_in()) +
         (now.lost() - start.lost());
}

} // namespace mergel::dem
