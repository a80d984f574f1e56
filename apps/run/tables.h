/// Whether the tables (CSV) that a run writes are whole: as it has left them.
#pragma once

#include "dem/io/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mergel::apps {

/// The tables that a job writes from its begin to its end, history.csv first; none of mergel
/// sample and of an unknown job "".
std::vector<std::string> tables_of(const std::string& job);

/// Whether a table has a whole line: a run that was killed while it began may have written none.
bool has_line(const std::filesystem::path& table);

/// What a table that is there has lost at its head: "its heading is lost ..."; "" for nothing.
/// One that cannot be read has lost nothing.
/// @param job as of job_of(); with "" any first column that a job writes will do
std::string lost_heading(const std::filesystem::path& table, const std::string& job);

/// What a history has lost of its first records: every run records its start. "" for nothing.
/// A history that the run itself began at a checkpoint, because the earlier one was missing, has
/// lost nothing: begins_at_checkpoint().
std::string lost_start(const dem::Table& history);
bool begins_at_checkpoint(const dem::Table& history);
/// The same of a file; false where it cannot be read.
bool begins_at_checkpoint(const std::filesystem::path& history);

/// What a table of a finished run has lost at its end: a part of its last line, or the records up
/// to the last file of the series (.pvd) beside it. "" for nothing.
std::string lost_end(const dem::Table& table, const std::filesystem::path& folder);

} // namespace mergel::apps
