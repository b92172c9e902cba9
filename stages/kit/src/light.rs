//! The lights of a scene file, in world space. Emitting surfaces are materials, not lights.

use crate::{Spectrum, Vec3};

/// A light source as described in a scene file.
///
/// ```
/// use kit::{Light, Spectrum, Vec3};
/// let lamp = Light::Point { position: Vec3::Y, intensity: Spectrum::grey(8.0) };
/// // 8 / 2² at a distance of 2.
/// let Light::Point { position, intensity } = lamp else { unreachable!() };
/// assert_eq!(intensity / position.distance_squared(-Vec3::Y), Spectrum::grey(2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// A parallelogram that emits from one side.
    Area {
        /// Centre.
        center: Vec3,
        /// First edge, full length.
        edge_x: Vec3,
        /// Second edge, full length.
        edge_y: Vec3,
        /// Unit normal of the emitting side.
        direction: Vec3,
        /// Emitted radiance.
        radiance: Spectrum,
    },
    /// A point light that is the same in all directions.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity (power per solid angle).
        intensity: Spectrum,
    },
    /// A point light that is restricted to a cone.
    Spot {
        /// Position.
        position: Vec3,
        /// Unit direction of the cone's axis.
        direction: Vec3,
        /// Radiant intensity on the axis.
        intensity: Spectrum,
        /// Full opening angle in degrees, in (0, 180].
        falloff_angle: f64,
        /// Exponent of the cosine of the angle to the axis, `>= 0`.
        falloff_exponent: f64,
    },
    /// A light at infinite distance.
    Directional {
        /// Unit direction of propagation, away from the light.
        direction: Vec3,
        /// Irradiance on a surface that faces the light.
        irradiance: Spectrum,
    },
    /// A sky that emits the same radiance from every direction with `y >= 0`.
    Hemisphere {
        /// Radiance of the sky.
        radiance: Spectrum,
    },
}
