#pragma once

namespace pastefit {

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
