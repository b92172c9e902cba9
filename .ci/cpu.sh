# Sourced by .ci/run and .ci/nightly.

# Sets `cpu` to the seconds of CPU, user and system, that the commands run by this shell have taken so far, with all
# that they waited for. `times` has to run in this shell: a pipe would make a new one, whose count begins at 0.
count_cpu() {
    local file
    file=$(mktemp)
    times > "$file"
    cpu=$(awk -F '[ms ]+' 'NR == 2 { printf "%d", 60 * $1 + $2 + 60 * $3 + $4 }' "$file")
    rm "$file"
}
