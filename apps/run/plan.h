/// What a case would run: sizes, steps, cost, and what is unusual of it. Estimates, each with its
/// rule, that mergel check prints.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/unusual.h"
#include "apps/run/jobs.h"
#include "apps/run/restart.h"

#include <string>

namespace mergel::apps {

/// Time of a particle and step on one core, all in [ns]: 70 to 105 bonded, 130 unbonded, 145 with
/// far field (apps/batch/README.md).
inline constexpr double usual_cost = 130.0;
/// The same of an element or triaxial test whose bonds yield and break; records and stresses of the
/// cell count in it.
inline constexpr double cost_of_test = 240.0;
/// Processor time of a step for each triangle of a membrane, its contacts included [s].
inline constexpr double seconds_of_triangle = 100e-9;
/// Processor time for the making of a specimen, for each particle [s] (apps/batch/README.md).
inline constexpr double seconds_to_make = 1.6e-3;
/// Of the start of the program, on each rank [s]: its libraries, MPI.
inline constexpr double seconds_to_start = 0.5;

struct Plan {
  double n_particles = 0.0; ///< expected, or of the specimen's file
  std::string particles_by; ///< where the number comes from
  double bonds_per_particle = 0.0;
  bool is_made = false; ///< the run makes its specimen
  double n_cells = 0.0; ///< of the far field
  double step = 0.0;    ///< [s]; 0: the job makes none
  double n_steps = 0.0;
  std::string steps_by;     ///< the rule
  double cost = usual_cost; ///< of a particle and step [ns]
  /// Processor time of a step beside its particles, that of a membrane [s].
  double step_overhead = 0.0;
  Remarks unusual;
};

/// Particles, bonds and time step of a specimen.
/// @param step_safety step over stable step
/// @throws InputError when the specimen's file cannot be read
Plan plan_of_specimen(const CaseFile& file, const SpecimenKeys& k,
                      const dem::PairMaterials& material, double step_safety,
                      double inertia_factor);

/// Steps and hours, on one core at the cost of the plan, that hardly anybody waits for.
void remark_on_length(Plan& plan);

/// The plan of a case file: reads and checks it as the job does, then asks plan_of(file, case).
/// @throws InputError naming file, line and key
template <class Case>
Plan plan_case(const JobOptions& options)
{
  CaseFile file;
  Case c;
  declare(file, c);
  read_case(file, options, std::nullopt);
  complete(file, c);
  Plan plan = plan_of(file, c);
  remark_on_length(plan);
  return plan;
}

/// Memory of the first rank [byte], which needs most: program, then far field or particles
/// (apps/batch/README.md, Sizing a run).
double memory_of(const Plan& plan);

/// What a run takes, by its parts [s].
struct RunTime {
  double start = 0.0, specimen = 0.0, steps = 0.0;
  double all() const { return start + specimen + steps; }
};
/// @param cost of a particle and step [ns]
RunTime time_of(const Plan& plan, double cost, int n_ranks);

} // namespace mergel::apps
