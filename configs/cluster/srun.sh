#!/bin/bash
# A shard for each task of one job: sbatch srun.sh SWEEP.json DIR
#SBATCH --ntasks=64
#SBATCH --time=1:00:00
#SBATCH --signal=TERM@90
exec srun --kill-on-bad-exit=0 grainsweep run "$1" --out "$2" --shard auto --threads 1 --tolerate-unsettled
