//! Closed meshes, and rays from inside aimed at their edges: one face must be hit.

use crate::tools::questions::probes::{ProbeRng, brute_force, through};
use kit::{Ray, Triangle, Vec3};
use wire::work::BruteForceWork;

/// A closed ball of 128 triangles, whose vertices have different distances from the centre.
fn closed_ball(rng: &mut ProbeRng, stretch: Vec3) -> Vec<Triangle> {
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let mut faces: Vec<[Vec3; 3]> = Vec::new();
    for (sx, sy, sz) in [
        (1.0, 1.0, 1.0),
        (-1.0, 1.0, -1.0),
        (-1.0, -1.0, 1.0),
        (1.0, -1.0, -1.0),
        (-1.0, 1.0, 1.0),
        (1.0, 1.0, -1.0),
        (1.0, -1.0, 1.0),
        (-1.0, -1.0, -1.0),
    ] {
        let outward = f64::signum(sx * sy * sz) > 0.0;
        let [a, b, c] = [sx * x, sy * y, sz * z];
        faces.push(if outward { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..2 {
        faces = faces.into_iter().flat_map(subdivided).collect();
    }
    // The displacement depends only on the position of the vertex, so that adjacent triangles share
    // it bit for bit.
    let turn = rng.range(0.0, 1.0);
    let moved = |v: Vec3| {
        let wave = kit::math::sin(40.0 * (v.x + 1.3 * v.y + 1.7 * v.z) + turn);
        (1.0 + 0.2 * wave) * v.normalize() * stretch
    };
    let bent = |face: [Vec3; 3]| {
        let [a, b, c] = face.map(moved);
        Triangle::flat(a, b, c)
    };
    faces.into_iter().map(bent).collect()
}

/// Splits a triangle into four at the midpoints of its edges. A midpoint is half of a sum, the same
/// for both triangles of the edge.
fn subdivided([a, b, c]: [Vec3; 3]) -> [[Vec3; 3]; 4] {
    let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Rays from inside, aimed at the edges and vertices of `mesh`.
fn at_edges(rng: &mut ProbeRng, mesh: &[Triangle], inner: Vec3, rays: usize) -> Vec<Ray> {
    let mut one = || {
        let t = mesh[rng.below(mesh.len())];
        let fraction = rng.one_of(&[0.0, 0.25, 0.5, -1.0]);
        let fraction = if fraction < 0.0 {
            rng.range(0.0, 1.0)
        } else {
            fraction
        };
        let target = t.p0 + fraction * (t.p1 - t.p0);
        through(rng.in_cube() * inner, target)
    };
    (0..rays).map(|_| one()).collect()
}

pub(super) fn shared_edges() -> BruteForceWork {
    let mut rng = ProbeRng::new("shared_edges", 0);
    let mesh = closed_ball(&mut rng, Vec3::ONE);
    let rays = at_edges(&mut rng, &mesh, Vec3::splat(0.2), 600);
    brute_force(&mesh, &[], &rays)
}

pub(super) fn needle_and_pancake() -> BruteForceWork {
    let mut rng = ProbeRng::new("needle_and_pancake", 0);
    let needle = closed_ball(&mut rng, Vec3::new(1.0, 1e6, 1.0));
    let pancake = closed_ball(&mut rng, Vec3::new(1e6, 1.0, 1e6));
    let mut rays = at_edges(&mut rng, &needle, Vec3::new(0.2, 2e5, 0.2), 250);
    rays.extend(at_edges(&mut rng, &pancake, Vec3::new(2e5, 0.2, 2e5), 250));
    let both: Vec<Triangle> = needle.into_iter().chain(pancake).collect();
    brute_force(&both, &[], &rays)
}
