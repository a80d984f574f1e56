/// What is read off the curves of loading stages: moduli, yield, strength. For any job with
/// stages.
#pragma once

#include "apps/case/case_file.h"
#include "apps/element/loading_stages.h"
#include "apps/run/summary.h"
#include "dem/element/element_test.h"

#include <optional>
#include <string>
#include <vector>

namespace mergel::apps {

/// Keys of section `Analysis`.
struct AnalysisKeys {
  double secant_from = 1e-4, secant_to = 1e-3; ///< strain [-]
  double yield_offset = 2e-4;                  ///< strain [-]
};
/// Declare them in the open section.
void declare(CaseFile& file, AnalysisKeys& keys);
/// @throws InputError naming file, line and key
void check(const CaseFile& file, const AnalysisKeys& keys);

/// What the analysis needs of a record.
struct StagePoint {
  std::size_t stage = 0;          ///< from 0
  bool is_approach = false;       ///< strains of the stage count from its end
  double controlled_strain = 0.0; ///< of the stage [-]
  dem::SoilState
      of_stage;           ///< strains from the start of the stage, or of the one it resumes
  std::size_t broken = 0; ///< bonds, so far
};

/// A result of the analysis: name, SI value and unit.
struct Finding {
  std::string name, unit; ///< "Young's modulus", "Pa"
  double value;
};

/// Outcome and results of one stage.
struct StageResult {
  std::string number, name; ///< "3a"; as the case says it
  dem::Outcome outcome = dem::Outcome::goes_on;
  std::optional<std::size_t> broken_in_approach; ///< bonds; none without an approach
  std::vector<Finding> findings;
  /// Mean pressure at which the specimen yielded in the approach, by the offset of the analysis
  /// [Pa]; none where it did not.
  std::optional<double> yield_in_approach = {};
  /// Number of the isotropic stage, or of the stage with an approach, in which the specimen yielded
  /// before; "" where it did not, and for stages that resume one.
  std::string yielded_before = {};
};

/// Results of each stage that was begun. A stage that others resume is analysed with them.
/// @param stages   of the test; those without an outcome were not begun
/// @param labels   of all stages
/// @param points   of all records of the stages that were begun, in order
std::vector<StageResult> analyse(const std::vector<dem::LoadingStage>& stages,
                                 const std::vector<StageLabel>& labels,
                                 const AnalysisKeys& keys,
                                 const std::vector<dem::Outcome>& outcomes,
                                 const std::vector<StagePoint>& points);

/// A line on how often the servo reached its largest rate; "" where it never did.
std::string servo_text(std::size_t n_limited, std::size_t n_steps);

/// Add the results to summary.json, and lines for each stage to the closing text.
void summarise(Summary& summary, const std::vector<StageResult>& stages,
               const AnalysisKeys& keys);

} // namespace mergel::apps
