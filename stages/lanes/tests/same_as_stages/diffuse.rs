//! `lanes::diffuse`, `direct::lambert_f`, `direct::lambert_pdf` and `direct::lambert_sample`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use kit::{Spectrum, Vec2, Vec3, math};
use lanes::{Real, diffuse};
use std::f64::consts::TAU;

/// The reflectance, the z of two directions; the BSDF, whether it is not black, and the density.
struct Evaluated;

impl Formula<5, 5> for Evaluated {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 5]) -> [R; 5] {
        let [r, g, b] = coordinates(diffuse::lambert_f(vector(&input)));
        [
            r,
            g,
            b,
            as_number(diffuse::on_same_side(input[3], input[4]), r),
            diffuse::lambert_pdf(input[3], input[4]),
        ]
    }
}

fn reflectance(random: &mut Random) -> [f64; 3] {
    let any = [random.one(), random.one(), random.one()];
    random.of(&[any, any, [0.0, 1.0, any[2]], [0.0; 3]])
}

/// The cosine between a normal and a direction; 0 in the plane of the surface.
fn cosine(random: &mut Random) -> f64 {
    let any = 2.0 * random.one() - 1.0;
    random.of(&[any, any, any, 0.0, -0.0, 1.0, -1.0, 1e-300])
}

#[test]
fn values() {
    let mut random = Random::new(9);
    let inputs: Vec<[f64; 5]> = (0..4000)
        .map(|_| {
            join(&[
                &reflectance(&mut random),
                &[cosine(&mut random), cosine(&mut random)],
            ])
        })
        .collect();
    let results = at_every_width(&Evaluated, &inputs);
    for (input, [r, g, b, is_same_side, pdf]) in inputs.iter().zip(results) {
        let [wo, wi] = [input[3], input[4]].map(|z| Vec3::new(0.0, 0.0, z));
        let expected = direct::lambert_f(Spectrum::new(input[0], input[1], input[2]), wo, wi);
        let f = Spectrum::new(r, g, b) * is_same_side;
        assert_eq!(f, expected, "for {input:?}");
        assert!(same(pdf, direct::lambert_pdf(wo, wi)), "for {input:?}");
    }
}

/// The reflectance, the viewer's z, `u` and the sine and cosine of an angle; the direction, its
/// density and the weight.
struct Sampled;

impl Formula<7, 7> for Sampled {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 7]) -> [R; 7] {
        let [.., wo_z, u, sin, cos] = input;
        let sample = diffuse::lambert_sample(vector(&input), wo_z, u, (sin, cos));
        let [x, y, z] = coordinates(sample.wi);
        let [r, g, b] = coordinates(sample.weight);
        [x, y, z, sample.pdf, r, g, b]
    }
}

#[test]
fn samples() {
    let mut random = Random::new(10);
    let last = 1.0 - f64::EPSILON / 2.0;
    let mut cases = Vec::new();
    let mut inputs = Vec::new();
    for _ in 0..4000 {
        let (rho, wo_z) = (reflectance(&mut random), cosine(&mut random));
        let any = Vec2::new(random.one(), random.one());
        let u = random.of(&[any, any, Vec2::new(0.0, any.y), Vec2::new(last, any.x)]);
        let (sin, cos) = math::sin_cos(TAU * u.y);
        inputs.push(join(&[&rho, &[wo_z, u.x, sin, cos]]));
        cases.push((Spectrum::from(rho), Vec3::new(0.0, 0.0, wo_z), u));
    }
    let mut count = 0;
    for (&(rho, wo, u), result) in cases.iter().zip(at_every_width(&Sampled, &inputs)) {
        let Some(expected) = direct::lambert_sample(rho, wo, u) else {
            continue;
        };
        let weight = expected.weight().to_array();
        let expected: [f64; 7] = join(&[&expected.wi.to_array(), &[expected.pdf], &weight]);
        let is_same = (0..7).all(|i| same(result[i], expected[i]));
        assert!(
            is_same,
            "{result:?}, expected {expected:?} for {rho:?}, {wo}, {u}"
        );
        count += 1;
    }
    assert!(count > 2000, "{count} samples");
}
