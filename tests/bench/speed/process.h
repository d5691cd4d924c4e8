#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pastefit {

/// What a child process left behind.
struct ChildResult {
  bool ok = false;     ///< it ended by itself with status 0
  std::string output;  ///< all it wrote; of a function: what it returned
  double wall_s = 0;
  double processor_s = 0;       ///< of the child and its own children
  std::int64_t peak_bytes = 0;  ///< largest resident set of any of them
};

/// Runs a program (found on the PATH) and waits for it. Its standard output and error are kept together; it is given
/// one thread (OMP_NUM_THREADS) and is ended after `limit_s`. Errors: `ok` is false and `output` says why.
ChildResult run_program(const std::vector<std::string>& command, unsigned limit_s);

/// Runs a function in a process of its own, so that its peak of memory is its own.
/// What it throws becomes `output`, with `ok` false.
ChildResult run_function(const std::function<std::string()>& function, unsigned limit_s);

/// True if a program of this name is on the PATH.
bool is_installed(const std::string& program);

}  // namespace pastefit
