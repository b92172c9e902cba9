//! A street of steps in the sun: walls, a door, pots, a chair, a vine over the steps.

use crate::collada::{Document, Mesh, Paint, Sun};
use crate::shapes::{block, lathe, unit};
use kit::math::sin_cos;
use kit::sampler::mix;
use kit::{Triangle, Vec3};
use std::f64::consts::TAU;

/// Lengths are metres: a step is 16 cm high, the door 2 m, the seat of the chair 46 cm.
const RISE: f64 = 0.16;
/// The depth of a step.
const RUN: f64 = 0.34;
/// The number of steps.
const STEPS: u32 = 15;
/// Leaves and blossoms of the vine.
const LEAVES: u64 = 9000;

/// The scene.
pub fn document() -> Document {
    let mesh = |name: &str, color, triangles| Mesh {
        name: name.to_owned(),
        paint: Paint::Matte(color),
        triangles,
    };
    Document {
        yfov: 32.0,
        aspect: 2.0,
        camera: [Vec3::new(0.15, 1.5, 6.3), Vec3::new(-0.1, 1.52, -1.0)],
        ambient: Some([0.42, 0.58, 0.85]),
        sun: Some(Sun {
            irradiance: [5.4, 4.7, 3.7],
            direction: Vec3::new(0.52, 0.75, 0.34),
        }),
        lights: Vec::new(),
        meshes: vec![
            mesh("walls", [0.82, 0.79, 0.74], walls()),
            mesh("stone", [0.52, 0.48, 0.43], steps()),
            mesh("wood", [0.10, 0.24, 0.36], [door(), shutters()].concat()),
            mesh("clay", [0.62, 0.29, 0.17], pots()),
            mesh(
                "chair",
                [0.44, 0.26, 0.12],
                chair(Vec3::new(1.02, 0.0, 0.25)),
            ),
            mesh(
                "iron",
                [0.05, 0.05, 0.055],
                lantern(Vec3::new(-1.28, 2.75, 0.35)),
            ),
            mesh("leaves", [0.10, 0.24, 0.05], leaves(0..LEAVES, 0.055)),
            mesh(
                "blossoms",
                [0.72, 0.07, 0.26],
                leaves(LEAVES..LEAVES * 8 / 5, 0.045),
            ),
        ],
    }
}

/// The ground, the flight of steps, and a landing above it.
fn steps() -> Vec<Triangle> {
    let mut all = block(Vec3::new(-6.0, -0.2, -0.6), Vec3::new(6.0, 0.0, 30.0));
    for i in 0..STEPS {
        let front = -0.6 - RUN * f64::from(i);
        let top = RISE * f64::from(i + 1);
        // Worn stones: each step is a few of them, none exactly as high as the next.
        let mut left = -1.5;
        let mut stone = 0;
        while left < 1.5 {
            let random = unit(u64::from(i * 16 + stone), 1);
            let right = (left + 0.45 + 0.4 * random).min(1.5);
            let (wear, gap) = (0.012 * unit(u64::from(i * 16 + stone), 2), 0.006);
            all.extend(block(
                Vec3::new(left + gap, top - RISE - 0.2, front - RUN - 0.3),
                Vec3::new(right - gap, top - wear, front + 0.02 * random),
            ));
            (left, stone) = (right, stone + 1);
        }
    }
    let (top, back) = (RISE * f64::from(STEPS), -0.6 - RUN * f64::from(STEPS));
    all.extend(block(
        Vec3::new(-6.0, -0.5, -30.0),
        Vec3::new(6.0, top - 0.004, back),
    ));
    all
}

/// Walls on both sides, with a doorway on the left, a window on the right and an arch over the
/// steps.
fn walls() -> Vec<Triangle> {
    let mut all = Vec::new();
    let mut wall = |min: [f64; 3], max: [f64; 3]| all.extend(block(min.into(), max.into()));
    // Left: around a doorway from z = 0.75 to 1.75.
    wall([-4.0, -0.2, -9.0], [-1.5, 4.6, 0.75]);
    wall([-4.0, -0.2, 1.75], [-1.5, 4.6, 9.0]);
    wall([-4.0, 2.1, 0.7], [-1.5, 4.6, 1.8]);
    wall([-4.0, -0.2, 0.7], [-2.6, 4.6, 1.8]);
    // Right: around a window from z = -0.6 to 0.3.
    wall([1.5, -0.2, -9.0], [4.0, 5.4, -0.6]);
    wall([1.5, -0.2, 0.3], [4.0, 5.4, 9.0]);
    wall([1.5, -0.2, -0.7], [4.0, 1.5, 0.4]);
    wall([1.5, 2.7, -0.7], [4.0, 5.4, 0.4]);
    wall([2.2, 1.4, -0.7], [4.0, 2.8, 0.4]);
    // A house at the end of the steps, with a dark doorway.
    let floor = RISE * f64::from(STEPS);
    wall([-4.0, 0.0, -11.0], [-0.5, 8.0, -9.0]);
    wall([0.5, 0.0, -11.0], [4.0, 8.0, -9.0]);
    wall([-0.6, floor + 2.1, -11.0], [0.6, 8.0, -9.0]);
    wall([-0.6, 0.0, -11.5], [0.6, 8.0, -10.8]);
    all.extend(arch(-2.4, 0.8, 3.55));
    all
}

