/// The job whose case a case file is.
#pragma once

#include "apps/case/case_scan.h"

#include <string>
#include <vector>

namespace mergel::apps {

enum class CaseJob {
  sample, ///< a specimen and nothing else
  bond,
  pile,
  element,
  triaxial,
  brazilian
};

/// A section Particles tells a case of bond; a section Pile or Far field, or `shape = half
/// cylinder`, one of pile; a section Plates, or `Loading/velocity`, one of brazilian; a section
/// Membrane or Platens one of triaxial; sections Specimen and Loading one of triaxial for a
/// cylinder and else of element. A cylinder without `shape` is told by its keys.
/// @param set overrides, as of --set @throws InputError when one has another form
CaseJob job_of_case(const CaseScan& scan, const std::vector<std::string>& set);

/// The name of the job on the command line.
const char* name_of(CaseJob job);

} // namespace mergel::apps
