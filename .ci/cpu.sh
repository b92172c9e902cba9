# Sourced by .ci/run and .ci/nightly: CPU seconds, and what they may be.

# Sets `cpu` to the seconds of CPU, user and system, that the commands run by this shell have taken so far, with all
# that they waited for. `times` has to run in this shell: a pipe would make a new one, whose count begins at 0.
count_cpu() {
    local file
    file=$(mktemp)
    times > "$file"
    cpu=$(awk -F '[ms ]+' 'NR == 2 { printf "%d", 60 * $1 + $2 + 60 * $3 + $4 }' "$file")
    rm "$file"
}

# Runs a command in this shell, and sets `taken` to the CPU seconds of it. Its exit code is that of the command.
measure_command() {
    local before code=0
    count_cpu
    before=$cpu
    "$@" || code=$?
    count_cpu
    taken=$((cpu - before))
    return $code
}

# A budget in seconds means little on another machine, or on one that others use: both make the same work take more CPU
# seconds. So a loop of the shell is measured beside the work, and budgets grow with it. It took this many milliseconds
# on the machine with two cores that the budgets were measured on, while the work was.
reference_loop_ms=720
loops=0
loops_ms=0
measure_machine() {
    local file ms
    file=$(mktemp)
    (
        for ((i = 0, x = 1; i < 300000; i++)); do ((x = (x * 1103515245 + 12345) & 2147483647)); done
        times > "$file"
    )
    ms=$(awk -F '[ms ]+' 'NR == 1 { printf "%d", 1000 * (60 * $1 + $2 + 60 * $3 + $4) }' "$file")
    rm "$file"
    loops=$((loops + 1)) loops_ms=$((loops_ms + ms))
}

# within_budget WHAT SECONDS AIM LIMIT: prints what was used, and fails if it was more than the limit. On a machine that is
# slower than the reference, the limit is higher in proportion; on a faster one it stays.
within_budget() {
    local mean=$((loops_ms / loops)) limit=$4
    if [ $mean -gt $reference_loop_ms ]; then limit=$((limit * mean / reference_loop_ms)); fi
    echo "$1 took $2 s of CPU (aim: $3 s, limit: $limit s, where the loop of $reference_loop_ms ms takes $mean ms)"
    [ "$2" -le "$limit" ]
}
