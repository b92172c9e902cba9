//! The instruction sets that a pass can run with.
//!
//! A default build for x86-64 has no fused multiply-add: there `mul_add` calls the C library, which
//! takes longer than the rest of a kernel. A program that wants one chooses it at run time, as
//! `simd_bvh` does.

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::{Level, Simd, x86::Avx2};

/// An instruction set that this machine has.
#[derive(Clone, Copy, Debug)]
pub struct Instructions {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    avx2: Option<Avx2>,
}

impl Instructions {
    /// The instructions that the program is built for.
    pub const BUILD: Instructions = Instructions {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        avx2: None,
    };

    /// AVX2 and FMA. `None` if the machine does not have them, or if the program is built for a
    /// fused multiply-add anyway.
    pub fn with_fma() -> Option<Instructions> {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if !cfg!(target_feature = "fma") {
            let avx2 = Some(Level::new().as_avx2()?);
            return Some(Instructions { avx2 });
        }
        None
    }

    /// Runs `work`, compiled for these instructions as far as it is inlined. Results are the same
    /// with all instructions: the compiler never fuses a product and a sum by itself.
    #[inline(always)]
    pub(crate) fn run<T>(self, work: impl FnOnce() -> T) -> T {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(avx2) = self.avx2 {
            return avx2.vectorize(work);
        }
        work()
    }
}
