#!/bin/sh
# Renders a picture in ranges of samples with GNU parallel, and merges them.
#
#   parallel.sh PARTS SAMPLES OUT [FLAGS...] SCENE.dae
#   parallel.sh 8 1024 picture.exr -m 6 -r 1920 1080 scene.dae
#
# PATHTRACER is the program (default: pathtracer). PARALLEL_FLAGS are flags of GNU parallel:
# with --sshloginfile FILE it uses several machines, which need the program and the scene at
# the same paths on a shared file system. A part that failed is rendered again if the script
# is: finished parts stay in OUT.parts.
set -eu

if [ $# -lt 4 ]; then
    echo "usage: parallel.sh PARTS SAMPLES OUT [FLAGS...] SCENE.dae" >&2
    exit 2
fi
parts=$1
samples=$2
out=$3
shift 3
pathtracer=${PATHTRACER:-pathtracer}
count=$((samples / parts))
if [ "$count" -lt 2 ] || [ $((count * parts)) -ne "$samples" ]; then
    echo "parallel.sh: SAMPLES has to be a multiple of PARTS, at least twice as large" >&2
    exit 2
fi

mkdir -p "$out.parts"
# -t 1: parallel runs one part for each core. {1} is the index of the first sample.
# shellcheck disable=SC2086 # PARALLEL_FLAGS are several words.
seq 0 "$count" $((samples - count)) |
    parallel --halt soon,fail=1 --joblog "$out.parts/log" ${PARALLEL_FLAGS:-} --quote \
        sh -c 'test -e "$1" || { part=$1; shift; exec "$@" -f "$part"; }' sh \
        "$out.parts/{1}.sums" "$pathtracer" -t 1 --first-sample {1} -s "$count" "$@"

"$pathtracer" merge -f "$out" "$out.parts"/*.sums
