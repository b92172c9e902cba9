//! `lanes::specular`, `global::glass_sample`, `mirror_sample` and `refraction_sample`.

use crate::inputs::{Random, join, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use global::{glass_sample, mirror_sample, refraction_sample};
use kit::{Spectrum, Vec3};
use lanes::Real;
use lanes::specular::SpecularMaterial;

const MIRROR: f64 = 1.0;
const REFRACTION: f64 = 0.0;
const GLASS: f64 = 2.0;

/// From reflectance, transmittance, refractive index, kind, the viewer and the choice: whether
/// there is a sample, its direction and weight.
struct Sampled;

impl Formula<12, 7> for Sampled {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 12]) -> [R; 7] {
        let kind = input[7];
        let material = SpecularMaterial {
            reflectance: vector(&input[0..3]),
            transmittance: vector(&input[3..6]),
            ior: input[6],
            has_fresnel: kind.equals(kind.constant(GLASS)),
            mirrors: kind,
        };
        let sample = material.sample(vector(&input[8..11]), input[11]);
        let (wi, weight) = (sample.wi, sample.weight);
        [
            as_number(sample.exists, kind),
            wi.x,
            wi.y,
            wi.z,
            weight.x,
            weight.y,
            weight.z,
        ]
    }
}

#[test]
fn samples() {
    let mut random = Random::new(14);
    let inputs: Vec<[f64; 12]> = (0..20_000)
        .map(|_| {
            let [reflectance, transmittance] = [0, 1].map(|_| random.point().abs().to_array());
            let kind = random.of(&[MIRROR, REFRACTION, GLASS, GLASS]);
            let any = 1.0 + random.one();
            let ior = random.of(&[any, any, 1.0, 1.0 / any, 1e3]);
            // Steep, grazing, in the plane, and at the angle of total reflection.
            let normal = random.normal();
            let slant = Vec3::new(1.0, 0.0, random.of(&[1e-9, -1e-9, 1e-200])).normalize();
            let sin = (1.0 / ior).min(1.0);
            let critical = Vec3::new(sin, 0.0, -(1.0 - sin * sin).sqrt());
            let wo = random.of(&[normal, normal, normal, slant, critical]);
            let any = random.one();
            let choice = random.of(&[any, any, 0.0, 1.0 - f64::EPSILON / 2.0]);
            let last = [ior, kind, wo.x, wo.y, wo.z, choice];
            join(&[&reflectance, &transmittance, &last])
        })
        .collect();
    let mut counts = [0; 2];
    for (input, result) in inputs.iter().zip(at_every_width(&Sampled, &inputs)) {
        let [r0, r1, r2, t0, t1, t2, ior, kind, x, y, z, choice] = *input;
        let (r, t) = (Spectrum::new(r0, r1, r2), Spectrum::new(t0, t1, t2));
        let wo = Vec3::new(x, y, z);
        let expected = if kind == MIRROR {
            mirror_sample(r, wo)
        } else if kind == REFRACTION {
            refraction_sample(t, ior, wo)
        } else {
            glass_sample(r, t, ior, wo, choice)
        };
        counts[usize::from(expected.is_some())] += 1;
        let is_same = match &expected {
            None => result[0] == 0.0,
            Some(sample) => {
                let weight = sample.weight().to_array();
                let expected: [f64; 7] = join(&[&[1.0], &sample.wi.to_array(), &weight]);
                (0..7).all(|i| same(result[i], expected[i]))
            }
        };
        assert!(is_same, "{result:?}, expected {expected:?} for {input:?}");
    }
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
}
