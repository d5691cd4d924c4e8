#pragma once

#include <string>

#include "calibrate/report/run_recording.h"

namespace pastefit {

/// A film as a page holds it; empty without pictures.
struct CodedRecording {
  /// What a page needs to know of it before it reads the grains, as JSON:
  ///     {"quantum_m", "low_m": [x, y, z], "most_pull_n", "reels": [{"grains", "frames": [{"time_s", "phase", "walls":
  ///     [...]}]}]};
  /// "walls" is left out where they stand as in the frame before.
  std::string index;
  /// Its grains, deflated (zlib) and in base64. Before that, for each part:
  ///     radii        16 bits a grain, in quanta;
  ///     each frame   x, y and z of all grains, 16 bits each, in quanta from `low_m`; then their speeds, 8 bits:
  ///                  51 (log10(v in m/s) + 4), 0 to 255; then what they touch, 8 bits; then what is pulled on them,
  ///                  255 times the share of most_pull_n, the largest pull in the film.
  /// Numbers of 16 bits stand as all their low bytes, then all their high ones. A frame that is not the first of its
  /// part holds the differences from the one before, modulo 2^16 or 2^8.
  /// A quantum is 0.05 mm, or more if the film is wider than 16 bits of that.
  std::string grains;

  bool empty() const { return grains.empty(); }
  bool operator==(const CodedRecording&) const = default;
};

CodedRecording coded(const RunRecording& film);

}  // namespace pastefit
