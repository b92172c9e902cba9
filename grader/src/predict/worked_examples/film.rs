//! Part 1, Tasks 1 and 2: a sample's position on the film, and the ray through it.

use super::example::{AskedNumber, WorkedExample, vector};
use crate::predict::draw::Draw;

/// A fraction of whole numbers.
fn of(above: i32, below: i32) -> f64 {
    f64::from(above) / f64::from(below)
}

/// The position of a sample on the film. Everything is counted in eighths of a pixel.
pub(super) fn sample(draw: &mut Draw) -> WorkedExample {
    let width = draw.one(&[4, 5, 8, 10]);
    let height = draw.one(&[2, 3, 6]);
    let x = draw.from(1, width - 1);
    let y = draw.from(0, height - 1);
    let s = [draw.one(&[1, 2, 3, 5, 6, 7]), draw.one(&[1, 2, 3, 5, 6, 7])];
    let radiance = [draw.from(1, 9), draw.from(2, 5)];
    let u = 8 * x + s[0];
    let v = 8 * y + s[1];
    let mean = of(radiance[0] + 10 * radiance[1], 20);
    WorkedExample {
        given: vec![
            format!(
                "A film has {width} columns and {height} rows. A sample is in the pixel x = {x}, y = {y}, at s = ({}, {}).",
                of(s[0], 8),
                of(s[1], 8)
            ),
            format!(
                "Its ray brings the radiance {}, that of the only other sample {}.",
                of(radiance[0], 10),
                radiance[1]
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "u",
                of(u, 8 * width),
                &[
                    (of(x, width), "u of the corner of the pixel, without s"),
                    (
                        of(2 * x + 1, 2 * width),
                        "u of the centre of the pixel, where only a single sample is",
                    ),
                    (
                        of(u, 8 * (width - 1)),
                        "the position divided by the width less 1: columns have one edge more than their number",
                    ),
                    (of(u, 8 * height), "the position divided by the height"),
                    (0.0, "the result of a division of integers"),
                    (of(u, 8), "the position in pixels, which is not divided yet"),
                ],
            ),
            AskedNumber::new(
                "v",
                of(v, 8 * height),
                &[
                    (of(8 * height - v, 8 * height), "v counted from the top"),
                    (of(y, height), "v of the corner of the pixel, without s"),
                    (of(v, 8 * width), "the position divided by the width"),
                    (of(2 * y + 1, 2 * height), "v of the centre of the pixel"),
                    (of(v, 8), "the position in pixels, which is not divided yet"),
                ],
            ),
            AskedNumber::new(
                "the estimate E",
                mean,
                &[
                    (
                        2.0 * mean,
                        "the sum, which is not divided by the number of samples",
                    ),
                    (
                        of(radiance[0].min(10) + 10, 20),
                        "the mean of samples that are clamped to 1",
                    ),
                ],
            ),
        ],
    }
}

/// The point on the sensor and its direction, for a camera with fields of view of 90 degrees that
/// looks along an axis.
pub(super) fn camera(draw: &mut Draw) -> WorkedExample {
    // The columns of the rotation: right, up and backward.
    let (columns, looks) = draw.one(&[
        ([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], "+x"),
        ([[0, 0, -1], [0, 1, 0], [1, 0, 0]], "-x"),
        ([[1, 0, 0], [0, 0, -1], [0, 1, 0]], "-y"),
        ([[1, 0, 0], [0, 0, 1], [0, -1, 0]], "+y"),
    ]);
    let u = draw.one(&[1, 2, 3, 5, 6, 7]);
    let v = draw.one(&[1, 2, 3, 5, 6, 7]);
    // With a half angle of 45 degrees the half size is 1. In quarters.
    let q = [u - 4, v - 4, -4];
    let world = [0, 1, 2].map(|i| of((0..3).map(|k| columns[k][i] * q[k]).sum(), 4));
    let inverse = [0, 1, 2].map(|k| of((0..3).map(|i| columns[k][i] * q[i]).sum(), 4));
    let axes = columns.map(|column| vector(column.map(f64::from)));
    let turned = |i: usize| {
        [
            (inverse[i], "the direction turned by the inverse rotation"),
            (of(q[i], 4), "the direction in camera space"),
            (
                -world[i],
                "the opposite direction: the camera looks along -z of its own space",
            ),
        ]
    };
    WorkedExample {
        given: vec![
            format!(
                "Both fields of view are 90 degrees. The camera's right direction is r = {}, up s = {}, backward c = {}: it looks along {looks}.",
                axes[0], axes[1], axes[2]
            ),
            format!(
                "The point of the film is u = {}, v = {}. The direction is not normalised yet.",
                of(u, 8),
                of(v, 8)
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "x of q, on the sensor",
                of(q[0], 4),
                &[
                    (
                        of(u, 8),
                        "u itself: the film reaches from 0 to 1, the sensor from -a to a",
                    ),
                    (-of(q[0], 4), "x mirrored"),
                    (
                        of(u - 4, 8),
                        "half of it: a is half the width, and 2 u - 1 goes from -1 to 1",
                    ),
                ],
            ),
            AskedNumber::new("x of M q, in the world", world[0], &turned(0)),
            AskedNumber::new(
                "y of M q",
                world[1],
                &[
                    turned(1).as_slice(),
                    &[(-of(q[1], 4), "v counted from the top")],
                ]
                .concat(),
            ),
            AskedNumber::new("z of M q", world[2], &turned(2)),
        ],
    }
}
