//! `lanes::surface` and `kit::Surface::leave`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, at_every_width, same};
use kit::{Hit, Material, PrimId, Primitive, Spectrum, Sphere, Surface, Triangle, Vec2, Vec3};
use lanes::Real;
use lanes::surface::Departure;

/// The normal on the outer side, and the origin of a ray that leaves.
type Leaving<R> = [R; 6];

#[inline(always)]
fn leaving<R: Real>(departure: &Departure<R>, w: lanes::Vec3<R>) -> Leaving<R> {
    let [ox, oy, oz] = coordinates(departure.origin(w));
    let ng = departure.ng;
    [ng.x, ng.y, ng.z, ox, oy, oz]
}

/// Compares with the surface at a hit with the point `p` and the normal `n`.
fn compare(result: Leaving<f64>, primitive: Primitive<'_>, p: Vec3, n: Vec3, w: Vec3) {
    let hit = Hit {
        t: 1.0,
        p,
        n,
        ng: n,
        uv: Vec2::ZERO,
        prim: PrimId(0),
    };
    let material = Material::Diffuse {
        reflectance: Spectrum::WHITE,
    };
    let surface = Surface::new(&hit, primitive, &material);
    let origin = surface.leave(w).o;
    let expected: Leaving<f64> = join(&[&surface.ng.to_array(), &origin.to_array()]);
    let is_same = (0..6).all(|i| same(result[i], expected[i]));
    assert!(
        is_same,
        "{result:?}, expected {expected:?} along {w} at {hit:?}"
    );
}

/// From the vertices, their normals, the point, the normal and the direction.
struct FromTriangle;

impl Formula<27, 6> for FromTriangle {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 27]) -> Leaving<R> {
        let vertices = [
            vector(&input[0..3]),
            vector(&input[3..6]),
            vector(&input[6..9]),
        ];
        let n = [
            vector(&input[9..12]),
            vector(&input[12..15]),
            vector(&input[15..18]),
        ];
        let (p, ng) = (vector(&input[18..21]), vector(&input[21..24]));
        leaving(
            &Departure::from_triangle(p, ng, vertices, n),
            vector(&input[24..27]),
        )
    }
}

#[test]
fn triangles() {
    let mut random = Random::new(7);
    let points: Vec<(Triangle, [Vec3; 3])> = (0..20_000)
        .map(|_| {
            let t = random.triangle();
            let [b1, b2] = random.weights();
            let p = t.p0 + b1 * (t.p1 - t.p0) + b2 * (t.p2 - t.p0);
            (t, [p, random.normal(), random.normal()])
        })
        .collect();
    let inputs: Vec<[f64; 27]> = points
        .iter()
        .map(|(t, rest)| {
            let vectors = [
                t.p0, t.p1, t.p2, t.n0, t.n1, t.n2, rest[0], rest[1], rest[2],
            ];
            join(
                &vectors
                    .each_ref()
                    .map(|v| &AsRef::<[f64; 3]>::as_ref(v)[..]),
            )
        })
        .collect();
    let results = at_every_width(&FromTriangle, &inputs);
    for ((triangle, [p, ng, w]), result) in points.iter().zip(results) {
        compare(result, Primitive::Triangle(triangle), *p, *ng, *w);
    }
}

/// From the sphere, the normal and the direction.
struct FromSphere;

impl Formula<10, 6> for FromSphere {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 10]) -> Leaving<R> {
        let sphere = lanes::Sphere {
            center: vector(&input[0..3]),
            radius: input[3],
        };
        let n = vector(&input[4..7]);
        let p = lanes::record::sphere_point(&sphere, n);
        leaving(
            &Departure::from_sphere(p, n, &sphere),
            vector(&input[7..10]),
        )
    }
}

#[test]
fn spheres() {
    let mut random = Random::new(8);
    let points: Vec<(Sphere, Vec3, Vec3)> = (0..20_000)
        .map(|_| {
            let scale = random.scale();
            let sphere = Sphere {
                center: scale * random.point(),
                radius: scale * random.of(&[0.3, 1.0, 1e-6, 1e5, 0.0]),
            };
            (sphere, random.normal(), random.normal())
        })
        .collect();
    let inputs: Vec<[f64; 10]> = points
        .iter()
        .map(|(s, n, w)| {
            join(&[
                &s.center.to_array(),
                &[s.radius],
                &n.to_array(),
                &w.to_array(),
            ])
        })
        .collect();
    for ((s, n, w), result) in points.iter().zip(at_every_width(&FromSphere, &inputs)) {
        compare(
            result,
            Primitive::Sphere(s),
            s.center + s.radius * *n,
            *n,
            *w,
        );
    }
}
