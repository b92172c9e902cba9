//! A sky at dusk, as an environment map.

use image::{Rgb, Rgb32FImage};
use kit::math::{acos, exp, sin_cos};
use kit::{Spectrum, Vec3};
use std::f64::consts::{PI, TAU};

/// Width of the map in texels; it is half as high.
pub const WIDTH: u32 = 2048;

/// The standard deviation of the sun's disc, in radians. A real sun has a radius of 0.0047. This
/// one is as wide as a sun behind thin clouds: a path that leaves a diffuse surface at random and
/// is refracted by glass hits it often enough for its caustic to converge. The light of a sun
/// twice as wide, with the same irradiance, has a quarter of the variance.
const SUN_WIDTH: f64 = 0.18;

/// The radiance in the middle of the sun.
const SUN: Spectrum = Spectrum::new(10.6, 5.3, 2.0);

/// The direction to the sun: beyond the scene, to the left of its middle, 23 degrees high.
pub fn sun_direction() -> Vec3 {
    Vec3::new(-0.40, 0.46, -1.0).normalize()
}

/// The radiance from the unit direction `w`: a gradient from a warm horizon to a deep blue zenith,
/// warmer near the sun, and dark ground below the horizon.
pub fn radiance(w: Vec3) -> Spectrum {
    let sun = sun_direction();
    let cos = w.dot(sun).clamp(-1.0, 1.0);
    // 1 - cos is half the squared angle for small angles, without the rounding of acos.
    let disc = exp(-(1.0 - cos) / (SUN_WIDTH * SUN_WIDTH));
    let height = 1.0 - acos(w.y.clamp(-1.0, 1.0)) / (0.5 * PI);
    if height < 0.0 {
        // The ground reflects a little of the sky, less the further down.
        return Spectrum::new(0.10, 0.085, 0.08) * (0.4 + 0.6 * exp(20.0 * height));
    }
    let zenith = Spectrum::new(0.030, 0.055, 0.150);
    let band = Spectrum::new(0.20, 0.115, 0.15);
    let horizon = Spectrum::new(0.62, 0.24, 0.08);
    let toward_sun = exp(-3.2 * (1.0 - cos));
    zenith
        + band * exp(-height / 0.22)
        + horizon * (exp(-height / 0.07) * (0.35 + 1.1 * toward_sun))
        + Spectrum::new(1.0, 0.44, 0.16) * (0.6 * exp(-(1.0 - cos) / 0.09))
        + SUN * disc
}

/// The map of [`radiance`]: texel by texel the direction through its middle, with the projection of
/// [`kit::Environment`].
pub fn map() -> Rgb32FImage {
    let height = WIDTH / 2;
    Rgb32FImage::from_fn(WIDTH, height, |x, y| {
        let (sin_phi, cos_phi) = sin_cos(TAU * (f64::from(x) + 0.5) / f64::from(WIDTH));
        let (sin, cos) = sin_cos(PI * (f64::from(y) + 0.5) / f64::from(height));
        let w = Vec3::new(-sin * sin_phi, cos, sin * cos_phi);
        Rgb(radiance(w).to_array().map(|c| c as f32))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Environment;

    /// The renderer finds the sun where the sky has it: both have the same projection.
    #[test]
    fn the_map_shows_the_sky_in_the_renderers_projection() {
        let texels = map();
        let texels = texels.pixels().map(|p| Spectrum::from(p.0.map(f64::from)));
        let map = Environment::new(WIDTH as usize, WIDTH as usize / 2, texels.collect())
            .expect("radiances");
        for w in [
            sun_direction(),
            Vec3::Y,
            -Vec3::Y,
            Vec3::new(1.0, 0.2, 0.0).normalize(),
            Vec3::new(0.0, 0.1, -1.0).normalize(),
            Vec3::new(0.3, 0.2, 0.9).normalize(),
        ] {
            let (a, b) = (map.radiance(w).luminance(), radiance(w).luminance());
            assert!((a / b - 1.0).abs() < 0.05, "{w}: {a} {b}");
        }
        let sun = map.radiance(sun_direction()).luminance();
        assert!(sun > 5.0, "{sun}");
    }

    /// What convergence depends on: one in fifty directions of cosine-weighted sampling on a
    /// horizontal surface ends in the sun, and no direction is so bright that one path in 256 of
    /// them shows. The pictures' README says so.
    #[test]
    fn the_sun_is_wide_and_not_bright() {
        // The integral of the Gaussian disc over the sphere is 2π·SUN_WIDTH² of its middle.
        let solid_angle = TAU * SUN_WIDTH * SUN_WIDTH;
        let irradiance_of_white = solid_angle * sun_direction().y;
        assert!(irradiance_of_white / PI > 0.02, "{solid_angle}");
        let brightest = radiance(sun_direction()).luminance();
        let stone = 0.58 / PI * SUN.luminance() * irradiance_of_white;
        assert!(brightest / 256.0 < 0.3 * stone, "{brightest} {stone}");
        assert!(brightest < 120.0 * radiance(Vec3::Y).luminance());
        let edge = sun_direction().any_orthonormal_vector() * (2.0 * SUN_WIDTH) + sun_direction();
        assert!(radiance(edge.normalize()).luminance() < radiance(sun_direction()).luminance());
    }
}
