/// Names of the numbers of a loading stage in a checkpoint.
#pragma once

#include "dem/element/stress_path.h"
#include "dem/io/state/named_numbers.h"

namespace mergel::dem {

inline const char* const axis_names[] = {"x", "y", "z"};

/// Append the components of a vector: "stress [Pa]" becomes "stress x [Pa]".
template <class Numbers, class Vector>
void append_vector(Numbers& to, const std::string& name, const std::string& unit, Vector& v)
{
  for (int a = 0; a < 3; ++a)
    to.push_back({name + ' ' + axis_names[a] + ' ' + unit, &v[a]});
}

template <class Numbers, class Stage>
void append_stage(Numbers& to, Stage& c)
{
  to.insert(to.end(),
            {{"stage: stress at zero [Pa]", &c.at_zero},
             {"stage: slope [-]", &c.slope},
             {"stage: direction [-]", &c.direction},
             {"stage: target [Pa] or [-]", &c.target},
             {"stage: controlled stress at the start [Pa]", &c.controlled_stress_at_start},
             {"stage: strain at the start [-]", &c.strain_at_start},
             {"stage: value at the start [Pa] or [-]", &c.value_at_start},
             {"stage: strain to return to [-]", &c.strain_to_return},
             {"stage: share of the approach that remains [-]", &c.remaining}});
  for (std::size_t a = 0; a < 3; ++a)
    to.push_back({std::string("stage: stress to hold ") + axis_names[a] + " [Pa]",
                  &c.rules[a].stress});
  append_vector(to, "stage: edge at the start", "[m]", c.size_0);
  append_vector(to, "stage: stress off what is to hold", "[Pa]", c.offset);
}

template <class Counts, class Stage>
void append_stage_counts(Counts& to, Stage& c)
{
  to.insert(to.end(),
            {{"stage: controlled axes", &c.controlled, ActiveStage::Controlled::y},
             {"stage: rule of the other axes", &c.follow, ActiveStage::Follow::each},
             {"stage: quantity of the target", &c.quantity, Quantity::controlled_stress},
             {"stage: returns", &c.returns},
             {"stage: approaches", &c.is_approaching}});
  for (std::size_t a = 0; a < 3; ++a)
    to.push_back({std::string("stage: rule of axis ") + axis_names[a], &c.rules[a].kind,
                  AxisRule::Kind::stress_controlled});
}

} // namespace mergel::dem
