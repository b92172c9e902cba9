// BEGIN SOLUTION(part6.task2)
//! Bits that stand for lanes.

/// The numbers of the lanes whose bits are set, from the lowest on.
#[inline(always)]
pub(crate) fn lanes(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            // Never more than 7; so the compiler knows, too.
            let lane = bits.trailing_zeros() as usize & 7;
            bits &= bits - 1;
            lane
        })
    })
}
// END SOLUTION(part6.task2)
