//! The pictures of Part 1, tasks 3 and 4.

use super::{Eye, Panel, direction_colour, nearness, two_panels};
use crate::convert;
use crate::stages::Intersect;
use kit::PrimId;
use wire::picture::View;
use wire::work::Xyz;

/// The closest hits of all shapes: normals, then distances. Misses are black.
pub(super) fn closest(
    stage: &Intersect,
    size: [u32; 2],
    triangles: &[[Xyz; 6]],
    spheres: &[(Xyz, f64)],
    view: &View,
    range: [f64; 2],
) -> Vec<Panel> {
    let triangles: Vec<_> = triangles.iter().map(convert::triangle).collect();
    let spheres: Vec<_> = spheres.iter().map(convert::sphere).collect();
    let eye = Eye::new(view);
    two_panels(size, |x, y| {
        let mut ray = eye.through(x, y);
        let mut closest = None;
        let mut ids = (0..).map(PrimId);
        for (triangle, id) in triangles.iter().zip(ids.by_ref()) {
            closest = (stage.intersect_triangle)(triangle, id, &mut ray).or(closest);
        }
        for (sphere, id) in spheres.iter().zip((triangles.len() as u32..).map(PrimId)) {
            closest = (stage.intersect_sphere)(sphere, id, &mut ray).or(closest);
        }
        closest.map_or([[0.0; 3]; 2], |hit| {
            [direction_colour(hit.n), [nearness(hit.t, range); 3]]
        })
    })
}
