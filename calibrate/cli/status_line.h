#pragma once

#include <chrono>
#include <string>

namespace pastefit {

/// Where some work is, on standard error: one line that is rewritten in place on a terminal, else a plain line now and
/// then. Nothing while the program is quiet. One caller at a time.
class StatusLine {
 public:
  using Clock = std::chrono::steady_clock;
  /// When a line is due: after the start, after another one on a terminal, after another one elsewhere.
  struct Schedule {
    Clock::duration first = std::chrono::seconds(2);
    Clock::duration on_terminal = std::chrono::milliseconds(500), elsewhere = std::chrono::seconds(10);
  };
  StatusLine();
  explicit StatusLine(const Schedule& schedule);

  bool is_terminal() const { return terminal_; }
  double gone_s() const;
  bool is_due() const;
  void show(const std::string& line);
  void clear();  ///< takes a rewritten line away
  void keep();   ///< leaves it as it is, and goes on below

 private:
  const Schedule schedule_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
  bool shown_ = false;
};

}  // namespace pastefit
