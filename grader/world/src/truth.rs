//! The exact answers, by the oracle.

use crate::case::{Answers, Case};
use kit::{Ray, Triangle};
use oracle::BigFloat;
use rayon::prelude::*;

/// A bounding sphere is enlarged by this fraction of its radius and of its distance: much more than
/// the rounding errors of the comparison.
const LOOSE: f64 = 1e-12;

/// The closest hit of each ray, and the number of points at which the ray crosses the mesh: triangles
/// that share the point count once. Triangles with a NaN are left out.
pub(crate) fn answers(case: &Case) -> Answers {
    let triangles = case.triangles();
    let spheres: Vec<_> = triangles.iter().map(BoundingSphere::new).collect();
    let hits = case.rays.par_iter().map(|ray| {
        let mut hits: Vec<(BigFloat, usize)> = (0..triangles.len())
            .filter(|id| spheres[*id].may_touch(ray))
            .filter_map(|id| {
                let verdict = oracle::triangle(&triangles[id], ray);
                let t = verdict.crossing.as_ref()?.t;
                verdict.hits().then_some((t, id))
            })
            .collect();
        hits.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
        let nearest = hits.first().map(|(t, id)| (t.to_f64(), *id as f64));
        hits.dedup_by(|a, b| a.0 == b.0);
        let (t, id) = nearest.unwrap_or((f64::INFINITY, -1.0));
        [t, id, hits.len() as f64]
    });
    Answers {
        seconds: 0.0,
        hits: hits.collect(),
    }
}

/// A sphere around a triangle.
struct BoundingSphere {
    center: kit::Vec3,
    radius: f64,
}

impl BoundingSphere {
    fn new(triangle: &Triangle) -> BoundingSphere {
        let corners = [triangle.p0, triangle.p1, triangle.p2];
        let center = (corners[0] + corners[1] + corners[2]) / 3.0;
        let distances = corners.map(|corner| corner.distance(center));
        // A NaN stays: the sphere then touches no ray.
        let radius = distances
            .into_iter()
            .fold(0.0, |a, b| if a > b { a } else { b });
        BoundingSphere { center, radius }
    }

    /// Whether the line of the ray comes close to the sphere. The cross product of the vector from
    /// the origin with the direction has the distance without cancellation.
    fn may_touch(&self, ray: &Ray) -> bool {
        let from_origin = self.center - ray.o;
        let distance = from_origin.cross(ray.d).length() / ray.d.length();
        distance <= self.radius * (1.0 + LOOSE) + LOOSE * from_origin.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::COLUMNS;

    /// The filter leaves out no triangle that the oracle says is hit.
    #[test]
    fn the_filter_loses_no_hit() {
        for column in &COLUMNS {
            let case = column.case(3, 40);
            let triangles = case.triangles();
            let answers = answers(&case);
            for (ray, [t, ..]) in case.rays.iter().zip(answers.hits) {
                let all = triangles.iter().filter(|triangle| triangle.p0.is_finite());
                let hits = all.filter(|tri| tri.p1.is_finite() && tri.p2.is_finite());
                let any = oracle::closest(hits.map(kit::Primitive::Triangle), ray);
                let expected = any.nearest.map_or(f64::INFINITY, |(_, t)| t.to_f64());
                assert_eq!(t, expected, "{}", column.name);
            }
        }
    }

    /// What the text of each column says of its rays.
    #[test]
    fn rays_hit_except_at_the_ends_of_ranges() {
        for column in &COLUMNS {
            let answers = answers(&column.case(1, 200));
            let found = answers.hits.iter().filter(|[t, ..]| t.is_finite()).count();
            assert_eq!(found, answers.hits.len(), "{}", column.name);
        }
    }
}
