//! Compares our normal-shading pictures with those of the assignment's own program. If we compute
//! vertex normals as that program does, the bytes are equal, apart from the rounding of a few.
//!
//! The pictures are in the folder `FIRSTLIGHT_REFERENCE`, or in `../reference` relative to
//! `FIRSTLIGHT_SCENES`.
//!
//! How the original program computes normals, and where our own pictures differ:
//! - It ignores the normals in the file and weights the faces around a vertex by their area. We use
//!   the file's normals: a difference of a byte or two on curved meshes.
//! - A boundary vertex `v` is on an edge that belongs to one face only. There it uses the normal of
//!   the hole instead of the faces' normals: `(w - v) x (x - v)`, where `w` and `x` are the next
//!   two vertices around the hole. So its normals of flat open meshes (the lamp, the ground under
//!   the banana) are opposite to ours.
//! - If these three vertices are collinear, that normal is rounding noise and cannot be compared.
// BEGIN SOLUTION(part2.task1)

use kit::{Hit, Scene, Triangle, Vec2, Vec3};
use pathtracer::normals::normal_color;
use pathtracer::{Accel, AccelKind, Counters, tone};
use scenes::CameraFile;
use std::collections::{HashMap, HashSet};
use std::env;
use std::path::{Path, PathBuf};

/// Identifies a vertex, which several triangles can share: its object, and the bits of its
/// position.
type Vertex = (u32, [u64; 3]);

fn vertices(scene: &Scene, i: usize) -> [Vertex; 3] {
    let t = &scene.triangles[i];
    // Adding 0 turns -0 into 0.
    [t.p0, t.p1, t.p2].map(|p| (scene.object_of[i], (p + 0.0).to_array().map(f64::to_bits)))
}

fn position(vertex: &Vertex) -> Vec3 {
    Vec3::from(vertex.1.map(f64::from_bits))
}

/// Maps each boundary vertex to the next one around its hole. Each edge of the hole is an edge of a
/// face in the opposite direction.
fn next_around_hole(scene: &Scene) -> HashMap<Vertex, Vertex> {
    let edges_of_face = |i: usize| {
        let [a, b, c] = vertices(scene, i);
        [(a, b), (b, c), (c, a)]
    };
    let edges: HashSet<(Vertex, Vertex)> =
        (0..scene.triangles.len()).flat_map(edges_of_face).collect();
    let open = edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a)));
    open.map(|(a, b)| (*b, *a)).collect()
}

/// If the sine of the angle at a vertex is at most this, it and its two neighbours count as
/// collinear: coordinates in the files have seven digits.
const COLLINEAR: f64 = 1e-5;

/// The original program's normal at each vertex; `None` where it is rounding noise.
fn original_normals(scene: &Scene) -> HashMap<Vertex, Option<Vec3>> {
    let mut sums: HashMap<Vertex, Vec3> = HashMap::new();
    for (i, t) in scene.triangles.iter().enumerate() {
        for vertex in vertices(scene, i) {
            *sums.entry(vertex).or_default() += (t.p1 - t.p0).cross(t.p2 - t.p0);
        }
    }
    let mut normals: HashMap<Vertex, Option<Vec3>> = sums
        .into_iter()
        .map(|(vertex, sum)| (vertex, sum.try_normalize()))
        .collect();
    let next = next_around_hole(scene);
    for (v, w) in &next {
        let to_next = position(w) - position(v);
        let to_second = position(&next[w]) - position(v);
        let n = to_next.cross(to_second);
        let is_noise = n.length() <= COLLINEAR * to_next.length() * to_second.length();
        normals.insert(*v, if is_noise { None } else { n.try_normalize() });
    }
    normals
}

/// The numbers of pixels by the size and cause of their difference.
#[derive(Debug, Default, PartialEq)]
struct Pixels {
    /// All three bytes equal.
    equal: u32,
    /// The largest difference of a byte is one: it was rounded differently.
    off_by_one: u32,
    /// A larger difference, on a triangle with a vertex whose original normal is noise.
    noise: u32,
    /// A larger difference of unknown cause.
    unexplained: u32,
    /// The fraction of pixels whose bytes differ by at most [`ALIKE`] if the file's normals are
    /// used, as in our program.
    alike_with_file_normals: f64,
}

/// Two bytes are similar if they differ by at most this. A normal whose byte differs by 5 is turned
/// by about 3 degrees.
const ALIKE: u8 = 5;

