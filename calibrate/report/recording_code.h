#pragma once

#include <string>

#include "calibrate/report/run_recording.h"

namespace pastefit {

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

}  // namespace pastefit
