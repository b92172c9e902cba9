//! Environment maps: light from an image at infinite distance.

use crate::math;
use crate::{LightSample, Spectrum, Vec2, Vec3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// An environment map: radiance from infinite distance as a latitude-longitude image.
///
/// Row 0 is the top. The point `(u, v)` of the image, in fractions of width and height from the top
/// left, shows the direction with the azimuth `φ = 2π·u` and the polar angle `θ = π·v` from +y:
/// `(x, y, z) = (-sin θ sin φ, cos θ, sin θ cos φ)`. So the centre of the image shows -z, where a
/// camera looks by default, and +x is to the right of it. Texels are not interpolated: each has
/// constant radiance, so that the samples follow the radiance exactly.
///
/// ```
/// use kit::{Environment, Spectrum, Vec3};
/// let [sky, ground] = [Spectrum::grey(2.0), Spectrum::grey(0.5)];
/// let map = Environment::new(1, 2, vec![sky, ground])?;
/// assert_eq!(map.radiance(Vec3::new(0.6, 0.8, 0.0)), sky);
/// assert_eq!(map.radiance(-Vec3::Y), ground);
/// # Ok::<(), kit::environment::EnvironmentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    map: Arc<Map>,
}

#[derive(Debug, PartialEq)]
struct Map {
    width: usize,
    height: usize,
    radiance: Vec<Spectrum>,
    /// For each row, the total weight of all rows up to and including it.
    cumulative_rows: Vec<f64>,
    /// For each row, the total luminance of its texels up to and including this one.
    cumulative_texels: Vec<f64>,
}

/// Why an image cannot be used as an environment map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvironmentError {
    /// There are no texels, or not `width · height` of them.
    WrongSize,
    /// A texel is negative, infinite or NaN.
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
                    "the environment map has no pixels, or not width x height of them"
                )
            }
            EnvironmentError::BadTexel { x, y } => write!(
                f,
                "the pixel in column {x}, row {y} is negative, infinite or not a number: expected a radiance of 0 or more"
            ),
        }
    }
}

impl std::error::Error for EnvironmentError {}

impl Environment {
    /// The environment map with the given texels, row by row from the top left.
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
        let mut cumulative_rows = Vec::with_capacity(height);
        let mut cumulative_texels = Vec::with_capacity(radiance.len());
        let mut total = 0.0;
        for (y, row) in radiance.chunks(width).enumerate() {
            let mut sum = 0.0;
            for texel in row {
                sum += texel.luminance();
                cumulative_texels.push(sum);
            }
            total += sum * row_solid_angle(y, height) / width as f64;
            cumulative_rows.push(total);
        }
        Ok(Environment {
            map: Arc::new(Map {
                width,
                height,
                radiance,
                cumulative_rows,
                cumulative_texels,
            }),
        })
    }

    /// An environment map with the same radiance from every direction.
    pub fn uniform(radiance: Spectrum) -> Environment {
        Environment::new(1, 1, vec![radiance])
            .expect("one texel is enough, and the radiance is finite and not negative")
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
        // A cast clamps: values below 0 and NaN become 0.
        let x = (u * self.map.width as f64) as usize;
        let y = (v * self.map.height as f64) as usize;
        (x.min(self.map.width - 1), y.min(self.map.height - 1))
    }

    /// Samples a direction with a density in proportion to the luminance: first a row by its total
    /// luminance and solid angle, then a texel of the row, then a point of the texel, uniform in
    /// solid angle. `None` if all texels are black.
    pub fn sample(&self, u: Vec2) -> Option<LightSample> {
        let map = &*self.map;
        let (y, v) = sample_discrete(&map.cumulative_rows, u.y)?;
        let (x, s) = sample_discrete(self.cumulative_row(y), u.x)?;
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

    /// The density with which [`Environment::sample`] samples the unit world direction `w`, in
    /// 1/sr.
    pub fn pdf(&self, w: Vec3) -> f64 {
        let (x, y) = self.texel(w);
        self.texel_pdf(x, y)
    }

    /// The luminance of the texel divided by the integral of luminance. The solid angle of the row
    /// cancels.
    fn texel_pdf(&self, x: usize, y: usize) -> f64 {
        let map = &*self.map;
        let total = map.cumulative_rows[map.height - 1];
        if total > 0.0 {
            map.radiance[y * map.width + x].luminance() / total
        } else {
            0.0
        }
    }

    fn cumulative_row(&self, y: usize) -> &[f64] {
        &self.map.cumulative_texels[y * self.map.width..(y + 1) * self.map.width]
    }
}

/// Cosines of the polar angle at the top and the bottom edge of row `y`.
fn row_cosines(y: usize, height: usize) -> (f64, f64) {
    let cos = |y: usize| math::cos(PI * y as f64 / height as f64);
    (cos(y), cos(y + 1))
}

/// Solid angle of row `y` in steradians.
fn row_solid_angle(y: usize, height: usize) -> f64 {
    let (top, bottom) = row_cosines(y, height);
    TAU * (top - bottom)
}

/// Samples an entry in proportion to its weight, given the running sums of the weights.
///
/// Returns the index and `u` rescaled to [0, 1) within the entry. `None` if all weights are 0.
fn sample_discrete(cumulative: &[f64], u: f64) -> Option<(usize, f64)> {
    let total = *cumulative.last()?;
    if total <= 0.0 {
        return None;
    }
    let target = u * total;
    let i = cumulative
        .partition_point(|&sum| sum <= target)
        .min(cumulative.len() - 1);
    let before = if i == 0 { 0.0 } else { cumulative[i - 1] };
    let within = (target - before) / (cumulative[i] - before);
    // The division may round up to 1, which belongs to the next entry.
    Some((i, within.min(1.0 - f64::EPSILON)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered_texels() -> Environment {
        let texels = (0..8).map(|i| Spectrum::grey(f64::from(i))).collect();
        Environment::new(4, 2, texels).unwrap()
    }

    /// The centre of the image is -z; +x is to the right of it.
    #[test]
    fn directions_map_to_the_documented_texels() {
        let map = numbered_texels();
        let d = |x: f64, y: f64, z: f64| Vec3::new(x, y, z).normalize();
        assert_eq!(map.radiance(d(-0.1, 0.1, -1.0)).g, 1.0);
        assert_eq!(map.radiance(d(0.1, 0.1, -1.0)).g, 2.0);
        assert_eq!(map.radiance(d(-0.1, 0.1, 1.0)).g, 0.0);
        assert_eq!(map.radiance(d(0.1, -0.1, 1.0)).g, 7.0);
    }

    #[test]
    fn samples_agree_with_radiance_and_pdf() {
        let map = numbered_texels();
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
    fn black_environment_returns_no_sample() {
        let black = Environment::uniform(Spectrum::BLACK);
        assert_eq!(black.sample(Vec2::splat(0.5)), None);
        assert_eq!(black.pdf(Vec3::Y), 0.0);
    }

    #[test]
    fn invalid_texels_are_errors() {
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
