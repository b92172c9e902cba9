//! Part 2, Tasks 1 and 3: a split of boxes, and the way of a ray through a tree.

use super::example::{AskedNumber, WorkedExample};
use crate::predict::draw::Draw;

/// Boxes on the x axis, one of them long: where they are split, and what the split costs.
pub(super) fn split(draw: &mut Draw) -> WorkedExample {
    // Twice the centroid and the length, so that all middles are whole.
    let mut boxes: Vec<(i32, i32)> = Vec::new();
    let mut x = 0;
    for _ in 0..5 {
        boxes.push((2 * x, 1));
        x += draw.from(1, 4);
    }
    let last = x + draw.from(4, 12);
    boxes.push((2 * last, draw.one(&[3, 5, 7])));
    let half = |x: i32| 0.5 * f64::from(x);
    let ends = |part: &[(i32, i32)]| {
        let low = part.iter().map(|(c, l)| c - l).min().unwrap_or(0);
        let high = part.iter().map(|(c, l)| c + l).max().unwrap_or(0);
        (low, high)
    };
    // The surface of a box of this length, 1 high and 1 deep.
    let area = |part: &[(i32, i32)]| {
        let (low, high) = ends(part);
        2.0 * (2.0 * half(high - low) + 1.0)
    };
    let middle = last;
    let below = boxes.iter().filter(|(c, _)| *c < middle).count();
    let (left, right) = boxes.split_at(below);
    let (count, others) = (left.len() as f64, right.len() as f64);
    let cost = (area(left) * count + area(right) * others) / area(&boxes);
    let (low, high) = ends(&boxes);
    let mean = boxes.iter().map(|(c, _)| half(*c)).sum::<f64>() / 6.0;
    let by_boxes = boxes.iter().filter(|(c, _)| 2 * *c < low + high).count();
    let centroids: Vec<String> = boxes.iter().map(|(c, _)| half(*c).to_string()).collect();
    WorkedExample {
        given: vec![
            format!(
                "Six boxes stand on the x axis, all 1 high and 1 deep, with their centroids at {}.",
                centroids.join(", ")
            ),
            format!(
                "The last one is {} long, the others 1. The split is at the midpoint of the centroids.",
                boxes[5].1
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "the split m",
                half(middle),
                &[
                    (
                        0.5 * half(low + high),
                        "the middle of the boxes: one side could be empty",
                    ),
                    (mean, "the mean of the centroids"),
                    (
                        0.5 * half(boxes[2].0 + boxes[3].0),
                        "the median: half of the boxes on each side",
                    ),
                ],
            ),
            AskedNumber::new(
                "the number of boxes on the left, n_L",
                count,
                &[
                    (others, "the number on the right"),
                    (3.0, "the number of a split at the median"),
                    (
                        by_boxes as f64,
                        "the number for a split at the middle of the boxes",
                    ),
                    (
                        6.0,
                        "all of them: the primitive at the largest coordinate is on the right",
                    ),
                ],
            ),
            AskedNumber::new(
                "the expected number of primitive tests, K / T",
                cost,
                &[
                    (cost * area(&boxes), "the sum that is not divided by A"),
                    (
                        (area(left) + area(right)) / area(&boxes),
                        "the sum of the areas without the numbers of primitives",
                    ),
                    (
                        6.0,
                        "all of them: many rays that hit the box of the root miss a child",
                    ),
                ],
            ),
        ],
    }
}

/// The tree of the chapter with other entries and hits. Its leaves are D and E below B, F and G
/// below C.
pub(super) fn traversal(draw: &mut Draw) -> WorkedExample {
    const NAMES: [&str; 4] = ["D", "E", "F", "G"];
    loop {
        let mut entries = [0.0; 4];
        let mut hits = [0.0; 4];
        for (entry, hit) in entries.iter_mut().zip(&mut hits) {
            *entry = f64::from(draw.from(1, 8));
            *hit = *entry + 0.5 * f64::from(draw.from(1, 10));
        }
        let parents = [entries[0].min(entries[1]), entries[2].min(entries[3])];
        let mut all: Vec<f64> = entries.iter().chain(&hits).copied().collect();
        all.sort_by(f64::total_cmp);
        let is_clear = all.windows(2).all(|pair| pair[0] != pair[1]);
        let nearest = hits.iter().copied().fold(f64::INFINITY, f64::min);
        if !is_clear || parents[0] == parents[1] {
            continue;
        }
        let visits = |nearer_first: bool| {
            let turned = |a: f64, b: f64| (a > b) == nearer_first;
            let sides = if turned(parents[0], parents[1]) {
                [1, 0]
            } else {
                [0, 1]
            };
            let (mut end, mut seen, mut first) = (f64::INFINITY, 0, f64::NAN);
            for side in sides {
                if parents[side] > end {
                    continue;
                }
                let (a, b) = (2 * side, 2 * side + 1);
                let leaves = if turned(entries[a], entries[b]) {
                    [b, a]
                } else {
                    [a, b]
                };
                for leaf in leaves {
                    if entries[leaf] > end {
                        continue;
                    }
                    seen += 1;
                    end = end.min(hits[leaf]);
                    if seen == 1 {
                        first = hits[leaf];
                    }
                }
            }
            (f64::from(seen), first)
        };
        let (seen, first) = visits(true);
        let (seen_far_first, _) = visits(false);
        if first == nearest || seen == 4.0 {
            continue;
        }
        let nearer = usize::from(parents[1] < parents[0]);
        let of_nearer = hits[2 * nearer].min(hits[2 * nearer + 1]);
        let leaves: Vec<String> = (0..4)
            .map(|i| {
                format!(
                    "{} is entered at {}, its hit is at {}",
                    NAMES[i], entries[i], hits[i]
                )
            })
            .collect();
        return WorkedExample {
            given: vec![
                format!(
                    "The root A has the children B (entry {}) and C (entry {}). Below B are the leaves D and E, below C are F and G.",
                    parents[0], parents[1]
                ),
                format!("{}.", leaves.join("; ")),
                "The nearer child is visited first.".into(),
            ],
            asked: vec![
                AskedNumber::new(
                    "t of the hit that is found",
                    nearest,
                    &[
                        (
                            first,
                            "the hit of the first leaf: boxes overlap, so a later leaf may have a nearer hit",
                        ),
                        (
                            of_nearer,
                            "the hit below the nearer child: the other one begins before it",
                        ),
                        (hits.iter().copied().fold(0.0, f64::max), "the farthest hit"),
                        (hits[3], "the hit of the last leaf"),
                    ],
                ),
                AskedNumber::new(
                    "the number of leaves that are visited",
                    seen,
                    &[
                        (4.0, "all leaves, as if no hit shortened the ray"),
                        (1.0, "the leaves up to the first hit, as for a shadow ray"),
                        (seen_far_first, "the leaves with the farther child first"),
                    ],
                ),
            ],
        };
    }
}
