//! Pines in snow, in the coordinates of a map: far from the origin, where `f32` is coarse.

use crate::collada::{Document, Mesh, Paint};
use crate::shapes::{lathe, unit};
use kit::math::sin_cos;
use kit::{Triangle, Vec3};
use std::f64::consts::TAU;

/// Where the forest stands, in metres: the map's easting and, to the south, its northing. A map of
/// a country in UTM has such numbers. Between neighbouring `f32` are 3 cm here to the east, and
/// half a metre to the north.
const ORIGIN: Vec3 = Vec3::new(513_000.0, 0.0, -5_630_000.0);

/// Pines: place of the trunk in metres from [`ORIGIN`], and height.
const PINES: [([f64; 2], f64); 18] = [
    ([-2.3, -4.6], 3.6),
    ([2.6, -5.4], 4.4),
    ([-4.4, -7.4], 5.2),
    ([0.5, -9.0], 3.4),
    ([4.9, -9.2], 5.6),
    ([-1.9, -11.5], 5.0),
    ([-6.9, -12.0], 6.4),
    ([2.6, -13.5], 5.8),
    ([7.6, -14.6], 6.2),
    ([-4.4, -16.5], 6.6),
    ([0.4, -18.5], 5.4),
    ([5.2, -19.5], 7.0),
    ([-9.5, -20.0], 7.2),
    ([11.0, -21.5], 7.4),
    ([-1.7, -24.0], 7.6),
    ([-6.2, -26.5], 7.8),
    ([2.9, -28.0], 7.4),
    ([8.0, -29.0], 8.0),
];

/// Needles of a branch, on both sides of it.
const NEEDLES: u64 = 56;

/// How the vertices of the forest are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// In `f64`: to a nanometre.
    Double,
    /// Rounded to the nearest `f32`.
    Single,
}

/// The scene. Only the vertices are rounded; the camera and all that follows are the same.
pub fn document(stored: Stored) -> Document {
    let mut needles = [Vec::new(), Vec::new()];
    let mut trunks = Vec::new();
    for (pine, &([x, z], height)) in (0..).zip(&PINES) {
        let foot = Vec3::new(x, ground(x, z), z);
        let r = 0.014 * height;
        trunks.extend(lathe(
            foot,
            &[[r, -0.3], [0.7 * r, 0.4 * height], [0.0, height]],
        ));
        grow(pine, foot, height, &mut needles);
    }
    let [green, white] = needles;
    let mesh = |name: &str, color, triangles: Vec<Triangle>| Mesh {
        name: name.to_owned(),
        paint: Paint::Matte(color),
        triangles: triangles.iter().filter_map(|t| placed(t, stored)).collect(),
    };
    Document {
        yfov: 42.0,
        aspect: 1.0,
        camera: [Vec3::new(0.0, 1.7, 1.5), Vec3::new(0.1, 2.3, -10.0)].map(|p| ORIGIN + p),
        ambient: None,
        sun: None,
        lights: Vec::new(),
        meshes: vec![
            mesh("snow", [0.86, 0.88, 0.92], snow()),
            mesh("trunks", [0.16, 0.10, 0.07], trunks),
            mesh("needles", [0.07, 0.16, 0.06], green),
            mesh("rime", [0.80, 0.84, 0.90], white),
        ],
    }
}

/// The triangle on the map. A renderer cannot hit one without an area, so that is left out.
fn placed(t: &Triangle, stored: Stored) -> Option<Triangle> {
    let place = |p: Vec3| match stored {
        Stored::Double => p + ORIGIN,
        Stored::Single => (p + ORIGIN).as_vec3().as_dvec3(),
    };
    let [p0, p1, p2] = [t.p0, t.p1, t.p2].map(place);
    let has_area = (p1 - p0).cross(p2 - p0) != Vec3::ZERO;
    has_area.then_some(Triangle { p0, p1, p2, ..*t })
}

/// The height of the snow.
fn ground(x: f64, z: f64) -> f64 {
    let wave = |a: f64, b: f64, shift: f64| sin_cos(a * x + b * z + shift).0;
    0.16 * wave(0.35, 0.21, 0.4) + 0.10 * wave(-0.62, 0.48, 1.9) + 0.03 * wave(1.7, 1.3, 0.2)
        - 0.012 * z.min(0.0)
}

