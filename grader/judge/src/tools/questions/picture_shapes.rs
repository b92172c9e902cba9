//! The shapes of the pictures of Part 1.

use kit::{Sphere, Triangle, Vec3, math};
use std::f64::consts::TAU;

/// Ten spheres in a pyramid on a large sphere, with small spheres around them.
pub(crate) fn spheres_in_a_pile() -> Vec<Sphere> {
    let mut spheres = vec![Sphere {
        center: Vec3::new(0.0, -40.0, 0.0),
        radius: 40.0,
    }];
    let layers: [(f64, &[(f64, f64)]); 3] = [
        (
            0.48,
            &[
                (-1.0, -0.577),
                (0.0, -0.577),
                (1.0, -0.577),
                (-0.5, 0.289),
                (0.5, 0.289),
                (0.0, 1.155),
            ],
        ),
        (1.3, &[(-0.5, -0.289), (0.5, -0.289), (0.0, 0.577)]),
        (2.11, &[(0.0, 0.0)]),
    ];
    for (y, places) in layers {
        spheres.extend(places.iter().map(|&(x, z)| Sphere {
            center: Vec3::new(x, y, z),
            radius: 0.5,
        }));
    }
    spheres.extend((0..9).map(|i| {
        let (sin, cos) = math::sin_cos(TAU * f64::from(i) / 9.0 + 0.2);
        let radius = 0.12 + 0.03 * f64::from(i % 4);
        Sphere {
            center: Vec3::new(2.3 * cos, radius - 0.07, 2.3 * sin),
            radius,
        }
    }));
    spheres
}

/// A torus around the y axis with `around` x `across` facets and its true normals at the vertices.
pub(crate) fn ring(around: u32, across: u32) -> Vec<Triangle> {
    let vertex = |i: u32, j: u32| {
        let (sin, cos) = math::sin_cos(TAU * f64::from(i % around) / f64::from(around));
        let (rise, out) = math::sin_cos(TAU * f64::from(j % across) / f64::from(across));
        let n = Vec3::new(cos * out, rise, sin * out);
        (Vec3::new(1.4 * cos, 0.0, 1.4 * sin) + 0.45 * n, n)
    };
    let triangle = |vertices: [(Vec3, Vec3); 3]| {
        Triangle::smooth(vertices.map(|v| v.0), vertices.map(|v| v.1))
    };
    let facet = |i: u32, j: u32| {
        let [a, b, c, d] = [
            vertex(i, j),
            vertex(i, j + 1),
            vertex(i + 1, j + 1),
            vertex(i + 1, j),
        ];
        [triangle([a, b, c]), triangle([a, c, d])]
    };
    (0..around)
        .flat_map(|i| (0..across).flat_map(move |j| facet(i, j)))
        .collect()
}

/// A triangle behind `eye`, across its line of sight to the world's origin, with `corners` to the
/// right and up.
pub(crate) fn behind(eye: Vec3, corners: [(f64, f64); 3]) -> Triangle {
    let [p0, p1, p2] = corners.map(|(x, y)| 1.5 * eye + Vec3::new(x, y, -0.3 * y));
    Triangle::flat(p0, p1, p2)
}

/// An octahedron around `center` with flat faces.
pub(crate) fn octahedron(center: Vec3, radius: f64) -> Vec<Triangle> {
    let signs = [1.0, -1.0];
    let corners = signs.map(|x| signs.map(|y| signs.map(|z| (x, y, z))));
    let face = |(x, y, z): (f64, f64, f64)| {
        let [a, b, c] = [x * Vec3::X, y * Vec3::Y, z * Vec3::Z].map(|v| center + radius * v);
        if x * y * z > 0.0 {
            Triangle::flat(a, b, c)
        } else {
            Triangle::flat(a, c, b)
        }
    };
    corners.into_iter().flatten().flatten().map(face).collect()
}
