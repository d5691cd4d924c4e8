#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pastefit {

/// A number that is not in its range, bounds included.
struct OutOfRange {
  double value = 0, smallest = 0, largest = 0;
  std::string unit;
};

/// One thing that is wrong in what the user gave: where it stands, what is wrong, and what would be right.
struct Fault {
  std::string where;   ///< place in the file, e.g. "apparatus.mould.height_mm", or an option's name
  std::string what;    ///< what is wrong, with the value
  std::string remedy;  ///< what would be right
  std::optional<OutOfRange> range = std::nullopt;  ///< what `what` and `remedy` say, where that is all there is to say
};

using Faults = std::vector<Fault>;

/// A value, or every fault that kept it from being made.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Faults faults) : content_(std::move(faults)) {}
  Result(Fault fault) : content_(Faults{std::move(fault)}) {}

  bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }
  const T& value() const& { return std::get<T>(content_); }
  T& value() & { return std::get<T>(content_); }
  T&& value() && { return std::get<T>(std::move(content_)); }
  const Faults& faults() const { return std::get<Faults>(content_); }

 private:
  std::variant<T, Faults> content_;
};

/// Why a simulation has no answer. Bad physics is a result, never an exception.
enum class FailureReason {
  non_finite,         ///< a position, velocity or force is not a number
  excessive_overlap,  ///< two bodies interpenetrate beyond the bound
  grain_lost,         ///< a grain passed through a boundary
  runaway_speed,      ///< a grain is faster than anything in the scene can make it
  energy_created,     ///< there is more energy than the energy balance explains
  energy_lost,        ///< there is less
  step_collapse,      ///< the stable time step shrinks without end
  never_settled,      ///< the heap is not at rest when the time allowed is over
  packing_failed,     ///< the mould could not be filled
  fell_apart,         ///< the specimen does not hold together
  step_limit,         ///< the bound on the number of steps was reached
  engine_failed,      ///< another engine, or the process it ran in, gave no answer
  stopped             ///< the caller asked to stop (time limit or interrupt)
};

/// The reason's name as it is stored and printed, e.g. "excessive_overlap".
std::string_view name_of(FailureReason reason);

/// A failed simulation, classified: what happened, when, to which grain, against which limit.
struct Failure {
  FailureReason reason{};
  std::string phase;        ///< e.g. "step1.lift"
  std::int64_t step = 0;    ///< time step at which it was seen
  double time_s = 0;        ///< simulated time at which it was seen
  std::int64_t grain = -1;  ///< identity of the grain, -1 if none
  double value = 0;         ///< what was seen
  double limit = 0;         ///< what is allowed
  std::string message;      ///< one sentence for a person, ending with what to do
};

}  // namespace pastefit
