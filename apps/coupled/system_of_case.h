/// The coupled system of a case: its far field and what else coupling/ needs to know.
#pragma once

#include "apps/case/coupled_case.h"
#include "coupling/coupled_system.h"

#include <functional>
#include <string>

namespace mergel::apps {

/// Load what makes meshes, before there is work that would be lost without it. Collective.
/// @throws CollectiveFailure as fem::mesh_library() does
void load_mesh_library();

/// The far field of a case, on all ranks of `comm`, which must outlive it. Sets in `c` the
/// number of faces of its side, inside which the specimen is made.
/// @throws std::invalid_argument as fem::FarField does, CollectiveFailure as load_mesh_library()
fem::FarField make_far_field(CoupledCase& c, MPI_Comm comm);

/// A coupled system begins from these and a specimen, or continues from these and a state.
coupling::CoupledSpec coupled_spec(const CoupledCase& c);
std::vector<coupling::StructureSpec> structures(const CoupledCase& c,
                                                fem::FarField far_field);

/// Put the surcharge of the case on the topmost of all particles of its specimen.
void apply_surcharge(const CoupledCase& c, dem::Particles& p);

/// Lines on the impedance of an elastic far field, and of the rock where a test has measured
/// it, with a warning where they differ by more than 10 %.
std::string report_on_impedance(const CoupledCase& c);

/// The far field of such a system.
const fem::FarField& far_field_of(const coupling::CoupledSystem& coupled);

/// coupling::equilibrate() with a progress line on std::cout.
void equilibrate(coupling::CoupledSystem& coupled, double ratio, std::size_t max_steps,
                 const std::function<void()>& after_step);

} // namespace mergel::apps
