//! Cases of rays through whole meshes, traced with all of the student's stages.

use crate::tools::questions::probes::wire_ray;
use crate::tools::questions::tree_plan::along_morton_curve;
use crate::tools::spec::Spec;
use crate::tools::truth::scene::load;
use kit::{Ray, Triangle, Vec3};
use wire::kind;
use wire::work::{SceneSource, SceneWork};

/// The cases of `part2.task3` that need box and primitive tests as well. The tree is given, so that
/// a wrong tree costs no points for a right traversal.
pub(crate) fn cases() -> Vec<Spec> {
    vec![
        Spec {
            picture: Some(PICTURE),
            ..case(
                "mesh_in_cornell_box",
                "A smooth mesh of 1,500 triangles in a Cornell box, traced with all of your \
                 stages: for every pixel the closest hit of all primitives.",
                cornell(),
                through_the_front(),
                false,
            )
        },
        case(
            "shadow_rays_in_cornell_box",
            "Shadow rays from the floor and the walls of the same box to points of its light: \
             whether a primitive blocks them.",
            cornell(),
            to_the_light(),
            true,
        ),
        case(
            "rays_on_the_grid",
            "A mesh with integer coordinates, and rays exactly through its vertices and edges and \
             along the faces of its boxes: no holes.",
            SceneSource::Triangles(steps().iter().map(wire_triangle).collect()),
            down_the_grid(),
            false,
        ),
        case(
            "closed_terrain",
            "A closed block with integer coordinates, and rays exactly through vertices, edges and \
             diagonals of its upper side: down, and slanting in planes that contain faces of boxes. \
             The zeros of d have both signs. Pitfall: 0 * inf is NaN in a box test, and a box that \
             is lost to it takes all that is in it along.",
            SceneSource::Triangles(closed_terrain().iter().map(wire_triangle).collect()),
            at_the_terrain(),
            false,
        ),
    ]
}

/// The largest leaf of the trees, as in the assignment's program.
const MAX_LEAF_SIZE: usize = 4;

fn case(
    name: &'static str,
    about: &'static str,
    scene: SceneSource,
    rays: Vec<Ray>,
    any_hit: bool,
) -> Spec {
    let work = SceneWork {
        tree: along_morton_curve(&load(&scene).primitive_bounds(), MAX_LEAF_SIZE),
        scene,
        rays: rays.iter().map(wire_ray).collect(),
        any_hit,
    };
    Spec::new::<kind::SceneHits>("part2.task3", name, about, work)
}

fn cornell() -> SceneSource {
    SceneSource::InCornellBox("smooth".into(), 1500)
}

/// Width and height of the picture.
const PICTURE: [u32; 2] = [72, 54];

/// Rays from an eye in front of the box through a regular grid of points on its open front.
fn through_the_front() -> Vec<Ray> {
    let eye = Vec3::new(0.1, 0.8, 4.0);
    let [w, h] = PICTURE;
    let pixels = (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
    pixels
        .map(|(x, y)| {
            let share = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n);
            let target = Vec3::new(2.1 * share(x, w) - 1.05, 1.6 * share(y, h) - 0.05, 1.0);
            Ray::new(eye, (target - eye).normalize())
        })
        .collect()
}

/// Rays from points just inside the floor and the walls to points just below the light; t = 1 is at
/// the light.
fn to_the_light() -> Vec<Ray> {
    let mut rays = Vec::new();
    for i in 0..20_u32 {
        for j in 0..20_u32 {
            let (u, v) = (f64::from(i) / 10.0 - 0.953, f64::from(j) / 10.0 - 0.947);
            let light = Vec3::new(0.3 * v, 1.48, 0.2 * u);
            for o in [
                Vec3::new(u, 0.01, v),
                Vec3::new(-0.99, 0.74 + 0.7 * u, v),
                Vec3::new(u, 0.74 + 0.7 * v, -0.99),
            ] {
                rays.push(Ray {
                    max_t: 1.0,
                    ..Ray::new(o, light - o)
                });
            }
        }
    }
    rays
}

