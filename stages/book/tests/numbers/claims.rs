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
