//! A closed smooth mesh: a sphere with lobes, in place of a scanned statue.

use super::indexed_mesh::IndexedMesh;
use super::noise::gradient_noise;
use super::octasphere::octasphere;
use kit::{Vec3, math};

/// The largest mesh of at most `triangles` triangles: 8f².
pub(super) fn mesh(triangles: usize) -> IndexedMesh {
    let f = ((triangles as f64 / 8.0).sqrt() as u32).max(1);
    octasphere(f, |direction| radius(direction) * direction)
}

/// Distance of the surface from the centre in a direction, in (0, 1): two octaves of noise for the
/// body, and ripples whose phase and amplitude are modulated by noise.
fn radius(direction: Vec3) -> f64 {
    let noise = |scale: f64, seed| gradient_noise(scale * direction + Vec3::splat(0.37), seed);
    let body = 0.26 * noise(1.5, 2) + 0.1 * noise(3.1, 3);
    let bend = 0.5 * noise(1.2, 1);
    let ripples = 0.5 + noise(1.9, 4);
    0.66 + body + 0.035 * ripples * math::sin(17.0 * (direction.y + bend))
}
