/// Fields for ParaView: VTK XML files and their time series.
///
/// Points and values are Float64; data are appended, raw and LZ4-compressed, so that a
/// reader gets back the same bits. The field data "made by" name the program
/// (dem/version.h), and nothing that differs between two runs of it. Every file is written
/// under a temporary name and renamed (dem/io/atomic_file.h). The folder must exist.
///
/// All writers throw NumericalError, naming file and reason, when the file cannot be
/// written (a full disk included), and std::logic_error when sizes or indices do not fit.
#pragma once

#include "dem/notation.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace mergel::dem {

/// A named quantity, one tuple per point or per line.
struct Field {
  std::string name;           ///< as ParaView shows it; unique in a file
  int components = 1;         ///< >= 1
  std::vector<double> values; ///< n * components, interleaved; SI
};

/// Points x [m], each a vertex cell, as .vtp.
void write_points(const std::filesystem::path& file, const std::vector<Vec3>& x,
                  const std::vector<Field>& point_fields);

/// Lines between points x [m], as .vtp; the fields belong to the lines (cell data).
void write_lines(const std::filesystem::path& file, const std::vector<Vec3>& x,
                 const std::vector<std::array<Index, 2>>& lines,
                 const std::vector<Field>& line_fields);

/// Triangles between points x [m], as .vtp; the fields belong to the points.
void write_surface(const std::filesystem::path& file, const std::vector<Vec3>& x,
                   const std::vector<std::array<Index, 3>>& triangles,
                   const std::vector<Field>& point_fields);

/// One file of a series.
struct SeriesEntry {
  double time = 0.0;          ///< [s]
  std::filesystem::path file; ///< relative to the folder of the .pvd, unless absolute there
};

/// Time series of files of one kind: a ParaView collection (.pvd).
class Series {
public:
  /// Nothing is written before the first add.
  /// @param earlier entries to keep in front, for example those of the run that is
  ///   continued (read_series())
  explicit Series(std::filesystem::path pvd, std::vector<SeriesEntry> earlier = {});

  /// Append `file`, written at `time` [s], and rewrite the .pvd; it lists paths relative to
  /// itself.
  void add(double time, const std::filesystem::path& file);

  /// Rewrite the .pvd, or remove it if there are no entries.
  void write() const;

  const std::vector<SeriesEntry>& entries() const { return entries_; }

private:
  std::filesystem::path pvd_;
  std::vector<SeriesEntry> entries_;
};

/// The entries of a .pvd, in the order of the file.
/// @throws InputError naming the file when it is missing or is no collection
std::vector<SeriesEntry> read_series(const std::filesystem::path& pvd);

} // namespace mergel::dem
