//! The lights that a scene file names, in world space. Surfaces that emit are materials, not lights.

use crate::{Spectrum, Vec3};

/// A light source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// A parallelogram that shines to one side.
    Area {
        /// Centre.
        center: Vec3,
        /// First edge, whole length.
        edge_x: Vec3,
        /// Second edge, whole length.
        edge_y: Vec3,
        /// Unit direction of the side that shines.
        direction: Vec3,
        /// Emitted radiance.
        radiance: Spectrum,
    },
    /// A point that shines the same everywhere.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity (power per solid angle).
        intensity: Spectrum,
    },
    /// A point that shines into a cone.
    Spot {
        /// Position.
        position: Vec3,
        /// Unit direction of the cone's axis.
        direction: Vec3,
        /// Radiant intensity on the axis.
        intensity: Spectrum,
        /// Full opening angle in degrees, in (0, 180].
        falloff_angle: f64,
        /// Exponent of the cosine to the axis, `>= 0`.
        falloff_exponent: f64,
    },
    /// A sun infinitely far away.
    Directional {
        /// Unit direction in which the light travels.
        direction: Vec3,
        /// Irradiance on a surface that faces the light.
        irradiance: Spectrum,
    },
    /// A sky that shines the same from every direction of the upper half (+y).
    Hemisphere {
        /// Radiance of the sky.
        radiance: Spectrum,
    },
}
