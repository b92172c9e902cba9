#!/usr/bin/env bash
# PrairieLearn runs this for each submission, without a network: it grades the stages of
# /grade/student/stages.zip in the handout and writes /grade/results/results.json.
set -u
grade="${GRADE_ROOT:-/grade}"
export CARGO_NET_OFFLINE=true
mkdir -p "$grade/results"
cd "${FIRST_LIGHT_COURSE:-/first-light/course}" || exit 2

submission="$(mktemp -d)"
unzip -q "$grade/student/stages.zip" -d "$submission"
for stage in {stages}; do
    # A stage that is missing stays as in the handout: it is not written yet. `--touch`, as the zip keeps old times, and cargo
    # would take what it compiled before for newer.
    lib="$submission/stages/$stage/src/lib.rs"
    if [ -f "$lib" ] && [ ! -L "$lib" ]; then
        rm -rf "stages/$stage/src"
        (cd "$submission" && find "stages/$stage/src" -type f -name '*.rs' -print0 |
            tar --create --null --files-from=- --file=-) | tar --extract --touch
    fi
done
# PrairieLearn stops it after 600 seconds: what is written by then would be lost.
timeout --kill-after=10 "${GRADE_SECONDS:-570}" \
    cargo grader {what} {options} --write "prairielearn=$grade/results/results.json"
code=$?
# 1 means that points are lost.
[ "$code" -le 1 ] || exit "$code"
