#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "calibrate/evaluate/run_observer.h"
#include "calibrate/laboratory/drawing.h"
#include "calibrate/report/run_recording.h"

namespace pastefit {

/// One simulation, and what is seen of it.
struct SeenSimulation {
  SeenRun seen;
  std::optional<RunRecorder> film;  ///< none if it is not filmed
  std::optional<Failure> failure;
  bool ended = false;

  /// A moment of this test.
  void see(const Test& test, const Snapshot& snapshot);
  void end(const Outcome& outcome);
};

/// What was seen of simulations while a search ran them. The first packing of each material is filmed, of the first few
/// materials: those that are confirmed.
class RunRecordings : public RunObserver {
 public:
  Watch begin(const Test& test) override;
  void end(const Test& test, const Outcome& outcome) override;
  double interval_s() const override { return RunRecorder::kInterval; }

  /// What was seen of this very simulation; nothing if it was not seen to its end. Given away once.
  std::optional<SeenSimulation> take(const Test& test);

 private:
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<SeenSimulation>> recordings_;  // by the simulation's name
  std::set<std::string> filmed_;                                       // materials
};

}  // namespace pastefit
