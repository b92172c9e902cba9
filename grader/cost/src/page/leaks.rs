//! A closed mesh with its leaks in magenta.
//!
//! Seen from outside, each pixel next to an edge sends its ray at that edge, as far as rounding lets it: one of the two triangles
//! there must stop it. Where neither does, one looks through the mesh. Other rays of a picture hit edges so rarely that
//! nothing would be seen; in a film of many frames they are the dots that flicker.

use super::words::{name, percent};
use crate::report::{Family, Row};
use grader::error::GraderError;
use image::{Rgb, RgbImage};
use kernels::{Found, Kernel};
use kit::{Ray, Triangle, Vec3};
use meshes::{MeshKind, generate};
use pages::html::{escape, png_data_uri};
use rayon::prelude::*;
use std::collections::HashMap;

const SIZE: [u32; 2] = [300, 240];
const TRIANGLES: usize = 600;

/// The mesh fills the cube from -1 to 1; the eye looks at its middle.
const EYE: Vec3 = Vec3::new(1.6, 1.4, 2.4);

/// Width of the picture at the middle of the mesh.
const WIDTH: f64 = 2.1;

/// A pixel this close to an edge, in pixels, aims at it.
const NEAR: f64 = 0.8;

/// A hit farther behind the edge than this share of its distance is that of another wall.
const SAME_WALL: f64 = 1e-3;

/// No surface has this colour.
const MAGENTA: Rgb<u8> = Rgb([255, 0, 255]);

type TriangleKernel = Kernel<Triangle, Found>;

/// A picture with a kernel that leaks (the textbook's, if it does, else the worst) and one with the fastest that does not,
/// and what they show; `None` where no known kernel leaks.
pub(crate) fn figure(family: &Family) -> Result<Option<(String, String)>, GraderError> {
    let known = kernels::triangles();
    let leaks = |row: &Row| row.leaks_per_million.unwrap_or(0.0);
    let kernel_of = |row: &Row| {
        let mut known = known.iter().filter(|kernel| !kernel.about.culls);
        known
            .find(|kernel| {
                let precision = crate::measure::precision(kernel.precision);
                kernel.about.name == row.name && precision == row.precision
            })
            .copied()
    };
    let rows = || {
        family
            .rows
            .iter()
            .filter_map(|row| Some((row, kernel_of(row)?)))
    };
    let leaking = rows()
        .filter(|(row, _)| leaks(row) > 0.0)
        .max_by(|(a, _), (b, _)| {
            let textbook = a.textbook.cmp(&b.textbook);
            textbook.then(leaks(a).total_cmp(&leaks(b)))
        });
    let tight = rows()
        .filter(|(row, _)| row.leaks_per_million == Some(0.0))
        .min_by(|a, b| a.0.time.ns_median.total_cmp(&b.0.time.ns_median));
    let (Some(leaking), Some(textbook)) = (leaking, known.first()) else {
        return Ok(None);
    };
    let view = View::new(textbook);
    let mut drawn = String::from("<div class=\"pair\">");
    let mut said = format!(
        "A closed mesh of {TRIANGLES} triangles; pixels within {NEAR} of an edge aim at it ({} of them). Magenta: both triangles \
         at the edge let the ray pass. ",
        view.at_edges()
    );
    for (row, kernel) in [Some(leaking), tight].into_iter().flatten() {
        let (picture, through) = view.picture(&kernel);
        let [w, h] = SIZE;
        drawn += &format!(
            "<figure><img src=\"{}\" width=\"{w}\" height=\"{h}\" alt=\"a closed mesh, {through} leaks in magenta\">\
             <figcaption>{}</figcaption></figure>",
            png_data_uri(&picture)?,
            escape(&name(row)),
        );
        said += &match through {
            0 => format!("With {} there is none. ", name(row)),
            _ => format!(
                "With {} that is so for {through} of them ({}). ",
                name(row),
                percent(through as f64 / view.at_edges().max(1) as f64)
            ),
        };
    }
    drawn += "</div>";
    Ok(Some((drawn, said)))
}

/// What is seen of the mesh, and through which rays.
struct View {
    mesh: Vec<Triangle>,
    /// Row by row from the top: the ray and the triangle it hits, and whether it aims at an edge.
    pixels: Vec<Option<Seen>>,
}

struct Seen {
    ray: Ray,
    t: f64,
    triangle: usize,
    at_edge: bool,
}

impl View {
    /// From outside, by the answers of `textbook`.
    fn new(textbook: &TriangleKernel) -> View {
        let mesh = generate(MeshKind::Smooth, TRIANGLES);
        let edges = inner_edges(&mesh);
        let [w, h] = SIZE;
        let pixels = (0..w * h)
            .into_par_iter()
            .map(|i| {
                let ray = camera_ray(i % w, i / w);
                let (triangle, hit) = closest(textbook, &mesh, &ray)?;
                let aimed = aim_at_edge(&mesh[triangle], &edges[triangle], &ray, hit.t);
                Some(Seen {
                    ray: aimed.unwrap_or(ray),
                    t: hit.t,
                    triangle,
                    at_edge: aimed.is_some(),
                })
            })
            .collect();
        View { mesh, pixels }
    }

