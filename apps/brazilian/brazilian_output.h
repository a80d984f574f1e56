/// Results of `mergel brazilian`: history.csv and the frames for ParaView.
#pragma once

#include "apps/run/frames.h"
#include "coupling/brazilian/brazilian_test.h"
#include "dem/io/history.h"

namespace mergel::apps {

class BrazilianOutput {
public:
  BrazilianOutput(const std::filesystem::path& folder, const coupling::DiscGeometry& disc);
  /// Continue the files that the folder `earlier`, which may be `folder`, held when save()
  /// wrote `state`. @throws InputError when the history is another one
  BrazilianOutput(const std::filesystem::path& folder, const coupling::DiscGeometry& disc,
                  const std::filesystem::path& earlier, const dem::State& state);

  /// @param output null on all ranks but the first
  static void save(dem::State& state, const BrazilianOutput* output);
  /// Lines on what `folder` lacks of the results before `state`; "" when it lacks nothing.
  /// @throws InputError when its history is another one
  static std::string check(const std::filesystem::path& folder, const dem::State& state);

  void record(const coupling::BrazilianRecord& r);
  /// @throws NumericalError when another program has touched the history
  void require_in_place() const { history_.require_in_place(); }
  /// Particles, bonds, contacts, breaks and plates at this time [s].
  /// @param assembly gathered: all particles
  /// @param porosity of the disc before the test, for the stress of the particles [-]
  void frame(double time, const dem::Assembly& assembly,
             const coupling::CoupledSystem& system, const coupling::BrazilianTest& test,
             double porosity);

private:
  coupling::DiscGeometry disc_;
  dem::History history_;
  Frames frames_;
};

} // namespace mergel::apps
