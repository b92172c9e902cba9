//! A scene with its light.

use crate::emitting_mesh::{EmittingMesh, EmittingTriangle};
use crate::math;
use crate::scene::{NamedMaterial, Object};
use crate::{
    Emitter, Environment, Hit, Light, Material, PrimId, Scene, Spectrum, Surface, Triangle, Vec3,
};

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

/// How far an area light may be from a surface that shows it, as a share of its size. The course's lamps agree to a
/// millionth; lights that are meant to be two are farther apart.
const SAME_PLACE: f64 = 1e-3;

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
            let triangles = ids.iter().map(|&i| emitting(&scene.triangles[i as usize]));
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

/// The side that shines is the side of the vertex normals.
fn emitting(t: &Triangle) -> EmittingTriangle {
    let (e1, e2) = (t.p1 - t.p0, t.p2 - t.p0);
    let ng = e1.cross(e2).normalize_or_zero();
    EmittingTriangle {
        p0: t.p0,
        e1,
        e2,
        front: if ng.dot(t.n0 + t.n1 + t.n2) < 0.0 {
            -ng
        } else {
            ng
        },
    }
}

/// Gives every area light that no surface of the scene shows a surface of its own.
fn show_area_lights(scene: &mut Scene) {
    for i in 0..scene.lights.len() {
        let Light::Area {
            center,
            edge_x,
            edge_y,
            direction,
            radiance,
        } = scene.lights[i].light
        else {
            continue;
        };
        let size = edge_x.length() + edge_y.length();
        if is_shown(scene, center, direction, SAME_PLACE * size) {
            continue;
        }
        let corner = |x: f64, y: f64| center + x * edge_x + y * edge_y;
        let (a, b, c, d) = (
            corner(-0.5, -0.5),
            corner(0.5, -0.5),
            corner(0.5, 0.5),
            corner(-0.5, 0.5),
        );
        // Wound so that the geometric normal is on the side that shines.
        let halves = if edge_x.cross(edge_y).dot(direction) < 0.0 {
            [[a, d, c], [a, c, b]]
        } else {
            [[a, b, c], [a, c, d]]
        };
        let name = scene.lights[i].name.clone();
        let object = scene.objects.len() as u32;
        scene.objects.push(Object {
            name: name.clone(),
            material: scene.materials.len() as u32,
        });
        scene.materials.push(NamedMaterial {
            name,
            material: Material::Emission { radiance },
        });
        for [p0, p1, p2] in halves {
            // Triangles are numbered before spheres.
            scene.object_of.insert(scene.triangles.len(), object);
            scene.triangles.push(Triangle::flat(p0, p1, p2));
        }
    }
}

/// Whether an emitting triangle that faces along `direction` passes within `tolerance` of `center`.
fn is_shown(scene: &Scene, center: Vec3, direction: Vec3, tolerance: f64) -> bool {
    scene.triangles.iter().enumerate().any(|(i, triangle)| {
        let id = PrimId(i as u32);
        !scene.material_of(id).emission().is_black() && {
            let t = emitting(triangle);
            t.front.dot(direction) > 0.0 && distance_to(triangle, center) <= tolerance
        }
    })
}

/// Distance from `p` to the nearest point of the triangle (Ericson, "Real-time collision detection", 2005, 5.1.5).
fn distance_to(t: &Triangle, p: Vec3) -> f64 {
    let (ab, ac) = (t.p1 - t.p0, t.p2 - t.p0);
    let n = ab.cross(ac);
    let inside = [(t.p0, t.p1), (t.p1, t.p2), (t.p2, t.p0)]
        .iter()
        .all(|&(a, b)| (b - a).cross(p - a).dot(n) >= 0.0);
    if inside {
        return (p - t.p0).dot(n.normalize_or_zero()).abs();
    }
    let to_edge = |a: Vec3, b: Vec3| {
        let d = b - a;
        let s = ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0);
        p.distance(a + s * d)
    };
    to_edge(t.p0, t.p1)
        .min(to_edge(t.p1, t.p2))
        .min(to_edge(t.p2, t.p0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::NamedLight;
    use crate::{Sphere, Vec2};

    fn area_light(center: Vec3) -> NamedLight {
        NamedLight {
            name: "Area".into(),
            light: Light::Area {
                center,
                edge_x: 0.6 * Vec3::X,
                edge_y: 0.8 * Vec3::Z,
                direction: -Vec3::Y,
                radiance: Spectrum::grey(10.0),
            },
        }
    }

    /// A ball, and a lamp of two triangles at height 1.49 like the course's, shining down.
    fn room(lights: Vec<NamedLight>) -> Scene {
        let corner = |x: f64, z: f64| Vec3::new(x, 1.49, z);
        let named = |name: &str, material| NamedMaterial {
            name: name.into(),
            material,
        };
        Scene {
            triangles: vec![
                Triangle::flat(corner(0.4, -0.3), corner(0.4, 0.3), corner(-0.4, 0.3)),
                Triangle::flat(corner(0.4, -0.3), corner(-0.4, 0.3), corner(-0.4, -0.3)),
            ],
            spheres: vec![Sphere {
                center: Vec3::ZERO,
                radius: 0.3,
            }],
            object_of: vec![0, 0, 1],
            objects: vec![
                Object {
                    name: "light".into(),
                    material: 0,
                },
                Object {
                    name: "ball".into(),
                    material: 1,
                },
            ],
            materials: vec![
                named(
                    "light",
                    Material::Emission {
                        radiance: Spectrum::grey(10.0),
                    },
                ),
                named(
                    "grey",
                    Material::Diffuse {
                        reflectance: Spectrum::grey(0.6),
                    },
                ),
            ],
            lights,
            ..Scene::default()
        }
    }

    fn areas(lit: &LitScene) -> Vec<f64> {
        let area = |emitter: &Emitter| match emitter {
            Emitter::Mesh(mesh) => mesh.area(),
            other => panic!("not a mesh: {other:?}"),
        };
        lit.emitters.iter().map(area).collect()
    }

    /// The course's lamp is described twice: as a mesh, and as an area light turned by a right angle.
    #[test]
    fn a_lamp_described_twice_is_one_lamp() {
        let scene = room(vec![area_light(Vec3::new(0.0, 1.49 + 1e-8, 0.004))]);
        let lit = LitScene::new(scene.clone(), None);
        assert_eq!(lit.scene, scene);
        let areas = areas(&lit);
        assert!(areas.len() == 1 && (areas[0] - 0.48).abs() < 1e-12);
        assert!(lit.emitter_of(PrimId(1)).is_some());
        assert!(lit.emitter_of(PrimId(2)).is_none());
    }

    #[test]
    fn an_area_light_alone_becomes_a_surface() {
        let lit = LitScene::new(room(vec![area_light(Vec3::new(0.0, 1.2, 0.0))]), None);
        assert_eq!(lit.scene.triangles.len(), 4);
        let sphere = lit.scene.material_of(PrimId(4));
        assert_eq!(
            sphere,
            &Scene::material_of(&room(vec![]), PrimId(2)).clone()
        );
        let areas = areas(&lit);
        assert!(areas.len() == 2 && (areas[1] - 0.48).abs() < 1e-12);
        // It shines down.
        let ng = |t: &Triangle| (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
        for triangle in &lit.scene.triangles[2..] {
            assert!((ng(triangle) + Vec3::Y).length() < 1e-12);
        }
    }

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
