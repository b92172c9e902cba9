#!/usr/bin/env bash
# Uses the window as a person does, on a virtual display, and writes screenshots to look at.
#
#   stages/viewer/tests/xvfb.sh [FOLDER]
#
# Needs (Debian) xvfb xdotool imagemagick libgl1 libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0.
# Fails if the window does not open, does not react, or does not close.
set -euo pipefail
root=$(cd "$(dirname "$0")/../../.." && pwd)
folder=${1:-$root/target/window}
mkdir -p "$folder"
rm -f "$folder"/*.png "$folder"/*.txt
cargo build --quiet --release --package viewer --manifest-path "$root/Cargo.toml"

# The server chooses a free display and writes its number.
display_file=$(mktemp)
Xvfb -displayfd 4 -screen 0 1400x900x24 4> "$display_file" > /dev/null 2>&1 &
server=$!
viewer=
trap 'kill $viewer $server 2> /dev/null || true; rm -f "$display_file"' EXIT
for _ in $(seq 100); do [ -s "$display_file" ] && break; sleep 0.1; done
DISPLAY=:$(cat "$display_file")
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1

open_window() {
    (cd "$folder" && exec "$root/target/release/viewer" "$@") &
    viewer=$!
    window=
    for _ in $(seq 120); do
        window=$(xdotool search --onlyvisible --pid "$viewer" 2> /dev/null | head -1 || true)
        [ -n "$window" ] && break
        sleep 0.25
    done
    [ -n "$window" ] || { echo "no window opened"; exit 1; }
    # There is no window manager that would do this.
    xdotool windowmove "$window" 0 0 windowfocus "$window"
    sleep 2
}
shot() { import -window root "$folder/$1.png"; }
key() { xdotool key "$1"; sleep "${2:-0.6}"; }
drag() { # BUTTON X Y DX DY
    xdotool mousemove "$2" "$3"; sleep 0.1; xdotool mousedown "$1"; sleep 0.1
    for i in 1 2 3 4 5; do xdotool mousemove $(($2 + $4 * i / 5)) $(($3 + $5 * i / 5)); sleep 0.08; done
    xdotool mouseup "$1"; sleep 1
}
differ() { # the view must have changed
    [ "$(compare -metric AE "$folder/$1.png" "$folder/$2.png" null: 2>&1 | cut -d' ' -f1)" != 0 ] \
        || { echo "$1 and $2 are the same"; exit 1; }
}

open_window -s 16 -m 4 --window 1400 900 "$root/scenes/dae/cornell_whale.dae"
shot 1_edit
drag 1 500 450 120 20; shot 2_rotated; differ 1_edit 2_rotated
drag 3 500 450 60 0; xdotool click 4; sleep 1.5; shot 3_moved; differ 2_rotated 3_moved
key space 1.5
key v; key Right; key Left 1.5; shot 4_bvh; differ 1_edit 4_bvh
key r 8; shot 5_render; differ 4_bvh 5_render
xdotool mousemove 500 450; sleep 0.1; xdotool click 1; sleep 3; key n; key n; shot 6_replay; differ 5_render 6_replay
key q; key x 6; shot 7_heat; differ 5_render 7_heat
key s 1; key d 1
ls "$folder"/cornell_whale_screenshot_*.png "$folder"/cornell_whale_cam_settings.txt
key question; shot 8_keys
key Escape; key Escape 2
kill -0 "$viewer" 2> /dev/null && { echo "the window did not close"; exit 1; }

open_window -s 1024 --light --window 800 600 "$root/scenes/dae/gems.dae"
shot 9_light_small
key r 0.3; key Escape 1; shot 10_question
key Escape 2
kill -0 "$viewer" 2> /dev/null && { echo "the window did not close"; exit 1; }
viewer=
echo "Screenshots: $folder"
