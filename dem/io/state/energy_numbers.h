/// The terms of an energy balance as named numbers of a checkpoint.
#pragma once

#include "dem/assembly/energy_balance.h"
#include "dem/io/state/named_numbers.h"

namespace mergel::dem {

/// Append all terms of `e`, a const one to save only, with `of` in front of their names.
template <class Numbers, class Balance>
void append_energies(Numbers& to, const std::string& of, Balance& e)
{
  to.insert(to.end(), {{of + "kinetic [J]", &e.kinetic},
                       {of + "of bonds [J]", &e.bonds},
                       {of + "of contacts [J]", &e.contacts},
                       {of + "at walls [J]", &e.walls},
                       {of + "at the mirror [J]", &e.mirror},
                       {of + "of gravity [J]", &e.gravity},
                       {of + "work of walls [J]", &e.wall_work},
                       {of + "work of rigid walls [J]", &e.rigid_wall_work},
                       {of + "work of the cell [J]", &e.cell_work},
                       {of + "slip [J]", &e.slip},
                       {of + "plasticity and damage [J]", &e.plastic},
                       {of + "released at bond breakage [J]", &e.breakage_release},
                       {of + "rotation-constraint loss [J]", &e.rotation_constraint},
                       {of + "damping [J]", &e.damping}});
}

/// Append what an energy alarm knows.
template <class Numbers, class Alarm>
void append_alarm(Numbers& to, Alarm& a)
{
  to.insert(to.end(), {{"energy error of the last record [-]", &a.before},
                       {"energy error of the alarm [-]", &a.first_error},
                       {"time of the alarm [s]", &a.first_time}});
}

} // namespace mergel::dem