/// An arch from wall to wall: a half ring over the steps and the wall above it.
fn arch(front: f64, depth: f64, spring: f64) -> Vec<Triangle> {
    const SEGMENTS: u32 = 48;
    let (radius, top) = (1.5, spring + 2.1);
    let at = |i: u32| {
        let (sin, cos) = sin_cos(0.5 * TAU * f64::from(i) / f64::from(SEGMENTS));
        [radius * cos, spring + 0.75 * radius * sin]
    };
    let mut all = Vec::new();
    for i in 0..SEGMENTS {
        let ([x0, y0], [x1, y1]) = (at(i), at(i + 1));
        let z = [front, front - depth];
        let p = |x, y, side: usize| Vec3::new(x, y, z[side]);
        // The soffit, and both faces up to the top.
        all.extend(quad(p(x0, y0, 0), p(x0, y0, 1), p(x1, y1, 1), p(x1, y1, 0)));
        all.extend(quad(
            p(x0, y0, 0),
            p(x0, top, 0),
            p(x1, top, 0),
            p(x1, y1, 0),
        ));
        all.extend(quad(
            p(x0, y0, 1),
            p(x1, y1, 1),
            p(x1, top, 1),
            p(x0, top, 1),
        ));
    }
    all.extend(block(
        Vec3::new(-1.6, top - 0.01, front - depth),
        Vec3::new(1.6, top + 0.1, front),
    ));
    all
}

