#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "calibrate/card/scene.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/python/module.h"
#include "calibrate/store/outcome_json.h"
#include "core/world/world.h"

namespace pastefit::python {

namespace py = pybind11;

namespace {

/// Grains at one time as in the engine: an array of `Motion`.
struct Frame {
  std::string phase;
  double time_s = 0;
  std::vector<Motion> grains;
  std::vector<std::int32_t> identity;
};

Frame frame_of(const Snapshot& snapshot) {
  const Particles& particles = snapshot.world->particles;
  return {std::string(snapshot.phase),
          snapshot.time_s,
          {particles.motion.begin(), particles.motion.begin() + particles.count()},
          particles.identity};
}

/// View of numbers of every grain, `stride` bytes apart, which keeps the frame alive. Shape: grains, then `width` if
/// that is > 0.
template <class Number>
py::array grains_array(const std::shared_ptr<Frame>& frame, const Number* first, std::size_t stride,
                       py::ssize_t width) {
  std::vector<py::ssize_t> shape{std::ssize(frame->grains)}, strides{static_cast<py::ssize_t>(stride)};
  if (width > 0) {
    shape.push_back(width);
    strides.push_back(sizeof(Number));
  }
  py::array view(py::dtype::of<Number>(), shape, strides, first, py::cast(frame));
  view.attr("flags").attr("writeable") = false;
  return view;
}

/// One run of a test for later inspection; `run` is called without the interpreter's lock.
class SimulationRun {
 public:
  /// `text`: content of the file, if there is one already.
  SimulationRun(const std::optional<std::string>& text, const std::string& file,
                const std::vector<std::string>& settings, const std::string& test_name,
                std::optional<std::uint64_t> seed, std::optional<double> frames_s, int threads,
                std::shared_ptr<Stop> stop)
      : frames_s_(frames_s), threads_(threads), stop_(std::move(stop)) {
    FoundScene found = value_or_throw(text ? scene_from_json(nlohmann::json::parse(*text), file, settings, test_name)
                                           : read_scene(file, settings, test_name));
    scene_ = std::move(found.scene);
    notes = std::move(found.notes);
    auto* test = std::get_if<Test>(&scene_);
    if (seed && !test) refuse({{"seed", "an impact has no random packing", "leave it out"}});
    if (seed) specimen_of(*test).packing_seed = *seed;
    if (test) refuse(validate_memory(*test, 1));
  }

  void run() {
    RunOptions options;
    options.steps.threads = threads_;
    options.watch_interval_s = frames_s_.value_or(0.1);
    options.watch = [this](const Snapshot& snapshot) {
      if (!snapshot.world) return true;
      if (!frames_s_) frames.clear();
      frames.push_back(std::make_shared<Frame>(frame_of(snapshot)));
      return true;
    };
    options.pulse = [this](const Snapshot&) { return !stop_->asked; };
    outcome = simulate(scene_, options);
  }

  std::string outcome_json() const {
    nlohmann::ordered_json out{{"readings", to_json(outcome.readings)},
                               {"failure", to_json(outcome.failure)},
                               {"run", to_json(outcome.run, 0)}};
    if (outcome.curve) {
      auto& points = out["curve"] = {{"x", outcome.curve->x}, {"y", outcome.curve->y}, {"points", {}}};
      for (const CurvePoint& point : outcome.curve->points) points["points"].push_back({point.x, point.y});
    }
    if (const auto* test = std::get_if<Test>(&scene_)) out["remarks"] = remarks_on(*test, {&outcome.readings, 1});
    return out.dump();
  }

  std::vector<std::shared_ptr<Frame>> frames;
  std::vector<std::string> notes;
  Outcome outcome;

 private:
  Scene scene_;
  std::optional<double> frames_s_;
  int threads_;
  std::shared_ptr<Stop> stop_;
};

}  // namespace

void add_simulation(py::module_& module) {
  using SharedFrame = std::shared_ptr<Frame>;
  py::class_<Frame, SharedFrame>(module, "Frame")
      .def_readonly("phase", &Frame::phase)
      .def_readonly("time_s", &Frame::time_s)
      .def_property_readonly("positions",
                             [](const SharedFrame& frame) {
                               return grains_array(frame, &frame->grains.data()->position.x, sizeof(Motion), 3);
                             })
      .def_property_readonly("radii",
                             [](const SharedFrame& frame) {
                               return grains_array(frame, &frame->grains.data()->radius, sizeof(Motion), 0);
                             })
      .def_property_readonly("velocities",
                             [](const SharedFrame& frame) {
                               return grains_array(frame, frame->grains.data()->velocity, sizeof(Motion), 3);
                             })
      .def_property_readonly("identities", [](const SharedFrame& frame) {
        return grains_array(frame, frame->identity.data(), sizeof(std::int32_t), 0);
      });
  py::class_<SimulationRun>(module, "SimulationRun")
      .def(py::init<const std::optional<std::string>&, const std::string&, const std::vector<std::string>&,
                    const std::string&, std::optional<std::uint64_t>, std::optional<double>, int,
                    std::shared_ptr<Stop>>())
      .def("run", &SimulationRun::run, py::call_guard<py::gil_scoped_release>())
      .def_readonly("frames", &SimulationRun::frames)
      .def_readonly("notes", &SimulationRun::notes)
      .def("outcome", &SimulationRun::outcome_json);
}

}  // namespace pastefit::python
