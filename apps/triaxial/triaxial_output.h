/// Results of `mergel triaxial`: history.csv, localisation.csv and the frames for ParaView.
#pragma once

#include "apps/run/frames.h"
#include "apps/triaxial/triaxial_case.h"
#include "coupling/triaxial/specimen_bands.h"
#include "dem/io/history.h"

namespace mergel::apps {

class TriaxialOutput {
public:
  TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c);
  /// Continue the files that the folder `earlier`, which may be `folder`, held when save()
  /// wrote `state`. @throws InputError when a table is another one
  TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c,
                 const std::filesystem::path& earlier, const dem::State& state);

  /// @param output null on all ranks but the first
  static void save(dem::State& state, const TriaxialOutput* output);
  /// Lines on what `folder` lacks of the results before `state`; "" when it lacks nothing.
  /// @throws InputError when a table is another one
  static std::string check(const std::filesystem::path& folder, const TriaxialCase& c,
                           const dem::State& state);

  void record(const coupling::TriaxialRecord& r, const StageLabel& stage);
  /// @param d_50 [m]
  void record(const coupling::BandRecord& r, double d_50, const StageLabel& stage);
  /// @throws NumericalError when another program has touched a table
  void require_in_place() const
  {
    history_.require_in_place();
    bands_.require_in_place();
  }
  /// The next frame consists of particles, bonds and contacts, which any rank may write into these
  /// files,
  dem::AssemblyFiles files() const;
  /// of platens and membrane,
  void write_fields(const coupling::CoupledSystem& system) const;
  /// and of a line in each series, when all files are there. @param time [s]
  void add_frame(double time) { frames_.add(time); }

private:
  dem::History history_, bands_;
  Frames frames_;
};

/// Fields of the particles: "shear strain [-]" and so on, "shear strain of the increment [-]" and
/// so on.
std::vector<dem::Field> fields_of(const coupling::LocalStrains& strains);

} // namespace mergel::apps
