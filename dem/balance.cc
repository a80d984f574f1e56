#include "dem/balance.h"

namespace mergel::dem {

EnergyBook energy_book(const Rock& rock, double dt)
{
  EnergyBook e;
  Particles now = rock.particles;
  KickWork work = rock.work;
  kick(now, rock.motion, 0.5 * dt, work);
  e.kinetic = kinetic_energy(now);
  const PairEnergy pairs =
      pair_energy(rock.material, rock.cell, rock.particles, rock.bonds, rock.contacts);
  e.bonds = pairs.bonds;
  e.contacts = pairs.contacts;
  for (const Mirror& m : rock.mirrors) e.mirror += m.energy;
  for (const PlaneWall& w : rock.planes) e.walls += w.contacts.energy();
  for (const Wall& w : rock.walls) e.walls += w.energy();
  for (const PileWall& w : rock.piles) e.walls += w.contacts.energy();

  const WallPower power = wall_power(rock);
  e.gravity = work.gravity.value();
  e.wall_work = rock.wall_work.value() + 0.5 * dt * power.walls;
  e.pile_work = rock.pile_work.value() + 0.5 * dt * power.pile;

  e.slip = rock.losses.slip.value();
  e.plastic = rock.losses.plastic.value();
  e.residue = rock.losses.residue.value();
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
