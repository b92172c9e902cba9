//! The pixels that are not empty: in many pictures most camera rays hit nothing.

use crate::beam::BEAM_SIZE;
use crate::{Beam, PathMemory, PathScene, PathStart, ScalarFallback, View};
use fearless_simd::Simd;
use std::ops::Range;

/// The pixels in which something may be visible, and memory that a thread reuses.
#[derive(Clone, Debug, Default)]
pub(crate) struct VisiblePixels {
    pixels: Vec<u32>,
    pending: Vec<Range<usize>>,
}

/// A search for the primitives of a pixel ends when it has found this many: then it has most
/// likely found one in the pixel.
const MAX_FOUND: usize = 16;

impl VisiblePixels {
    /// The numbers of the pixels that [`VisiblePixels::find`] found, in ascending order.
    pub(crate) fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// Finds the pixels of `starts` in which something may be visible: not those whose camera rays
    /// all miss everything for certain and find no background. Counts their rays, `samples` in each
    /// pixel.
    ///
    /// First all pixels together, then one half and the other. Stops at so few pixels that their
    /// rays are a single beam.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "inlined where it is used")]
    pub(crate) fn find<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        view: &View,
        starts: &[PathStart],
        samples: usize,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                self.pixels.clear();
                let may_be_empty = !scene.has_background && !view.has_lens;
                self.pending.push(0..starts.len());
                while let Some(range) = self.pending.pop() {
                    if may_be_empty && let Some(beam) = Beam::through(view, &starts[range.clone()])
                    {
                        let nearby = &mut memory.nearby;
                        let list = nearby.find_in(simd, scene, &beam, MAX_FOUND, fallback);
                        if list.is_some_and(|list| list.len() == 0) {
                            memory.counts.rays += (range.len() * samples) as u64;
                            continue;
                        }
                    }
                    if !may_be_empty || range.len() * samples <= BEAM_SIZE || range.len() == 1 {
                        self.pixels.extend(range.start as u32..range.end as u32);
                        continue;
                    }
                    let middle = range.start + range.len() / 2;
                    self.pending.push(middle..range.end);
                    self.pending.push(range.start..middle);
                }
            },
        )
    }
}
