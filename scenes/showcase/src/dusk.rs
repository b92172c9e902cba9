//! A wider view of `scenes/dae/dusk.dae`: a terrace above a lake, and mountains behind it.

use crate::collada::{Mesh, Paint, effect, material, node};
use crate::shapes::{random, square};
use kit::{Triangle, Vec3};
use std::io::{self, Write};

/// The scene file that is extended: its plane becomes a terrace.
const FOREGROUND: &str = include_str!("../../dae/dusk.dae");

/// Where the unit square of the ground becomes the terrace.
const TERRACE: &str = "<translate>0 0 2.2</translate><scale>14 1 8.4</scale>";
/// How far the lake is below it.
const DEPTH: f64 = 0.5;

/// A row of mountains: its distance, its mean and largest height as slopes seen from the terrace,
/// its reflectance. The further, the brighter, as haze would make it.
struct Range {
    distance: f64,
    slopes: [f64; 2],
    color: [f64; 3],
    seed: u64,
}

const RANGES: [Range; 3] = [
    Range {
        distance: 420.0,
        slopes: [0.030, 0.052],
        color: [0.86, 0.70, 0.78],
        seed: 11,
    },
    Range {
        distance: 250.0,
        slopes: [0.012, 0.036],
        color: [0.46, 0.40, 0.52],
        seed: 5,
    },
    Range {
        distance: 150.0,
        slopes: [0.001, 0.020],
        color: [0.13, 0.12, 0.18],
        seed: 23,
    },
];

/// Writes the scene. Fails if the foreground has no longer the parts that are replaced.
pub fn write(out: &mut impl Write) -> io::Result<()> {
    let mut meshes = vec![Mesh {
        name: "lake".to_owned(),
        paint: Paint::Mirror([0.60, 0.64, 0.72]),
        triangles: square(4000.0, -DEPTH),
    }];
    meshes.extend(RANGES.iter().enumerate().map(|(i, range)| Mesh {
        name: format!("range-{i}"),
        paint: Paint::Matte(range.color),
        triangles: range.triangles(),
    }));
    let each = |text: fn(&Mesh) -> String| meshes.iter().map(text).collect::<String>();
    let mut geometries = Vec::new();
    for mesh in &meshes {
        mesh.write(&mut geometries)?;
    }
    let geometries = String::from_utf8_lossy(&geometries);
    let mut text = FOREGROUND.to_owned();
    for (end, with) in [
        ("<scale>4000 4000 4000</scale>", TERRACE.to_owned()),
        (
            "</library_effects>",
            each(|mesh| effect(&mesh.name, mesh.paint)),
        ),
        ("</library_materials>", each(|mesh| material(&mesh.name))),
        ("</library_geometries>", geometries.into_owned()),
        ("</visual_scene>", each(|mesh| node(&mesh.name))),
    ] {
        let at = text.find(end).ok_or_else(|| {
            io::Error::other(format!("scenes/dae/dusk.dae has no {end} to replace"))
        })?;
        let is_end = end.starts_with("</");
        text.replace_range(at..at + if is_end { 0 } else { end.len() }, &with);
    }
    out.write_all(text.as_bytes())
}

impl Range {
    /// A curtain from below the lake to the ridge.
    fn triangles(&self) -> Vec<Triangle> {
        const STEPS: u32 = 600;
        let z = -self.distance;
        let corner = |i: u32| {
            let u = f64::from(i) / f64::from(STEPS);
            let [mean, most] = self.slopes;
            let ridge = mean + (most - mean) * self.ridge(u);
            Vec3::new(
                (2.0 * u - 1.0) * 1.2 * self.distance,
                ridge * self.distance,
                z,
            )
        };
        let foot = |p: Vec3| Vec3::new(p.x, -DEPTH - 1.0, z);
        let strips = (0..STEPS).flat_map(|i| {
            let (a, b) = (corner(i), corner(i + 1));
            [
                Triangle::flat(foot(a), foot(b), b),
                Triangle::flat(foot(a), b, a),
            ]
        });
        strips.collect()
    }

    /// The shape of the ridge in [0, 1] at `u` in [0, 1]: folded noise, each octave half as high.
    fn ridge(&self, u: f64) -> f64 {
        let octave = |i: u32| {
            let folded = 1.0
                - (2.0 * noise(self.seed + u64::from(i), u * 9.0 * 2.0_f64.powi(i as i32)) - 1.0)
                    .abs();
            folded * 0.5_f64.powi(i as i32 + 1)
        };
        (0..6).map(octave).sum()
    }
}

/// Smooth noise in [0, 1] along a line.
fn noise(seed: u64, x: f64) -> f64 {
    let at = |i: f64| random(seed << 32 ^ i as u64);
    let (i, f) = (x.floor(), x - x.floor());
    let smooth = f * f * (3.0 - 2.0 * f);
    at(i) + smooth * (at(i + 1.0) - at(i))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::read_again;

    #[test]
    fn the_scene_has_the_foreground_and_the_mountains() {
        let wide = read_again(write);
        assert_eq!(wide.scene.spheres.len(), 6);
        assert_eq!(wide.scene.triangles.len(), 60 + 2 + 3 * 2 * 600);
        // Nothing of the lake is above the terrace.
        let top = wide.scene.triangles[..60].iter().map(|t| t.p0.y);
        assert!(top.fold(f64::INFINITY, f64::min) > -DEPTH);
    }
}
