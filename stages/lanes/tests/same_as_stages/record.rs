//! `lanes::record`, `intersect::record_triangle` and `intersect::intersect_sphere`.

use crate::inputs::{Random, coordinates, join, numbers, ray, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use kit::{Hit, PrimId, Ray, Sphere, Triangle, TriangleHit, Vec3};
use lanes::{Real, record};

/// Whether the record is accurate, the point, the geometric and the shading normal.
type Record<R> = [R; 10];

#[inline(always)]
fn joined<R: Real>(
    is_accurate: R::Mask,
    p: lanes::Vec3<R>,
    ng: lanes::Vec3<R>,
    n: lanes::Vec3<R>,
) -> Record<R> {
    let ([px, py, pz], [gx, gy, gz]) = (coordinates(p), coordinates(ng));
    [
        as_number(is_accurate, px),
        px,
        py,
        pz,
        gx,
        gy,
        gz,
        n.x,
        n.y,
        n.z,
    ]
}

/// Compares the accurate records with `expected`; returns how many there are.
fn compare(records: &[Record<f64>], expected: impl Fn(usize) -> Hit) -> usize {
    let accurate = |(_, record): &(usize, &Record<f64>)| record[0] == 1.0;
    let accurate = records.iter().enumerate().filter(accurate);
    accurate
        .inspect(|(i, record)| {
            let hit = expected(*i);
            let numbers: [f64; 9] = join(
                &[hit.p, hit.ng, hit.n]
                    .each_ref()
                    .map(Vec3::as_ref)
                    .map(|v: &[f64; 3]| &v[..]),
            );
            let is_same = numbers.iter().zip(&record[1..]).all(|(&a, &b)| same(a, b));
            assert!(is_same, "record {i}: {record:?}, expected {hit:?}");
        })
        .count()
}

/// From the vertices, their normals and the weights.
struct TriangleRecord;

impl Formula<20, 10> for TriangleRecord {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 20]) -> Record<R> {
        let p0 = vector(&input[0..3]);
        let (e1, e2) = (vector(&input[3..6]) - p0, vector(&input[6..9]) - p0);
        let n = [
            vector(&input[9..12]),
            vector(&input[12..15]),
            vector(&input[15..18]),
        ];
        let weights = [input[18], input[19]];
        let (ng, is_accurate) = record::geometric_normal(e1, e2);
        joined(
            is_accurate,
            record::triangle_point(p0, e1, e2, weights),
            ng,
            record::shading_normal(n, weights, ng),
        )
    }
}

#[test]
fn triangles() {
    let mut random = Random::new(5);
    let hits: Vec<(Triangle, [f64; 2])> = (0..20_000)
        .map(|_| (random.triangle(), random.weights()))
        .collect();
    let inputs: Vec<[f64; 20]> = hits
        .iter()
        .map(|(t, weights)| {
            let [p0, p1, p2] = [t.p0, t.p1, t.p2].map(|p| p.to_array());
            let [n0, n1, n2] = [t.n0, t.n1, t.n2].map(|n| n.to_array());
            join(&[&p0, &p1, &p2, &n0, &n1, &n2, weights])
        })
        .collect();
    let accurate = compare(&at_every_width(&TriangleRecord, &inputs), |i| {
        let (triangle, [b1, b2]) = hits[i];
        let hit = TriangleHit { t: 1.0, b1, b2 };
        let mut ray = Ray::new(Vec3::ZERO, Vec3::X);
        intersect::record_triangle(&triangle, PrimId(0), &mut ray, hit)
    });
    assert!(
        (8_000..18_000).contains(&accurate),
        "{accurate} are accurate"
    );
}

/// From the ray, the sphere and `t`.
struct SphereRecord;

impl Formula<13, 10> for SphereRecord {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 13]) -> Record<R> {
        let sphere = lanes::Sphere {
            center: vector(&input[8..11]),
            radius: input[11],
        };
        let (n, is_defined) = record::sphere_normal(&ray(&input), &sphere, input[12]);
        joined(is_defined, record::sphere_point(&sphere, n), n, n)
    }
}

#[test]
fn spheres() {
    let mut random = Random::new(6);
    let hits: Vec<(Sphere, Ray, Hit)> = (0..20_000)
        .filter_map(|_| {
            let scale = random.scale();
            let sphere = Sphere {
                center: scale * random.point(),
                radius: scale * random.of(&[0.3, 1.0, 1e-6, 1e-16, 1e-30, 1e5, 0.0]),
            };
            let from = sphere.center
                + sphere.radius * random.of(&[0.0, 1.0, 3.0, 1e5]) * random.direction();
            let to = sphere.center + sphere.radius * random.one() * random.direction();
            let ray = random.ray(from, to);
            let hit = intersect::intersect_sphere(&sphere, PrimId(0), &mut { ray })?;
            Some((sphere, ray, hit))
        })
        .collect();
    let inputs: Vec<[f64; 13]> = hits
        .iter()
        .map(|(s, ray, hit)| join(&[&numbers(ray), &s.center.to_array(), &[s.radius, hit.t]]))
        .collect();
    let defined = compare(&at_every_width(&SphereRecord, &inputs), |i| hits[i].2);
    assert!(
        defined > 5_000 && defined < hits.len(),
        "{defined} of {}",
        hits.len()
    );
}