fn quad(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> [Triangle; 2] {
    [Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
}

/// A door of planks in the doorway on the left.
fn door() -> Vec<Triangle> {
    let plank = |i: u32| {
        let z = 0.76 + 0.14 * f64::from(i);
        block(
            Vec3::new(-1.80, 0.02, z),
            Vec3::new(-1.74 + 0.008 * unit(u64::from(i), 3), 2.08, z + 0.13),
        )
    };
    let mut all: Vec<Triangle> = (0..7).flat_map(plank).collect();
    for y in [0.35, 1.05, 1.75] {
        all.extend(block(
            Vec3::new(-1.75, y, 0.78),
            Vec3::new(-1.71, y + 0.1, 1.72),
        ));
    }
    all
}

/// Open shutters beside the window on the right, of slats.
fn shutters() -> Vec<Triangle> {
    let mut all = Vec::new();
    for z in [-1.12, 0.34] {
        for (a, b) in [(z, z + 0.05), (z + 0.41, z + 0.46)] {
            all.extend(block(Vec3::new(1.44, 1.46, a), Vec3::new(1.49, 2.74, b)));
        }
        for i in 0..22 {
            let y = 1.48 + 0.057 * f64::from(i);
            all.extend(block(
                Vec3::new(1.45, y, z + 0.05),
                Vec3::new(1.485, y + 0.03, z + 0.41),
            ));
        }
    }
    all
}

/// Pots on the steps and on the ground.
fn pots() -> Vec<Triangle> {
    let pot = |x: f64, z: f64, step: f64, scale: f64| {
        let profile = [
            [0.0, 0.0],
            [0.13, 0.0],
            [0.17, 0.10],
            [0.20, 0.26],
            [0.20, 0.30],
            [0.225, 0.30],
            [0.225, 0.36],
            [0.19, 0.36],
            [0.175, 0.31],
            [0.0, 0.31],
        ];
        let scaled = profile.map(|[r, y]| [r * scale, y * scale]);
        lathe(Vec3::new(x, RISE * step, z), &scaled)
    };
    let spots = [
        (-1.2, 2.15, 0.0, 1.2),
        (-1.25, -0.8, 1.0, 0.9),
        (1.22, -1.14, 2.0, 1.0),
        (-1.22, -1.82, 4.0, 0.8),
        (1.25, -2.16, 5.0, 0.9),
        (1.2, 1.25, 0.0, 1.2),
    ];
    spots
        .into_iter()
        .flat_map(|(x, z, step, scale)| pot(x, z, step, scale))
        .collect()
}

/// A chair whose seat is 46 cm above the ground at `at`, with its back to the right wall.
fn chair(at: Vec3) -> Vec<Triangle> {
    let mut all = Vec::new();
    let mut bar = |min: [f64; 3], max: [f64; 3]| {
        all.extend(block(at + Vec3::from(min), at + Vec3::from(max)));
    };
    for z in [0.0, 0.38] {
        bar([0.0, 0.0, z], [0.035, 0.45, z + 0.035]);
        bar([0.38, 0.0, z], [0.415, 0.95, z + 0.035]);
        bar([0.035, 0.18, z + 0.008], [0.38, 0.2, z + 0.028]);
    }
    for i in 0..8 {
        let x = 0.004 + 0.047 * f64::from(i);
        bar([x, 0.445, -0.005], [x + 0.038, 0.465, 0.42]);
    }
    for y in [0.58, 0.7, 0.82] {
        bar([0.385, y, 0.03], [0.405, y + 0.06, 0.39]);
    }
    all
}

/// A lantern on an arm at the left wall.
fn lantern(at: Vec3) -> Vec<Triangle> {
    let mut all = block(
        at + Vec3::new(-0.3, 0.30, -0.012),
        at + Vec3::new(0.02, 0.325, 0.012),
    );
    all.extend(lathe(
        at + Vec3::new(0.0, 0.2, 0.0),
        &[[0.12, 0.0], [0.02, 0.09], [0.0, 0.10]],
    ));
    all.extend(lathe(at, &[[0.0, -0.03], [0.07, 0.0], [0.0, 0.0]]));
    for i in 0..4 {
        let (sin, cos) = sin_cos(TAU * (f64::from(i) + 0.5) / 4.0);
        let (low, high) = (
            Vec3::new(0.065 * cos, 0.0, 0.065 * sin),
            Vec3::new(0.105 * cos, 0.2, 0.105 * sin),
        );
        let side = Vec3::new(-sin, 0.0, cos) * 0.006;
        all.extend(quad(
            at + low - side,
            at + low + side,
            at + high + side,
            at + high - side,
        ));
    }
    all
}

/// Leaves of a vine that hangs from the right wall over the arch and the steps.
fn leaves(which: std::ops::Range<u64>, size: f64) -> Vec<Triangle> {
    let leaf = |i: u64| {
        // Strands hang from a line along the top of the right wall; leaves are denser near it.
        let strand = mix(i) % 46;
        let s = unit(strand, 4);
        let length = 0.5 + 1.9 * unit(strand, 5) * unit(strand, 6);
        let down = unit(i, 7);
        let spread = 0.10 + 0.16 * (1.0 - down);
        let scatter = |salt| (unit(i, salt) - 0.5) * 2.0 * spread;
        let center = Vec3::new(
            1.30 + scatter(8) - 0.25 * unit(strand, 9),
            4.1 - length * down + 0.7 * spread * (unit(i, 10) - 0.5),
            -2.4 + 4.1 * s + scatter(11),
        );
        let direction = |salt| Vec3::new(unit(i, salt), unit(i, salt + 1), unit(i, salt + 2)) - 0.5;
        let along = direction(12).normalize_or(Vec3::X);
        let across = along.cross(direction(15)).normalize_or(Vec3::Y);
        let (a, b) = (along * size, across * (0.42 * size));
        quad(center - a, center - b, center + a, center + b)
    };
    which.flat_map(leaf).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collada::read_again;

    #[test]
    fn the_street_can_be_read_again() {
        let document = document();
        let loaded = read_again(|file| document.write(file));
        let count: usize = document.meshes.iter().map(|m| m.triangles.len()).sum();
        assert_eq!(loaded.scene.triangles.len(), count);
        assert_eq!(loaded.scene.lights.len(), 2);
    }

    /// A person fits through the door and on the chair.
    #[test]
    fn things_have_the_size_of_people() {
        let bounds = |triangles: Vec<Triangle>| {
            let all = triangles.iter().flat_map(|t| [t.p0, t.p1, t.p2]);
            all.fold((Vec3::INFINITY, -Vec3::INFINITY), |(min, max), p| {
                (min.min(p), max.max(p))
            })
        };
        let (low, high) = bounds(door());
        assert!((2.0..2.2).contains(&(high.y - low.y)));
        let (low, high) = bounds(chair(Vec3::ZERO));
        assert!((0.9..1.0).contains(&(high.y - low.y)));
    }
}
