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

/// Picture: one value per grain of its part, ordered by identity.
struct RecordedFrame {
  double time_s = 0;  ///< on the clock of the film
  std::string phase;
  std::vector<Vec3> centres_m;
  std::vector<float> speeds_m_s;
  std::vector<std::uint8_t> coordination;  ///< number of touched grains
  std::vector<float> pulls_n;              ///< tension by neighbours (`pulls_of`)
  std::vector<Wall> walls;
};

/// Pictures with the same grains.
struct RecordingPart {
  std::vector<double> radii_m;
  std::vector<RecordedFrame> frames;
};

/// Film of a run: consecutive parts on one clock.
struct RunRecording {
  std::vector<RecordingPart> parts;

  std::size_t grains() const;  ///< of the largest part
  std::size_t frames() const;
};

/// Film as embedded in a page; empty without pictures.
struct CodedRecording {
  /// Index, as JSON:
  ///     {"quantum_m", "low_m": [x, y, z], "most_pull_n", "reels": [{"grains", "frames": [{"time_s", "phase", "walls":
  ///     [...]}]}]};
  /// "walls" is omitted if unchanged since the frame before.
  std::string index;
  /// Grains, deflated (zlib), in base64. For each part:
  ///     radii        16 bits a grain, in quanta;
  ///     each frame   x, y and z of all grains, 16 bits each, in quanta from `low_m`; then their speeds, 8 bits:
  ///                  51 (log10(v in m/s) + 4), 0 to 255; then their coordination, 8 bits; then their tension, 255
  ///                  times the share of most_pull_n, the largest tension in the film.
  /// 16-bit numbers are stored as all low bytes, then all high bytes. Frames other than the first of a part contain
  /// differences from the one before, modulo 2^16 or 2^8. The quantum is 0.05 mm, or more if the film is too wide for
  /// 16 bits.
  std::string grains;

  bool empty() const { return grains.empty(); }
  bool operator==(const CodedRecording&) const = default;
};

CodedRecording coded(const RunRecording& film);

/// Records the snapshots of a run (`RunOptions::watch`) as a film. A new part begins where grains are replaced or have
/// grown: at a stage with its own clock, and at each further drop of one heap, which its phases name.
class RunRecorder {
 public:
  static constexpr double kInterval = 0.02;  ///< [s] between two pictures, for `RunOptions::watch_interval_s`

  void add(const Snapshot& snapshot);

  /// The film, reduced to the capacity of a page: about 140 pictures, fewer with many grains, a quarter of them of the
  /// filling. Includes the first and last picture of each part.
  RunRecording film() &&;

 private:
  RunRecording film_;
  double begun_s_ = 0, first_s_ = 0;  // start of the part on the clocks of film and run
  double last_s_ = 0;                 // time of the run
  int drop_ = 0;
};

struct SeenSimulation {
  SeenRun seen;
  std::optional<RunRecorder> film;  ///< none if not filmed
  std::optional<Failure> failure;
  bool ended = false;

  void see(const Test& test, const Snapshot& snapshot);
  void end(const Outcome& outcome);
};

/// Simulations seen during a search. Films the first packing of the first few materials, those in confirmation.
class RunRecordings : public RunObserver {
 public:
  Watch begin(const Test& test) override;
  void end(const Test& test, const Outcome& outcome) override;
  double interval_s() const override { return RunRecorder::kInterval; }

  /// Removes and returns the recording of this simulation; nothing if it was not seen to its end.
  std::optional<SeenSimulation> take(const Test& test);

 private:
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<SeenSimulation>> recordings_;  // by key of the simulation
  std::set<std::string> filmed_;                                       // materials
};

}  // namespace pastefit
