// BEGIN SOLUTION(part1.task3)
//! The bounds at which kernels stop to trust plain arithmetic.
//!
//! The reference kernels compute such cases again, with more care. Every version of a kernel must
//! decide alike, so the bounds are here.

/// A sum that is smaller than this fraction of its terms has lost ten bits to cancellation.
///
/// For a triangle's determinant this is a needle of 1000:1, or a ray within a thousandth of its
/// plane; otherwise the weights are accurate to about 2^-42. For a sphere it is a ray that is
/// almost tangent, or starts almost on the surface.
pub const CANCELLATION: f64 = 1.0 / 1024.0;

/// A product of several factors below this may have underflowed in an intermediate step, with a
/// margin for the digits of its terms.
pub const SMALLEST_PRODUCT: f64 = 1e-290;

/// The direction of a shorter weighted sum of three unit normals is mostly rounding error.
pub const CANCELLED_NORMAL: f64 = 1e-12;

/// Squared distance of a ray's origin from a sphere, in radii, from which rounding moves the line
/// noticeably (2^20 radii).
pub const FARTHEST2: f64 = (1_u64 << 40) as f64;

/// Squares between this and [`LARGEST_SQUARE`] can be multiplied without underflow or overflow.
pub const SMALLEST_SQUARE: f64 = 1e-100;

/// See [`SMALLEST_SQUARE`].
pub const LARGEST_SQUARE: f64 = 1e100;
// END SOLUTION(part1.task3)
