//! What the pixels of a picture can show, by the projections of primitives.

use crate::Job;
use kit::camera::half_tan;
use kit::{Camera, FilmSize, LitScene, Mat3, Material, PrimId, Primitive, Spectrum, Vec2, Vec3};
use std::sync::OnceLock;

/// Which pixels of a film can show a primitive, and which a lamp.
///
/// Black samples never end the adaptive sampling of a pixel, because its light may not have been
/// hit yet. Where no primitive is projected onto the pixel, there is nothing to hit: one batch is
/// enough. And only where a lamp is projected can its edge be.
///
/// Every primitive is projected by corners: a triangle by its vertices, a sphere by those of its
/// bounding box. All of its points then lie in the bounding rectangle of the projected corners,
/// because they lie in the convex hull of the corners, whose projection is the convex hull of the
/// projected corners where all corners are in front of the camera. Others are cut off. The answer
/// depends on the scene and the camera only, not on a tree, so every tree takes the same samples.
#[derive(Clone, Debug, Default)]
pub struct PixelContents {
    /// Pixels in a row.
    width: usize,
    primitives: Coverage,
    /// Whether the edge of a lamp is in each pixel, once that is known. Without entries if nobody
    /// asks or there is no lamp.
    lamp_edges: Vec<OnceLock<bool>>,
    /// Where a lamp may be too small to be seen at a corner of a pixel.
    small_lamps: Coverage,
    /// The light that a lamp sends to each corner of them, once that is known.
    corners: Vec<OnceLock<u32>>,
}

/// The pixels that some primitives may be seen in.
#[derive(Clone, Debug, Default)]
enum Coverage {
    /// Perhaps all.
    #[default]
    Unknown,
    /// Row by row from the bottom left.
    Known(Vec<bool>),
}

impl PixelContents {
    /// What the pixels of `job` can show: if asked, which are `empty` and which may show `lamps`.
    /// None is known to be empty where the background can have radiance.
    pub(crate) fn new(lit: &LitScene, job: &Job, [empty, lamps]: [bool; 2]) -> PixelContents {
        let (scene, camera, film) = (&lit.scene, &job.camera, job.film);
        let mut contents = PixelContents {
            width: film.w as usize,
            ..PixelContents::default()
        };
        if empty && !lit.has_background() {
            contents.primitives = Coverage::of(scene.primitives(), camera, film);
        }
        let emits = |material: &Material| material.emission() != Spectrum::BLACK;
        if lamps && scene.materials.iter().any(|m| emits(&m.material)) {
            let numbered = (0..).map(PrimId).zip(scene.primitives());
            let lamps = numbered.filter(|&(id, _)| emits(scene.material_of(id)));
            let seen = lamps
                .map(|(_, lamp)| lamp)
                .filter(|lamp| faces(lamp, camera.pos));
            let seen: Vec<Primitive<'_>> = seen.collect();
            let covered = Coverage::of(seen.iter().copied(), camera, film);
            let projection = Projection::of(camera);
            let size = Vec2::new(film.w.into(), film.h.into());
            let is_small = |lamp: &Primitive<'_>| projection.width(lamp, size) < SMALL;
            contents.small_lamps = Coverage::of(seen.into_iter().filter(is_small), camera, film);
            let edge = |index| match covered.may_contain(index) {
                true => OnceLock::new(),
                false => false.into(),
            };
            contents.lamp_edges = (0..film.whole().area() as usize).map(edge).collect();
            let corners = (film.w as usize + 1) * (film.h as usize + 1);
            contents.corners = vec![OnceLock::new(); corners];
        }
        contents
    }

    /// Whether no ray of the pixel `(x, y)` can hit anything.
    pub fn is_empty(&self, pixel: (u32, u32)) -> bool {
        !self.primitives.may_contain(self.index(pixel))
    }

    /// Whether the edge of a lamp is in the pixel `(x, y)`. `find` looks for it, once, if a ray of
    /// the pixel may hit a lamp.
    pub(crate) fn has_lamp_edge(&self, pixel: (u32, u32), find: impl FnOnce() -> bool) -> bool {
        let edge = self.lamp_edges.get(self.index(pixel));
        edge.is_some_and(|edge| *edge.get_or_init(find))
    }

    /// Whether a lamp may be in the pixel `(x, y)` that is too small for the corners around it.
    pub(crate) fn has_small_lamp(&self, pixel: (u32, u32)) -> bool {
        self.small_lamps.may_contain(self.index(pixel))
    }

    /// The light at the corner `(x, y)` of pixels with an edge. `find` looks for it, once.
    pub(crate) fn light_at_corner(&self, (x, y): (u32, u32), find: impl FnOnce() -> u32) -> u32 {
        *self.corners[y as usize * (self.width + 1) + x as usize].get_or_init(find)
    }

    fn index(&self, (x, y): (u32, u32)) -> usize {
        y as usize * self.width + x as usize
    }
}

/// Whether the outer side of a primitive, which emits light, can be seen from `point`.
fn faces(primitive: &Primitive<'_>, point: Vec3) -> bool {
    match primitive {
        Primitive::Triangle(t) => (t.p1 - t.p0).cross(t.p2 - t.p0).dot(point - t.p0) > 0.0,
        Primitive::Sphere(s) => s.center.distance(point) > s.radius,
    }
}

