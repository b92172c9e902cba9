//! Simple directions for diffuse surfaces.

use wire::direct::LambertProbe;
use wire::work::Xyz;

/// Unit vectors above the surface: straight up, and with coordinates of one digit.
const ABOVE: [Xyz; 3] = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, -0.8, 0.6]];

/// Numbers for a sample. None is 0, where some correct code samples a direction in the plane of the
/// surface.
const NUMBERS: [[f64; 2]; 4] = [[0.5, 0.5], [0.25, 0.5], [0.5, 0.25], [0.75, 0.25]];

/// The simple questions about diffuse surfaces: white ones first, then coloured ones; from above,
/// from below and through the surface.
pub(crate) fn questions() -> Vec<Vec<LambertProbe>> {
    let mut probes = Vec::new();
    for reflectance in [[1.0; 3], [1.0, 0.5, 0.0]] {
        for u in NUMBERS {
            for wo in ABOVE {
                for wi in ABOVE {
                    for (wo, wi) in [(wo, wi), (below(wo), below(wi)), (wo, below(wi))] {
                        probes.push(LambertProbe {
                            reflectance,
                            wo,
                            wi,
                            u,
                        });
                    }
                }
            }
        }
    }
    vec![probes]
}

fn below([x, y, z]: Xyz) -> Xyz {
    [x, y, -z]
}
