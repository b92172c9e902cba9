//! Compares the picture of a task with its golden.

use crate::Image;
use crate::image::Rgb;
use crate::palette;
use judge::pictures::{Differences, TaskPicture};

/// What differs at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// A hit where the golden misses.
    FalseHit,
    /// A miss where the golden hits.
    FalseMiss,
    /// A hit with another normal.
    Normal,
    /// A hit at another distance.
    Distance,
    /// Another colour.
    Value,
    /// Brighter than the golden, by more than the noise.
    Brighter,
    /// Darker than the golden, by more than the noise.
    Darker,
    /// Another colour, in a picture that can be right in many ways.
    Choice,
}

impl Mark {
    const ALL: [Mark; 8] = [
        Mark::FalseHit,
        Mark::FalseMiss,
        Mark::Normal,
        Mark::Distance,
        Mark::Value,
        Mark::Brighter,
        Mark::Darker,
        Mark::Choice,
    ];

    /// The text in the legend.
    pub fn label(self) -> &'static str {
        match self {
            Mark::FalseHit => "hit where there is nothing",
            Mark::FalseMiss => "black where there is a surface",
            Mark::Normal => "another normal",
            Mark::Distance => "another distance",
            Mark::Value => "another value",
            Mark::Brighter => "too bright",
            Mark::Darker => "too dark",
            Mark::Choice => "differs, which can be right",
        }
    }

    /// Its colour in the picture of differences.
    pub fn colour(self) -> Rgb {
        match self {
            Mark::FalseHit | Mark::Brighter => palette::VERMILION,
            Mark::FalseMiss | Mark::Darker => palette::SKY_BLUE,
            Mark::Normal => palette::PURPLE,
            Mark::Distance => palette::YELLOW,
            Mark::Value => palette::ORANGE,
            Mark::Choice => palette::GREEN,
        }
    }
}

/// The differences of a picture from its golden.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The picture in grey, coloured where it differs.
    pub difference: Image,
    /// For each panel, the number of pixels with each mark that occurs.
    pub counts: Vec<Vec<(Mark, usize)>>,
}

impl Comparison {
    /// Whether nothing differs.
    pub fn is_same(&self) -> bool {
        self.counts.iter().all(Vec::is_empty)
    }
}

/// Compares `yours` with `golden`, which both have the size of `picture`.
///
/// # Panics
///
/// If they do not.
pub fn compare(picture: &TaskPicture, golden: &Image, yours: &Image) -> Comparison {
    for image in [golden, yours] {
        assert_eq!(image.size(), picture.size(), "{}", picture.task);
    }
    let [w, h] = picture.work.size;
    let mut difference = Image::filled(picture.size(), [0; 3]);
    let mut counts = Vec::new();
    for (number, kind) in (0..).zip(picture.panels) {
        let panel = |image: &Image| Image::from_fn([w, h], |x, y| image.get(x, number * h + y));
        let of_panel = compare_panel(kind.differences, &panel(golden), &panel(yours));
        difference.paste(&of_panel.difference, 0, number * h);
        counts.extend(of_panel.counts);
    }
    Comparison { difference, counts }
}

/// Compares two pictures of one size as one panel.
///
/// # Panics
///
/// If their sizes differ.
pub fn compare_panel(kind: Differences, golden: &Image, yours: &Image) -> Comparison {
    assert_eq!(golden.size(), yours.size());
    let [w, _] = yours.size();
    let mut difference = Image::from_fn(yours.size(), |x, y| palette::dimmed(yours.get(x, y)));
    let marks = marks(kind, golden, yours);
    for (mark, i) in marks.iter().zip(0..) {
        if let Some(mark) = mark {
            difference.set(i % w, i / w, mark.colour());
        }
    }
    let count = |mark| marks.iter().filter(|m| **m == Some(mark)).count();
    let counted = Mark::ALL.map(|mark| (mark, count(mark)));
    Comparison {
        difference,
        counts: vec![counted.into_iter().filter(|(_, n)| *n > 0).collect()],
    }
}

/// The mark of each pixel, row by row from the top left.
fn marks(kind: Differences, golden: &Image, yours: &Image) -> Vec<Option<Mark>> {
    if kind == Differences::Noise {
        return beyond_noise(golden, yours);
    }
    let pairs = golden.pixels().iter().zip(yours.pixels());
    let mark = |(golden, yours): (&Rgb, &Rgb)| {
        if golden == yours {
            return None;
        }
        let hits = [golden, yours].map(|colour| *colour != [0; 3]);
        Some(match (kind, hits) {
            (Differences::Choice, _) => Mark::Choice,
            (Differences::Values | Differences::Noise, _) => Mark::Value,
            (_, [false, true]) => Mark::FalseHit,
            (_, [true, false]) => Mark::FalseMiss,
            (Differences::Normals, _) => Mark::Normal,
            (Differences::Distances, _) => Mark::Distance,
        })
    };
    pairs.map(mark).collect()
}

