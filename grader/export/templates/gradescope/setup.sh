#!/usr/bin/env bash
# Gradescope runs this once, when it builds the image: it installs Rust, builds the grader, and grades
# the reference solution. So a submission has only its own stages to compile, and needs no network.
#
# AUTOGRADER_ROOT is the folder that Gradescope calls /autograder: set it to try the package elsewhere.
set -euo pipefail
root="${AUTOGRADER_ROOT:-/autograder}"
course="$root/source/course"

if ! command -v cc > /dev/null || ! command -v curl > /dev/null; then
    apt-get update
    DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        ca-certificates curl gcc libc6-dev
fi
if ! command -v cargo > /dev/null; then
    export RUSTUP_HOME=/usr/local/rustup CARGO_HOME=/usr/local/cargo PATH="/usr/local/cargo/bin:$PATH"
    curl --proto '=https' --tlsv1.2 --fail --silent --show-error https://sh.rustup.rs |
        sh -s -- -y --no-modify-path --profile minimal --default-toolchain {toolchain}
fi

cd "$course"
# The container has little memory: one compiler at a time.
export CARGO_BUILD_JOBS=1
# All that is ever compiled here is downloaded now: the worker's libraries, too, which only grading builds.
cargo fetch --locked
export CARGO_NET_OFFLINE=true
cargo build --release --locked {packages}
check="$(mktemp -d)"
code=0
./target/release/submission {what} --submission "$course"{unsandboxed} --write "gradescope=$check/results.json" || code=$?
case "$code" in
    0) ;;
    1) echo "setup.sh: the reference solution does not get every core point of {what} here: the report is above" >&2 ;;
    *) echo "setup.sh: the grader does not run here (exit code $code): its error is above" >&2 ;;
esac
rm -r "$check"
exit "$code"
