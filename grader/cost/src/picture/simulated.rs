//! Simulated pictures, for tests.

use super::estimate::ConvergedPair;
use super::program::RenderedPicture;
use kit::PixelSampler;

/// Returns a grey picture with value `2 + offset` and uniform noise of this standard deviation.
pub(super) fn noisy(seed: u32, deviation: f64, offset: f64) -> Vec<[f64; 3]> {
    let mut random = PixelSampler::new(seed, 0, 7);
    let width = deviation * 12.0_f64.sqrt();
    let pixel = |_| [(); 3].map(|()| 2.0 + offset + width * (random.next_1d() - 0.5));
    (0..4000).map(pixel).collect()
}

/// Returns five such pictures with independent noise.
pub(super) fn pictures(deviation: f64, offset: f64, seconds: f64) -> Vec<RenderedPicture> {
    let picture = |seed| RenderedPicture {
        pixels: noisy(seed, deviation, offset),
        seconds,
        samples: None,
    };
    (10..15).map(picture).collect()
}

/// Returns a reference of value 2 with a little noise.
pub(super) fn converged() -> ConvergedPair {
    ConvergedPair::new(noisy(1, 0.1, 0.0), noisy(2, 0.1, 0.0)).expect("pictures")
}
