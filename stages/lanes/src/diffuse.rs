//! Diffuse surfaces, as `direct::lambert_f` and `direct::lambert_sample`, in the local space of the
//! surface, where z is the normal.

use crate::real::{Mask, Real};
use crate::vec3::Vec3;
use std::f64::consts::FRAC_1_PI;

/// The BSDF for directions on the same side of the surface.
#[inline(always)]
pub fn lambert_f<R: Real>(reflectance: Vec3<R>) -> Vec3<R> {
    reflectance * reflectance.x.constant(FRAC_1_PI)
}

/// Whether the directions with these z are on the same side of the surface; else the BSDF is black.
#[inline(always)]
pub fn on_same_side<R: Real>(wo_z: R, wi_z: R) -> R::Mask {
    wo_z.constant(0.0).less(wo_z * wi_z)
}

/// The density with which [`lambert_sample`] samples a direction with this `wi_z`, in 1/sr, as
/// `direct::lambert_pdf`.
#[inline(always)]
pub fn lambert_pdf<R: Real>(wo_z: R, wi_z: R) -> R {
    let pdf = wi_z.abs() * wi_z.constant(FRAC_1_PI);
    on_same_side(wo_z, wi_z).choose(pdf, wi_z.constant(0.0))
}

/// The factor of a soft terminator, as [`kit::shading_normal::Sides::terminator`]. The geometric
/// normal and `wi` are in the local space of the shading normal.
#[inline(always)]
pub fn terminator<R: Real>(ng: Vec3<R>, wi: Vec3<R>) -> R {
    let (height, expected) = (ng.dot(wi).abs(), (ng.z * wi.z).abs());
    let one = height.constant(1.0);
    let g = expected.at_most(height).choose(one, height / expected);
    g * (one + g * (one - g))
}

/// A sampled direction.
///
/// ```
/// use lanes::{Vec3, diffuse};
/// let half = Vec3 { x: 0.5, y: 0.5, z: 0.5 };
/// let sample = diffuse::lambert_sample(half, -1.0, 0.36, (0.0, 1.0));
/// assert_eq!((sample.wi.x, sample.wi.z), (0.6, -0.8));
/// assert!((sample.weight.x - 0.5_f64).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DiffuseSample<R> {
    /// The unit direction.
    pub wi: Vec3<R>,
    /// Its density, in 1/sr.
    pub pdf: R,
    /// The weight of the path along it: `f · cos θ / pdf`.
    pub weight: Vec3<R>,
}

/// Samples a direction on the side of `wo_z` from `u` in [0, 1) and the sine and cosine of a
/// uniform angle.
#[inline(always)]
pub fn lambert_sample<R: Real>(
    reflectance: Vec3<R>,
    wo_z: R,
    u: R,
    (sin, cos): (R, R),
) -> DiffuseSample<R> {
    let r = u.sqrt();
    let z = (u.constant(1.0) - u).sqrt();
    let wi = Vec3 {
        x: r * cos,
        y: r * sin,
        z: z.copysign(wo_z),
    };
    let pdf = z * z.constant(FRAC_1_PI);
    DiffuseSample {
        wi,
        pdf,
        weight: lambert_f(reflectance) * (z / pdf),
    }
}
