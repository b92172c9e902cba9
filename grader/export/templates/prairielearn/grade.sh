#!/usr/bin/env bash
# PrairieLearn runs this for each submission, without a network: it grades /grade/student/stages.zip and
# writes /grade/results/results.json.
set -u
grade="${GRADE_ROOT:-/grade}"
export CARGO_NET_OFFLINE=true
mkdir -p "$grade/results"
cd "${FIRST_LIGHT_COURSE:-/first-light/course}" || exit 2

submission="$(mktemp -d)"
unzip -q "$grade/student/stages.zip" -d "$submission"
{take_stages}# PrairieLearn stops it after 600 seconds: what is written by then would be lost.
timeout --kill-after=10 "${GRADE_SECONDS:-570}" \
    {grade} {options} \
    --write "prairielearn=$grade/results/results.json"
code=$?
# 1 means that points are lost.
[ "$code" -le 1 ] || exit "$code"
