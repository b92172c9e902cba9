//! Lights and surfaces of a scripted world in words.

use crate::tools::call_text::{self, direction, point};
use wire::light::{Light, Material, Panel};

pub(super) fn light(light: &Light) -> String {
    match *light {
        Light::Point {
            position,
            intensity,
        } => {
            let (position, intensity) = (point(position), point(intensity));
            format!("a point light at {position}, intensity {intensity}")
        }
        Light::Spot {
            position,
            direction: axis,
            intensity,
            falloff_angle,
            falloff_exponent,
        } => format!(
            "a spot light at {} along {}, intensity {}, angle {falloff_angle}, exponent {falloff_exponent}",
            point(position),
            direction(axis),
            point(intensity)
        ),
        Light::Directional {
            direction: along,
            irradiance,
        } => {
            let (along, irradiance) = (direction(along), point(irradiance));
            format!("a sun along {along}, irradiance {irradiance}")
        }
        Light::Sky(radiance) => format!("a sky of {}", point(radiance)),
    }
}

/// The panel by two opposite corners, and the direction of its front.
pub(super) fn panel(panel: &Panel) -> String {
    let [from, _, to, _] = panel.corners().map(point);
    let sign = if panel.faces < 0.0 { '-' } else { '+' };
    let side = ["x", "y", "z"][panel.axis];
    let (kind, of) = match panel.material {
        Material::Emission(radiance) | Material::PartOfLamp(radiance) => {
            ("a lamp", format!(", radiance {}", point(radiance)))
        }
        _ => ("a wall", String::new()),
    };
    format!("{kind} from {from} to {to} that faces {sign}{side}{of}")
}

/// What a surface scatters or emits. The BSDF of diffuse ones is that of
/// [`wire::light::scripted_f`], of local directions.
pub(super) fn material(material: &Material) -> String {
    match *material {
        Material::Diffuse(reflectance) => {
            let share = match reflectance {
                [1.0, 1.0, 1.0] => String::new(),
                _ => format!("{} ", point(reflectance)),
            };
            format!(
                "f = {share}(1/4 + wi.x/10 + wo.y wi.y/20) in the frame of n, 0 through the surface"
            )
        }
        _ => call_text::material(material),
    }
}

#[cfg(test)]
mod tests {
    use super::super::worlds::lamp;
    use super::*;
    use wire::light::{MEAN_F, scripted_f};

    #[test]
    fn the_bsdf_is_the_one_that_is_used() {
        let (wo, wi) = ([0.5, 2.0, 1.0], [3.0, 5.0, 7.0]);
        let written = 1.0 / 4.0 + wi[0] / 10.0 + wo[1] * wi[1] / 20.0;
        let [f, ..] = scripted_f([1.0; 3], wo, wi);
        assert!((f - written).abs() < 1e-15, "{f} {written}");
        assert_eq!(MEAN_F, 1.0 / 4.0);
        let white = material(&Material::Diffuse([1.0; 3]));
        assert_eq!(
            white,
            "f = (1/4 + wi.x/10 + wo.y wi.y/20) in the frame of n, 0 through the surface"
        );
    }

    #[test]
    fn a_lamp_is_described_by_its_corners() {
        assert_eq!(
            panel(&lamp(2.0, [1.0; 3])),
            "a lamp from (-1.0, 2.0, -1.0) to (1.0, 2.0, 1.0) that faces -y, radiance (1.0, 1.0, 1.0)"
        );
    }
}
