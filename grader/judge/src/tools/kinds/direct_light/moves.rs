//! The light of a question, multiplied.

use wire::direct::{DirectWork, ShadedPoint};
use wire::light::{Light, LitWorld, Material, Panel, Surroundings};
use wire::work::Xyz;

/// The question with all light that something emits multiplied by `times`. What arrives is
/// proportional to it.
pub(super) fn multiplied(work: &DirectWork, mut times: impl FnMut(Xyz) -> Xyz) -> DirectWork {
    let mut panels = Vec::new();
    for panel in &work.world.panels {
        panels.push(Panel {
            material: of_material(panel.material, &mut times),
            ..*panel
        });
    }
    let lights = work
        .world
        .lights
        .iter()
        .map(|light| of_light(*light, &mut times))
        .collect();
    let environment = work.world.environment.as_ref().map(|map| Surroundings {
        width: map.width,
        texels: map.texels.iter().map(|texel| times(*texel)).collect(),
    });
    let points = work.points.iter().map(|point| ShadedPoint {
        material: of_material(point.material, &mut times),
        ..*point
    });
    DirectWork {
        points: points.collect(),
        world: LitWorld {
            panels,
            lights,
            environment,
        },
        ..work.clone()
    }
}

/// A material with its emission multiplied.
pub(crate) fn of_material(material: Material, times: &mut impl FnMut(Xyz) -> Xyz) -> Material {
    match material {
        Material::Emission(light) => Material::Emission(times(light)),
        Material::PartOfLamp(light) => Material::PartOfLamp(times(light)),
        Material::Diffuse(_) | Material::Mirror(_) | Material::Glass(_) => material,
    }
}

fn of_light(light: Light, times: &mut impl FnMut(Xyz) -> Xyz) -> Light {
    match light {
        Light::Point {
            position,
            intensity,
        } => Light::Point {
            position,
            intensity: times(intensity),
        },
        Light::Spot {
            position,
            direction,
            intensity,
            falloff_angle,
            falloff_exponent,
        } => Light::Spot {
            position,
            direction,
            intensity: times(intensity),
            falloff_angle,
            falloff_exponent,
        },
        Light::Directional {
            direction,
            irradiance,
        } => Light::Directional {
            direction,
            irradiance: times(irradiance),
        },
        Light::Sky(radiance) => Light::Sky(times(radiance)),
    }
}
