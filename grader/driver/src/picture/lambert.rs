//! The picture of Part 3, task 1.

use super::{Panel, panel};
use crate::stages::Direct;
use kit::{Frame, Spectrum, Vec2, Vec3};
use std::f64::consts::PI;

const REFLECTANCE: Spectrum = Spectrum::new(0.9, 0.6, 0.35);

/// The background, which differs from black surfaces.
const BACKGROUND: [f64; 3] = [0.02, 0.02, 0.05];

/// Directions to two suns and their irradiance. The second is behind the ball.
const SUNS: [(Vec3, Spectrum); 2] = [
    (Vec3::new(0.48, 0.64, 0.6), Spectrum::grey(0.55)),
    (Vec3::new(-0.64, 0.48, -0.6), Spectrum::new(0.2, 0.35, 0.8)),
];

/// The directions of the second panel: a regular grid of this many numbers `u` on each side.
const GRID: u32 = 40;

/// A ball (left) and the inside of a bowl (right) under two suns; then `lambert_pdf` over the
/// directions of the upper hemisphere (left) and the directions of `lambert_sample` (right).
pub(super) fn lambert(stage: &Direct, size: [u32; 2]) -> Vec<Panel> {
    let discs = Discs::of(size);
    let lit = panel(size, |x, y| {
        let Some((side, [a, b, height])) = discs.at(x, y) else {
            return BACKGROUND;
        };
        // The ball's normals point to the viewer, those of the bowl's outside away from them.
        let towards_viewer = if side == 0 { height } else { -height };
        lit(stage, Vec3::new(a, b, towards_viewer)).to_array()
    });
    let density = panel(size, |x, y| match discs.at(x, y) {
        Some((0, wi)) => [(stage.lambert_pdf)(Vec3::Z, wi.into()) * PI * 0.7; 3],
        Some((1, _)) => [0.04; 3],
        _ => BACKGROUND,
    });
    vec![lit, with_samples(stage, density, &discs)]
}

/// The radiance towards +z of a point with the normal `n`.
fn lit(stage: &Direct, n: Vec3) -> Spectrum {
    let frame = Frame::around(n);
    let wo = frame.to_local(Vec3::Z);
    let of_sun = |&(d, irradiance): &(Vec3, Spectrum)| {
        let wi = frame.to_local(d);
        (stage.lambert_f)(REFLECTANCE, wo, wi) * irradiance * (PI * wi.z.abs())
    };
    SUNS.iter().map(of_sun).sum()
}

/// Adds a dot for each sampled direction, in the colour of its weight `f · cos θ / pdf`.
fn with_samples(stage: &Direct, mut panel: Panel, discs: &Discs) -> Panel {
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
    for i in 0..GRID {
        for j in 0..GRID {
            let u = Vec2::new(share(i), share(j));
            let Some(sample) = (stage.lambert_sample)(REFLECTANCE, Vec3::Z, u) else {
                continue;
            };
            let colour = (sample.weight() * 0.7).to_array().map(|c| c as f32);
            for pixel in discs.dot(1, sample.wi) {
                panel[pixel] = colour;
            }
        }
    }
    panel
}

/// The left and the right unit disc of a panel.
struct Discs {
    size: [u32; 2],
    radius: f64,
}

impl Discs {
    fn of(size: [u32; 2]) -> Discs {
        let [w, h] = size.map(f64::from);
        Discs {
            size,
            radius: 0.47 * (0.5 * w).min(h),
        }
    }

    fn centre(&self, side: usize) -> [f64; 2] {
        let [w, h] = self.size.map(f64::from);
        [w * (0.25 + 0.5 * side as f64), 0.5 * h]
    }

    /// The disc that a pixel is in, and the direction of the upper hemisphere above it.
    fn at(&self, x: u32, y: u32) -> Option<(usize, [f64; 3])> {
        let side = usize::from(2 * x >= self.size[0]);
        let [cx, cy] = self.centre(side);
        let a = (f64::from(x) + 0.5 - cx) / self.radius;
        let b = (f64::from(y) + 0.5 - cy) / self.radius;
        let height2 = 1.0 - a * a - b * b;
        (height2 > 0.0).then(|| (side, [a, b, height2.sqrt()]))
    }

    /// The four pixels at the place of a direction.
    fn dot(&self, side: usize, d: Vec3) -> impl Iterator<Item = usize> {
        let [cx, cy] = self.centre(side);
        let [w, h] = self.size.map(i64::from);
        let (x, y) = (cx + d.x * self.radius, cy + d.y * self.radius);
        // A NaN is at 0, 0.
        let (x, y) = ((x - 0.5).floor() as i64, (y - 0.5).floor() as i64);
        let pixels = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].into_iter();
        let inside = pixels.filter(move |(x, y)| (0..w).contains(x) && (0..h).contains(y));
        inside.map(move |(x, y)| (y * w + x) as usize)
    }
}
