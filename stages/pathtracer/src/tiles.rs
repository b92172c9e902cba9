//! Renders a film tile by tile, in parallel.

use kit::film::Cell;
use kit::sampler::Sampling;
use kit::{Film, FilmSize, PixelEstimate, PixelSampler};
use rayon::prelude::*;

/// Renders the pixels of `cell` in parallel on rayon's current thread pool.
///
/// `new_state` creates the state of one tile, for example counters. `pixel` is called with that
/// state, the column, the row and the sampler of the pixel. `tile_done` is called with each
/// finished tile and its state. Pixels do not depend on the number of threads or on the order of
/// tiles. Returns the film and the states of all tiles.
pub(crate) fn render<S: Send>(
    size: FilmSize,
    cell: Cell,
    sampling: impl Into<Sampling>,
    new_state: impl Fn() -> S + Sync,
    pixel: impl Fn(&mut S, u32, u32, &mut PixelSampler) -> PixelEstimate + Sync,
    tile_done: impl Fn(Cell, &S) + Sync,
) -> (Film, Vec<S>) {
    let sampling = sampling.into();
    let tile = |state: &mut S, tile: Cell| {
        tile.pixels()
            .map(|(x, y)| pixel(state, x, y, &mut PixelSampler::new(x, y, sampling)))
            .collect()
    };
    render_tiles(size, cell, new_state, tile, tile_done)
}

/// Like [`render`], but `tile` renders a whole tile: it returns one estimate for each pixel, in the
/// order of [`Cell::pixels`].
pub(crate) fn render_tiles<S: Send>(
    size: FilmSize,
    cell: Cell,
    new_state: impl Fn() -> S + Sync,
    tile: impl Fn(&mut S, Cell) -> Vec<PixelEstimate> + Sync,
    tile_done: impl Fn(Cell, &S) + Sync,
) -> (Film, Vec<S>) {
    let tiles: Vec<(Cell, Vec<PixelEstimate>, S)> = cell
        .tiles()
        .into_par_iter()
        .map(|cell| {
            let mut state = new_state();
            let pixels = tile(&mut state, cell);
            assert_eq!(
                pixels.len() as u64,
                cell.area(),
                "`tile` must return one estimate for each pixel of {cell:?}"
            );
            tile_done(cell, &state);
            (cell, pixels, state)
        })
        .collect();
    let mut film = Film::new(size);
    let mut states = Vec::with_capacity(tiles.len());
    for (tile, pixels, state) in tiles {
        for ((x, y), estimate) in tile.pixels().zip(pixels) {
            film.set(x, y, estimate);
        }
        states.push(state);
    }
    (film, states)
}
