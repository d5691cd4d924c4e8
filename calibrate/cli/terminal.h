#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pastefit {

/// Whether standard error is a terminal in which a line can be rewritten.
bool is_terminal();

/// The columns of a line on standard error: of the terminal's window, 80 where there is none.
std::size_t columns();

/// A message as it is written to standard error: on a terminal its lines are broken between words.
std::string for_terminal(const std::string& text);

/// As many of the parts, joined by commas, as fit on a line; the first one always, cut if need be.
std::string fitted(const std::vector<std::string>& parts);

/// A time to wait, from `least_s` to `most_s`, in words: "40 s to 3 min".
std::string range_of_time(double least_s, double most_s);

/// Prints to standard output by printf's rules, without what could drive a terminal (`lines_of`).
[[gnu::format(printf, 1, 2)]] void print(const char* pattern, ...);

/// Says on standard error, by the same rules, what goes on and what is remarkable; nothing once `be_quiet` was called.
/// Faults, and why there is no answer, are no such notes.
[[gnu::format(printf, 1, 2)]] void note(const char* pattern, ...);
void be_quiet();
bool is_quiet();

/// Keeps a standard stream that was closed from being taken by the next file that is opened. Call first of all. Who
/// stops reading the output ends no run either: what is missing is told by `after_output`.
void guard_standard_streams();

/// The exit status once everything is printed: `status`, or that of a failure if standard output did not take it all.
int after_output(int status);

}  // namespace pastefit
