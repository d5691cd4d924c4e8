#include "calibrate/store/checkpoint.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "calibrate/base/atomic_file.h"
#include "calibrate/base/text.h"
#include "calibrate/store/program.h"
#include "core/step/kernels.h"

namespace pastefit {

namespace {

const std::string kFormat = "pastefit-checkpoint-1";

/// SSE2 gives other bits than the other instruction sets.
bool rounds_once() {
  return kernels_of_this_processor().instruction_set != four_lanes::kernels.instruction_set;
}

std::string name_of_run(const Test& test, const RunOptions& options) {
  const auto& step = options.steps.fixed_step_s;
  return content_hash(
      nlohmann::json{identity_of(test), step ? nlohmann::json(*step) : nlohmann::json(), rounds_once()}.dump());
}

constexpr double kLongest_s = 1e9;  // longest run, thirty years

const char* const kAnew = "delete it to start anew, or name another file";

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path file, const Test& test, const RunOptions& options)
    : file_(std::move(file)), run_(name_of_run(test, options)) {}

Result<RunState> Checkpoint::read() const {
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) return RunState{};
  const auto fault = [&](std::string what, std::string remedy) {
    return Fault{file_.string(), std::move(what), std::move(remedy)};
  };
  if (!std::filesystem::is_regular_file(file_, error)) return fault("is not a regular file", "the name of a file");
  std::ifstream in(file_, std::ios::binary);
  if (!in) return fault(std::string("cannot be read: ") + std::strerror(errno), "a file that can be read");
  // The first line is read separately, so that no other file is loaded into memory.
  std::string whole(kFormat.size() + 1, '\0');
  if (!in.read(whole.data(), static_cast<std::streamsize>(whole.size())) || whole != kFormat + "\n")
    return fault("is not a checkpoint of pastefit", "name another file, which it would replace");
  std::ostringstream content;
  content << in.rdbuf();
  whole += std::move(content).str();
  std::string_view left = whole;
  next_line(left);
  const std::string_view program = next_line(left), run = next_line(left);
  if (program != program_identity())
    return fault("was written by " + printable(std::string(program)) + ", this is " + program_identity(),
                 std::string("go on with that program; or ") + kAnew);
  if (run != run_)
    return fault("is of another run: another test, seed, --set or --time-step",
                 std::string("go on with the same command; or ") + kAnew);
  const std::string wall(next_line(left)), hash(next_line(left));
  if (content_hash(wall + "\n" + std::string(left)) != hash || left.empty())
    return fault("is damaged: its state is not what was written", kAnew);
  const auto wall_s = parsed_number<double>(wall);
  if (!wall_s || !(*wall_s >= 0 && *wall_s <= kLongest_s))
    return fault("is damaged: the time it has taken is not a number of seconds", kAnew);
  return RunState{std::string(left), *wall_s};
}

Faults Checkpoint::write(const RunState& state) const {
  const std::string body = format("%.6g", state.wall_s) + "\n" + state.bytes;
  const auto end = body.find('\n') + 1;
  return write_atomically(file_, kFormat + "\n" + program_identity() + "\n" + run_ + "\n" + body.substr(0, end) +
                                     content_hash(body) + "\n" + state.bytes);
}

Faults Checkpoint::no_state_of_this_run(std::string_view why) const {
  return {{file_.string(), "is damaged: " + std::string(why), kAnew}};
}

void Checkpoint::remove() const {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace pastefit
