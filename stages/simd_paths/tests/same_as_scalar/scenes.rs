//! Random scenes: a box that contains triangles and spheres of every material and lights of every
//! kind.

use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{
    Environment, Light, LitScene, Material, PixelSampler, Scene, Spectrum, Sphere, Triangle, Vec3,
    warp,
};

/// Random random, points and directions from a fixed seed.
pub(crate) struct Random(PixelSampler);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(PixelSampler::new(0, 0, seed))
    }

    fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    fn point(&mut self) -> Vec3 {
        let p = self.0.next_2d();
        2.0 * Vec3::new(p.x, p.y, self.one()) - 1.0
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.0.next_2d())
    }

    fn colour(&mut self) -> Spectrum {
        let p = self.point().abs();
        Spectrum::new(p.x, p.y, p.z)
    }

    fn material(&mut self) -> Material {
        let (tint, ior) = (self.colour(), 1.0 + self.one());
        match self.below(16) {
            0 => Material::Mirror { reflectance: tint },
            1 => Material::Glossy {
                reflectance: tint,
                shininess: 20.0 * ior,
            },
            2 => Material::Refraction {
                transmittance: tint,
                roughness: 0.0,
                ior,
            },
            3 => Material::Glass {
                reflectance: tint,
                transmittance: Spectrum::WHITE,
                roughness: 0.0,
                ior,
            },
            4 => Material::Emission { radiance: tint },
            5 => Material::Diffuse {
                reflectance: Spectrum::BLACK,
            },
            6 => Material::Diffuse {
                reflectance: Spectrum::WHITE,
            },
            _ => Material::Diffuse { reflectance: tint },
        }
    }

    fn light(&mut self) -> Light {
        let (position, direction, light) = (self.point(), self.direction(), self.colour());
        match self.below(6) {
            0 => Light::Point {
                position,
                intensity: light,
            },
            1 => Light::Spot {
                position,
                direction,
                intensity: light,
                falloff_angle: 90.0,
                falloff_exponent: 1.5,
            },
            2 => Light::Directional {
                direction,
                irradiance: light,
            },
            3 => Light::Hemisphere { radiance: light },
            _ => {
                let edge_x = direction.any_orthonormal_vector();
                Light::Area {
                    center: 0.9 * position,
                    edge_x: 0.7 * edge_x,
                    edge_y: 0.4 * direction.cross(edge_x),
                    direction,
                    radiance: 5.0 * light,
                }
            }
        }
    }
}

/// The five walls of a box that is open towards +z, with shared vertices.
fn walls() -> Vec<Triangle> {
    let corner = |i: usize| {
        let side = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Vec3::new(side(0), side(1), side(2))
    };
    [
        [0, 1, 3, 2],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
    ]
    .iter()
    .flat_map(|quad| {
        let [a, b, c, d] = quad.map(corner);
        [Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
    })
    .collect()
}

/// A grey box with a point light and `spheres` in it.
pub(crate) fn box_with_a_point_light(spheres: Vec<Sphere>) -> Scene {
    let triangles = walls();
    Scene {
        object_of: vec![0; triangles.len() + spheres.len()],
        objects: vec![Object {
            name: "box".to_owned(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "grey".to_owned(),
            material: Material::Diffuse {
                reflectance: Spectrum::grey(0.7),
            },
        }],
        lights: vec![NamedLight {
            name: "lamp".to_owned(),
            light: Light::Point {
                position: Vec3::new(0.3, 0.5, 0.2),
                intensity: Spectrum::WHITE,
            },
        }],
        triangles,
        spheres,
        ..Scene::default()
    }
}

/// A box with at max_triangles `max_triangles` triangles and a few spheres. Some triangles are
/// duplicates or degenerate, or have vertex normals that point elsewhere or cancel.
pub(crate) fn random_scene(random: &mut Random, max_triangles: usize) -> LitScene {
    let mut triangles = walls();
    while triangles.len() < max_triangles && random.below(20) > 0 {
        let p = random.point();
        let size = [0.02, 0.5, 1.5][random.below(3)];
        let mut t = Triangle::flat(p, p + size * random.point(), p + size * random.point());
        match random.below(8) {
            0 => t.n2 = random.direction(),
            1 => (t.n0, t.n1, t.n2) = (-t.n0, -t.n1, -t.n2),
            2 => (t.n1, t.n2) = (-0.5 * t.n0, -0.5 * t.n0),
            3 => t.p2 = t.p0 + 2.0 * (t.p1 - t.p0),
            5 => t.n1 = -(-t.n1).map(|c| if c == 0.0 { -c } else { c }),
            4 => t = triangles[random.below(triangles.len())],
            _ => {}
        }
        triangles.push(t);
    }
    let count = random.below(4);
    let spheres = (0..count)
        .map(|_| Sphere {
            center: random.point(),
            radius: [3e-16, 0.001, 0.2, 0.6, 3.0][random.below(5)],
        })
        .collect::<Vec<_>>();
    let materials: Vec<Material> = (0..5).map(|_| random.material()).collect();
    let objects = (0..5).map(|material| Object {
        name: format!("object {material}"),
        material,
    });
    let lights = (0..random.below(4)).map(|i| NamedLight {
        name: format!("light {i}"),
        light: random.light(),
    });
    let lights = lights.collect();
    let scene = Scene {
        object_of: (0..triangles.len() + spheres.len())
            .map(|_| random.below(5) as u32)
            .collect(),
        objects: objects.collect(),
        materials: materials
            .into_iter()
            .map(|material| NamedMaterial {
                name: String::new(),
                material,
            })
            .collect(),
        triangles,
        spheres,
        lights,
        ..Scene::default()
    };
    let environment = (random.below(10) == 0).then(|| Environment::uniform(random.colour()));
    LitScene::new(scene, environment)
}
