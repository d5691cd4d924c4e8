#pragma once

#include <atomic>

namespace pastefit {

/// Becomes true at the first Ctrl-C, SIGTERM or SIGHUP, so that a run ends with the best so far; the second one kills,
/// as usual. Call once, before threads are started.
const std::atomic<bool>& listen_for_stop();

}  // namespace pastefit
