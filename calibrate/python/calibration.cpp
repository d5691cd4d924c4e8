#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/calibrate.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/inference/description.h"
#include "calibrate/python/module.h"
#include "calibrate/report/page.h"
#include "calibrate/report/run_recording.h"
#include "calibrate/report/summary.h"
#include "calibrate/store/program.h"
#include "calibrate/study/tests.h"

namespace pastefit::python {

namespace py = pybind11;

namespace {

struct CalibrationOptions {
  std::string study_file, out;
  bool resume = false, force = false;
  bool page = true;  ///< write the page; its film may need a simulation
  int threads = 0;
  double wall_budget_s = 0;
};

/// Calibration into a folder, as by `pastefit calibrate`. The constructor validates the input; `run` is called without
/// the interpreter's lock; `progress` may be called from another thread.
class CalibrationRun {
 public:
  CalibrationRun(std::shared_ptr<Study> study, CalibrationOptions options, std::shared_ptr<Stop> stop,
                 const std::optional<std::pair<py::function, std::string>>& engine)
      : study_(std::move(study)), options_(std::move(options)), stop_(std::move(stop)) {
    pool_.threads = options_.threads;
    pool_.wall_budget_s = options_.wall_budget_s;
    pool_.stop = &stop_->asked;
    if (engine) pool_.engine = engine_of(engine->first, engine->second);
    elsewhere_ = engine.has_value();
    refuse(in_file(validate(*study_, options_.threads), options_.study_file));
    folder_ = std::make_unique<OutputFolder>(
        value_or_throw(open_calibration_folder(options_.out, *study_, options_.resume, options_.force)));
    const std::string file = folder_->file(kStore);
    store_ = std::make_unique<Store>(value_or_throw(Store::open(file, {program_identity(), inputs_of(*study_)})));
    refuse(strangers_in(*study_, *store_, file));
  }

  void run() {
    LivePage page(folder_->path());
    RunRecordings looks;
    CalibrateCallbacks callbacks;
    callbacks.progress = [&](const Progress& progress) {
      keep(progress);
      if (options_.page && progress.phase != "examination") page.show(*study_, *store_);
    };
    callbacks.evaluated = [this](const EvaluationCounts& counts) {
      const std::lock_guard lock(mutex_);
      progress_.simulations = counts.simulated + counts.answered;
      progress_.best_error = counts.best_error;
    };
    if (options_.page && !elsewhere_) pool_.run_observer = &looks;
    result_ = value_or_throw(calibrate(*study_, *store_, pool_, callbacks, options_.study_file));
    callbacks.evaluated(result_.counts);
    write(elsewhere_ ? nullptr : &looks);
  }

  std::string progress() const {
    const std::lock_guard lock(mutex_);
    return progress_json(progress_).dump();
  }

  std::string result() const { return result_json(result_).dump(); }
  std::string evaluations() const { return evaluations_json(*store_).dump(); }

 private:
  void keep(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    const Progress before = progress_;
    progress_ = progress;
    progress_.simulations = std::max(progress.simulations, before.simulations);
    if (progress_.best_error < 0) progress_.best_error = before.best_error;
  }

  void write(RunRecordings* looks) const {
    if (!result_.card) return;
    const std::string findings = result_.inference ? describe(*result_.inference) : "";
    refuse(write_card(*folder_, *result_.card, summary_of(*result_.card, findings)));
    std::vector<std::string> files;
    if (options_.page)
      refuse(write_looks(*folder_, findings_of(*result_.card, *store_, result_.inference), stop_->asked,
                         {.threads = options_.threads, .seen = looks}, files));
  }

  const std::shared_ptr<Study> study_;
  const CalibrationOptions options_;
  const std::shared_ptr<Stop> stop_;
  PoolOptions pool_;
  bool elsewhere_ = false;  // simulations run on an executor
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<Store> store_;
  CalibrationResult result_;
  mutable std::mutex mutex_;  // guards what follows
  Progress progress_;
};

}  // namespace

void add_calibration(py::module_& module) {
  py::class_<CalibrationOptions>(module, "CalibrationOptions")
      .def(py::init<>())
      .def_readwrite("study_file", &CalibrationOptions::study_file)
      .def_readwrite("out", &CalibrationOptions::out)
      .def_readwrite("resume", &CalibrationOptions::resume)
      .def_readwrite("force", &CalibrationOptions::force)
      .def_readwrite("page", &CalibrationOptions::page)
      .def_readwrite("threads", &CalibrationOptions::threads)
      .def_readwrite("wall_budget_s", &CalibrationOptions::wall_budget_s);
  py::class_<CalibrationRun>(module, "CalibrationRun")
      .def(py::init<std::shared_ptr<Study>, CalibrationOptions, std::shared_ptr<Stop>,
                    const std::optional<std::pair<py::function, std::string>>&>())
      .def("run", &CalibrationRun::run, py::call_guard<py::gil_scoped_release>())
      .def("progress", &CalibrationRun::progress, py::call_guard<py::gil_scoped_release>())
      .def("result", &CalibrationRun::result)
      .def("evaluations", &CalibrationRun::evaluations);
}

}  // namespace pastefit::python
