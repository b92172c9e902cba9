//! Camera rays, as `raygen::generate_ray` generates them.

use crate::real::Real;
use crate::vec3::Vec3;
use kit::Camera;
use kit::math::tan;

/// What the directions of all rays of a camera are computed from.
///
/// ```
/// use lanes::camera::CameraAxes;
/// let camera = kit::Camera {
///     pos: kit::Vec3::ZERO,
///     c2w: kit::Mat3::IDENTITY,
///     h_fov: 90.0,
///     v_fov: 60.0,
///     n_clip: 0.0,
///     f_clip: f64::INFINITY,
/// };
/// let axes = CameraAxes::of(&camera, 0.0_f64);
/// assert_eq!(axes.direction([0.5, 0.5]).z, -1.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CameraAxes<R> {
    axes: [Vec3<R>; 3],
    half_width: R,
    half_height: R,
}

impl<R: Real> CameraAxes<R> {
    /// The axes of `camera`, in as many lanes as `like` has.
    #[inline(always)]
    pub fn of(camera: &Camera, like: R) -> CameraAxes<R> {
        CameraAxes {
            axes: [
                Vec3::constant(like, camera.c2w.x_axis),
                Vec3::constant(like, camera.c2w.y_axis),
                Vec3::constant(like, camera.c2w.z_axis),
            ],
            half_width: like.constant(tan((0.5 * camera.h_fov).to_radians())),
            half_height: like.constant(tan((0.5 * camera.v_fov).to_radians())),
        }
    }

    /// The unit direction through the point `sensor` of the film, in world space.
    #[inline(always)]
    pub fn direction(&self, sensor: [R; 2]) -> Vec3<R> {
        let (one, two) = (sensor[0].constant(1.0), sensor[0].constant(2.0));
        let x = (sensor[0] * two - one) * self.half_width;
        let y = (sensor[1] * two - one) * self.half_height;
        let [right, up, back] = self.axes;
        let d = right * x + up * y + back * -one;
        d * (one / d.length())
    }
}
