//! Simple directions for mirrors and glass.

use wire::global::SpecularCall::{self, Fresnel, Glass, Mirror, Reflect, Refract, Refraction};
use wire::work::Xyz;

/// Directions: straight up and down, and with coordinates of one digit. From inside with an index
/// of 2 the slanted ones are totally reflected.
const DIRECTIONS: [Xyz; 6] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.6, 0.0, 0.8],
    [0.6, 0.0, -0.8],
    [0.0, 0.8, 0.6],
    [0.0, 0.8, -0.6],
];

/// The simple questions about mirrors and glass, white ones first.
pub(crate) fn questions() -> Vec<Vec<SpecularCall>> {
    let mut calls = Vec::new();
    for tint in [[1.0; 3], [1.0, 0.5, 0.0]] {
        for ior in [2.0, 1.5, 0.5, 1.0] {
            for wo in DIRECTIONS {
                calls.extend([
                    Reflect { wo },
                    Mirror {
                        reflectance: tint,
                        wo,
                    },
                    Refract { wo, ior },
                    Refraction {
                        transmittance: tint,
                        ior,
                        wo,
                    },
                ]);
                // No probability of a choice is near these.
                calls.extend([0.0, 0.999].map(|choice| Glass {
                    reflectance: tint,
                    transmittance: tint,
                    ior,
                    wo,
                    choice,
                }));
            }
            for cos_i in [1.0, 0.5, 0.75, 0.25] {
                for eta in [ior, 1.0 / ior] {
                    calls.push(Fresnel { cos_i, eta });
                }
            }
        }
    }
    vec![calls]
}
