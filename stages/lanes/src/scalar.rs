//! Single numbers: those types of [`Real`] that convert from and to `f64`.

use crate::real::Real;

/// The number type of a kernel.
///
/// ```
/// use lanes::Precision::{F32, F32InF64};
/// assert_eq!(F32InF64.stored(0.1), F32.stored(0.1));
/// assert!(F32InF64.epsilon() < F32.epsilon());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Single precision: 24 bits.
    F32,
    /// Double precision: 53 bits.
    F64,
    /// Stored in single precision, computed in double precision.
    F32InF64,
}

impl Precision {
    /// Returns the nearest number that can be stored.
    pub fn stored(self, x: f64) -> f64 {
        match self {
            Precision::F64 => x,
            Precision::F32 | Precision::F32InF64 => f64::from(x as f32),
        }
    }

    /// Returns the distance from 1 to the next larger number, in the precision of the results.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::EPSILON),
            Precision::F64 | Precision::F32InF64 => f64::EPSILON,
        }
    }
}

/// A single floating-point number: `f32`, `f64`, or one that counts its operations.
///
/// ```
/// use lanes::Scalar;
/// fn third<R: Scalar>() -> f64 {
///     (R::from_f64(1.0) / R::from_f64(3.0)).to_f64()
/// }
/// assert!(third::<f32>() > 1.0 / 3.0 && third::<f64>() == 1.0 / 3.0);
/// ```
pub trait Scalar: Real<Mask = bool> + PartialOrd + Send + Sync + 'static {
    /// The precision.
    const PRECISION: Precision;

    /// Rounds `x` to this type.
    fn from_f64(x: f64) -> Self;

    /// Returns the value as `f64`.
    fn to_f64(self) -> f64;

    /// Returns `self · factor + term` with a single rounding. If the target has no fused
    /// multiply-add instruction, as in a default build for x86-64, this calls the C library.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// Returns the distance from 1 to the next larger number.
    fn epsilon() -> Self {
        Self::from_f64(Self::PRECISION.epsilon())
    }
}

macro_rules! scalar {
    ($number:ident, $precision:expr) => {
        impl Scalar for $number {
            const PRECISION: Precision = $precision;

            #[inline(always)]
            fn from_f64(x: f64) -> $number {
                x as $number
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn mul_add(self, factor: $number, term: $number) -> $number {
                $number::mul_add(self, factor, term)
            }
        }
    };
}

scalar!(f32, Precision::F32);
scalar!(f64, Precision::F64);
