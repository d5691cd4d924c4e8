#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// A batch as jobs of Slurm.
struct ArrayJob {
  std::filesystem::path program;     ///< pastefit, absolute
  std::filesystem::path directory;   ///< in which the jobs run, absolute: names of files are relative to it
  std::filesystem::path out;         ///< folder of the results
  std::vector<std::string> studies;  ///< files, one per element
  int workers = 1;                   ///< cores of an element
  int part = 1;                      ///< of the arrays that one batch needs
};

/// Elements that an array has at most: Slurm's own limit (MaxArraySize 1001), where its administrator has set no other.
inline constexpr std::size_t kMostElements = 1000;

/// What no script can name: Slurm reads a line of options to its end, and a backslash as the end of its wildcards.
Faults unusable_in_job(const ArrayJob& job);

/// The script of the array job: an element calibrates one study. It is asked for again when Slurm or its node ends it,
/// two minutes before the time limit, and up to three times when its process is killed; then it goes on where it was.
std::string array_job_script(const ArrayJob& job);

/// The script of the job that makes the table, to be started when the array has ended.
std::string table_job_script(const ArrayJob& job);

}  // namespace pastefit
