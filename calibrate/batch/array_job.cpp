#include "calibrate/batch/array_job.h"

#include "calibrate/base/shell_word.h"
#include "calibrate/store/program.h"

namespace pastefit {

namespace {

/// What both scripts begin with.
std::string heading_of_job(const ArrayJob& job, const std::string& meaning, const std::string& name) {
  return "#!/bin/bash\n# " + meaning + " Written by pastefit " + program_version() +
         ".\n# Time limit, partition, account and memory: options of sbatch, or further #SBATCH lines.\n#SBATCH "
         "--job-name=" +
         name + "\n#SBATCH --chdir=" + shell_word(job.directory.string()) + "\n#SBATCH --nodes=1 --ntasks=1\n";
}

std::string studies_of(const ArrayJob& job) {
  std::string out = "studies=(\n";
  for (const std::string& study : job.studies) out += "  " + shell_word(study) + "\n";
  return out + ")\n";
}

/// A file that Slurm writes the output to.
std::string output_line(const ArrayJob& job, const std::string& name) {
  return "#SBATCH --output=" + shell_word((job.out / name).string()) + " --open-mode=append\n";
}

constexpr const char* kElement = R"sh(
driver=
requeue() { echo "$1: the element is queued again and goes on where it was"; scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"; }
# Before the time limit, and where Slurm or a person ends the job, the calibration ends with all that it has simulated.
trap 'time_is_up=yes; kill -TERM $driver' USR1
trap 'kill -TERM $driver' TERM
)sh";

constexpr const char* kWait = R"sh(driver=$!
wait $driver; status=$?
while kill -0 $driver 2>/dev/null; do wait $driver; status=$?; done
if [ -n "$time_is_up" ]; then
  requeue "the time is up"
elif [ $status -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  requeue "pastefit was killed (status $status)"
fi
exit $status
)sh";

}  // namespace

std::string array_job_script(const ArrayJob& job) {
  const std::string last = std::to_string(job.studies.size() - 1);
  return heading_of_job(job, "Calibrates one study per element.", "pastefit") + "#SBATCH --array=0-" + last +
         "\n#SBATCH --cpus-per-task=" + std::to_string(job.workers) + "\n#SBATCH --requeue --signal=B:USR1@120\n" +
         output_line(job, "slurm-%a.txt") + studies_of(job) + kElement + shell_word(job.program.string()) +
         " batch \"${studies[SLURM_ARRAY_TASK_ID]}\" --out " + shell_word(job.out.string()) +
         " --workers \"$SLURM_CPUS_PER_TASK\" --no-table &\n" + kWait;
}

std::string table_job_script(const ArrayJob& job) {
  return heading_of_job(job, "Makes the table of the studies.", "pastefit-table") + "#SBATCH --requeue\n" +
         output_line(job, "slurm-table.txt") + studies_of(job) + "exec " + shell_word(job.program.string()) +
         " batch \"${studies[@]}\" --out " + shell_word(job.out.string()) + " --table\n";
}

}  // namespace pastefit
