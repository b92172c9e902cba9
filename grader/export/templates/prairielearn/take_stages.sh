for stage in {stages}; do
    # A stage that is missing stays as in the handout: it is not written yet. `--touch`, as the zip
    # keeps old times, and cargo would take what it compiled before for newer.
    lib="$submission/stages/$stage/src/lib.rs"
    if [ -f "$lib" ] && [ ! -L "$lib" ]; then
        rm -rf "stages/$stage/src"
        (cd "$submission" && find "stages/$stage/src" -type f -name '*.rs' -print0 |
            tar --create --null --files-from=- --file=-) | tar --extract --touch
    fi
done
