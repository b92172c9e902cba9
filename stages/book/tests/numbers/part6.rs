//! The worked examples of Part 6.

use super::{Numbers, check};

#[test]
fn task1() {
    let mut text = Numbers::default();
    let triangles = text.n(32768.0);
    let leaf = text.n(8.0);
    let leaves = text.n(triangles / leaf);
    text.n(1.0);
    let binary = text.n(leaves - 1.0);
    text.n(leaves.log2());
    let width = text.n(8.0);
    text.n(binary);
    let joined = text.n(width - 1.0);
    text.n(binary / joined);
    text.n(leaves.log2() / width.log2());
    text.n(6.0);
    text.n(width);
    let numbers = text.n(6.0 * width);
    let bytes = text.n(size_of::<f32>() as f64);
    text.n(numbers * bytes);
    let line = text.n(64.0);
    assert_eq!(numbers * bytes / line, 3.0);
    let plane = text.n(0.1);
    let nearest = plane as f32;
    text.n(f64::from(nearest));
    text.n(f64::from(nearest.next_down()));
    check("part6/task1.md", text);
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let q = text.n(0.5);
    let lanes = text.n(8.0);
    text.n(1.0);
    text.n(1.0);
    text.n(q);
    let one = text.n(1.0 / (1.0 - q));
    let reaches = |bounce: i32| 1.0 - (1.0 - q.powi(bounce)).powi(lanes as i32);
    for bounce in 0..4 {
        text.n(reaches(bounce));
    }
    let longest = text.n((0..1000).map(reaches).sum());
    text.n(0.0);
    text.n(3.0);
    text.n(one);
    text.n(longest);
    text.n(one / longest);
    let batch = text.n(64.0);
    text.n(batch / lanes);
    text.n(batch * q);
    text.n(batch * q / lanes);
    text.n(batch * q / lanes + 1.0);
    text.n(batch * q * q);
    check("part6/task2.md", text);
}
