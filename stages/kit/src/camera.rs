//! The pinhole camera.

use crate::{Mat3, Vec3, math};

/// A pinhole camera. In camera space it is at the origin, looks along -z and has +y up.
///
/// ```
/// use kit::{Camera, Vec3, camera};
/// let pos = Vec3::new(0.0, 0.0, 5.0);
/// let c2w = Camera::look_at(pos, Vec3::ZERO, Vec3::Y).expect("it has a direction");
/// // The camera looks along -z of its own space.
/// assert_eq!(c2w * Vec3::NEG_Z, Vec3::NEG_Z);
/// let camera = Camera {
///     pos,
///     c2w,
///     h_fov: camera::scale_fov(60.0, 1.5),
///     v_fov: 60.0,
///     n_clip: 0.0,
///     f_clip: f64::INFINITY,
/// };
/// assert!(camera.h_fov > camera.v_fov);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position in world space.
    pub pos: Vec3,
    /// Rotation from camera space to world space. Its columns are the camera's right, up and
    /// backward directions.
    pub c2w: Mat3,
    /// Horizontal field of view in degrees, in (0, 180].
    pub h_fov: f64,
    /// Vertical field of view in degrees, in (0, 180].
    pub v_fov: f64,
    /// Near clip distance: the smallest visible `t`, measured along the unit ray.
    pub n_clip: f64,
    /// Far clip distance: the largest visible `t`, measured along the unit ray.
    pub f_clip: f64,
}

/// Error of [`Camera::look_at`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceError {
    /// The camera is at its target, or a coordinate is not finite.
    NoDirection,
    /// The up direction is parallel to the viewing direction.
    UpAlongView,
}

impl std::fmt::Display for PlaceError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            PlaceError::NoDirection => {
                "the camera is at its target, so it has no viewing direction: move one of them"
            }
            PlaceError::UpAlongView => {
                "the up direction is parallel to the viewing direction: choose another up"
            }
        })
    }
}

impl std::error::Error for PlaceError {}

impl Camera {
    /// The rotation `c2w` of a camera at `pos` that looks at `target`, with its up direction as
    /// close to `up` as possible.
    pub fn look_at(pos: Vec3, target: Vec3, up: Vec3) -> Result<Mat3, PlaceError> {
        let backward = (pos - target)
            .try_normalize()
            .ok_or(PlaceError::NoDirection)?;
        let up = up.try_normalize().ok_or(PlaceError::UpAlongView)?;
        let right = up.cross(backward);
        // If the angle between them is below 1e-6 radians, the cross product is mostly rounding
        // error.
        if right.length() < 1e-6 {
            return Err(PlaceError::UpAlongView);
        }
        let right = right.normalize();
        Ok(Mat3::from_cols(right, backward.cross(right), backward))
    }
}

/// Tangent of half of a field of view. `fov` is in degrees, in [0, 180].
pub fn half_tan(fov: f64) -> f64 {
    math::tan(0.5 * fov.to_radians())
}

/// The field of view whose half has `ratio` times the tangent of half of `fov`. Both are in
/// degrees.
///
/// With the aspect ratio of an image as `ratio` this is the horizontal field of view that belongs
/// to a vertical one.
pub fn scale_fov(fov: f64, ratio: f64) -> f64 {
    2.0 * math::atan2(half_tan(fov) * ratio, 1.0).to_degrees()
}
