/// The job whose case a case file is, of those that make a specimen.
#pragma once

#include "apps/case/case_scan.h"

#include <string>
#include <vector>

namespace mergel::apps {

enum class CaseJob {
  sample, ///< a specimen and nothing else
  pile,
  element,
  triaxial,
  brazilian
};

/// A section Pile, or `shape = half cylinder`, tells a case of pile; a section Plates, or
/// `Loading/velocity`, one of brazilian; a section Membrane or Platens one of triaxial; a
/// section Loading, without Particles, one of triaxial for a cylinder and else of element. A
/// cylinder without `shape` is told by its keys.
/// @param set overrides, as of --set @throws InputError when one has another form
CaseJob job_of_case(const CaseScan& scan, const std::vector<std::string>& set);

} // namespace mergel::apps
