//! Eight numbers or vectors, one per lane.

use fearless_simd::f64x8;

/// The number of paths in a packet.
pub(crate) const LANES: usize = 8;

/// A vector or a colour in each lane.
pub(crate) type Vec3x8<S> = lanes::Vec3<f64x8<S>>;
