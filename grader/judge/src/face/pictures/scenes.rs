//! The scenes of the pictures.

use super::SIZE;
use crate::tools::questions::eye::view;
use crate::tools::questions::picture_shapes::{behind, octahedron, ring, spheres_in_a_pile};
use crate::tools::questions::probes::wire_triangle;
use crate::tools::questions::scattering;
use crate::tools::questions::tree_plan::along_morton_curve;
use crate::tools::truth::scene::load;
use kit::{Camera, Triangle, Vec3};
use meshes::{MeshKind, generate};
use wire::direct::Strategy;
use wire::light::{LitWorld, Material, Panel};
use wire::picture::{Subject, View};
use wire::work::{self, SceneSource, Xyz};

/// A camera that is turned about both axes, with a different scale for each.
pub(super) fn turned_camera() -> work::Camera {
    let pos = Vec3::new(4.0, 3.0, 5.0);
    let c2w = Camera::look_at(pos, Vec3::new(0.5, 0.9, 0.0), Vec3::Y)
        .expect("the camera does not look along +y");
    work::Camera {
        pos: pos.into(),
        c2w: [c2w.x_axis, c2w.y_axis, c2w.z_axis].map(Vec3::into),
        h_fov: 90.0,
        v_fov: 60.0,
        n_clip: 0.0,
        f_clip: f64::INFINITY,
    }
}

/// Part of a ring, whose inside is seen, an octahedron and a floor; behind the eye is a wall, and a
/// second one before the near end of nothing: only wrong ranges hit it.
pub(super) fn cut_ring() -> Subject {
    const AROUND: u32 = 20;
    let eye = Vec3::new(1.6, 3.1, 4.2);
    let mut triangles = ring(AROUND, 9);
    // Two triangles a facet: without those of the facets towards the eye.
    let per_column = triangles.len() / AROUND as usize;
    triangles.drain(2 * per_column..5 * per_column);
    triangles.extend(octahedron(Vec3::new(0.0, 0.35, 0.0), 0.55));
    let corner = |x: f64, z: f64| Vec3::new(x, -0.6, z);
    triangles.push(Triangle::flat(
        corner(-1.9, -1.9),
        corner(-1.9, 1.9),
        corner(1.9, 1.9),
    ));
    triangles.push(behind(eye, [(-1.0, -0.4), (1.2, -0.4), (0.0, 1.1)]));
    Subject::Shapes {
        triangles: triangles.iter().map(wire_triangle).collect(),
        spheres: Vec::new(),
        view: view(eye.into(), [0.0; 3], 46.0, SIZE),
        range: [3.0, 9.0],
    }
}

/// A pile of spheres on a large one, a sphere behind the eye, and one around everything, whose
/// inside is the background.
pub(super) fn spheres() -> Subject {
    let eye = Vec3::new(2.0, 2.6, 6.5);
    let mut spheres: Vec<(Xyz, f64)> = spheres_in_a_pile()
        .iter()
        .map(|sphere| (sphere.center.into(), sphere.radius))
        .collect();
    spheres.push(((1.4 * eye).into(), 1.0));
    // The eye is in this one: it is hit from inside wherever nothing else is hit.
    spheres.push(([-9.0, 6.0, -4.0], 16.0));
    Subject::Shapes {
        triangles: Vec::new(),
        spheres,
        view: view(eye.into(), [0.0, 0.85, 0.0], 40.0, SIZE),
        range: [4.0, 14.0],
    }
}

/// A mesh to build a tree over.
pub(super) fn leaves() -> Subject {
    let mesh = generate(MeshKind::Smooth, 4000);
    Subject::Leaves {
        triangles: mesh
            .iter()
            .map(|t| [t.p0, t.p1, t.p2].map(Vec3::into))
            .collect(),
        max_leaf_size: 16,
    }
}

/// A staircase of boxes, a flat one below it, and one behind the eye.
pub(super) fn boxes() -> Subject {
    let mut boxes: Vec<[Xyz; 2]> = (0..6)
        .flat_map(|i| (0..4).map(move |j| (f64::from(i), f64::from(j))))
        .map(|(i, j)| {
            let height = 0.3 + 0.25 * ((2.0 * i + 3.0 * j) % 5.0);
            let min = [i - 3.0, 0.0, j - 2.0];
            [min, [min[0] + 0.7, height, min[2] + 0.7]]
        })
        .collect();
    // A flat sheet, and a box behind the eye, which must not be seen.
    boxes.push([[-3.4, -0.1, -2.4], [3.4, -0.1, 2.4]]);
    boxes.push([[5.0, 5.0, 8.0], [8.0, 8.0, 11.0]]);
    Subject::Boxes {
        boxes,
        view: view([3.1, 4.3, 5.6], [0.0, 0.1, 0.2], 50.0, SIZE),
        range: [2.0, 12.0],
    }
}

