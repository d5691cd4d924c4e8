#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pastefit {

/// A number outside its range; the range includes its bounds.
struct OutOfRange {
  double value = 0, smallest = 0, largest = 0;
  std::string unit;
};

/// One error in the input: where it is, what is wrong, and what would be right.
struct Fault {
  std::string where;   ///< place in the file, e.g. "apparatus.mould.height_mm", or an option's name
  std::string what;    ///< what is wrong, with the value
  std::string remedy;  ///< what would be right
  std::optional<OutOfRange> range = std::nullopt;  ///< set if `what` and `remedy` only state this range
};

using Faults = std::vector<Fault>;

/// A value, or all the reasons why it could not be made.
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

/// Why a simulation failed. Bad physics is a result, never an exception.
enum class FailureReason {
  non_finite,         ///< a position, velocity or force is not a number
  excessive_overlap,  ///< two bodies interpenetrate beyond the bound
  grain_lost,         ///< a grain passed through a boundary
  runaway_speed,      ///< a grain is faster than physically possible in the scene
  energy_created,     ///< energy balance: more energy than explained
  energy_lost,        ///< energy balance: less energy than explained
  step_collapse,      ///< the stable time step decreases without limit
  never_settled,      ///< the heap is not at rest at the end of the allowed time
  packing_failed,     ///< the mould could not be filled
  fell_apart,         ///< the specimen collapsed
  step_limit,         ///< the limit on the number of steps was reached
  engine_failed,      ///< another engine, or its process, gave no result
  stopped             ///< the caller asked to stop (time limit or interrupt)
};

/// Name of the reason in files and messages, e.g. "excessive_overlap".
std::string_view name_of(FailureReason reason);

/// A classified failure: what happened, when, to which grain, against which limit.
struct Failure {
  FailureReason reason{};
  std::string phase;        ///< e.g. "step1.lift"
  std::int64_t step = 0;    ///< time step of detection
  double time_s = 0;        ///< simulated time of detection
  std::int64_t grain = -1;  ///< identity of the grain, -1 if none
  double value = 0;         ///< observed value
  double limit = 0;         ///< allowed value
  std::string message;      ///< one sentence for the user, ending with what to do
};

}  // namespace pastefit
