#!/bin/bash
# Grades a class with Slurm: one shard of it in each task of an array. See README.md.
#
#   COURSE=~/first-light CLASS=~/submissions OUT=~/graded PART=1 \
#       sbatch --array=1-17 --export=ALL slurm.sh
#
# OPTIONS holds more options of `grader class`, such as --before 2026-11-20.
#
#SBATCH --job-name=first-light
#SBATCH --cpus-per-task=2
#SBATCH --mem=6G
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=first-light-%A_%a.log
set -euo pipefail
: "${COURSE:?the folder of the course}" "${CLASS:?the folder of the submissions}"
: "${OUT:?the folder for the results}" "${PART:?the number of the part}"
cd "$COURSE"
exec target/release/class class "$CLASS" --out "$OUT" --part "$PART" \
    ${OPTIONS:-} --shard "$SLURM_ARRAY_TASK_ID/${SHARDS:-$SLURM_ARRAY_TASK_COUNT}" --jobs "${SLURM_CPUS_PER_TASK:-1}"
