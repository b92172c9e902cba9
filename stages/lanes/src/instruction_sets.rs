//! The instruction sets that code in lanes is compiled for and tested with.

use fearless_simd::Level;

/// Instruction sets of this machine, the best one first: results have to be the same with all of
/// them.
pub fn instruction_sets() -> Vec<Level> {
    let mut levels = vec![Level::new(), Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    levels.extend(Level::new().as_avx2().map(Level::Avx2));
    levels
}

/// Computes the expression with the best instruction set that the [`Level`] allows, as
/// `fearless_simd::dispatch!` does, without a copy for SSE4.2, which would take long to compile.
#[macro_export]
macro_rules! dispatch {
    ($level:expr, $simd:pat => $result:expr) => {{
        #[cfg(target_arch = "x86_64")]
        {
            let level: fearless_simd::Level = $level;
            if let Some(simd) = level.as_avx512() {
                $crate::compiled_for!(simd, $simd => $result)
            } else if let Some(simd) = level.as_avx2() {
                $crate::compiled_for!(simd, $simd => $result)
            } else {
                let simd = level.as_sse2().expect("each x86-64 has SSE2");
                $crate::compiled_for!(simd, $simd => $result)
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        fearless_simd::dispatch!($level, $simd => $result)
    }};
}

/// The expression, compiled for the instruction set of `$token`. For [`dispatch!`].
#[doc(hidden)]
#[macro_export]
macro_rules! compiled_for {
    ($token:expr, $simd:pat => $result:expr) => {{
        let $simd = $token;
        fearless_simd::Simd::vectorize(
            $token,
            #[inline(always)]
            || $result,
        )
    }};
}
