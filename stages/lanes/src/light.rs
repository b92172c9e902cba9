//! Samples of lights, as [`kit::Emitter::sample`] takes them, their densities, and what they
//! contribute.

use crate::real::{Mask, Real};
use crate::vec3::Vec3;
use kit::warp::UNIFORM_HEMISPHERE_PDF;
use kit::{EmittingMesh, Lamp};

/// A sample of a light.
///
/// ```
/// use lanes::light::sample_sky;
/// let sample = sample_sky(kit::Vec3::ONE, 0.6, (0.0, 1.0_f64));
/// assert!(sample.exists && sample.distance.is_infinite());
/// assert_eq!((sample.wi.x, sample.wi.y), (0.8, 0.6));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LightSample<R: Real> {
    /// Whether there is a sample.
    pub exists: R::Mask,
    /// The unit direction to the sampled point.
    pub wi: Vec3<R>,
    /// The distance to it.
    pub distance: R,
    /// The density of the direction, in 1/sr.
    pub pdf: R,
    /// The radiance of the light if nothing blocks it.
    pub radiance: Vec3<R>,
}

/// Samples `mesh` from the point `p` with `u` in [0, 1)². Takes as long as the mesh has triangles,
/// because each number may choose another one.
#[inline(always)]
pub fn sample_mesh<R: Real>(mesh: &EmittingMesh, p: Vec3<R>, u: [R; 2]) -> LightSample<R> {
    let like = u[0];
    let target = u[0] * like.constant(mesh.area());
    let part = mesh.part(0);
    let mut before = like.constant(part.before);
    let mut inverse_area = like.constant(part.inverse_area);
    let mut p0 = Vec3::constant(like, part.triangle.p0);
    let mut e1 = Vec3::constant(like, part.triangle.e1);
    let mut e2 = Vec3::constant(like, part.triangle.e2);
    let mut front = Vec3::constant(like, part.triangle.front);
    for i in 1..mesh.len() {
        let part = mesh.part(i);
        let here = like.constant(part.before).at_most(target);
        before = here.choose(like.constant(part.before), before);
        inverse_area = here.choose(like.constant(part.inverse_area), inverse_area);
        p0 = Vec3::constant(like, part.triangle.p0).masked_or(here, p0);
        e1 = Vec3::constant(like, part.triangle.e1).masked_or(here, e1);
        e2 = Vec3::constant(like, part.triangle.e2).masked_or(here, e2);
        front = Vec3::constant(like, part.triangle.front).masked_or(here, front);
    }
    let (zero, one) = (like.constant(0.0), like.constant(1.0));
    let s = ((target - before) * inverse_area).min(one).sqrt();
    let (b1, b2) = (s * (one - u[1]), s * u[1]);
    let d = p0 + e1 * b1 + e2 * b2 - p;
    let height = -d.dot(front);
    let distance2 = d.dot(d);
    let distance = distance2.sqrt();
    let pdf = distance2 * distance / (height * like.constant(mesh.area()));
    let radiance = mesh.radiance.to_array().into();
    LightSample {
        exists: zero.less(height) & zero.less(pdf) & pdf.less(like.constant(f64::INFINITY)),
        wi: d / distance,
        distance,
        pdf,
        radiance: Vec3::constant(like, radiance),
    }
}

/// Samples a sky, which sends `radiance` from every direction with `y >= 0`, with the height `u` in
/// [0, 1) and the sine and cosine of a uniform angle.
#[inline(always)]
pub fn sample_sky<R: Real>(radiance: kit::Vec3, u: R, (sin, cos): (R, R)) -> LightSample<R> {
    let (zero, one) = (u.constant(0.0), u.constant(1.0));
    let r = (one - u * u).max(zero).sqrt();
    LightSample {
        exists: zero.at_most(u),
        wi: Vec3 {
            x: r * cos,
            y: u,
            z: r * sin,
        },
        distance: u.constant(f64::INFINITY),
        pdf: u.constant(UNIFORM_HEMISPHERE_PDF),
        radiance: Vec3::constant(u, radiance),
    }
}

/// About what `lamp` can send to the points `p`, as [`Lamp::weight`].
#[inline(always)]
pub fn lamp_weight<R: Real>(lamp: &Lamp, p: Vec3<R>) -> R {
    let like = p.x;
    let d = p - Vec3::constant(like, lamp.center);
    let distance2 = d.dot(d);
    let at_front = like.constant(lamp.power) / distance2.max(like.constant(lamp.radius2));
    match lamp.front {
        Some(front) => {
            let height = d.dot(Vec3::constant(like, front)).max(like.constant(0.0));
            at_front * (height / distance2.max(like.constant(f64::MIN_POSITIVE)).sqrt())
        }
        None => at_front,
    }
}

/// The density of the direction `wi` among the samples of a mesh of this `area`, in 1/sr, given
/// that the ray along `wi` hits the mesh at `distance`, where the unit normal of the front side is
/// `normal`.
#[inline(always)]
pub fn mesh_pdf<R: Real>(area: R, wi: Vec3<R>, distance: R, normal: Vec3<R>) -> R {
    let zero = area.constant(0.0);
    let cos = -wi.dot(normal);
    zero.less(cos)
        .choose(distance * distance / (cos * area), zero)
}

impl<R: Real> LightSample<R> {
    /// The light that a surface with the BSDF `f` scatters towards the viewer, if nothing blocks
    /// the sample: a term of `direct::estimate_direct_lighting_mis`, and with the `weight` 1 of
    /// `direct::estimate_direct_lighting_importance`. `wi_z` is the cosine between
    /// [`LightSample::wi`] and the normal.
    #[inline(always)]
    pub fn scattered(&self, f: Vec3<R>, wi_z: R, weight: R) -> Vec3<R> {
        f * self.radiance * (weight * wi_z.abs() / self.pdf)
    }
}
