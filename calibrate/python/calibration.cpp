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

/// Calibration into a folder, as by `pastefit calibrate`. The constructor validates the input; `run` is called without
/// the interpreter's lock; `progress` may be called from another thread.
class CalibrationRun {
 public:
  /// `page`: write the page; its film may need a simulation.
  CalibrationRun(std::shared_ptr<Study> study, std::string study_file, const std::string& out, bool resume, bool force,
                 bool page, int threads, double wall_budget_s, std::shared_ptr<Stop> stop,
                 const std::optional<std::pair<py::function, std::string>>& engine)
      : study_(std::move(study)),
        study_file_(std::move(study_file)),
        writes_page_(page),
        stop_(std::move(stop)),
        elsewhere_(engine.has_value()) {
    pool_.threads = threads;
    pool_.wall_budget_s = wall_budget_s;
    pool_.stop = &stop_->asked;
    if (engine) pool_.engine = engine_of(engine->first, engine->second);
    refuse(in_file(validate(*study_, threads), study_file_));
    folder_ = std::make_unique<OutputFolder>(value_or_throw(open_calibration_folder(out, *study_, resume, force)));
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
      if (writes_page_ && progress.phase != "examination") page.show(*study_, *store_);
    };
    callbacks.evaluated = [this](const EvaluationCounts& counts) {
      const std::lock_guard lock(mutex_);
      progress_.simulations = counts.simulated + counts.answered;
      progress_.best_error = counts.best_error;
    };
    if (writes_page_ && !elsewhere_) pool_.run_observer = &looks;
    result_ = value_or_throw(calibrate(*study_, *store_, pool_, callbacks, study_file_));
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
    if (writes_page_)
      refuse(write_looks(*folder_, findings_of(*result_.card, *store_, result_.inference), stop_->asked,
                         {.threads = pool_.threads, .seen = looks}, files));
  }

  const std::shared_ptr<Study> study_;
  const std::string study_file_;
  const bool writes_page_;
  const std::shared_ptr<Stop> stop_;
  const bool elsewhere_;  // simulations run on an executor
  PoolOptions pool_;
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<Store> store_;
  CalibrationResult result_;
  mutable std::mutex mutex_;  // guards what follows
  Progress progress_;
};

}  // namespace

void add_calibration(py::module_& module) {
  py::class_<CalibrationRun>(module, "CalibrationRun")
      .def(py::init<std::shared_ptr<Study>, std::string, const std::string&, bool, bool, bool, int, double,
                    std::shared_ptr<Stop>, const std::optional<std::pair<py::function, std::string>>&>())
      .def("run", &CalibrationRun::run, py::call_guard<py::gil_scoped_release>())
      .def("progress", &CalibrationRun::progress, py::call_guard<py::gil_scoped_release>())
      .def("result", &CalibrationRun::result)
      .def("evaluations", &CalibrationRun::evaluations);
}

}  // namespace pastefit::python
