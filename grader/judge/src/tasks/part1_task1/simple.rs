//! Simple pixels: few samples on small films.

use wire::work::{PixelWork, PixelWorld};

/// The simple questions about pixels: one sample first, then the means of a few.
pub(crate) fn questions() -> Vec<PixelWork> {
    let one_sample =
        [[1, 1], [2, 1], [1, 2], [2, 2], [4, 2]].map(|film| work(film, 1, PixelWorld::Ramp));
    let white = PixelWorld::Constant([1.0; 3]);
    let blinking = PixelWorld::Flicker([2.0; 3]);
    let bright = PixelWorld::Constant([8.0, 4.0, 2.0]);
    let mut questions = one_sample.to_vec();
    for samples in [1, 2, 4] {
        questions.extend([white, bright].map(|world| work([1, 1], samples, world)));
    }
    questions.push(work([1, 1], 2, blinking));
    questions.push(work([2, 2], 4, blinking));
    questions.push(work([2, 2], 3, PixelWorld::Ramp));
    questions.push(work([2, 2], 4, PixelWorld::Ramp));
    questions.push(work([2, 2], 16, PixelWorld::Ramp));
    questions
}

/// All pixels of a film.
fn work(film: [u32; 2], ns_aa: u32, world: PixelWorld) -> PixelWork {
    let [w, h] = film;
    let pixels = (0..h).flat_map(|y| (0..w).map(move |x| [x, y]));
    PixelWork {
        film,
        pixels: pixels.collect(),
        ns_aa,
        seeds: vec![0],
        world,
        gain: [1.0; 3],
    }
}
