//! Simple directions for mirrors and glass.

use wire::global::SpecularCall::{self, Fresnel, Glass, Mirror, Reflect, Refract, Refraction};
use wire::work::Xyz;

/// Directions straight up and down, then those with fifths as coordinates. From inside with an
/// index of 2 the slanted ones are totally reflected.
const DIRECTIONS: [Xyz; 6] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.6, 0.0, 0.8],
    [0.6, 0.0, -0.8],
    [0.0, 0.8, 0.6],
    [0.0, 0.8, -0.6],
];

/// Directions in the plane of the surface, where nothing is sampled by convention.
const EDGE_ON: [Xyz; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// The two colours of a glass: what is reflected, and what passes.
type Tints = [Xyz; 2];

const WHITE: Tints = [[1.0; 3]; 2];
const COLOURED: Tints = [[1.0, 0.5, 0.0], [0.5, 0.0, 1.0]];

/// Indices of refraction.
const IORS: [f64; 4] = [2.0, 0.5, 1.5, 1.0];

/// The simple questions about mirrors and glass, white ones first, those along the normal before
/// slanted ones.
pub(crate) fn questions() -> Vec<Vec<SpecularCall>> {
    let mut calls = fresnel(&[1.0, 0.5], &[2.0, 0.5, 1.5, 1.0, 3.0]);
    let mut add = |wo: Xyz, ior: f64, tints: Tints| {
        let [reflectance, transmittance] = tints;
        calls.extend([
            Reflect { wo },
            Mirror { reflectance, wo },
            Refract { wo, ior },
            Refraction {
                transmittance,
                ior,
                wo,
            },
        ]);
        let glass = |choice: f64| Glass {
            reflectance,
            transmittance,
            ior,
            wo,
            choice,
        };
        calls.extend(choices(ior).iter().map(|&choice| glass(choice)));
    };
    for directions in DIRECTIONS.chunks(2) {
        for ior in IORS {
            directions.iter().for_each(|&wo| add(wo, ior, WHITE));
        }
        directions.iter().for_each(|&wo| add(wo, 2.0, COLOURED));
    }
    EDGE_ON.iter().for_each(|&wo| add(wo, 2.0, WHITE));
    calls.extend(fresnel(&[0.0, 0.75, 0.25], &[2.0, 0.5, 1.0 / 1.5]));
    vec![calls]
}

fn fresnel(cosines: &[f64], etas: &[f64]) -> Vec<SpecularCall> {
    let of_cosine = |&cos_i: &f64| etas.iter().map(move |&eta| Fresnel { cos_i, eta });
    cosines.iter().flat_map(of_cosine).collect()
}

/// Choices that no probability of reflection is near. Where the index is 1 the probability is 0,
/// and a formula with angles computes 1e-32: 0 is no choice there.
fn choices(ior: f64) -> &'static [f64] {
    match ior == 1.0 {
        true => &[0.5],
        false => &[0.0, 0.5],
    }
}

#[cfg(test)]
mod tests {
    use super::super::truth::reflected_share;
    use super::*;

    #[test]
    fn no_choice_is_near_the_probability_of_reflection() {
        for call in questions().concat() {
            if let Glass {
                ior, wo, choice, ..
            } = call
            {
                let share = reflected_share(wo, ior);
                assert!((choice - share).abs() > 1e-3, "{call:?}: {share}");
            }
        }
    }
}
