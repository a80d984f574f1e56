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
  /// The next frame consists of particles, bonds and contacts, which any rank may write into these
  /// files,
  dem::AssemblyFiles files() const;
  /// of breaks and plates,
  void write_fields(const dem::Assembly& assembly,
                    const coupling::BrazilianTest& test) const;
  /// and of a line in each series, when all files are there. @param time [s]
  void add_frame(double time) { frames_.add(time); }

private:
  coupling::DiscGeometry disc_;
  dem::History history_;
  Frames frames_;
};

} // namespace mergel::apps
