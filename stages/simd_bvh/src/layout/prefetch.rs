//! Loads memory into the cache before it is needed.

/// The size of a cache line on most machines; on others a prefetch does too much or too little.
const LINE: usize = 64;

/// Starts to load `SIZE` bytes from `start` into the cache, without waiting for them. The address
/// may be any: one without memory is ignored. Does nothing on machines other than x86-64.
#[inline(always)]
#[cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "the safe prefetch of the standard library is not stable"
    )
)]
pub(crate) fn prefetch<const SIZE: usize>(start: *const u8) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        for offset in (0..SIZE).step_by(LINE) {
            // SAFETY: a prefetch does not access memory as far as the program can observe, and it
            // is part of x86-64.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(offset).cast()) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (start, LINE);
}
