//! Light from a picture all around.

use crate::math;
use crate::{LightSample, Spectrum, Vec2, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A picture of everything that is infinitely far away, by longitude and latitude.
///
/// Row 0 is the top. The column at `u` of the width shows the direction at the angle `φ = 2π·u` and the row at `v` of
/// the height the one at `θ = π·v` from straight up: `(x, y, z) = (-sin θ sin φ, cos θ, sin θ cos φ)`, so the middle of
/// the picture is along -z, where a camera looks by default, and right in the picture is right of it. Between texels
/// nothing is blended: a texel is a patch of constant radiance, which makes its sampling exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    map: Arc<Map>,
}

#[derive(Debug, PartialEq)]
struct Map {
    width: usize,
    height: usize,
    radiance: Vec<Spectrum>,
    /// Weight of the rows up to and with this one.
    rows_up_to: Vec<f64>,
    /// For each row, weight of its texels up to and with this one.
    texels_up_to: Vec<f64>,
}

/// Why a picture cannot light a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentError {
    /// There are no texels, or not `width · height` of them.
    WrongSize,
    /// A texel is negative, infinite or not a number: its column and row.
    BadTexel {
        /// Column from the left.
        x: usize,
        /// Row from the top.
        y: usize,
    },
}

impl std::fmt::Display for EnvironmentError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            EnvironmentError::WrongSize => {
                write!(
                    f,
                    "the picture has no pixels, or not width x height of them"
                )
            }
            EnvironmentError::BadTexel { x, y } => write!(
                f,
                "the pixel in column {x}, row {y} is negative, infinite or not a number: radiance is 0 or more"
            ),
        }
    }
}

impl std::error::Error for EnvironmentError {}

impl Environment {
    /// The environment with these texels, row by row from the top left.
    pub fn new(
        width: usize,
        height: usize,
        radiance: Vec<Spectrum>,
    ) -> Result<Environment, EnvironmentError> {
        if width == 0 || height == 0 || width.checked_mul(height) != Some(radiance.len()) {
            return Err(EnvironmentError::WrongSize);
        }
        let bad = |s: &Spectrum| !s.is_finite() || s.r < 0.0 || s.g < 0.0 || s.b < 0.0;
        if let Some(i) = radiance.iter().position(bad) {
            return Err(EnvironmentError::BadTexel {
                x: i % width,
                y: i / width,
            });
        }
        let mut rows_up_to = Vec::with_capacity(height);
        let mut texels_up_to = Vec::with_capacity(radiance.len());
        let mut all = 0.0;
        for (y, row) in radiance.chunks(width).enumerate() {
            let mut sum = 0.0;
            for texel in row {
                sum += texel.luminance();
                texels_up_to.push(sum);
            }
            all += sum * row_solid_angle(y, height) / width as f64;
            rows_up_to.push(all);
        }
        Ok(Environment {
            map: Arc::new(Map {
                width,
                height,
                radiance,
                rows_up_to,
                texels_up_to,
            }),
        })
    }

    /// The same radiance from everywhere.
    pub fn uniform(radiance: Spectrum) -> Environment {
        Environment::new(1, 1, vec![radiance]).expect("one texel of a finite colour")
    }

    /// Radiance that arrives from the unit world direction `w`.
    pub fn radiance(&self, w: Vec3) -> Spectrum {
        let (x, y) = self.texel(w);
        self.map.radiance[y * self.map.width + x]
    }

    /// Column and row of the texel that shows the direction `w`.
    fn texel(&self, w: Vec3) -> (usize, usize) {
        let turns = math::atan2(-w.x, w.z) / TAU;
        let u = if turns < 0.0 { turns + 1.0 } else { turns };
        let v = math::acos(w.y.clamp(-1.0, 1.0)) / PI;
        // A cast of a float below 0 gives 0: NaN, too.
        let x = (u * self.map.width as f64) as usize;
        let y = (v * self.map.height as f64) as usize;
        (x.min(self.map.width - 1), y.min(self.map.height - 1))
    }

    /// Draws a direction in proportion to the luminance of the texels: a row by its light and its solid angle, a texel
    /// of that row, a place in that texel, uniform in solid angle. `None` if all is black.
    pub fn sample(&self, u: Vec2) -> Option<LightSample> {
        let map = &*self.map;
        let (y, v) = pick(&map.rows_up_to, u.y)?;
        let (x, s) = pick(self.row(y), u.x)?;
        let phi = TAU * (x as f64 + s) / map.width as f64;
        let (top, bottom) = row_cosines(y, map.height);
        let cos = top + v * (bottom - top);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (sin_phi, cos_phi) = math::sin_cos(phi);
        Some(LightSample {
            wi: Vec3::new(-sin * sin_phi, cos, sin * cos_phi),
            distance: f64::INFINITY,
            pdf: self.texel_pdf(x, y),
            radiance: map.radiance[y * map.width + x],
        })
    }

