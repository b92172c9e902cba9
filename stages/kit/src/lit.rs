//! A scene with its light sources.

use crate::area_lights::add_area_lights;
use crate::emitting_mesh::{EmittingMesh, EmittingTriangle};
use crate::lamps::Lamps;
use crate::math;
use crate::{Emitter, Environment, Hit, Light, Material, PrimId, Scene, Spectrum, Surface, Vec3};

/// A scene and its light sources.
///
/// Every light with an area is a surface of this scene. So camera rays, random rays and light
/// samples see the same light, and hemisphere sampling and light sampling estimate the same value:
///
/// - An object whose material emits is one emitter, whatever its number of triangles. An emitting
///   sphere is one emitter.
/// - An area light of the file whose centre lies on an emitting surface that faces the same way is
///   the same light as that surface. The course's scenes describe their lamp twice, as a visible
///   mesh and as an area light, and even their outlines differ (0.8 x 0.6 and 0.6 x 0.8). The mesh
///   is used, with its radiance.
/// - Any other area light becomes two triangles, appended to the scene's triangles as a new object.
///   So it is visible and casts a shadow; its back is black.
///
/// ```
/// use kit::{Environment, LitScene, Scene, Spectrum, Vec3};
/// let sky = Environment::uniform(Spectrum::grey(0.5));
/// let lit = LitScene::new(Scene::default(), Some(sky));
/// assert!(lit.has_background());
/// assert_eq!(lit.background(Vec3::X), Spectrum::grey(0.5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LitScene {
    /// The geometry, including the area lights.
    pub scene: Scene,
    /// All light sources: lights in the order of the file, then emitting objects.
    pub emitters: Vec<Emitter>,
    /// For each primitive, the index of its emitter, if it emits.
    emitter_of: Vec<Option<u32>>,
}

/// The largest number of lamps that each point samples all of.
const MOST_LAMPS: usize = 8;

impl LitScene {
    /// Collects the light sources of `scene` and of its `environment` map, if there is one.
    pub fn new(mut scene: Scene, environment: Option<Environment>) -> LitScene {
        add_area_lights(&mut scene);
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

    /// The same scene, but if it has more than eight lamps with an area, they are one emitter,
    /// whose samples choose a lamp. For light sampling only, without [`LitScene::emitter_of`].
    #[must_use]
    pub fn with_chosen_lamps(mut self) -> LitScene {
        let is_lamp = |e: &Emitter| matches!(e, Emitter::Mesh(_) | Emitter::Sphere { .. });
        if self.emitters.iter().filter(|e| is_lamp(e)).count() > MOST_LAMPS {
            let (lamps, others) = self.emitters.into_iter().partition(is_lamp);
            self.emitters = others;
            self.emitters.push(Emitter::Lamps(Lamps::new(lamps)));
            self.emitter_of.fill(None);
        }
        self
    }

    /// The surface data for shading at `hit`.
    #[inline]
    pub fn surface(&self, hit: &Hit) -> Surface<'_> {
        Surface::new(
            hit,
            self.scene.primitive(hit.prim),
            self.scene.material_of(hit.prim),
        )
    }

    /// The radiance of a ray along the unit direction `d` that hits nothing.
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

    /// Whether a ray that hits nothing can have radiance: there is a sky or an environment map.
    pub fn has_background(&self) -> bool {
        let is_background =
            |e: &Emitter| matches!(e, Emitter::Sky { .. } | Emitter::Environment(_));
        self.emitters.iter().any(is_background)
    }

    /// Whether there is any light source.
    pub fn has_light(&self) -> bool {
        !self.emitters.is_empty()
    }

    /// The emitter that primitive `id` belongs to, if it emits.
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

/// The emitter of a light of the file. Area lights have none: [`add_area_lights`] has turned them
/// into surfaces.
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
    use crate::area_lights::tests::scene_with_lamp;
    use crate::scene::NamedLight;

    #[test]
    fn black_emission_is_not_an_emitter() {
        let mut dark = scene_with_lamp(vec![]);
        dark.materials[0].material = Material::Emission {
            radiance: Spectrum::BLACK,
        };
        assert!(!LitScene::new(dark, None).has_light());
        assert!(LitScene::new(scene_with_lamp(vec![]), None).has_light());
    }

    #[test]
    fn background_is_the_sum_of_sky_and_environment() {
        let sky = NamedLight {
            name: "sky".into(),
            light: Light::Hemisphere {
                radiance: Spectrum::grey(2.0),
            },
        };
        let environment = Environment::uniform(Spectrum::grey(0.5));
        let lit = LitScene::new(scene_with_lamp(vec![sky]), Some(environment));
        assert_eq!(lit.background(Vec3::Y), Spectrum::grey(2.5));
        assert_eq!(lit.background(-Vec3::Y), Spectrum::grey(0.5));
    }

    /// The front of a surface is the side of its vertex normals, whatever its winding order.
    #[test]
    fn lamp_with_reversed_winding_emits_along_its_vertex_normals() {
        let mut scene = scene_with_lamp(vec![]);
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