impl Coverage {
    fn of<'a>(
        primitives: impl Iterator<Item = Primitive<'a>>,
        camera: &Camera,
        film: FilmSize,
    ) -> Coverage {
        let projection = Projection::of(camera);
        let mut cover = Cover::new(film);
        for primitive in primitives {
            match projection.bounds(&primitive) {
                Bounds::Hidden => {}
                Bounds::On(rectangle) => cover.add(rectangle),
                Bounds::Unknown => return Coverage::Unknown,
            }
        }
        Coverage::Known(cover.finish())
    }

    /// Whether the pixel with this index may be one of them.
    fn may_contain(&self, index: usize) -> bool {
        match self {
            Coverage::Unknown => true,
            Coverage::Known(pixels) => pixels.get(index) != Some(&false),
        }
    }
}

/// Where a primitive is projected.
enum Bounds {
    /// In this rectangle on the film.
    On([Vec2; 2]),
    /// No camera ray reaches it: it is behind the camera, or nearer than rays start.
    Hidden,
    /// A corner is too far beside the camera to say.
    Unknown,
}

/// The smallest cosine between the viewing direction and the direction to a point that counts as in
/// front of the camera: below it rounding moves the projection by more than a pixel.
const LEAST_COSINE: f64 = 1e-6;

/// A lamp that is at least this wide on the film, in pixels, hardly hides between the corners of a
/// pixel and of those around it.
const SMALL: f64 = 3.0;

/// Projects points in world space onto the film, whose corners are (0, 0) and (1, 1): the inverse
/// of [`generate_ray`](raygen::generate_ray).
struct Projection {
    pos: Vec3,
    world_to_camera: Mat3,
    /// Tangents of half of the fields of view.
    tangents: Vec2,
    /// No ray starts nearer to the plane of the camera, and there rounding moves no point beyond
    /// it; 0 if rays start at the camera.
    least_depth: f64,
}

impl Projection {
    fn of(camera: &Camera) -> Projection {
        let tangents = Vec2::new(half_tan(camera.h_fov), half_tan(camera.v_fov));
        Projection {
            pos: camera.pos,
            world_to_camera: camera.c2w.inverse(),
            tangents,
            least_depth: 0.5 * camera.n_clip / (1.0 + tangents.length_squared()).sqrt(),
        }
    }

    /// How wide a triangle is on a film of this `size`, in pixels, where it is narrow; of a sphere
    /// its radius. Infinity if a part is behind the camera.
    fn width(&self, primitive: &Primitive<'_>, size: Vec2) -> f64 {
        let to_camera = |p: Vec3| self.world_to_camera * (p - self.pos);
        let points = match primitive {
            Primitive::Triangle(t) => [t.p0, t.p1, t.p2].map(to_camera),
            Primitive::Sphere(s) => {
                [Vec3::X, Vec3::Y, -Vec3::X].map(|axis| to_camera(s.center) + s.radius * axis)
            }
        };
        if points.iter().any(|p| -p.z < self.least_depth) {
            return f64::INFINITY;
        }
        let [a, b, c] = points.map(|p| 0.5 * p.truncate() / -p.z / self.tangents * size);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        (b - a).perp_dot(c - a).abs() / longest
    }

    /// The bounding rectangle of a primitive on the film. A primitive that is partly hidden is cut
    /// off at the least depth: what is left lies within the corners before it and the points at it
    /// between these and the corners behind it.
    fn bounds(&self, primitive: &Primitive<'_>) -> Bounds {
        let mut corners = [Vec3::ZERO; 8];
        let count = match primitive {
            Primitive::Triangle(t) => {
                corners[..3].copy_from_slice(&[t.p0, t.p1, t.p2]);
                3
            }
            Primitive::Sphere(_) => {
                let bounds = primitive.bounds();
                let either = [bounds.min, bounds.max];
                corners = std::array::from_fn(|corner| {
                    let [x, y, z] = [0, 1, 2].map(|axis| either[corner >> axis & 1][axis]);
                    Vec3::new(x, y, z)
                });
                8
            }
        };
        let corners = corners.map(|corner| self.world_to_camera * (corner - self.pos));
        let corners = &corners[..count];
        let least = |p: &Vec3| LEAST_COSINE * p.length();
        let is_seen = |p: &&Vec3| -p.z > least(p) && -p.z >= self.least_depth;
        let is_hidden = |p: &&Vec3| -p.z < -least(p) || -p.z < self.least_depth;
        let hidden_count = corners.iter().filter(is_hidden).count();
        if hidden_count == count {
            return Bounds::Hidden;
        }
        let mut rectangle = [Vec2::INFINITY, Vec2::NEG_INFINITY];
        let mut is_finite = true;
        let mut add = |p: Vec3| {
            let point = 0.5 + 0.5 * Vec2::new(p.x, p.y) / -p.z / self.tangents;
            rectangle = [rectangle[0].min(point), rectangle[1].max(point)];
            is_finite &= point.is_finite();
        };
        let mut seen_count = 0;
        for &p in corners.iter().filter(is_seen) {
            seen_count += 1;
            add(p);
            for &q in corners.iter().filter(is_hidden).take(hidden_count) {
                let part = (-p.z - self.least_depth) / (q.z - p.z);
                add((p + (q - p) * part).with_z(-self.least_depth));
            }
        }
        if is_finite && seen_count + hidden_count == count {
            Bounds::On(rectangle)
        } else {
            Bounds::Unknown
        }
    }
}