/// A mesh with a given tree.
pub(super) fn traversal() -> Subject {
    let scene = SceneSource::InCornellBox("smooth".into(), 6000);
    Subject::Traversal {
        tree: along_morton_curve(&load(&scene).primitive_bounds(), 4),
        scene,
        view: view([0.15, 0.85, 4.0], [0.0, 0.72, 0.0], 36.0, SIZE),
        hottest: 420,
    }
}

/// Half of the width and depth of the room.
const HALF: f64 = 1.0;

/// The height of its floor. It is not 0: the error bound of a coordinate is relative, and a ray
/// that leaves a floor at 0 would start in it.
const FLOOR: f64 = -0.75;

/// The height of its ceiling.
const CEILING: f64 = 0.75;

const WHITE: Material = Material::Diffuse([0.75; 3]);
const RED: Material = Material::Diffuse([0.7, 0.13, 0.1]);
const GREEN: Material = Material::Diffuse([0.12, 0.5, 0.15]);

/// A panel; `min` and `max` are its coordinates on the two axes after `axis`.
fn plate(
    axis: usize,
    at: f64,
    min: [f64; 2],
    max: [f64; 2],
    faces: f64,
    material: Material,
) -> Panel {
    Panel {
        axis,
        at,
        min,
        max,
        faces,
        material,
    }
}

/// A room with a red wall on the left and a green one on the right, open to the front, with a tall
/// and a low white block, and a lamp of half the width `lamp` at the ceiling.
fn room(lamp: f64, radiance: Xyz) -> LitWorld {
    let (l, f, h) = (HALF, FLOOR, CEILING);
    let mut panels = vec![
        plate(1, f, [-l, -l], [l, l], 1.0, WHITE),
        plate(1, h, [-l, -l], [l, l], -1.0, WHITE),
        plate(2, -l, [-l, f], [l, h], 1.0, WHITE),
        plate(0, -l, [f, -l], [h, l], 1.0, RED),
        plate(0, l, [f, -l], [h, l], -1.0, GREEN),
        plate(
            1,
            h - 0.01,
            [-lamp, -lamp],
            [lamp, lamp],
            -1.0,
            Material::Emission(radiance),
        ),
    ];
    panels.extend(block([-0.65, f, -0.6], [-0.1, 0.2, -0.1], WHITE));
    panels.extend(block([0.1, f, -0.05], [0.6, -0.33, 0.4], WHITE));
    LitWorld {
        panels,
        lights: Vec::new(),
        environment: None,
    }
}

/// The five visible sides of a block on the floor.
fn block([x0, y0, z0]: Xyz, [x1, y1, z1]: Xyz, material: Material) -> [Panel; 5] {
    [
        plate(0, x0, [y0, z0], [y1, z1], -1.0, material),
        plate(0, x1, [y0, z0], [y1, z1], 1.0, material),
        plate(1, y1, [z0, x0], [z1, x1], 1.0, material),
        plate(2, z0, [x0, y0], [x1, y1], -1.0, material),
        plate(2, z1, [x0, y0], [x1, y1], 1.0, material),
    ]
}

fn room_view() -> View {
    view([0.1, 0.1, 3.9], [0.0, -0.01, 0.0], 39.0, SIZE)
}

/// The room under a wide lamp, which random directions often hit.
pub(super) fn hemisphere() -> Subject {
    Subject::Direct {
        world: room(0.75, [1.5; 3]),
        view: room_view(),
        strategy: Strategy::Hemisphere,
        samples: 64,
        scattering: scattering::given(),
    }
}

/// The room under a small lamp, with a second light without extent: a point in front of it.
pub(super) fn lights() -> Subject {
    let mut world = room(0.3, [6.5; 3]);
    world.lights.push(wire::light::Light::Point {
        position: [0.75, -0.25, 0.8],
        intensity: [0.1, 0.14, 0.25],
    });
    Subject::Direct {
        world,
        view: room_view(),
        strategy: Strategy::Lights,
        samples: 16,
        scattering: scattering::given(),
    }
}

/// The room with a mirror in its left wall.
pub(super) fn paths() -> Subject {
    let mut world = room(0.6, [1.7; 3]);
    let mirror = Material::Mirror([0.9; 3]);
    world.panels.push(plate(
        0,
        0.001 - HALF,
        [-0.5, -0.7],
        [0.45, 0.75],
        1.0,
        mirror,
    ));
    Subject::Paths {
        world,
        view: room_view(),
        max_depth: 5,
        samples: 12,
        scattering: scattering::given(),
    }
}

/// The room under a small lamp, sampled adaptively.
pub(super) fn adaptive() -> Subject {
    Subject::Adaptive {
        world: room(0.35, [5.5; 3]),
        view: room_view(),
        ns_aa: 128,
        batch: 16,
        tolerance: 0.1,
        scattering: scattering::given(),
    }
}
