#include "calibrate/cli/interrupt.h"

#include <csignal>

namespace pastefit {

namespace {

std::atomic<bool> stop_requested = false;

extern "C" void request_stop(int) {
  stop_requested = true;
}

}  // namespace

const std::atomic<bool>& listen_for_stop() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
  return stop_requested;
}

}  // namespace pastefit