/// Counts how many rectangles cover each pixel, in a time that does not depend on their size.
struct Cover {
    film: FilmSize,
    /// How much the count changes at each pixel, along rows and along columns. One row and one
    /// column more than the film has.
    changes: Vec<i64>,
}

impl Cover {
    fn new(film: FilmSize) -> Cover {
        let [w, h] = [film.w, film.h].map(|size| size as usize + 1);
        Cover {
            film,
            changes: vec![0; w * h],
        }
    }

    fn index(&self, x: usize, y: usize) -> usize {
        y * (self.film.w as usize + 1) + x
    }

    /// Adds a rectangle on the film, and one pixel around it: rounding moves rays and corners by
    /// far less.
    fn add(&mut self, [min, max]: [Vec2; 2]) {
        let size = Vec2::new(f64::from(self.film.w), f64::from(self.film.h));
        let first = ((min * size).floor() - 1.0).clamp(Vec2::ZERO, size);
        let end = ((max * size).floor() + 2.0).clamp(Vec2::ZERO, size);
        let [x0, y0, x1, y1] = [first.x, first.y, end.x, end.y].map(|pixel| pixel as usize);
        for (x, y, change) in [(x0, y0, 1), (x1, y0, -1), (x0, y1, -1), (x1, y1, 1)] {
            let index = self.index(x, y);
            self.changes[index] += change;
        }
    }

    /// Whether any rectangle covers each pixel.
    fn finish(self) -> Vec<bool> {
        let (w, h) = (self.film.w as usize, self.film.h as usize);
        let mut counts = vec![0; w];
        let mut is_covered = Vec::with_capacity(w * h);
        for y in 0..h {
            let mut change = 0;
            for (x, count) in counts.iter_mut().enumerate() {
                change += self.changes[self.index(x, y)];
                *count += change;
                is_covered.push(*count > 0);
            }
        }
        is_covered
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Sphere, Triangle};

    #[test]
    fn covered_pixels_are_those_of_the_rectangles_and_around_them() {
        let film = FilmSize { w: 8, h: 6 };
        let mut cover = Cover::new(film);
        // Pixel (5, 2) alone, and a corner outside the film.
        cover.add([
            Vec2::new(5.2 / 8.0, 2.2 / 6.0),
            Vec2::new(5.8 / 8.0, 2.8 / 6.0),
        ]);
        cover.add([Vec2::new(-9.0, -9.0), Vec2::new(0.1 / 8.0, 0.1 / 6.0)]);
        let covered = cover.finish();
        for (x, y) in film.whole().pixels() {
            let is_near = (4..=6).contains(&x) && (1..=3).contains(&y) || x <= 1 && y <= 1;
            assert_eq!(covered[(y * 8 + x) as usize], is_near, "({x}, {y})");
        }
    }

    /// What is looked for with many rays is a lamp between the corners of pixels.
    #[test]
    fn only_small_lamps_hide_between_corners_and_none_shows_its_back() {
        let (x, y) = (Vec3::X, Vec3::Y);
        let camera = Camera {
            pos: 4.0 * Vec3::Z,
            c2w: Mat3::IDENTITY,
            h_fov: 90.0,
            v_fov: 90.0,
            n_clip: 0.1,
            f_clip: 9.0,
        };
        let size = Vec2::splat(8.0);
        let projection = Projection::of(&camera);
        let sphere = |radius| Sphere {
            center: Vec3::ZERO,
            radius,
        };
        let triangle = |p1, p2| Triangle::flat(Vec3::ZERO, p1, p2);
        let [narrow, needle] = [triangle(4.0 * x, 3.0 * y), triangle(7.0 * (x + y), 0.1 * x)];
        let round = sphere(2.5);
        // A pixel is as wide as 1 there.
        for (lamp, width) in [
            (Primitive::Triangle(&narrow), 2.4),
            (Primitive::Triangle(&needle), 0.0707),
            (Primitive::Sphere(&round), 2.5),
        ] {
            let found = projection.width(&lamp, size);
            assert!((found - width).abs() < 1e-3 * width, "{found}");
        }
        let [lamp, back] = [[x, y], [y, x]].map(|[p1, p2]| Triangle::flat(Vec3::ZERO, p1, p2));
        assert!(faces(&Primitive::Triangle(&lamp), camera.pos));
        assert!(!faces(&Primitive::Triangle(&back), camera.pos));
        assert!(faces(&Primitive::Sphere(&sphere(3.0)), camera.pos));
        assert!(!faces(&Primitive::Sphere(&sphere(5.0)), camera.pos));
    }
}
