//! A Cornell box around a mesh.

use kit::camera::scale_fov;
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{Aabb, Camera, Light, Mat3, Material, Scene, Spectrum, Triangle, Vec3};

/// Half of the width and depth of the box. Its floor is at y = 0, and its front at +z is open.
const HALF: f64 = 1.0;
/// Height of the ceiling.
const HEIGHT: f64 = 1.5;
/// Half of the edge lengths of the light in x and z.
const LIGHT: [f64; 2] = [0.4, 0.3];
/// Height of the light, slightly below the ceiling.
const LIGHT_HEIGHT: f64 = 1.49;
/// Space for the mesh: width, height, depth.
const MESH_SPACE: Vec3 = Vec3::new(1.6, 1.15, 1.6);
/// Distance of the mesh from the floor.
const GAP: f64 = 1e-3;

/// A Cornell box with `mesh` on the centre of its floor, scaled uniformly to fit, with a light
/// below the ceiling.
///
/// These scenes replace the two large scenes of the assignment:
/// `cornell_with(generate(MeshKind::Smooth, 100_000))` for CBdragon and
/// `cornell_with(generate(MeshKind::Terrain, 500_000))` for CBlucy.
pub fn cornell_with(mesh: Vec<Triangle>) -> Scene {
    let mut scene = Scene {
        triangles: fitted(mesh),
        ..Scene::default()
    };
    let matte = |r, g, b| Material::Diffuse {
        reflectance: Spectrum::new(r, g, b),
    };
    let radiance = Spectrum::grey(10.0);
    add_object(&mut scene, "mesh", matte(0.7, 0.7, 0.7));
    // The winding order of the walls is such that their normals point into the box.
    let (l, h) = (HALF, HEIGHT);
    let white = matte(0.7, 0.7, 0.7);
    add_quad(
        &mut scene,
        "floor",
        white,
        [[-l, 0.0, l], [l, 0.0, l], [l, 0.0, -l], [-l, 0.0, -l]],
    );
    add_quad(
        &mut scene,
        "ceiling",
        white,
        [[-l, h, -l], [l, h, -l], [l, h, l], [-l, h, l]],
    );
    add_quad(
        &mut scene,
        "back",
        white,
        [[-l, 0.0, -l], [l, 0.0, -l], [l, h, -l], [-l, h, -l]],
    );
    add_quad(
        &mut scene,
        "left",
        matte(0.65, 0.15, 0.12),
        [[-l, 0.0, l], [-l, 0.0, -l], [-l, h, -l], [-l, h, l]],
    );
    add_quad(
        &mut scene,
        "right",
        matte(0.18, 0.5, 0.2),
        [[l, 0.0, -l], [l, 0.0, l], [l, h, l], [l, h, -l]],
    );
    let ([x, z], y) = (LIGHT, LIGHT_HEIGHT);
    let emission = Material::Emission { radiance };
    add_quad(
        &mut scene,
        "light",
        emission,
        [[-x, y, -z], [x, y, -z], [x, y, z], [-x, y, z]],
    );
    scene.lights.push(NamedLight {
        name: "light".to_owned(),
        light: Light::Area {
            center: Vec3::new(0.0, y, 0.0),
            edge_x: Vec3::new(2.0 * x, 0.0, 0.0),
            edge_y: Vec3::new(0.0, 0.0, 2.0 * z),
            direction: Vec3::NEG_Y,
            radiance,
        },
    });
    scene.camera = Some(Camera {
        pos: Vec3::new(0.0, 0.75, 4.3),
        c2w: Mat3::IDENTITY,
        h_fov: scale_fov(VERTICAL_FOV, 4.0 / 3.0),
        v_fov: VERTICAL_FOV,
        n_clip: 0.1,
        f_clip: 100.0,
    });
    scene
}

/// Vertical angle of view in degrees, such that the front of the box fills the image.
const VERTICAL_FOV: f64 = 27.0;

/// The mesh, scaled and translated into the box.
fn fitted(mut mesh: Vec<Triangle>) -> Vec<Triangle> {
    let bounds = mesh
        .iter()
        .fold(Aabb::EMPTY, |all, triangle| all.union(triangle.bounds()));
    if bounds.is_empty() {
        return mesh;
    }
    let scale = (MESH_SPACE / bounds.extent()).min_element();
    let base = Vec3::new(bounds.centroid().x, bounds.min.y, bounds.centroid().z);
    for triangle in &mut mesh {
        for p in [&mut triangle.p0, &mut triangle.p1, &mut triangle.p2] {
            *p = scale * (*p - base) + Vec3::new(0.0, GAP, 0.0);
        }
    }
    mesh
}

fn add_quad(scene: &mut Scene, name: &str, material: Material, corners: [[f64; 3]; 4]) {
    let [a, b, c, d] = corners.map(Vec3::from);
    scene
        .triangles
        .extend([Triangle::flat(a, b, c), Triangle::flat(a, c, d)]);
    add_object(scene, name, material);
}

/// Adds an object with all triangles that have no object yet.
fn add_object(scene: &mut Scene, name: &str, material: Material) {
    let index = scene.objects.len() as u32;
    scene.materials.push(NamedMaterial {
        name: name.to_owned(),
        material,
    });
    scene.objects.push(Object {
        name: name.to_owned(),
        material: index,
    });
    scene.object_of.resize(scene.triangles.len(), index);
}
