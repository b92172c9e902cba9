//! Iterates over the lanes of a bit mask.

/// The numbers of the lanes whose bits are set, in ascending order.
#[inline(always)]
pub(crate) fn lanes(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            // At most 7; the mask lets the compiler drop bounds checks.
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            lane
        })
    })
}
