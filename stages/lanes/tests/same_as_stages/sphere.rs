//! `lanes::sphere` and `intersect::test_sphere`.

use crate::inputs::{Random, join, numbers, ray, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use kit::{Ray, Sphere};
use lanes::sphere::SphereEquation;
use lanes::{Mask, Real};

/// Whether it decides, whether there is a hit, and its `t`.
struct SphereTest;

impl Formula<12, 3> for SphereTest {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 12]) -> [R; 3] {
        let ray = ray(&input);
        let sphere = lanes::Sphere {
            center: vector(&input[8..11]),
            radius: input[11],
        };
        let equation = SphereEquation::of(&ray, &sphere);
        let [near, far] = equation.roots();
        let t = ray.in_range(near).choose(near, far);
        [
            as_number(equation.is_sound(), t),
            as_number(equation.has_roots() & ray.in_range(t), t),
            t,
        ]
    }
}

/// A sphere and a ray from its inside, its surface or elsewhere, towards its inside, a tangent or
/// past it.
fn pair(random: &mut Random) -> (Sphere, Ray) {
    let scale = random.scale();
    let sphere = Sphere {
        center: scale * random.point(),
        radius: scale * random.of(&[0.3, 1.0, 0.5, 1e-6, 1e5, 0.0, -1.0, f64::NAN]),
    };
    let mut around = |distances: &[f64]| {
        sphere.center + sphere.radius * random.of(distances) * random.direction()
    };
    let from = around(&[0.0, 0.5, 1.0, 1.0001, 3.0, 3.0, 3.0, 1e3, 1e7]);
    let to = around(&[0.0, 0.3, 0.7, 0.9, 1.0, 1.1, 2.0]);
    (sphere, random.ray(from, to))
}

#[test]
fn spheres() {
    let mut random = Random::new(2);
    let pairs: Vec<(Sphere, Ray)> = (0..40_000).map(|_| pair(&mut random)).collect();
    let inputs: Vec<[f64; 12]> = pairs
        .iter()
        .map(|(s, ray)| join(&[&numbers(ray), &s.center.to_array(), &[s.radius]]))
        .collect();
    let results = at_every_width(&SphereTest, &inputs);
    let mut counts = [0; 2];
    for ((sphere, ray), [is_sound, is_hit, t]) in pairs.iter().zip(results) {
        if is_sound == 0.0 {
            continue;
        }
        counts[is_hit as usize] += 1;
        let expected = intersect::test_sphere(sphere, ray);
        let is_same = match expected {
            Some(expected) => is_hit == 1.0 && same(t, expected),
            None => is_hit == 0.0,
        };
        assert!(
            is_same,
            "{is_hit} {t}, expected {expected:?}\n{sphere:?}\n{ray:?}"
        );
    }
    assert!(counts.iter().all(|&count| count > 2_000), "{counts:?}");
}
