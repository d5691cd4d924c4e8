#!/bin/bash
# Calibrates one study per element. Written by pastefit @version@.
# Time limit, partition, account and memory: options of sbatch, or further #SBATCH lines.
#SBATCH --job-name=pastefit
#SBATCH --chdir=@directory@
#SBATCH --nodes=1 --ntasks=1
#SBATCH --array=0-@last@
#SBATCH --cpus-per-task=@workers@
#SBATCH --requeue --signal=B:USR1@120
#SBATCH --output=@output@ --open-mode=append
studies=(
@studies@
)

driver=
requeue() { echo "$1: the element is queued again and continues where it was"; scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"; }
# Before the time limit, and where Slurm or a person ends the job, the calibration ends with all that it has simulated.
trap 'time_is_up=yes; kill -TERM $driver' USR1
trap 'kill -TERM $driver' TERM
@program@ batch "${studies[SLURM_ARRAY_TASK_ID]}" --out @out@ --workers "$SLURM_CPUS_PER_TASK" --no-table &
driver=$!
wait $driver; status=$?
while kill -0 $driver 2>/dev/null; do wait $driver; status=$?; done
if [ -n "$time_is_up" ]; then
  requeue "the time is up"
elif [ $status -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
  requeue "pastefit was killed (status $status)"
fi
exit $status
