//! Eight numbers at a time, for the instruction set `S`.

use crate::real::{Mask, Real};
use crate::shapes::Ray;
use crate::vec3::Vec3;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, f32x8, f64x8, mask32x8, mask64x8};

macro_rules! eight_numbers {
    ($numbers:ident, $mask:ident, $number:ident) => {
        impl<S: Simd> Real for $numbers<S> {
            type Mask = $mask<S>;

            #[inline(always)]
            fn constant(self, x: f64) -> Self {
                SimdBase::splat(self.simd, x as $number)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                SimdFloat::copysign(self, sign)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                SimdBase::max_precise(self, other)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                SimdBase::min_precise(self, other)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                SimdBase::max(self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                SimdBase::min(self, other)
            }

            #[inline(always)]
            fn less(self, other: Self) -> Self::Mask {
                self.simd_lt(other)
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> Self::Mask {
                self.simd_le(other)
            }

            #[inline(always)]
            fn equals(self, other: Self) -> Self::Mask {
                self.simd_eq(other)
            }
        }

        impl<S: Simd> Mask<$numbers<S>> for $mask<S> {
            #[inline(always)]
            fn choose(self, yes: $numbers<S>, no: $numbers<S>) -> $numbers<S> {
                Select::select(self, yes, no)
            }
        }
    };
}

eight_numbers!(f32x8, mask32x8, f32);
eight_numbers!(f64x8, mask64x8, f64);

/// Vectors in eight lanes.
impl<S: Simd> Vec3<f64x8<S>> {
    /// `v` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, v: kit::Vec3) -> Vec3<f64x8<S>> {
        Vec3::constant(f64x8::splat(simd, 0.0), v)
    }

    /// The vectors that `of` returns for each lane.
    #[inline(always)]
    pub fn gather(simd: S, of: impl Fn(usize) -> [f64; 3]) -> Vec3<f64x8<S>> {
        Vec3 {
            x: f64x8::from_fn(simd, |lane| of(lane)[0]),
            y: f64x8::from_fn(simd, |lane| of(lane)[1]),
            z: f64x8::from_fn(simd, |lane| of(lane)[2]),
        }
    }

    /// The vector in a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> kit::Vec3 {
        kit::Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Sets the vector in a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, v: [f64; 3]) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v[0], v[1], v[2]);
    }
}

/// Eight rays.
impl<S: Simd> Ray<f64x8<S>> {
    /// The ray in a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> kit::Ray {
        kit::Ray {
            o: self.o.lane(lane),
            d: self.d.lane(lane),
            min_t: self.min_t[lane],
            max_t: self.max_t[lane],
        }
    }
}
