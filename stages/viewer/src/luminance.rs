//! The luminances of a picture: false colours and the histogram, on one scale of stops.
//!
//! A stop is a factor of 2. The scale has no unit of its own: the luminance 1 is at stop 0.

use kit::Spectrum;
use pathtracer::rate_picture::viridis;

/// The stop at the left end of the scale. What is darker is counted there.
pub const FIRST_STOP: i32 = -10;
/// The stop at the right end of the scale. What is brighter is counted there.
pub const LAST_STOP: i32 = 4;
/// The bars of the histogram for each stop.
const BARS_PER_STOP: usize = 4;
/// The number of bars of a histogram.
pub const BARS: usize = (LAST_STOP - FIRST_STOP) as usize * BARS_PER_STOP;
/// The colour of what is not a number, as in pictures.
const NOT_A_NUMBER: [u8; 3] = [255, 0, 255];

/// Where a luminance is on the scale, from 0 to 1; `None` if it is not a number.
pub fn place(luminance: f64) -> Option<f64> {
    let stops = f64::from(LAST_STOP - FIRST_STOP);
    let place = (luminance.max(0.0).log2() - f64::from(FIRST_STOP)) / stops;
    (!luminance.is_nan()).then(|| place.clamp(0.0, 1.0))
}

/// The false colour of a radiance, exposed by this many stops.
pub fn false_color(radiance: Spectrum, exposure: f64) -> [u8; 3] {
    place(radiance.luminance() * exposure.exp2()).map_or(NOT_A_NUMBER, viridis)
}

/// How many pixels have which luminance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Histogram {
    /// The pixels of each bar, from the left.
    pub bars: [usize; BARS],
    /// Pixels without light; no bar counts them.
    pub black: usize,
    /// Pixels whose luminance is above 1.
    pub above_one: usize,
    /// Pixels that are not a number; no bar counts them.
    pub not_a_number: usize,
    /// All pixels.
    pub pixels: usize,
}

impl Histogram {
    /// Counts the pixels of a picture, exposed by this many stops.
    pub fn of(radiances: impl IntoIterator<Item = Spectrum>, exposure: f64) -> Histogram {
        let mut histogram = Histogram {
            bars: [0; BARS],
            black: 0,
            above_one: 0,
            not_a_number: 0,
            pixels: 0,
        };
        let factor = exposure.exp2();
        for radiance in radiances {
            let luminance = factor * radiance.luminance();
            histogram.pixels += 1;
            match place(luminance) {
                None => histogram.not_a_number += 1,
                Some(_) if luminance <= 0.0 => histogram.black += 1,
                Some(place) => {
                    let bar = (place * BARS as f64) as usize;
                    histogram.bars[bar.min(BARS - 1)] += 1;
                    histogram.above_one += usize::from(luminance > 1.0);
                }
            }
        }
        histogram
    }

    /// The pixels of the highest bar, at least 1.
    pub fn highest(&self) -> usize {
        self.bars.iter().copied().max().unwrap_or(0).max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_is_counted_once() {
        let grey = [0.0, 1e-9, 0.5, 0.5, 1.0, 2.0, 1e9, f64::NAN].map(Spectrum::grey);
        let histogram = Histogram::of(grey, 0.0);
        let in_bars: usize = histogram.bars.iter().sum();
        assert_eq!(histogram.pixels, 8);
        assert_eq!(in_bars + histogram.black + histogram.not_a_number, 8);
        assert_eq!((histogram.black, histogram.not_a_number), (1, 1));
        assert_eq!(histogram.above_one, 2, "2 and 1e9");
        let bar = |stop: i32| (stop - FIRST_STOP) as usize * BARS_PER_STOP;
        // The luminance of grey may be rounded down to the bar before.
        let near = |at: usize| histogram.bars[at - 1] + histogram.bars[at];
        assert_eq!([near(bar(-1)), near(bar(0)), near(bar(1))], [2, 1, 1]);
        assert_eq!((histogram.bars[0], histogram.bars[BARS - 1]), (1, 1));
    }

    #[test]
    fn a_stop_of_exposure_moves_by_a_stop() {
        let stops = f64::from(LAST_STOP - FIRST_STOP);
        let moved = place(0.2).zip(place(0.4)).map(|(a, b)| b - a);
        assert!((moved.expect("numbers") - 1.0 / stops).abs() < 1e-12);
        let dim = Spectrum::new(0.1, 0.3, 0.2);
        assert_eq!(false_color(dim, 1.0), false_color(dim * 2.0, 0.0));
        assert_eq!(false_color(Spectrum::grey(f64::NAN), 0.0), NOT_A_NUMBER);
        assert_eq!(false_color(Spectrum::BLACK, 0.0), viridis(0.0));
    }
}
