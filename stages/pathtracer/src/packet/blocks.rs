//! Tiles whose pixels share what their paths find, in blocks of eight (`--reuse-paths`).

use super::{MAX_SAMPLES, Memory, PacketRenderer};
use crate::exact_sum::PixelSum;
use crate::integrator::PathIntegrator;
use kit::film::Cell;
use kit::{PixelEstimate, PixelSampler, Tally};
use simd_paths::PathStart;
use std::cell;
use std::sync::atomic::{AtomicBool, Ordering};

/// The columns and rows of a block. Blocks lie at multiples of these on the film.
const BLOCK: (u32, u32) = (4, 2);
const BLOCK_AREA: usize = (BLOCK.0 * BLOCK.1) as usize;

impl<'a> PacketRenderer<'a> {
    /// The pixels of `tile`. Blocks that are partly outside of it are traced as a whole, so that a
    /// pixel is the same in every cell of the picture.
    pub(super) fn tile_in_blocks(
        &self,
        integrator: &mut PathIntegrator<'a>,
        tile: Cell,
        stop: &AtomicBool,
    ) -> Vec<PixelEstimate> {
        let mut memory = Memory::default();
        let mut finished = vec![(PixelSum::default(), Tally::default()); tile.area() as usize];
        let pixels = pixels_of_blocks(tile);
        let at_once = (self.job.samples as usize).min(MAX_SAMPLES / BLOCK_AREA);
        for pixels in pixels.chunks((MAX_SAMPLES / at_once).next_multiple_of(BLOCK_AREA)) {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let mut starts: Vec<PathStart> = pixels
                .iter()
                .map(|&(x, y)| PathStart {
                    pixel: (x, y),
                    sampler: PixelSampler::new(x, y, self.job.sampling),
                })
                .collect();
            let removed = vec![cell::Cell::default(); starts.len()];
            let mut left = self.job.samples;
            while left > 0 {
                let count = left.min(at_once as u32);
                let samples = self.trace(integrator, &mut memory, &mut starts, count, &removed);
                for (&pixel, samples) in pixels.iter().zip(samples.chunks(count as usize)) {
                    let Some(place) = place_in(tile, pixel) else {
                        continue;
                    };
                    let (sum, luminance) = &mut finished[place];
                    for &radiance in samples {
                        luminance.push(radiance.luminance());
                        sum.push(radiance);
                    }
                }
                left -= count;
            }
        }
        integrator.add_counts(memory.paths.counts);
        let finished = finished.into_iter();
        finished
            .map(|(sum, luminance)| integrator.finish_pixel(sum, luminance))
            .collect()
    }
}

/// The pixels of all blocks that have a pixel in `tile`, block by block.
fn pixels_of_blocks(tile: Cell) -> Vec<(u32, u32)> {
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
