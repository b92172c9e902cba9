//! The picture of Part 4, task 1.

use super::{Panel, panel};
use crate::stages::Global;
use kit::{BsdfSample, Frame, Spectrum, Vec3};

/// Index of refraction of the glass.
const GLASS: f64 = 1.5;

/// Paths per pixel: each takes other numbers `choice`.
const PATHS: u32 = 16;

/// The largest number of boundaries of a path.
const BOUNDARIES: u32 = 6;

/// Distance of the rays' origins from the plane of the balls.
const BEHIND: f64 = 6.0;

/// Height of the floor below the centres of the balls, whose radius is 1.
const FLOOR: f64 = -1.0;

/// A mirror ball and a glass ball; then bands of the Fresnel reflectance and of refracted
/// directions over the cosine.
pub(super) fn specular(stage: &Global, size: [u32; 2]) -> Vec<Panel> {
    vec![balls(stage, size), bands(stage, size)]
}

/// The balls, in a parallel projection that looks down a little.
fn balls(stage: &Global, size: [u32; 2]) -> Panel {
    let forward = Vec3::new(0.0, -0.28, -0.96);
    let up = Vec3::new(0.0, 0.96, -0.28);
    let [w, h] = size.map(f64::from);
    let scale = 4.4 / w;
    panel(size, |x, y| {
        let right = (f64::from(x) + 0.5 - 0.5 * w) * scale;
        let rise = (f64::from(y) + 0.5 - 0.5 * h) * scale;
        for (centre, is_glass) in [(-1.07, false), (1.07, true)] {
            let a = right - centre;
            let height2 = 1.0 - a * a - rise * rise;
            if height2 > 0.0 {
                // The point of the unit ball that this pixel sees.
                let n = a * Vec3::X + rise * up - height2.sqrt() * forward;
                let centre = centre * Vec3::X;
                return match is_glass {
                    true => through_glass(stage, centre, n, forward),
                    false => mirrored(stage, centre, n, forward),
                }
                .to_array();
            }
        }
        surroundings(right * Vec3::X + rise * up - BEHIND * forward, forward).to_array()
    })
}

/// What is seen in the mirror at the point `n` of the unit ball.
fn mirrored(stage: &Global, centre: Vec3, n: Vec3, d: Vec3) -> Spectrum {
    let frame = Frame::around(n);
    let tint = Spectrum::new(0.9, 0.85, 0.75);
    match (stage.mirror_sample)(tint, frame.to_local(-d)) {
        Some(sample) => sample.weight() * surroundings(centre + n, frame.to_world(sample.wi)),
        None => Spectrum::BLACK,
    }
}

/// What is seen through the glass at the point `n` of the unit ball: the mean of some paths.
fn through_glass(stage: &Global, centre: Vec3, n: Vec3, d: Vec3) -> Spectrum {
    let paths = (0..PATHS).map(|path| {
        let (mut n, mut d) = (n, d);
        let mut throughput = Spectrum::WHITE;
        for boundary in 0..BOUNDARIES {
            let frame = Frame::around(n);
            // Regular at the first boundary, and unrelated to it at the others.
            let turn = f64::from(path) * 0.618_034 * f64::from(boundary);
            let choice = ((f64::from(path) + 0.5) / f64::from(PATHS) + turn).fract();
            let Some(sample) = glass(stage, frame.to_local(-d), choice) else {
                return Spectrum::BLACK;
            };
            throughput *= sample.weight();
            d = frame.to_world(sample.wi);
            if d.dot(n) > 0.0 {
                return throughput * surroundings(centre + n, d);
            }
            // The other end of the chord from the point `n` of the unit ball along `d`.
            n = (n - 2.0 * n.dot(d) * d).normalize();
        }
        Spectrum::BLACK
    });
    paths.sum::<Spectrum>() / f64::from(PATHS)
}

fn glass(stage: &Global, wo: Vec3, choice: f64) -> Option<BsdfSample> {
    (stage.glass_sample)(Spectrum::WHITE, Spectrum::WHITE, GLASS, wo, choice)
}

/// The radiance from `p` along `d`: a chequered floor, or a sky with a red wall of light on the
/// left and a blue one on the right.
fn surroundings(p: Vec3, d: Vec3) -> Spectrum {
    if !d.is_finite() {
        return Spectrum::grey(f64::NAN);
    }
    let to_floor = (FLOOR - p.y) / d.y;
    if d.y < 0.0 && to_floor > 0.0 && to_floor < 22.0 {
        let place = p + to_floor * d;
        let is_dark = (place.x.floor() + place.z.floor()).rem_euclid(2.0) < 1.0;
        let shade = if is_dark { 0.06 } else { 0.45 };
        return Spectrum::grey(shade) * (1.0 - to_floor / 30.0);
    }
    let sky = 0.5 + 0.5 * d.y;
    if d.x.abs() > 0.75 && d.y.abs() < 0.35 {
        return match d.x < 0.0 {
            true => Spectrum::new(0.7, 0.12, 0.08),
            false => Spectrum::new(0.08, 0.2, 0.7),
        };
    }
    Spectrum::new(0.25, 0.4, 0.6) * sky + Spectrum::new(0.25, 0.2, 0.12) * (1.0 - sky)
}

/// From the top: `fresnel_dielectric` for four ratios `eta`, the direction of `refract` for two
/// `ior`; the cosine of the angle to the normal falls from 1 (left) to 0 (right).
fn bands(stage: &Global, size: [u32; 2]) -> Panel {
    const ETAS: [f64; 4] = [1.0 / GLASS, GLASS, 1.0, 2.4];
    const IORS: [f64; 2] = [GLASS, 1.0 / GLASS];
    let height = size[1] / 6;
    panel(size, |x, y| {
        let cos = 1.0 - (f64::from(x) + 0.5) / f64::from(size[0]);
        let band = ((size[1] - 1 - y) / height) as usize;
        if (size[1] - 1 - y) % height < 3 {
            return [0.0; 3];
        }
        match ETAS.get(band) {
            Some(&eta) => [0.05 + 0.6 * (stage.fresnel_dielectric)(cos, eta); 3],
            None => {
                let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
                let ior = IORS[(band - ETAS.len()).min(1)];
                match (stage.refract)(wo, ior) {
                    Some(wi) => (0.35 * wi + 0.35).to_array(),
                    None => [0.0; 3],
                }
            }
        }
    })
}