fn compare(scenes: &Path, reference: &Path, name: &str) -> Pixels {
    let scene = scenes::load(scenes.join(format!("{name}.dae")))
        .expect("a scene")
        .scene;
    let view = CameraFile::load(reference.join(format!("{name}.cam.txt")))
        .expect("a camera")
        .view;
    let picture = image::open(reference.join(format!("{name}.png")))
        .expect("a picture")
        .to_rgb8();
    let (w, h) = picture.dimensions();

    let normals = original_normals(&scene);
    let is_noise = |hit: &Hit| {
        let i = hit.prim.0 as usize;
        i < scene.triangles.len() && vertices(&scene, i).iter().any(|c| normals[c].is_none())
    };
    let mut with_original_normals = scene.clone();
    for (i, triangle) in with_original_normals.triangles.iter_mut().enumerate() {
        let [n0, n1, n2] = vertices(&scene, i).map(|c| normals[&c].unwrap_or(Vec3::ZERO));
        *triangle = Triangle {
            n0,
            n1,
            n2,
            ..*triangle
        };
    }

    let tree = Accel::build(AccelKind::Bvh, &scene);
    let mut counters = Counters::default();
    let mut pixels = Pixels::default();
    let mut alike = 0;
    for (x, from_top, theirs) in picture.enumerate_pixels() {
        let y = h - 1 - from_top;
        let center = Vec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let sensor = center / Vec2::new(f64::from(w), f64::from(h));
        let ray = raygen::generate_ray(&view.camera, sensor);
        let difference = |hit: Option<Hit>| {
            let ours = tone::to_bytes(hit.map_or(kit::Spectrum::BLACK, |hit| normal_color(hit.n)));
            let differences = [0, 1, 2].map(|c| ours[c].abs_diff(theirs.0[c]));
            differences.into_iter().max().unwrap_or(0)
        };
        alike +=
            u32::from(difference(tree.closest(&scene, &mut { ray }, None, &mut counters)) <= ALIKE);
        let hit = tree.closest(&with_original_normals, &mut { ray }, None, &mut counters);
        *match difference(hit) {
            0 => &mut pixels.equal,
            1 => &mut pixels.off_by_one,
            _ if hit.is_some_and(|hit| is_noise(&hit)) => &mut pixels.noise,
            _ => &mut pixels.unexplained,
        } += 1;
    }
    pixels.alike_with_file_normals = f64::from(alike) / f64::from(w * h);
    pixels
}

/// The folders of scenes and of reference pictures; `None` if they are not available.
fn folders() -> Option<(PathBuf, PathBuf)> {
    let scenes = PathBuf::from(env::var_os("FIRSTLIGHT_SCENES")?);
    let reference = match env::var_os("FIRSTLIGHT_REFERENCE") {
        Some(reference) => PathBuf::from(reference),
        None => scenes.join("../reference"),
    };
    reference.is_dir().then_some((scenes, reference))
}

#[test]
fn our_pictures_equal_the_originals() {
    let Some((scenes, reference)) = folders() else {
        eprintln!(
            "skipped: set FIRSTLIGHT_SCENES to a folder of scenes that has a folder `reference` beside it"
        );
        return;
    };
    // The smallest fraction of similar pixels with the file's normals. What differs is the lamp in
    // the Cornell boxes, the box and the ground under the banana, and the spout and the handle of
    // the teapot.
    let cases = [
        ("CBbunny", 0.985),
        ("CBempty", 0.985),
        ("CBspheres", 0.985),
        ("CBspheres_lambertian", 0.985),
        ("banana", 0.70),
        ("cow", 0.99),
        ("maxplanck", 0.99),
        ("teapot", 0.97),
    ];
    for (name, least_alike) in cases {
        let pixels = compare(&scenes, &reference, name);
        println!("{name}: {pixels:?}");
        assert_eq!(pixels.unexplained, 0, "{name}: {pixels:?}");
        // Different last bits of a normal round a few bytes of the 172,800 pixels differently.
        assert!(pixels.off_by_one <= 8, "{name}: {pixels:?}");
        let most_noise = if name == "banana" { 3000 } else { 0 };
        assert!(pixels.noise <= most_noise, "{name}: {pixels:?}");
        assert!(
            pixels.alike_with_file_normals >= least_alike,
            "{name}: {pixels:?}"
        );
    }
}
// END SOLUTION(part2.task1)
