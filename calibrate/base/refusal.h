#pragma once

#include <utility>

#include "core/result.h"

namespace pastefit {

/// Exception that ends a verb of the program, or a call from Python. Thrown at that level only; lower levels return a
/// `Result`.
struct Refusal {
  Faults faults;  ///< all of them
  int status;     ///< exit status of the verb
};

inline constexpr int kBadInput = 2;  ///< unusable input; nothing was written
inline constexpr int kFailed = 1;    ///< no result, or the result could not be saved

inline void refuse(Faults faults, int status = kBadInput) {
  if (!faults.empty()) throw Refusal{std::move(faults), status};
}

template <class T>
T value_or_throw(Result<T> result, int status = kBadInput) {
  if (!result.ok()) throw Refusal{result.faults(), status};
  return std::move(result).value();
}

}  // namespace pastefit
