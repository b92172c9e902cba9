//! Turns the area lights of a scene file into surfaces.

use crate::emitting_mesh::EmittingTriangle;
use crate::scene::{NamedMaterial, Object};
use crate::{Light, Material, PrimId, Scene, Triangle, Vec3};

/// Largest distance between an area light and the surface that represents it, relative to the size
/// of the light. The course's lamps agree to 1e-6; separate lights are farther apart.
const MAX_RELATIVE_DISTANCE: f64 = 1e-3;

/// Adds a surface for every area light that no surface of the scene represents.
pub(crate) fn add_area_lights(scene: &mut Scene) {
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
        if has_surface(scene, center, direction, MAX_RELATIVE_DISTANCE * size) {
            continue;
        }
        let corner = |x: f64, y: f64| center + x * edge_x + y * edge_y;
        let (a, b, c, d) = (
            corner(-0.5, -0.5),
            corner(0.5, -0.5),
            corner(0.5, 0.5),
            corner(-0.5, 0.5),
        );
        // The winding order puts the geometric normal on the emitting side.
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
            // Triangles come before spheres in `object_of`.
            scene.object_of.insert(scene.triangles.len(), object);
            scene.triangles.push(Triangle::flat(p0, p1, p2));
        }
    }
}

/// Whether an emitting triangle that faces along `direction` is within `tolerance` of `center`.
fn has_surface(scene: &Scene, center: Vec3, direction: Vec3, tolerance: f64) -> bool {
    scene.triangles.iter().enumerate().any(|(i, triangle)| {
        let id = PrimId(i as u32);
        !scene.material_of(id).emission().is_black() && {
            let t = EmittingTriangle::of(triangle);
            t.front.dot(direction) > 0.0 && distance_to(triangle, center) <= tolerance
        }
    })
}

/// Distance from `p` to the closest point of the triangle (Ericson, "Real-time collision
/// detection", 2005, section 5.1.5).
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
pub(crate) mod tests {
    use super::*;
    use crate::scene::NamedLight;
    use crate::{Emitter, LitScene, Spectrum, Sphere};

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

    /// A sphere, and a lamp of two triangles at height 1.49 that faces down, as in the course's
    /// scenes.
    pub(crate) fn scene_with_lamp(lights: Vec<NamedLight>) -> Scene {
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

    fn light_areas(lit: &LitScene) -> Vec<f64> {
        let area = |emitter: &Emitter| match emitter {
            Emitter::Mesh(mesh) => mesh.area(),
            other => panic!("not a mesh: {other:?}"),
        };
        lit.emitters.iter().map(area).collect()
    }

    /// The course's scenes describe the lamp twice: as a mesh, and as an area light rotated by 90
    /// degrees.
    #[test]
    fn lamp_described_twice_is_one_light() {
        let scene = scene_with_lamp(vec![area_light(Vec3::new(0.0, 1.49 + 1e-8, 0.004))]);
        let lit = LitScene::new(scene.clone(), None);
        assert_eq!(lit.scene, scene);
        let areas = light_areas(&lit);
        assert!(areas.len() == 1 && (areas[0] - 0.48).abs() < 1e-12);
        assert!(lit.emitter_of(PrimId(1)).is_some());
        assert!(lit.emitter_of(PrimId(2)).is_none());
    }

    #[test]
    fn area_light_without_surface_becomes_a_surface() {
        let light = area_light(Vec3::new(0.0, 1.2, 0.0));
        let lit = LitScene::new(scene_with_lamp(vec![light]), None);
        assert_eq!(lit.scene.triangles.len(), 4);
        let sphere = lit.scene.material_of(PrimId(4));
        assert_eq!(
            sphere,
            &Scene::material_of(&scene_with_lamp(vec![]), PrimId(2)).clone()
        );
        let areas = light_areas(&lit);
        assert!(areas.len() == 2 && (areas[1] - 0.48).abs() < 1e-12);
        // It faces down.
        let ng = |t: &Triangle| (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
        for triangle in &lit.scene.triangles[2..] {
            assert!((ng(triangle) + Vec3::Y).length() < 1e-12);
        }
    }
}
