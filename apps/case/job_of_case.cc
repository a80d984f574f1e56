#include "apps/case/job_of_case.h"

namespace mergel::apps {

CaseJob job_of_case(const CaseScan& scan, const std::vector<std::string>& set)
{
  std::vector<CaseEntry> entries = scan.entries;
  std::map<std::string, int> sections = scan.sections;
  for (const std::string& text : set) {
    entries.push_back(scan_override(text));
    sections.try_emplace(entries.back().section, 0);
  }
  const auto has = [&](const char* section) { return sections.contains(section); };
  std::string shape;
  bool has_diameter = false, has_velocity = false;
  for (const CaseEntry& e : entries) {
    if (e.section == "Loading" && e.key == "velocity") has_velocity = true;
    if (e.section != "Specimen") continue;
    if (e.key == "shape") shape = e.value;
    if (e.key == "diameter") has_diameter = true;
  }

  if (has("Particles")) return CaseJob::bond;
  if (has("Pile") || has("Far field") || shape == "half cylinder") return CaseJob::pile;
  if (has("Plates") || has_velocity) return CaseJob::brazilian;
  if (has("Membrane") || has("Platens")) return CaseJob::triaxial;
  if (!has("Loading") || !has("Specimen")) return CaseJob::sample;
  const bool is_round = shape.empty() ? has_diameter : shape == "cylinder";
  return is_round ? CaseJob::triaxial : CaseJob::element;
}

const char* name_of(CaseJob job)
{
  switch (job) {
  case CaseJob::sample:
    return "sample";
  case CaseJob::bond:
    return "bond";
  case CaseJob::pile:
    return "pile";
  case CaseJob::element:
    return "element";
  case CaseJob::triaxial:
    return "triaxial";
  case CaseJob::brazilian:
    return "brazilian";
  }
  return "";
}

} // namespace mergel::apps
