#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pastefit {

/// True if standard error is a terminal in which a line can be rewritten.
bool is_terminal();

/// Columns of the terminal of standard error; 80 without one.
std::size_t columns();

/// Formats a message for standard error: on a terminal, lines are broken between words.
std::string for_terminal(const std::string& text);

/// Joins as many parts by commas as fit on a line; the first one always, truncated if necessary.
std::string fitted(const std::vector<std::string>& parts);

/// Waiting time from `least_s` to `most_s` as text: "40 s to 3 min".
std::string range_of_time(double least_s, double most_s);

/// Prints a text, or values with a printf pattern, to standard output, without control sequences (`lines_of`).
void print(const std::string& text);
[[gnu::format(printf, 1, 2)]] void print(const char* pattern, ...);

/// Prints progress and notes to standard error in the same way; silent after `be_quiet`. Not for faults, and not for
/// reasons why there is no result.
void note(const std::string& text);
[[gnu::format(printf, 1, 2)]] void note(const char* pattern, ...);
void be_quiet();
bool is_quiet();

/// Prevents the next opened file from taking the place of a closed standard stream. Call this first. Also ignores a
/// closed output pipe, which `after_output` reports.
void guard_standard_streams();

/// Exit status after all output: `status`, or failure if standard output was not written completely.
int after_output(int status);

}  // namespace pastefit