    fn at_edges(&self) -> usize {
        self.pixels
            .iter()
            .flatten()
            .filter(|seen| seen.at_edge)
            .count()
    }

    /// The picture that `kernel` makes, and how many rays at edges it lets through.
    fn picture(&self, kernel: &TriangleKernel) -> (RgbImage, usize) {
        let colours: Vec<Rgb<u8>> = self
            .pixels
            .par_iter()
            .map(|seen| match seen {
                None => Rgb([255; 3]),
                Some(seen) if seen.at_edge && self.lets_through(kernel, seen) => MAGENTA,
                Some(seen) => shade(&self.mesh[seen.triangle]),
            })
            .collect();
        let through = colours.iter().filter(|colour| **colour == MAGENTA).count();
        let [w, h] = SIZE;
        let mut colours = colours.into_iter();
        let picture = RgbImage::from_fn(w, h, |_, _| colours.next().unwrap_or(MAGENTA));
        (picture, through)
    }

    /// Whether nothing stops the ray where its edge is.
    fn lets_through(&self, kernel: &TriangleKernel, seen: &Seen) -> bool {
        let wall = seen.ray_length() * (1.0 + SAME_WALL);
        !self.mesh.iter().any(|tri| {
            kernel
                .answer(tri, &seen.ray)
                .is_some_and(|hit| hit.t <= wall)
        })
    }
}

impl Seen {
    /// Where along its ray the edge is: rays at edges end there at 1, and pixels are small.
    fn ray_length(&self) -> f64 {
        if self.at_edge { 1.0 } else { self.t }
    }
}

/// Through the middle of the pixel in column `x` and row `y` from the top left.
fn camera_ray(x: u32, y: u32) -> Ray {
    let [w, h] = SIZE.map(f64::from);
    let backward = EYE.normalize();
    let right = Vec3::Y.cross(backward).normalize();
    let up = backward.cross(right);
    let across = (f64::from(x) + 0.5) / w - 0.5;
    let along = (0.5 * h - f64::from(y) - 0.5) / w;
    let target = WIDTH * (across * right + along * up);
    Ray::new(EYE, (target - EYE).normalize())
}

fn closest(kernel: &TriangleKernel, mesh: &[Triangle], ray: &Ray) -> Option<(usize, Found)> {
    let hits = mesh.iter().enumerate();
    hits.filter_map(|(i, tri)| Some((i, kernel.answer(tri, ray)?)))
        .min_by(|a, b| a.1.t.total_cmp(&b.1.t))
}

/// For each triangle, whether its edges opposite to its first, second and third vertex are shared with another one that
/// faces the eye, too: a ray past the rim of the mesh is no leak.
fn inner_edges(mesh: &[Triangle]) -> Vec<[bool; 3]> {
    let corner = |v: Vec3| v.to_array().map(f64::to_bits);
    let key = |a: Vec3, b: Vec3| {
        let (a, b) = (corner(a), corner(b));
        (a.min(b), a.max(b))
    };
    let edges = |tri: &Triangle| {
        [
            key(tri.p1, tri.p2),
            key(tri.p2, tri.p0),
            key(tri.p0, tri.p1),
        ]
    };
    let mut facing: HashMap<_, u32> = HashMap::new();
    for tri in mesh.iter().filter(|tri| faces_eye(tri)) {
        for edge in edges(tri) {
            *facing.entry(edge).or_default() += 1;
        }
    }
    let both = |edge| facing.get(&edge).is_some_and(|count| *count >= 2);
    mesh.iter().map(|tri| edges(tri).map(both)).collect()
}

fn faces_eye(tri: &Triangle) -> bool {
    // The mesh is round about the origin: outwards is away from it.
    let n = normal(tri);
    n.dot(tri.p0) * n.dot(EYE - tri.p0) > 0.0
}

fn normal(tri: &Triangle) -> Vec3 {
    (tri.p1 - tri.p0).cross(tri.p2 - tri.p0)
}

/// The ray from the same origin at the nearest edge, if that is less than [`NEAR`] pixels away: it gets there at `t = 1`.
fn aim_at_edge(tri: &Triangle, inner: &[bool; 3], ray: &Ray, t: f64) -> Option<Ray> {
    let p = ray.at(t);
    let pixel = NEAR * WIDTH / f64::from(SIZE[0]) * t / EYE.length();
    let corners = [tri.p0, tri.p1, tri.p2];
    let on_edge = |i: usize| {
        let (a, b) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
        let along = (b - a) * ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a + along
    };
    let nearest = (0..3)
        .filter(|i| inner[*i])
        .map(on_edge)
        .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))?;
    (nearest.distance(p) < pixel).then(|| Ray::new(ray.o, nearest - ray.o))
}

/// Facets in grey: lightest where they face a lamp above the eye.
fn shade(tri: &Triangle) -> Rgb<u8> {
    let n = normal(tri).normalize();
    let lamp = (EYE + Vec3::Y).normalize();
    Rgb([(90.0 + 140.0 * n.dot(lamp).abs()) as u8; 3])
}
