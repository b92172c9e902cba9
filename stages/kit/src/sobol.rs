//! Points that cover the square evenly, and still at random: Sobol's sequence in two dimensions, scrambled.
//!
//! Among the first 2ᵏ points every elementary interval (a rectangle of 2⁻ⁱ by 2ⁱ⁻ᵏ) holds exactly one point, where
//! independent points clump and leave gaps: the error of a mean falls nearly like 1/n on smooth integrands instead of
//! 1/√n. Owen's scrambling ("Randomly permuted (t,m,s)-nets", 1995) keeps that and makes every point uniform, so
//! estimates stay right on average. It is done by hashing, as in Burley, "Practical hash-based Owen scrambling" (JCGT
//! 2020), with the hash of Laine and Karras in the form that Vegdahl mended.
//!
//! More dimensions are made of such pairs, each with its own scrambling and its points in an order of its own, so that
//! pairs know nothing of each other. The order shuffles blocks of 2ᵏ points within themselves: the first 2ᵏ samples
//! of every pair are still even.

/// Point number `index` of the scrambled sequence number `key`: two numbers in units of 2⁻³².
#[inline]
pub(crate) fn point(index: u32, key: u64) -> [u32; 2] {
    let (low, high) = (key as u32, (key >> 32) as u32);
    // Scrambling an index moves blocks of 2ᵏ points as a whole: any such block is as even as the first.
    let index = scramble(index.reverse_bits(), low).reverse_bits();
    // The first dimension of the sequence is the index with its bits reversed (van der Corput).
    let x = scramble(index, high);
    let y = scramble(second_dimension(index), second_seed(low, high));
    // Both are turned round at once: that is what costs most here.
    let xy = (u64::from(x) << 32 | u64::from(y)).reverse_bits();
    [xy as u32, (xy >> 32) as u32]
}

/// [`point`] for each of several indices and keys: all first numbers, all second ones.
#[inline(always)]
pub(crate) fn points<const N: usize>(indices: &[u32; N], keys: &[u64; N]) -> [[u32; N]; 2] {
    let (mut low, mut high, mut index) = ([0; N], [0; N], *indices);
    for i in 0..N {
        (low[i], high[i]) = (keys[i] as u32, (keys[i] >> 32) as u32);
    }
    reverse_bits(&mut index);
    for i in 0..N {
        index[i] = scramble(index[i], low[i]);
    }
    reverse_bits(&mut index);
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

/// The seed that scrambles the second dimension, from the halves of the key.
#[inline(always)]
fn second_seed(low: u32, high: u32) -> u32 {
    high.wrapping_mul(0x9e37_79b1) ^ low
}

/// The second dimension, its highest digit in the lowest bit: each bit of the index adds, without carry, a row of Pascal's
/// triangle modulo 2.
///
/// There a number is odd if the digits of its column are among those of its row (Lucas, 1878). So bit `j` of the sum is
/// the sum of the index's bits whose numbers have all the digits of `j`, and five steps add up all 32, a digit each.
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

/// Owen's scrambling of a fraction whose highest digit is the lowest bit of `x`: flips every digit or not, depending on
/// `seed` and the digits before it, and on nothing after it.
#[inline]
fn scramble(mut x: u32, seed: u32) -> u32 {
    // Every step lets a bit change only bits above it, which are the digits after it.
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

    /// The property that makes the sequence what it is, for several keys and every shape of interval.
    #[test]
    fn every_elementary_interval_holds_one_point() {
        for key in [0, 1, 0x1234_5678_9abc_def0, u64::MAX] {
            for k in 0..=10_u32 {
                let points: Vec<[u32; 2]> = (0..1 << k).map(|i| point(i, key)).collect();
                for i in 0..=k {
                    let mut seen = vec![false; 1 << k];
                    for [x, y] in &points {
                        let column = (u64::from(*x) << i) >> 32;
                        let row = (u64::from(*y) << (k - i)) >> 32;
                        let cell = (row << i | column) as usize;
                        assert!(
                            !seen[cell],
                            "key {key:x}: two of 2^{k} points in cell {cell}"
                        );
                        seen[cell] = true;
                    }
                }
            }
        }
    }

    /// The first points of the plain sequence, from Sobol's paper.
    #[test]
    fn the_second_dimension_is_sobols() {
        let eighths: Vec<u32> = (0..8)
            .map(|i| second_dimension(i).reverse_bits() >> 29)
            .collect();
        assert_eq!(eighths, [0, 4, 6, 2, 5, 1, 3, 7]);
    }

    #[test]
    fn the_rows_are_those_of_pascals_triangle() {
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
    fn keys_give_different_points() {
        assert_ne!(point(3, 1), point(3, 2));
        assert_ne!(point(3, 1), point(3, 1 << 32));
    }
}
