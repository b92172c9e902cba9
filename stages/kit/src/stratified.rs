//! Stratified (jittered) sampling.
//!
//! The unit square is divided into as many cells as there are samples. Each cell gets one sample at
//! a random position in it (Cook, Porter, Carpenter, "Distributed ray tracing", 1984). Where the
//! integrand is smooth within a cell the error of the mean falls like 1/n, at an edge like
//! n^(-3/4), compared to 1/√n for independent samples.
//!
//! Each later dimension is stratified independently and visits its cells in its own order.
//! Otherwise the position in the pixel and the position on a light would be correlated.

use crate::sampler::mix;

/// The largest float below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// A number in [0, 1) for sample `index`, from one of `samples` (at least 1) equal cells. `key`
/// determines the order of the cells, and `jitter` in [0, 1) the position in the cell.
///
/// Samples from `samples` on visit the cells again, in another order.
pub(crate) fn sample_1d(index: u32, samples: u32, key: u64, jitter: f64) -> f64 {
    let cell = cell(index, samples, key);
    jittered(cell, samples, jitter)
}

/// A point in [0, 1)² for sample `index`, with the cells in rows and columns. Otherwise like
/// [`sample_1d`].
pub(crate) fn sample_2d(index: u32, samples: u32, key: u64, jitter: [f64; 2]) -> [f64; 2] {
    let columns = columns(samples);
    let cell = cell(index, samples, key);
    [
        jittered(cell % columns, columns, jitter[0]),
        jittered(cell / columns, samples / columns, jitter[1]),
    ]
}

/// The point at `jitter` in [0, 1) of cell `cell`, below 1.
fn jittered(cell: u32, cells: u32, jitter: f64) -> f64 {
    // The sum may round up to the start of the next cell, which is 1 for the last cell.
    ((f64::from(cell) + jitter) / f64::from(cells)).min(BELOW_ONE)
}

/// The number of columns that makes the cells as square as possible: the largest divisor of
/// `samples` that is not above its square root. A prime number of samples gives one column.
fn columns(samples: u32) -> u32 {
    let mut columns = samples.isqrt().max(1);
    while !samples.is_multiple_of(columns) {
        columns -= 1;
    }
    columns
}

/// The cell of sample `index`.
fn cell(index: u32, samples: u32, key: u64) -> u32 {
    let round = index / samples;
    permute(index % samples, samples, mix(key ^ u64::from(round)) as u32)
}

/// Element `i` of permutation `p` of `0..l`, without a table (Kensler, "Correlated multi-jittered
/// sampling", Pixar 2013). A hash permutes the numbers below the next power of two, and is repeated
/// until the result is below `l`.
fn permute(mut i: u32, l: u32, p: u32) -> u32 {
    let w = l.next_power_of_two() - 1;
    loop {
        i ^= p;
        i = i.wrapping_mul(0xe170_893d);
        i ^= p >> 16;
        i ^= (i & w) >> 4;
        i ^= p >> 8;
        i = i.wrapping_mul(0x0929_eb3f);
        i ^= p >> 23;
        i ^= (i & w) >> 1;
        i = i.wrapping_mul(1 | (p >> 27));
        i = i.wrapping_mul(0x6935_fa69);
        i ^= (i & w) >> 11;
        i = i.wrapping_mul(0x74dc_b303);
        i ^= (i & w) >> 2;
        i = i.wrapping_mul(0x9e50_1cc3);
        i ^= (i & w) >> 2;
        i = i.wrapping_mul(0xc860_a3df);
        i &= w;
        i ^= i >> 5;
        if i < l {
            return ((u64::from(i) + u64::from(p)) % u64::from(l)) as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_cell_gets_one_sample_in_every_round() {
        for samples in [1, 2, 6, 7, 16, 100, 256] {
            let (w, h) = (columns(samples), samples / columns(samples));
            for round in 0..3 {
                let indices = round * samples..(round + 1) * samples;
                let cells: BTreeSet<(u32, u32)> = indices
                    .clone()
                    .map(|i| sample_2d(i, samples, 5, [0.5; 2]))
                    .map(|[x, y]| ((x * f64::from(w)) as u32, (y * f64::from(h)) as u32))
                    .collect();
                assert_eq!(cells.len(), samples as usize);
                let strata: BTreeSet<u32> = indices
                    .map(|i| (sample_1d(i, samples, 5, 0.5) * f64::from(samples)) as u32)
                    .collect();
                assert_eq!(strata.len(), samples as usize);
            }
        }
    }

    #[test]
    fn cells_are_as_square_as_possible() {
        assert_eq!([1, 4, 12, 16, 13].map(columns), [1, 2, 3, 4, 1]);
    }

    #[test]
    fn keys_and_rounds_change_the_order() {
        let order = |round: u32, key| -> Vec<u32> {
            (0..16).map(|i| cell(round * 16 + i, 16, key)).collect()
        };
        assert_ne!(order(0, 1), order(0, 2));
        assert_ne!(order(0, 1), order(1, 1));
    }

    #[test]
    fn samples_of_the_last_cell_are_below_one() {
        for index in 0..7 {
            assert!(sample_1d(index, 7, 3, BELOW_ONE) < 1.0);
        }
    }
}
