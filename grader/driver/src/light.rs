//! Converts materials and environment maps, and builds scenes from objects.

use kit::scene::{NamedMaterial, Object};
use kit::{Environment, Material, Scene, Spectrum, Triangle};
use wire::light::Surroundings;

pub(crate) fn material(m: &wire::light::Material) -> Material {
    match *m {
        wire::light::Material::Diffuse(reflectance) => Material::Diffuse {
            reflectance: reflectance.into(),
        },
        wire::light::Material::Emission(radiance) | wire::light::Material::PartOfLamp(radiance) => {
            Material::Emission {
                radiance: radiance.into(),
            }
        }
        wire::light::Material::Mirror(reflectance) => Material::Mirror {
            reflectance: reflectance.into(),
        },
        wire::light::Material::Glass(ior) => Material::Glass {
            reflectance: Spectrum::WHITE,
            transmittance: Spectrum::WHITE,
            roughness: 0.0,
            ior,
        },
    }
}

/// Builds a scene with one object for each list of triangles and its material.
pub(crate) fn scene(objects: &[(Vec<Triangle>, Material)]) -> Scene {
    let mut scene = Scene::default();
    for (number, (triangles, material)) in (0..).zip(objects) {
        let name = format!("object {number}");
        scene.objects.push(Object {
            name: name.clone(),
            material: number,
        });
        scene.materials.push(NamedMaterial {
            name,
            material: *material,
        });
        scene.triangles.extend(triangles);
        scene.object_of.resize(scene.triangles.len(), number);
    }
    scene
}

/// Converts an environment map.
pub(crate) fn environment(around: &Surroundings) -> Environment {
    let width = around.width as usize;
    let texels: Vec<Spectrum> = around.texels.iter().map(|&texel| texel.into()).collect();
    Environment::new(width, texels.len() / width, texels)
        .expect("the cases have complete environment maps")
}
