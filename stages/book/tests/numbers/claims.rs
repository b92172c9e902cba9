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
    let words = format!(
        "overflow from about $10^{{{largest}}}$ on, and lose digits below about $10^{{{smallest}}}$"
    );
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
    says(
        "part2/task2.md",
        &format!("A sphere in a box leaves {empty:.0} % of the box empty"),
    );
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

#[test]
fn rare_light_is_lost_as_often_as_the_text_says() {
    let missed = 0.999_f64.powi(32);
    let words = format!(
        "With $p = 0.001$ and $b = 32$ that happens to {:.0} % of the pixels",
        100.0 * missed
    );
    says("part5/task2.md", &words);
    let words = format!(
        "256 samples miss the lamp with the probability {:.2}",
        0.999_f64.powi(256)
    );
    says("part5/task2.md", &words);
    let hits = (1.96_f64 / 0.05).powi(2).ceil();
    says(
        "part5/task2.md",
        &format!("With a tolerance of 5 % it is {hits}"),
    );
}

#[test]
fn roulette_leaves_as_many_bounces_as_the_text_says() {
    assert!((0.8 / (1.0 - 0.8) - 4.0_f64).abs() < 1e-12);
    says("part4/task3.md", "For $\\rho = 0.8$ that is four.");
}

#[test]
fn glass_reflects_as_much_as_the_text_says() {
    let r: f64 = (1.5 - 1.0) / (1.5 + 1.0);
    says(
        "part4/task1.md",
        &format!("glass reflects {:.0} % head on", 100.0 * r * r),
    );
}

#[test]
fn rounding_of_a_box_is_as_large_as_the_text_says() {
    let u = 0.5 * f64::EPSILON;
    let gamma = 3.0 * u / (1.0 - 3.0 * u);
    let words = format!(
        "a factor of $1 + {:.1} \\cdot 10^{{-16}}$",
        2.0 * gamma * 1e16
    );
    says("part2/task2.md", &words);
}