/// Snow as a grid of 40 cm, smooth.
fn snow() -> Vec<Triangle> {
    const STEP: f64 = 0.4;
    let vertex = |i: i32, k: i32| {
        let at = |x: f64, z: f64| Vec3::new(x, ground(x, z), z);
        let (x, z) = (STEP * f64::from(i), STEP * f64::from(k));
        let (east, south) = (
            at(x + 0.01, z) - at(x - 0.01, z),
            at(x, z + 0.01) - at(x, z - 0.01),
        );
        (at(x, z), south.cross(east).normalize())
    };
    let mut all = Vec::new();
    for i in -75..75 {
        for k in -125..12 {
            let corners = [(i, k), (i, k + 1), (i + 1, k + 1), (i + 1, k)];
            let [a, b, c, d] = corners.map(|(i, k)| vertex(i, k));
            for face in [[a, b, c], [a, c, d]] {
                all.push(Triangle::smooth(face.map(|v| v.0), face.map(|v| v.1)));
            }
        }
    }
    all
}

/// The needles of a pine: those that are green, and those with rime, which lie on top.
fn grow(pine: u64, foot: Vec3, height: f64, needles: &mut [Vec<Triangle>; 2]) {
    let whorls = (3.2 * height) as u64;
    for whorl in 0..whorls {
        // From the ground up: a share of the height, and the length of the branches there.
        let up = 0.05 + 0.93 * whorl as f64 / whorls as f64;
        let length = height * (0.03 + 0.26 * (1.0 - up));
        for branch in 0..8 {
            let key = (pine * 64 + whorl) * 16 + branch;
            let turn = TAU * (branch as f64 / 8.0 + unit(key, 1));
            let (sin, cos) = sin_cos(turn);
            let out = Vec3::new(cos, 0.0, sin);
            let root = foot + Vec3::Y * (up * height);
            let length = length * (0.75 + 0.4 * unit(key, 2));
            for needle in 0..NEEDLES {
                let (sprout, tip, side) = needle_on(key * 128 + needle, out, length);
                let top = sprout.y > tip.y || unit(key * 128 + needle, 9) < 0.3;
                let [a, b, c] = [sprout - side, sprout + side, tip].map(|p| root + p);
                needles[usize::from(top && unit(key, 8) < 0.6)].push(Triangle::flat(a, b, c));
            }
        }
    }
}

/// A needle on a branch of this length, which leaves the trunk towards `out`: the middle of its
/// foot, its tip, and half its width. The branch hangs, and its end rises again.
fn needle_on(key: u64, out: Vec3, length: f64) -> (Vec3, Vec3, Vec3) {
    let s = 1.0 - unit(key, 3) * unit(key, 4);
    let sag = |s: f64| length * (0.10 * s - 0.62 * s * s + 0.24 * s * s * s);
    let sprout = out * (length * s) + Vec3::Y * sag(s);
    let along = (out + Vec3::Y * (sag(s + 0.01) - sag(s)) / (0.01 * length)).normalize();
    let across = along.cross(Vec3::Y).normalize();
    let (sin, cos) = sin_cos(TAU * unit(key, 5));
    let round = across * cos + along.cross(across) * sin;
    let reach = 0.12 + 0.12 * (1.0 - s) + 0.05 * unit(key, 6);
    let direction = (along * 0.75 + round).normalize();
    let side = direction.cross(along).normalize() * 0.006;
    (sprout, sprout + direction * reach, side)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(stored: Stored) -> Vec<Triangle> {
        let meshes = document(stored).meshes;
        meshes.into_iter().flat_map(|mesh| mesh.triangles).collect()
    }

    /// In `f64` a needle is as thin as it was made; in `f32` it spans the distance of two numbers.
    #[test]
    fn needles_are_thin_in_double_precision_only() {
        let widest = |stored| {
            let meshes = document(stored).meshes;
            let needles = meshes.iter().filter(|mesh| mesh.name == "needles");
            let widths = needles
                .flat_map(|mesh| &mesh.triangles)
                .map(|t| t.p0.distance(t.p1));
            widths.fold(0.0, f64::max)
        };
        let [double, single] = [Stored::Double, Stored::Single].map(widest);
        assert!(double < 0.0121, "{double}");
        assert!(single >= 0.5, "{single}");
    }

    /// No vertex moves further than half the distance of two `f32` of its size.
    #[test]
    fn single_precision_moves_vertices_by_half_a_step() {
        for t in triangles(Stored::Single) {
            for p in [t.p0, t.p1, t.p2] {
                assert!(p.z % 0.5 == 0.0 && p.x % 0.03125 == 0.0, "{p}");
            }
        }
    }
}
