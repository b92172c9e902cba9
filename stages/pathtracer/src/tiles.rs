//! Renders tiles in parallel.

use kit::film::Cell;
use kit::sampler::Sampling;
use kit::{PixelEstimate, PixelSampler};
use rayon::prelude::*;

/// Renders the pixels of `tiles` in parallel on rayon's current thread pool.
///
/// `new_state` creates the state of one tile, for example counters. `pixel` is called with that
/// state, the column, the row and the sampler of the pixel. `finish` turns each finished tile, its
/// pixels in the order of [`Cell::pixels`] and its state into a result. Pixels do not depend on the
/// number of threads or on the order of tiles. Returns the results in the order of `tiles`.
pub(crate) fn render<S, R: Send>(
    tiles: &[Cell],
    sampling: impl Into<Sampling>,
    new_state: impl Fn() -> S + Sync,
    pixel: impl Fn(&mut S, u32, u32, &mut PixelSampler) -> PixelEstimate + Sync,
    finish: impl Fn(Cell, Vec<PixelEstimate>, S) -> R + Sync,
) -> Vec<R> {
    let sampling = sampling.into();
    let tile = |state: &mut S, tile: Cell| {
        tile.pixels()
            .map(|(x, y)| pixel(state, x, y, &mut PixelSampler::new(x, y, sampling)))
            .collect()
    };
    render_tiles(tiles, new_state, tile, finish)
}

/// Like [`render`], but `tile` renders a whole tile: it returns one estimate for each pixel, in the
/// order of [`Cell::pixels`].
pub(crate) fn render_tiles<S, R: Send>(
    tiles: &[Cell],
    new_state: impl Fn() -> S + Sync,
    tile: impl Fn(&mut S, Cell) -> Vec<PixelEstimate> + Sync,
    finish: impl Fn(Cell, Vec<PixelEstimate>, S) -> R + Sync,
) -> Vec<R> {
    tiles
        .par_iter()
        .map(|&cell| {
            let mut state = new_state();
            let pixels = tile(&mut state, cell);
            assert_eq!(
                pixels.len() as u64,
                cell.area(),
                "`tile` must return one estimate for each pixel of {cell:?}"
            );
            finish(cell, pixels, state)
        })
        .collect()
}
