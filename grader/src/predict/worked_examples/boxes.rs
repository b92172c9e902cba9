//! Part 2, Task 2: a ray and a box. The oracle computes the truth.

use super::example::{AskedNumber, WorkedExample, vector};
use crate::predict::draw::Draw;
use kit::{Aabb, Ray, Vec3};

/// A ray through a box. The components of its direction are powers of two, so that no division
/// rounds.
pub(super) fn slabs(draw: &mut Draw) -> WorkedExample {
    loop {
        let corner = || [0, 1, 2];
        let low = corner().map(|_| f64::from(draw.from(-3, 0)));
        let size = corner().map(|_| f64::from(draw.from(2, 4)));
        let high = [0, 1, 2].map(|i| low[i] + size[i]);
        let d = corner().map(|_| draw.one(&[-2.0, -1.0, -0.5, 0.5, 1.0, 2.0]));
        let o = corner().map(|_| f64::from(draw.from(-6, 6)));
        let bounds = Aabb {
            min: Vec3::from(low),
            max: Vec3::from(high),
        };
        let ray = Ray::new(Vec3::from(o), Vec3::from(d));
        let Ok(inside) = oracle::bbox(&bounds, &ray).inside else {
            continue;
        };
        let (entry, exit) = (inside.min.to_f64(), inside.max.to_f64());
        if entry <= 0.0 || exit - entry < 0.25 {
            continue;
        }
        // Where the line meets the planes of the low corner, and of the high one.
        let planes = [low, high].map(|plane| [0, 1, 2].map(|i| (plane[i] - o[i]) / d[i]));
        let largest = |list: &[f64]| list.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let smallest = |list: &[f64]| list.iter().copied().fold(f64::INFINITY, f64::min);
        let near: Vec<f64> = (0..3).map(|i| planes[0][i].min(planes[1][i])).collect();
        let far: Vec<f64> = (0..3).map(|i| planes[0][i].max(planes[1][i])).collect();
        let length = ray.d.length();
        return WorkedExample {
            given: vec![
                format!("Box: from l = {} to h = {}.", vector(low), vector(high)),
                format!(
                    "Ray: o = {}, d = {}. Its range starts at 0.",
                    vector(o),
                    vector(d)
                ),
            ],
            asked: vec![
                AskedNumber::new(
                    "t_e, where the ray enters",
                    entry,
                    &[
                        (
                            smallest(&near),
                            "the earliest entry: inside is where the ray is in all slabs, from the last entry on",
                        ),
                        (largest(&near[..2]), "the entry without the z axis"),
                        (
                            largest(&planes[0]),
                            "the entry with planes that are not swapped where d is negative",
                        ),
                        (
                            largest(&planes[1]),
                            "the entry by the planes of the high corner",
                        ),
                        (
                            0.0,
                            "the start of the range, which counts only for a ray that starts inside",
                        ),
                        (
                            entry * length,
                            "t for a direction of length 1: the distance",
                        ),
                    ],
                ),
                AskedNumber::new(
                    "t_f, where it leaves",
                    exit,
                    &[
                        (
                            largest(&far),
                            "the latest exit: inside ends with the first exit",
                        ),
                        (smallest(&far[..2]), "the exit without the z axis"),
                        (
                            smallest(&planes[1]),
                            "the exit with planes that are not swapped where d is negative",
                        ),
                        (entry, "the entry"),
                        (exit * length, "t for a direction of length 1: the distance"),
                    ],
                ),
            ],
        };
    }
}
