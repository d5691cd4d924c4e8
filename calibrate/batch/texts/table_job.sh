#!/bin/bash
# Makes the table of the studies. Written by pastefit @version@.
# Time limit, partition, account and memory: options of sbatch, or further #SBATCH lines.
#SBATCH --job-name=pastefit-table
#SBATCH --chdir=@directory@
#SBATCH --nodes=1 --ntasks=1
#SBATCH --requeue
#SBATCH --output=@output@ --open-mode=append
studies=(
@studies@
)
exec @program@ batch "${studies[@]}" --out @out@ --table