/// The side of the blocks of pixels whose means are compared.
const BLOCK: u32 = 8;

/// How many standard errors the mean of a block may differ. Of the 1200 blocks of a panel, one in
/// ten million panels of right code has one that differs by more.
const STANDARD_ERRORS: f64 = 6.5;

/// The smallest difference of means that counts, in bytes: less than the steps of noisy panels.
const SMALLEST: f64 = 2.5;

/// Marks the blocks of pixels whose means differ by more than the noise of their pixels explains.
fn beyond_noise(golden: &Image, yours: &Image) -> Vec<Option<Mark>> {
    let [w, h] = golden.size();
    let mut marks = vec![None; golden.pixels().len()];
    for top in (0..h).step_by(BLOCK as usize) {
        for left in (0..w).step_by(BLOCK as usize) {
            let columns = left..w.min(left + BLOCK);
            let rows = top..h.min(top + BLOCK);
            let places: Vec<(u32, u32)> = rows
                .flat_map(|y| columns.clone().map(move |x| (x, y)))
                .collect();
            let Some(mark) = of_block(golden, yours, &places) else {
                continue;
            };
            for (x, y) in places {
                marks[(y * w + x) as usize] = Some(mark);
            }
        }
    }
    marks
}

/// The mark of a block of pixels, by the channel that differs most.
fn of_block(golden: &Image, yours: &Image, places: &[(u32, u32)]) -> Option<Mark> {
    let n = places.len() as f64;
    let mut worst = (0.0, None);
    for channel in 0..3 {
        let of = |image: &Image, &(x, y): &(u32, u32)| f64::from(image.get(x, y)[channel]);
        let differences: Vec<f64> = places
            .iter()
            .map(|place| of(yours, place) - of(golden, place))
            .collect();
        let mean = differences.iter().sum::<f64>() / n;
        let squares = differences.iter().map(|d| (d - mean) * (d - mean));
        // One byte of rounding, so that equal differences have an error, too.
        let variance = squares.sum::<f64>() / (n - 1.0).max(1.0) + 1.0;
        let allowed = (STANDARD_ERRORS * (variance / n).sqrt()).max(SMALLEST);
        if mean.abs() > allowed && mean.abs() / allowed > worst.0 {
            let mark = if mean > 0.0 {
                Mark::Brighter
            } else {
                Mark::Darker
            };
            worst = (mean.abs() / allowed, Some(mark));
        }
    }
    worst.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small(task: &str) -> TaskPicture {
        let mut picture = judge::pictures::of(task).expect("the task has a picture");
        picture.work.size = [16, 16];
        picture
    }

    #[test]
    fn black_is_a_miss_and_another_colour_another_field() {
        let picture = small("part1.task3");
        let golden = Image::from_fn(picture.size(), |x, _| [if x < 8 { 0 } else { 90 }; 3]);
        let mut yours = golden.clone();
        assert!(compare(&picture, &golden, &yours).is_same());
        yours.set(0, 0, [1; 3]);
        yours.set(9, 1, [0; 3]);
        yours.set(9, 2, [91; 3]);
        yours.set(9, 17, [91; 3]);
        let comparison = compare(&picture, &golden, &yours);
        let once = [Mark::FalseHit, Mark::FalseMiss, Mark::Normal].map(|mark| (mark, 1));
        assert_eq!(
            comparison.counts,
            [once.to_vec(), vec![(Mark::Distance, 1)]]
        );
        assert_eq!(comparison.difference.get(9, 1), Mark::FalseMiss.colour());
        assert_eq!(comparison.difference.get(10, 1), [45; 3]);
    }

    /// Two pictures of independent noise around 100, and around 100 and `mean`.
    fn noisy(picture: &TaskPicture, mean: f64) -> [Image; 2] {
        let image = |seed, mean: f64| {
            Image::from_fn(picture.size(), |x, y| {
                let u = kit::PixelSampler::new(x, y, seed).next_1d();
                [(mean + 60.0 * (u - 0.5)) as u8; 3]
            })
        };
        [image(1, 100.0), image(2, mean)]
    }

    #[test]
    fn noise_is_no_difference_and_a_bias_is() {
        let picture = small("part3.task2");
        let [golden, yours] = noisy(&picture, 100.0);
        assert!(golden != yours && compare(&picture, &golden, &yours).is_same());
        let [golden, yours] = noisy(&picture, 125.0);
        let all = 16 * 16;
        let found = |golden, yours| compare(&picture, golden, yours).counts[0].clone();
        assert_eq!(found(&golden, &yours), [(Mark::Brighter, all)]);
        assert_eq!(found(&yours, &golden), [(Mark::Darker, all)]);
    }
}
