//! Blocks of eight pixels that share what their paths find (`--reuse-paths`).

use kit::film::Cell;

/// The columns and rows of a block. Blocks lie at multiples of these on the film.
const BLOCK: (u32, u32) = (4, 2);

/// The number of pixels in a block.
pub(super) const BLOCK_AREA: usize = (BLOCK.0 * BLOCK.1) as usize;

/// The pixels of all blocks that have a pixel in `tile`, block by block.
pub(super) fn pixels_of_blocks(tile: Cell) -> Vec<(u32, u32)> {
    let (w, h) = BLOCK;
    let rows = tile.y0 / h..tile.y1.div_ceil(h);
    let blocks = rows.flat_map(|row| {
        let columns = tile.x0 / w..tile.x1.div_ceil(w);
        columns.map(move |column| (column * w, row * h))
    });
    let pixels = blocks.flat_map(|(x, y)| (0..h * w).map(move |i| (x + i % w, y + i / w)));
    pixels.collect()
}

/// The number of the pixel in the order of [`Cell::pixels`], if it is one of `cell`.
pub(super) fn place_in(cell: Cell, (x, y): (u32, u32)) -> Option<usize> {
    let is_inside = (cell.x0..cell.x1).contains(&x) && (cell.y0..cell.y1).contains(&y);
    is_inside.then(|| ((y - cell.y0) * (cell.x1 - cell.x0) + x - cell.x0) as usize)
}
