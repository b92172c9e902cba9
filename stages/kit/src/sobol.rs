//! The Sobol sequence in two dimensions, with Owen scrambling.
//!
//! Each elementary interval (a rectangle of 2⁻ⁱ by 2ⁱ⁻ᵏ) contains exactly one of the first 2ᵏ
//! points. Independent points form clusters and gaps instead. So for smooth integrands the error of
//! a mean falls nearly like 1/n instead of 1/√n. Owen's scrambling ("Randomly permuted
//! (t,m,s)-nets", 1995) keeps this property and makes every point uniform, so that estimates are
//! unbiased. It is computed with a hash, as in Burley, "Practical hash-based Owen scrambling" (JCGT
//! 2020); the hash is Vegdahl's corrected version of the one by Laine and Karras.
//!
//! Higher dimensions use further two-dimensional sequences (padding). Each has its own scrambling
//! and visits its points in its own order, so that different pairs are independent. The order
//! permutes the points within blocks of 2ᵏ, so the first 2ᵏ samples of every pair are still well
//! distributed.
//!
//! Two pairs that belong together are a sequence in four dimensions: the second pair ([`Half`])
//! visits its points in an order that depends on the first pair.

/// Which two of the four dimensions of a point: all bits are 0 for the first two, 1 for the others.
pub(crate) type Half = u32;

/// Point `index` of the sequence that `key` scrambles: two numbers in units of 2⁻³².
#[inline]
pub(crate) fn point(index: u32, key: u64, half: Half) -> [u32; 2] {
    let (low, high) = seeds_of(key, half);
    // Scrambling the index maps blocks of 2ᵏ points to such blocks, and each of them is as well
    // distributed as the first.
    let scrambled = scramble(index.reverse_bits(), low).reverse_bits();
    let index = index_in_half(scrambled, half);
    // The first dimension of the sequence is the index with its bits reversed (van der Corput).
    let x = scramble(index, high);
    let y = scramble(second_dimension(index), second_seed(low, high));
    // Reverses the bits of both numbers at once, because this is the most expensive step.
    let xy = (u64::from(x) << 32 | u64::from(y)).reverse_bits();
    [xy as u32, (xy >> 32) as u32]
}

/// A coordinate of a point as a number in [0, 1).
#[inline(always)]
pub(crate) fn fraction(coordinate: u32) -> f64 {
    f64::from(coordinate) / (1_u64 << 32) as f64
}

/// Computes [`point`] for several indices and keys. Returns all first numbers, then all second
/// ones.
#[inline(always)]
pub(crate) fn points<const N: usize>(
    indices: &[u32; N],
    keys: &[u64; N],
    halves: &[Half; N],
) -> [[u32; N]; 2] {
    let (mut low, mut high, mut index) = ([0; N], [0; N], *indices);
    for i in 0..N {
        (low[i], high[i]) = seeds_of(keys[i], halves[i]);
    }
    reverse_bits(&mut index);
    for i in 0..N {
        index[i] = scramble(index[i], low[i]);
    }
    reverse_bits(&mut index);
    for i in 0..N {
        index[i] = index_in_half(index[i], halves[i]);
    }
    let mut points = [[0; N]; 2];
    for i in 0..N {
        points[0][i] = scramble(index[i], high[i]);
        let seed = second_seed(low[i], high[i]);
        points[1][i] = scramble(second_dimension(index[i]), seed);
    }
    reverse_bits(&mut points[0]);
    reverse_bits(&mut points[1]);
    points
}

#[inline(always)]
fn reverse_bits<const N: usize>(numbers: &mut [u32; N]) {
    for number in numbers {
        *number = number.reverse_bits();
    }
}

/// The seeds of the order and of the first dimension. Both halves of a point have the same order.
#[inline(always)]
fn seeds_of(key: u64, half: Half) -> (u32, u32) {
    let (low, high) = (key as u32, (key >> 32) as u32);
    (low, high ^ low.wrapping_mul(0x85eb_ca6b) & half)
}

/// The place of point `index` in the order of its half: its own in the first one.
#[inline(always)]
fn index_in_half(index: u32, half: Half) -> u32 {
    let bits = index & half;
    let mut sum = index;
    for (bit, column) in (2..).zip(SECOND_HALF) {
        sum ^= column & 0_u32.wrapping_sub(bits >> bit & 1);
    }
    sum
}

/// What bit 2 of an index, bit 3 and so on add to its place: found by a search for points whose
/// four coordinates together are spread evenly, too, most of all 16, 64 and 256 points. Beyond 1024
/// points only the halves themselves become more even.
const SECOND_HALF: [u32; 8] = [2, 3, 3, 1, 0x2e, 0x35, 0x34, 3];

