//! Numbers in sentences of the chapters.

use book::chapter::Chapter;
use std::path::Path;

/// Requires that the chapter at `path` contains `words`, in which the computed numbers stand.
fn says(path: &str, words: &str) {
    let chapter = Chapter::read(Path::new(path)).expect("the chapter");
    let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat(&chapter.text).contains(&flat(words)),
        "{path} does not say: {words}"
    );
}

#[test]
fn triangles_overflow_where_the_text_says() {
    let largest = f64::MAX.cbrt().log10().floor();
    let smallest = f64::MIN_POSITIVE.cbrt().log10().ceil();
    let words = format!("overflow from about $10^{{{largest}}}$ on, and lose digits below about $10^{{{smallest}}}$");
    says("part1/task3.md", &words);
}

#[test]
fn brute_force_takes_as_long_as_the_text_says() {
    let tests = 480.0 * 360.0 * 100_000.0;
    let words = format!(
        "takes {:.0} billion tests; at 10 nanoseconds each that is {:.0} seconds",
        (tests / 1e9_f64).floor(),
        tests * 1e-8
    );
    says("part2/README.md", &words);
}

#[test]
fn a_sphere_leaves_half_of_its_box_empty() {
    let empty = 100.0 * (1.0 - std::f64::consts::PI / 6.0);
    says("part2/task2.md", &format!("A sphere in a box leaves {empty:.0} % of the box empty"));
}

#[test]
fn fields_of_view_are_those_of_the_text() {
    let half = 30_f64.to_radians().tan();
    let wide = (2.0 * half).atan().to_degrees();
    let words = format!(
        "Half of 60 degrees has the tangent {half:.3}, and twice that is the tangent of {wide:.1} degrees, so the \
         horizontal field of view is {:.1} degrees",
        2.0 * wide
    );
    says("part1/task2.md", &words);
}
