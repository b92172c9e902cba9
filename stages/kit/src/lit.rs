//! A scene with its light.

use crate::emitter::{EmittingMesh, EmittingTriangle};
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
