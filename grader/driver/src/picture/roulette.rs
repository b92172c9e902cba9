//! The picture of Part 4, task 3.

use super::{Panel, panel};
use crate::stages::Global;
use kit::Spectrum;

/// The largest channel at the right edge of a column.
const BRIGHTEST: f64 = 1.25;

/// Colours are this much darker than the throughput, so that a throughput of 1 is not yet white.
const EXPOSURE: f64 = 0.55;

/// The colour of paths that end.
const ENDED: [f64; 3] = [0.02, 0.02, 0.22];

/// The numbers `u` of which the second panel shows the mean.
const NUMBERS: u32 = 256;

/// A column for each number of bounces.
pub(super) fn roulette(stage: &Global, size: [u32; 2], bounces: &[u32]) -> Vec<Panel> {
    let columns = bounces.len() as u32;
    let width = size[0] / columns;
    let of_pixel = |x: u32| {
        let column = (x / width).min(columns - 1);
        let share = (f64::from(x - column * width) + 0.5) / f64::from(width);
        let throughput = Spectrum::new(1.0, 0.6, 0.25) * (share * BRIGHTEST);
        (bounces[column as usize], throughput)
    };
    let played = panel(size, |x, y| {
        let (bounces, throughput) = of_pixel(x);
        let u = (f64::from(y) + 0.5) / f64::from(size[1]);
        let survivor = (stage.play_roulette)(throughput, bounces, u);
        survivor.map_or(ENDED, |throughput| (throughput * EXPOSURE).to_array())
    });
    // The mean depends on the column of pixels alone.
    let means: Vec<Spectrum> = (0..size[0])
        .map(|x| {
            let (bounces, throughput) = of_pixel(x);
            let numbers = (0..NUMBERS).map(|i| (f64::from(i) + 0.5) / f64::from(NUMBERS));
            let survivors = numbers.filter_map(|u| (stage.play_roulette)(throughput, bounces, u));
            survivors.sum::<Spectrum>() / f64::from(NUMBERS)
        })
        .collect();
    let compared = panel(size, |x, y| {
        let shown = match 2 * y < size[1] {
            true => of_pixel(x).1,
            false => means[x as usize],
        };
        (shown * EXPOSURE).to_array()
    });
    vec![played, compared]
}