    /// The density with which [`Environment::sample`] draws the unit world direction `w`, in 1/sr.
    pub fn pdf(&self, w: Vec3) -> f64 {
        let (x, y) = self.texel(w);
        self.texel_pdf(x, y)
    }

    /// Luminance over the integral of luminance: the row's solid angle cancels.
    fn texel_pdf(&self, x: usize, y: usize) -> f64 {
        let map = &*self.map;
        let total = map.rows_up_to[map.height - 1];
        if total > 0.0 {
            map.radiance[y * map.width + x].luminance() / total
        } else {
            0.0
        }
    }

    fn row(&self, y: usize) -> &[f64] {
        &self.map.texels_up_to[y * self.map.width..(y + 1) * self.map.width]
    }
}

/// Cosines of the polar angle at the top and the bottom of row `y`.
fn row_cosines(y: usize, height: usize) -> (f64, f64) {
    let cos = |y: usize| math::cos(PI * y as f64 / height as f64);
    (cos(y), cos(y + 1))
}

/// Solid angle of row `y` in steradians.
fn row_solid_angle(y: usize, height: usize) -> f64 {
    let (top, bottom) = row_cosines(y, height);
    TAU * (top - bottom)
}

/// Which of the entries with these running sums `u` falls into, and how far into it, in [0, 1). `None` if all are 0.
fn pick(up_to: &[f64], u: f64) -> Option<(usize, f64)> {
    let total = *up_to.last()?;
    if total <= 0.0 {
        return None;
    }
    let target = u * total;
    let i = up_to
        .partition_point(|&sum| sum <= target)
        .min(up_to.len() - 1);
    let before = if i == 0 { 0.0 } else { up_to[i - 1] };
    let within = (target - before) / (up_to[i] - before);
    // The division may round up to 1, which is the next entry's.
    Some((i, within.min(1.0 - f64::EPSILON)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered() -> Environment {
        let texels = (0..8).map(|i| Spectrum::grey(f64::from(i))).collect();
        Environment::new(4, 2, texels).unwrap()
    }

    /// The middle of the picture is along -z; right of it is +x.
    #[test]
    fn texels_are_where_the_doc_says() {
        let map = numbered();
        let d = |x: f64, y: f64, z: f64| Vec3::new(x, y, z).normalize();
        assert_eq!(map.radiance(d(-0.1, 0.1, -1.0)).g, 1.0);
        assert_eq!(map.radiance(d(0.1, 0.1, -1.0)).g, 2.0);
        assert_eq!(map.radiance(d(-0.1, 0.1, 1.0)).g, 0.0);
        assert_eq!(map.radiance(d(0.1, -0.1, 1.0)).g, 7.0);
    }

    #[test]
    fn every_sample_falls_into_the_texel_it_was_drawn_from() {
        let map = numbered();
        for i in 0..64 {
            for j in 0..64 {
                let u = Vec2::new(f64::from(i), f64::from(j)) / 64.0 + 1.0 / 128.0;
                let s = map.sample(u).unwrap();
                assert_eq!(s.radiance, map.radiance(s.wi));
                assert_eq!(s.pdf, map.pdf(s.wi));
                assert!(s.pdf > 0.0);
            }
        }
        let last = map.sample(Vec2::splat(1.0 - f64::EPSILON / 2.0)).unwrap();
        assert_eq!(last.radiance.g, 7.0);
    }

    #[test]
    fn a_black_picture_is_never_sampled() {
        let black = Environment::uniform(Spectrum::BLACK);
        assert_eq!(black.sample(Vec2::splat(0.5)), None);
        assert_eq!(black.pdf(Vec3::Y), 0.0);
    }

    #[test]
    fn bad_pictures_are_refused() {
        assert_eq!(
            Environment::new(2, 2, vec![Spectrum::WHITE; 3]),
            Err(EnvironmentError::WrongSize)
        );
        assert_eq!(
            Environment::new(0, 0, vec![]),
            Err(EnvironmentError::WrongSize)
        );
        let mut texels = vec![Spectrum::WHITE; 6];
        texels[4].g = f64::NAN;
        assert_eq!(
            Environment::new(3, 2, texels),
            Err(EnvironmentError::BadTexel { x: 1, y: 1 })
        );
    }
}
