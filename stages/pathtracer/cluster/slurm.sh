#!/bin/sh
# Renders a picture in ranges of samples as a Slurm job array, and merges them.
#
#   slurm.sh PARTS SAMPLES OUT [FLAGS...] SCENE.dae
#   slurm.sh 64 4096 picture.exr -m 6 -r 3840 2160 scene.dae
#
# Run it on a login node: it submits itself twice, as the array and as the job that merges.
# PATHTRACER is the program (default: pathtracer); it, the scene and OUT have to be on a file
# system that all nodes share. Edit the limits of a part here:
part_flags="--cpus-per-task=16 --mem=4G --time=01:00:00"
merge_flags="--cpus-per-task=1 --mem=16G --time=00:30:00"
set -eu

pathtracer=${PATHTRACER:-pathtracer}
case "${1:-}" in
--part) # --part COUNT OUT FLAGS...: one task of the array
    count=$2
    out=$3
    shift 3
    first=$((SLURM_ARRAY_TASK_ID * count))
    exec "$pathtracer" -f "$out.parts/$first.sums" -t "${SLURM_CPUS_PER_TASK:-1}" \
        --first-sample "$first" -s "$count" "$@"
    ;;
--merge) # --merge OUT
    exec "$pathtracer" merge -f "$2" "$2.parts"/*.sums
    ;;
esac

if [ $# -lt 4 ]; then
    echo "usage: slurm.sh PARTS SAMPLES OUT [FLAGS...] SCENE.dae" >&2
    exit 2
fi
parts=$1
samples=$2
out=$3
shift 3
count=$((samples / parts))
if [ "$count" -lt 2 ] || [ $((count * parts)) -ne "$samples" ]; then
    echo "slurm.sh: SAMPLES has to be a multiple of PARTS, at least twice as large" >&2
    exit 2
fi
mkdir -p "$out.parts"
log="$out.parts/%A_%a.log"
# shellcheck disable=SC2086 # The flags are several words.
array=$(sbatch --parsable $part_flags --array="0-$((parts - 1))" --output="$log" \
    "$0" --part "$count" "$out" "$@")
# --parsable prints JOB or JOB;CLUSTER.
# shellcheck disable=SC2086
sbatch $merge_flags --dependency="afterok:${array%%;*}" --output="$out.parts/merge.log" \
    "$0" --merge "$out"
