//! Vectors, matrices and elementary functions.
//!
//! All numbers are `f64`. Transcendental functions come from `libm`, not from the platform, so that
//! images and operation counts are the same on every machine.

/// Two numbers, such as a point on the film or a pair of barycentric weights.
pub type Vec2 = glam::DVec2;
/// A point or a direction in space. World space is right-handed with +y up.
pub type Vec3 = glam::DVec3;
/// A 3x3 matrix, stored by columns. `m * v` multiplies it by a column vector.
pub type Mat3 = glam::DMat3;

/// Sine of an angle in radians.
pub fn sin(radians: f64) -> f64 {
    libm::sin(radians)
}

/// Cosine of an angle in radians.
pub fn cos(radians: f64) -> f64 {
    libm::cos(radians)
}

/// Tangent of an angle in radians.
pub fn tan(radians: f64) -> f64 {
    libm::tan(radians)
}

/// Angle in radians, in [0, π], whose cosine is `cosine`.
pub fn acos(cosine: f64) -> f64 {
    libm::acos(cosine)
}

/// Angle in radians, in [-π, π], between the +x axis and the direction to the point `(x, y)`.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// `base` to the power `exponent`.
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// Natural exponential of `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm of `x`.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Sine and cosine of an angle in radians.
pub fn sin_cos(radians: f64) -> (f64, f64) {
    libm::sincos(radians)
}
