#pragma once

#include <iterator>
#include <utility>

#include "core/result.h"

namespace pastefit {

/// Ends a verb of the program, or a call from Python, that cannot do what it was asked for. Only these throw it; what
/// they call answers with a `Result`.
struct Refusal {
  Faults faults;  ///< all of them
  int status;     ///< exit status of the verb
};

inline constexpr int kBadInput = 2;  ///< what the user gave cannot be used; nothing was written
inline constexpr int kFailed = 1;    ///< the run has no answer, or could not keep it

inline void refuse(Faults faults, int status = kBadInput) {
  if (!faults.empty()) throw Refusal{std::move(faults), status};
}

template <class T>
T value_or_throw(Result<T> result, int status = kBadInput) {
  if (!result.ok()) throw Refusal{result.faults(), status};
  return std::move(result).value();
}

/// Where all faults are to be told at once.
inline void append(Faults& faults, Faults more) {
  faults.insert(faults.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}
template <class T>
void append(Faults& faults, const Result<T>& result) {
  if (!result.ok()) append(faults, result.faults());
}

}  // namespace pastefit