/// The seed that scrambles the second dimension, from the halves of the key.
#[inline(always)]
fn second_seed(low: u32, high: u32) -> u32 {
    high.wrapping_mul(0x9e37_79b1) ^ low
}

/// The second dimension of the sequence, with the most significant digit in the lowest bit.
///
/// Each set bit `i` of the index adds (without carry) row `i` of Pascal's triangle modulo 2. The
/// entry in column `j` of this row is odd if the binary digits of `j` are a subset of those of `i`
/// (Lucas, 1878). So bit `j` of the sum adds up all bits `i` of the index for which `i` has all the
/// digits of `j`. Five steps compute this for all 32 bits, one binary digit each.
#[inline]
fn second_dimension(index: u32) -> u32 {
    let mut sum = index;
    sum ^= sum >> 1 & 0x5555_5555;
    sum ^= sum >> 2 & 0x3333_3333;
    sum ^= sum >> 4 & 0x0f0f_0f0f;
    sum ^= sum >> 8 & 0x00ff_00ff;
    sum ^= sum >> 16;
    sum
}

/// Owen scrambling of a fraction whose most significant digit is the lowest bit of `x`: flips each
/// digit depending on `seed` and on the more significant digits only.
#[inline]
fn scramble(mut x: u32, seed: u32) -> u32 {
    // In each step a bit affects only higher bits of `x`, which are less significant digits.
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The defining property of the sequence, for several keys and all shapes of intervals.
    #[test]
    fn every_elementary_interval_contains_one_point() {
        for (key, half) in [
            (0, 0),
            (1, u32::MAX),
            (0x1234_5678_9abc_def0, 0),
            (!0, u32::MAX),
        ] {
            for k in 0..=10_u32 {
                let points: Vec<[u32; 2]> = (0..1 << k).map(|i| point(i, key, half)).collect();
                for i in 0..=k {
                    let mut occupied = vec![false; 1 << k];
                    for [x, y] in &points {
                        let column = (u64::from(*x) << i) >> 32;
                        let row = (u64::from(*y) << (k - i)) >> 32;
                        let cell = (row << i | column) as usize;
                        assert!(
                            !occupied[cell],
                            "key {key:x}: two of 2^{k} points in cell {cell}"
                        );
                        occupied[cell] = true;
                    }
                }
            }
        }
    }

    /// Of 64 points each elementary interval of a sixteenth of the space holds four.
    #[test]
    fn both_halves_together_are_even() {
        for key in [0, 0x1234_5678_9abc_def0] {
            let both = |i| [point(i, key, 0), point(i, key, u32::MAX)].concat();
            let points: Vec<Vec<u32>> = (0..64).map(both).collect();
            for digits in 0..5_u32.pow(4) {
                let digits = [1, 5, 25, 125].map(|unit| digits / unit % 5);
                if digits.iter().sum::<u32>() != 4 {
                    continue;
                }
                let mut cells = [0; 16];
                for point in &points {
                    let cell = point.iter().zip(digits).fold(0, |cell, (x, count)| {
                        cell << count | (u64::from(*x) << count) >> 32
                    });
                    cells[cell as usize] += 1;
                }
                assert_eq!(cells, [4; 16], "{digits:?}");
            }
        }
    }

    /// The first points of the sequence without scrambling, from Sobol's paper.
    #[test]
    fn second_dimension_is_the_sobol_sequence() {
        let eighths: Vec<u32> = (0..8)
            .map(|i| second_dimension(i).reverse_bits() >> 29)
            .collect();
        assert_eq!(eighths, [0, 4, 6, 2, 5, 1, 3, 7]);
    }

    #[test]
    fn second_dimension_sums_rows_of_pascals_triangle() {
        for index in [1, 2, 3, 0x8000_0000, 0xdead_beef, 0x0123_4567, u32::MAX] {
            let (mut row, mut sum) = (1_u32 << 31, 0);
            for bit in 0..32 {
                if index >> bit & 1 == 1 {
                    sum ^= row;
                }
                row ^= row >> 1;
            }
            assert_eq!(second_dimension(index).reverse_bits(), sum, "{index:x}");
        }
    }

    #[test]
    fn different_keys_give_different_points() {
        assert_ne!(point(3, 1, 0), point(3, 2, 0));
        assert_ne!(point(3, 1, 0), point(3, 1 << 32, 0));
        assert_ne!(point(3, 1, 0), point(3, 1, u32::MAX));
    }
}
