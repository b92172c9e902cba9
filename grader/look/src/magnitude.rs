//! How much the colours of two pictures differ, as a picture.

use pictures::image::Rgb;
use pictures::{Image, palette};

/// The colours of the steps, from small differences to large ones: samples of viridis, whose
/// brightness grows evenly for all eyes.
const STEPS: [Rgb; 8] = [
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [68, 191, 112],
    [157, 217, 59],
    [253, 231, 37],
];

/// Each step of the legend: its least difference of a channel, and its colour. A step ends where
/// the next begins, at twice its least difference.
pub fn legend() -> impl Iterator<Item = (u32, Rgb)> {
    (0..).map(|step| 1 << step).zip(STEPS)
}

/// The actual picture in grey, coloured where its colours differ from the golden by the largest
/// difference of a channel. `None` if the sizes differ.
pub fn image(golden: &Image, actual: &Image) -> Option<Image> {
    let colour = |x, y| {
        let (a, b) = (golden.get(x, y), actual.get(x, y));
        let channels = a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b));
        match channels.max().unwrap_or(0).checked_ilog2() {
            None => palette::dimmed(b),
            Some(step) => STEPS[step as usize],
        }
    };
    (golden.size() == actual.size()).then(|| Image::from_fn(actual.size(), colour))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_has_the_step_of_its_largest_channel() {
        let golden = Image::filled([4, 1], [100; 3]);
        let mut actual = golden.clone();
        actual.set(1, 0, [100, 101, 100]);
        actual.set(2, 0, [95, 100, 102]);
        actual.set(3, 0, [255, 100, 100]);
        let image = image(&golden, &actual).expect("the sizes are equal");
        let step = |least: u32| legend().find(|(from, _)| *from == least).map(|(_, c)| c);
        let colours = [1, 2, 3].map(|x| Some(image.get(x, 0)));
        assert_eq!(image.get(0, 0), palette::dimmed([100; 3]));
        assert_eq!(colours, [step(1), step(4), step(128)]);
    }
}
