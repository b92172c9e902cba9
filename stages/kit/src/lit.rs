//! A scene with its light.

use crate::emitting_mesh::{EmittingMesh, EmittingTriangle};
use crate::math;
use crate::shown_light::show_area_lights;
use crate::{Emitter, Environment, Hit, Light, Material, PrimId, Scene, Spectrum, Surface, Vec3};

/// A scene and all that it is lit by.
///
/// Every light that has an extent is a surface here, so that what is seen, what a random ray finds and what is
/// sampled are one and the same light, and estimates by hemisphere and by light sampling agree:
///
/// - An object whose material emits is one emitter, however many triangles it has; an emitting sphere is one.
/// - An area light of the file whose centre lies on an emitting surface that faces its way is that surface: the
///   course's scenes describe their lamp twice, as a mesh that is seen and as a light that is sampled, and the two do
///   not even have the same outline (0.8 x 0.6 and 0.6 x 0.8). The mesh counts, with its radiance.
/// - Any other area light becomes two triangles, appended to the scene's triangles as an object of its own. So it is
///   seen, too, and casts a shadow; its back is black.
#[derive(Clone, Debug, PartialEq)]
pub struct LitScene {
    /// The geometry, with the area lights in it.
    pub scene: Scene,
    /// Everything that light comes from, in the order of the file: lights first, then emitting objects.
    pub emitters: Vec<Emitter>,
    /// For each primitive, its emitter's index, if it emits.
    emitter_of: Vec<Option<u32>>,
}

impl LitScene {
    /// Collects the light of `scene`, with an `environment` around it or none.
    pub fn new(mut scene: Scene, environment: Option<Environment>) -> LitScene {
        show_area_lights(&mut scene);
        let mut emitters: Vec<Emitter> = scene
            .lights
            .iter()
            .filter_map(|named| emitter(&named.light))
            .collect();
        emitters.extend(environment.map(Emitter::Environment));
        let mut lit = LitScene {
            emitter_of: vec![None; scene.len()],
            scene,
            emitters,
        };
        lit.add_emitting_surfaces();
        lit
    }

    /// What shading asks about the place of `hit`.
    #[inline]
    pub fn surface(&self, hit: &Hit) -> Surface<'_> {
        Surface::new(
            hit,
            self.scene.primitive(hit.prim),
            self.scene.material_of(hit.prim),
        )
    }

    /// The radiance of what a ray along the unit direction `d` sees if it hits nothing.
    pub fn background(&self, d: Vec3) -> Spectrum {
        self.emitters
            .iter()
            .map(|emitter| match emitter {
                Emitter::Sky { radiance } if d.y >= 0.0 => *radiance,
                Emitter::Environment(environment) => environment.radiance(d),
                _ => Spectrum::BLACK,
            })
            .sum()
    }

    /// Whether a ray that hits nothing may see light.
    pub fn has_background(&self) -> bool {
        let is_background =
            |e: &Emitter| matches!(e, Emitter::Sky { .. } | Emitter::Environment(_));
        self.emitters.iter().any(is_background)
    }

    /// Whether there is any light at all.
    pub fn has_light(&self) -> bool {
        !self.emitters.is_empty()
    }

    /// The emitter that primitive `id` is part of, if it emits.
    pub fn emitter_of(&self, id: PrimId) -> Option<&Emitter> {
        self.emitter_of[id.0 as usize].map(|i| &self.emitters[i as usize])
    }

    fn add_emitting_surfaces(&mut self) {
        let scene = &self.scene;
        let mut meshes: Vec<Vec<u32>> = vec![Vec::new(); scene.objects.len()];
        for i in 0..scene.len() as u32 {
            let Material::Emission { radiance } = *scene.material_of(PrimId(i)) else {
                continue;
            };
            if radiance.is_black() {
                continue;
            }
            match (i as usize).checked_sub(scene.triangles.len()) {
                None => meshes[scene.object_of[i as usize] as usize].push(i),
                Some(sphere) => {
                    self.emitter_of[i as usize] = Some(self.emitters.len() as u32);
                    self.emitters.push(Emitter::Sphere {
                        sphere: scene.spheres[sphere],
                        radiance,
                        prim: PrimId(i),
                    });
                }
            }
        }
        for (object, ids) in meshes.iter().enumerate().filter(|(_, ids)| !ids.is_empty()) {
            let material = &scene.materials[scene.objects[object].material as usize].material;
            let triangles = ids
                .iter()
                .map(|&i| EmittingTriangle::of(&scene.triangles[i as usize]));
            if let Some(mesh) = EmittingMesh::new(triangles.collect(), material.emission()) {
                for &i in ids {
                    self.emitter_of[i as usize] = Some(self.emitters.len() as u32);
                }
                self.emitters.push(Emitter::Mesh(mesh));
            }
        }
    }
}

/// The emitter of a light of the file. Area lights have none: by now they are surfaces.
fn emitter(light: &Light) -> Option<Emitter> {
    match *light {
        Light::Area { .. } => None,
        Light::Point {
            position,
            intensity,
        } => Some(Emitter::Point {
            position,
            intensity,
        }),
        Light::Spot {
            position,
            direction,
            intensity,
            falloff_angle,
            falloff_exponent,
        } => Some(Emitter::Spot {
            position,
            direction,
            intensity,
            cos_edge: math::cos((0.5 * falloff_angle).to_radians()),
            falloff_exponent,
        }),
        Light::Directional {
            direction,
            irradiance,
        } => Some(Emitter::Directional {
            direction,
            irradiance,
        }),
        Light::Hemisphere { radiance } => Some(Emitter::Sky { radiance }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec2;
    use crate::scene::NamedLight;
    use crate::shown_light::tests::room;

    #[test]
    fn no_light_is_no_emitter() {
        let mut dark = room(vec![]);
        dark.materials[0].material = Material::Emission {
            radiance: Spectrum::BLACK,
        };
        assert!(!LitScene::new(dark, None).has_light());
        assert!(LitScene::new(room(vec![]), None).has_light());
    }

    #[test]
    fn the_background_is_the_sky_above_and_the_environment_all_around() {
        let sky = NamedLight {
            name: "sky".into(),
            light: Light::Hemisphere {
                radiance: Spectrum::grey(2.0),
            },
        };
        let all_around = Environment::uniform(Spectrum::grey(0.5));
        let lit = LitScene::new(room(vec![sky]), Some(all_around));
        assert_eq!(lit.background(Vec3::Y), Spectrum::grey(2.5));
        assert_eq!(lit.background(-Vec3::Y), Spectrum::grey(0.5));
    }

    /// The front of a surface is the side of its vertex normals, however it is wound.
    #[test]
    fn a_lamp_wound_the_wrong_way_shines_where_its_normals_point() {
        let mut scene = room(vec![]);
        for t in &mut scene.triangles {
            std::mem::swap(&mut t.p1, &mut t.p2);
        }
        let lit = LitScene::new(scene, None);
        let hit = Hit {
            t: 1.0,
            p: Vec3::new(0.0, 1.49, 0.0),
            n: -Vec3::Y,
            ng: Vec3::Y,
            uv: Vec2::ZERO,
            prim: PrimId(0),
        };
        let surface = lit.surface(&hit);
        assert_eq!(surface.emitted(-Vec3::Y), Spectrum::grey(10.0));
        assert!(surface.emitted(Vec3::Y).is_black());
        assert!(surface.emitted(Vec3::X).is_black());
        assert!(
            lit.emitters[0]
                .sample(Vec3::ZERO, Vec2::splat(0.5))
                .is_some()
        );
    }
}
