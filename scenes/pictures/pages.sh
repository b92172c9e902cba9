#!/bin/sh
# Makes the pictures of the report's pages: the reference with a mistake, `look` and `review`
# of it, and screenshots by a headless Chromium. Run it in the root of the project.
set -eu

mistake=scenes/pictures/culled_back_faces.patch
browser=${BROWSER:-chromium}
folder=$PWD/target/showcase
mkdir -p "$folder"

git apply "$mistake"
trap 'git apply --reverse "$mistake"' EXIT
# Both exit with 1, because answers are wrong.
cargo grader look part1.task3 --no-open || test $? -eq 1
cargo grader review part1.task3 --out "$folder/review.html" || test $? -eq 1
cp target/first-light/part1_task3.html "$folder/look.html"

for page in look review; do
    "$browser" --headless --no-sandbox --hide-scrollbars --window-size=1200,960 \
        --screenshot="scenes/pictures/pages/$page.png" "file://$folder/$page.html"
done
