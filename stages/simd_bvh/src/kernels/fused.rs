//! A product and a sum with one rounding, on every processor.

use fearless_simd::{Level, Simd, prelude::*};

/// `a·b + c` with one rounding.
///
/// x86-64 has had no instruction for it before AVX2. What computes the same there takes some sixty
/// instructions: they are a function, because traversals with dozens of copies are long enough to
/// take most of this crate's time to compile.
#[inline(always)]
pub(crate) fn mul_add<S: Simd, F: SimdFloat<S, Element = f32>>(
    simd: S,
    a: F,
    b: impl SimdInto<F, S>,
    c: impl SimdInto<F, S>,
) -> F {
    let (b, c) = (b.simd_into(simd), c.simd_into(simd));
    if is_one_instruction(simd.level()) {
        a.mul_add_precise(b, c)
    } else {
        emulated(simd, a, b, c)
    }
}

#[inline(never)]
fn emulated<S: Simd, F: SimdFloat<S, Element = f32>>(simd: S, a: F, b: F, c: F) -> F {
    simd.vectorize(
        #[inline(always)]
        || a.mul_add_precise(b, c),
    )
}

/// Whether `level` has an instruction for a product and a sum. Elsewhere than on x86-64 the answer
/// would only save time to compile.
#[inline(always)]
fn is_one_instruction(level: Level) -> bool {
    #[cfg(target_arch = "x86_64")]
    return level.as_avx2().is_some();
    #[cfg(not(target_arch = "x86_64"))]
    return !level.is_fallback();
}
