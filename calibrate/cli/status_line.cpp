#include "calibrate/cli/status_line.h"

#include <cstdio>

#include "calibrate/base/text.h"
#include "calibrate/cli/standard_output.h"
#include "calibrate/cli/terminal.h"

namespace pastefit {

StatusLine::StatusLine() : StatusLine(Schedule{}) {}

StatusLine::StatusLine(const Schedule& schedule)
    : schedule_(schedule), terminal_(pastefit::is_terminal()), next_(start_ + schedule.first) {}

double StatusLine::gone_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

bool StatusLine::is_due() const {
  return !is_quiet() && Clock::now() >= next_;
}

void StatusLine::show(const std::string& line) {
  if (is_quiet()) return;
  next_ = Clock::now() + (terminal_ ? schedule_.on_terminal : schedule_.elsewhere);
  shown_ = true;
  if (terminal_)
    std::fprintf(stderr, "\r%s\033[K", one_line(line).c_str());
  else
    note("%s\n", line.c_str());
}

void StatusLine::clear() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

void StatusLine::keep() {
  if (shown_ && terminal_) note("\n");
  shown_ = false;
}

}  // namespace pastefit
