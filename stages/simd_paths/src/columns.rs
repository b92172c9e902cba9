//! A table of numbers whose rows are appended from lanes and loaded into lanes.

use crate::vec3x8::LANES;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};

/// Rows of `N` numbers, stored by columns.
#[derive(Clone, Debug)]
pub(crate) struct Columns<const N: usize> {
    count: usize,
    columns: [Vec<f64>; N],
}

impl<const N: usize> Default for Columns<N> {
    fn default() -> Columns<N> {
        Columns {
            count: 0,
            columns: std::array::from_fn(|_| Vec::new()),
        }
    }
}

impl<const N: usize> Columns<N> {
    /// Removes all rows.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    /// The number of rows.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Column number `i`: the numbers of all rows and others behind them.
    pub(crate) fn column(&self, i: usize) -> &[f64] {
        &self.columns[i]
    }

    /// Appends the rows in the lanes of `mask`.
    #[inline(always)]
    pub(crate) fn push<S: Simd>(&mut self, rows: [f64x8<S>; N], mask: mask64x8<S>) {
        let end = self.count + LANES;
        // Eight numbers are loaded from any row.
        let size = end + LANES;
        if self.columns[0].len() < size {
            for column in &mut self.columns {
                column.resize(2 * size, 0.0);
            }
        }
        for (row, column) in rows.iter().zip(&mut self.columns) {
            let compressed = row.compress(mask);
            compressed.store_slice(&mut column[self.count..end]);
        }
        self.count += mask.to_bitmask().count_ones() as usize;
    }

    /// Row number `row`, which exists.
    pub(crate) fn row(&self, row: usize) -> [f64; N] {
        self.columns.each_ref().map(|column| column[row])
    }

    /// Replaces row number `row`, which exists.
    #[inline(always)]
    pub(crate) fn set(&mut self, row: usize, numbers: [f64; N]) {
        for (column, number) in self.columns.iter_mut().zip(numbers) {
            column[row] = number;
        }
    }

    /// Loads eight rows from number `first`, which exists. Lanes after the last row have any
    /// numbers.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, first: usize) -> [f64x8<S>; N] {
        let mut rows = [f64x8::splat(simd, 0.0); N];
        for (row, column) in rows.iter_mut().zip(&self.columns) {
            *row = f64x8::from_slice(simd, &column[first..first + LANES]);
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::Level;
    use lanes::dispatch;

    #[test]
    fn rows_are_loaded_in_the_order_in_which_they_were_pushed() {
        dispatch!(Level::new(), simd => check(simd));
    }

    /// Pushes rows until there are many, each time as many as the bits of a number.
    #[inline(always)]
    fn check<S: Simd>(simd: S) {
        let mut columns = Columns::<2>::default();
        let mut expected = Vec::new();
        for bits in 0..256 {
            let row = f64x8::from_fn(simd, |lane| (8 * bits + lane as u64) as f64);
            columns.push([row, -row], mask64x8::from_bitmask(simd, bits));
            let pushed = (0..LANES).filter(|lane| bits >> lane & 1 == 1);
            expected.extend(pushed.map(|lane| row[lane]));
            assert_eq!(columns.count(), expected.len());
            for (first, rows) in (0..).step_by(LANES).zip(expected.chunks(LANES)) {
                let [loaded, negative] = columns.load(simd, first);
                for (lane, &number) in rows.iter().enumerate() {
                    assert_eq!((loaded[lane], negative[lane]), (number, -number));
                }
            }
        }
        columns.clear();
        assert_eq!(columns.count(), 0);
    }
}
