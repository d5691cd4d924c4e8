#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibrate/laboratory/drawing.h"
#include "calibrate/laboratory/engine.h"
#include "core/step/run.h"
#include "core/vec3.h"
#include "core/world/walls.h"

namespace pastefit {

/// A wall as it stands in one picture.
struct RecordedWall {
  std::string name;
  Shape shape;
};

/// One picture: a value for each grain of its part, in the order of their identities.
struct RecordedFrame {
  double time_s = 0;  ///< on the film's own clock
  std::string phase;
  std::vector<Vec3> centres_m;
  std::vector<float> speeds_m_s;
  std::vector<std::uint8_t> coordination;  ///< grains that touch it
  std::vector<float> pulls_n;              ///< what its neighbours pull on it (`pulls_of`)
  std::vector<RecordedWall> walls;
};

/// Pictures of the same grains.
struct RecordingPart {
  std::vector<double> radii_m;
  std::vector<RecordedFrame> frames;
};

/// A run as a film: one part after the other, on one clock.
struct RunRecording {
  std::vector<RecordingPart> parts;

  std::size_t grains() const;  ///< of the largest part
  std::size_t frames() const;
};

/// Makes a film of the moments of a run (`RunOptions::watch`). A part ends where the grains are other ones or have
/// grown: at a stage of the test that begins its own clock, and at each further drop of one heap, whose phases say that
/// they are of that.
class RunRecorder {
 public:
  static constexpr double kInterval = 0.02;  ///< [s] between two pictures, for `RunOptions::watch_interval_s`

  void add(const Snapshot& snapshot);

  /// The film, thinned to what a page can hold: about 140 pictures, fewer of many grains, a quarter of them of the
  /// filling. First and last of each part are in it.
  RunRecording film() &&;

 private:
  RunRecording film_;
  double begun_s_ = 0, first_s_ = 0;  // start of the part on the film's clock, and on that of the run
  double last_s_ = 0;                 // time of the run
  int drop_ = 0;
};

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