/// Cells along each side of the grid.
const SIDE: i32 = 12;

/// A height field over a grid, with integer heights; flat in places.
fn steps() -> Vec<Triangle> {
    let vertex = |i: i32, j: i32| {
        let height = (i / 3 + j / 4) % 3;
        Vec3::new(f64::from(i), f64::from(height), f64::from(j))
    };
    let cells = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i, j + 1), vertex(i + 1, j + 1)];
            [Triangle::flat(a, c, b), Triangle::flat(d, b, c)]
        })
        .collect()
}

/// Vertical rays through all vertices and midpoints of edges, and horizontal rays along the lines
/// of the grid.
fn down_the_grid() -> Vec<Ray> {
    let mut rays = Vec::new();
    for i in 0..=2 * SIDE {
        for j in 0..=2 * SIDE {
            let (x, z) = (0.5 * f64::from(i), 0.5 * f64::from(j));
            rays.push(Ray::new(Vec3::new(x, 8.0, z), Vec3::NEG_Y));
            rays.push(Ray::new(Vec3::new(x, -8.0, z), Vec3::Y));
        }
        let level = 0.5 * f64::from(i);
        rays.push(Ray::new(Vec3::new(-3.0, 1.5, level), Vec3::X));
        rays.push(Ray::new(Vec3::new(level, 0.5, 30.0), Vec3::NEG_Z));
    }
    rays
}

/// A closed block: integer heights over a grid above, a plane at 0 below.
fn closed_terrain() -> Vec<Triangle> {
    let height = |i: i32, j: i32| 1 + (7 * i * i + 5 * i * j + 3 * j) % 8;
    let above = |i: i32, j: i32| Vec3::from([i, height(i, j), j].map(f64::from));
    let below = |i: i32, j: i32| Vec3::from([i, 0, j].map(f64::from));
    let quad = |a, b, c, d| [Triangle::flat(a, b, c), Triangle::flat(a, c, d)];
    let ends = |k: i32| {
        [
            (k, 0, k + 1, 0),
            (k + 1, SIDE, k, SIDE),
            (SIDE, k, SIDE, k + 1),
            (0, k + 1, 0, k),
        ]
    };
    let sides = (0..SIDE)
        .flat_map(ends)
        .flat_map(|(i, j, k, l)| quad(below(i, j), below(k, l), above(k, l), above(i, j)));
    let cells = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j)));
    let faces = cells.flat_map(|(i, j)| {
        let cell = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
        let [a, b, c, d] = cell.map(|(i, j)| above(i, j));
        let [e, f, g, h] = cell.map(|(i, j)| below(i, j));
        [quad(a, b, c, d), quad(h, g, f, e)].concat()
    });
    faces.chain(sides).collect()
}

/// Rays at all vertices and midpoints of edges and diagonals of [`closed_terrain`] that are not on
/// its sides: down, and from below or slanting in one of the two planes of the grid through the
/// point.
fn at_the_terrain() -> Vec<Ray> {
    let inner = 2..=2 * SIDE - 2;
    let points = inner
        .clone()
        .flat_map(|i| inner.clone().map(move |j| (i, j)));
    let rays = points.flat_map(|(i, j)| {
        let (x, z) = (0.5 * f64::from(i), 0.5 * f64::from(j));
        let zero = if (i / 2 + j / 2) % 2 == 0 { 0.0 } else { -0.0 };
        let slope = if i % 4 < 2 { 1.0 } else { -1.0 };
        let (y, d) = match (i + j) % 3 {
            0 => (-4.0, Vec3::new(-zero, 2.0, zero)),
            1 => (16.0, Vec3::new(zero, -4.0, slope)),
            _ => (16.0, Vec3::new(slope, -4.0, zero)),
        };
        let down = Ray::new(Vec3::new(x, 16.0, z), Vec3::new(zero, -1.0, -zero));
        [down, Ray::new(Vec3::new(x, y, z), d)]
    });
    rays.collect()
}

fn wire_triangle(t: &Triangle) -> [[f64; 3]; 6] {
    [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(Vec3::into)
}
