//! Two pictures of one size, where they differ, and why.

use kit::FilmSize;
use pictures::Image;
use pictures::difference::{Mark, compare_panel};
use pictures::image::Rgb;

pub use judge::pictures::Differences;

/// Two pictures of one size and their difference.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePair {
    /// What they show; for a picture of several panels, from top to bottom.
    pub about: Vec<String>,
    /// The picture that is judged: that of the student, or A.
    pub first: Image,
    /// The picture that it is compared with: the golden one, or B.
    pub second: Image,
    /// The first picture in grey, coloured where it differs.
    pub difference: Image,
    /// The causes that occur.
    pub legend: Vec<CauseCount>,
}

/// A cause of differences and how many pixels it has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CauseCount {
    /// The cause in a few words.
    pub label: &'static str,
    /// Its colour in the picture of differences.
    pub color: Rgb,
    /// The number of pixels.
    pub pixels: usize,
}

impl CauseCount {
    /// The causes that `marks` stand for.
    pub fn of_marks(marks: impl IntoIterator<Item = (Mark, usize)>) -> Vec<CauseCount> {
        let marks = marks.into_iter();
        marks
            .map(|(mark, pixels)| CauseCount {
                label: mark.label(),
                color: mark.colour(),
                pixels,
            })
            .collect()
    }
}

impl PicturePair {
    /// Compares `first` with `second`, pixel by pixel or, where both are noisy, block by block; `None`
    /// if their sizes differ.
    pub fn of(first: Image, second: Image, differences: Differences) -> Option<PicturePair> {
        if first.size() != second.size() {
            return None;
        }
        let compared = compare_panel(differences, &second, &first);
        Some(PicturePair {
            about: Vec::new(),
            legend: CauseCount::of_marks(compared.counts.into_iter().flatten()),
            difference: compared.difference,
            first,
            second,
        })
    }

    /// Width and height.
    pub fn size(&self) -> FilmSize {
        let [w, h] = self.first.size();
        FilmSize { w, h }
    }
}

/// How two pictures are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PairView {
    /// The first to the left of a line that the mouse moves, the second to the right.
    #[default]
    Wipe,
    /// Both in turns.
    Flicker,
    /// The first.
    First,
    /// The second.
    Second,
    /// Where they differ, by cause.
    Difference,
}

impl PairView {
    /// All ways, in the order of the key.
    pub const ALL: [PairView; 5] = [
        PairView::Wipe,
        PairView::Flicker,
        PairView::First,
        PairView::Second,
        PairView::Difference,
    ];

    /// The next way.
    pub fn next(self) -> PairView {
        let at = PairView::ALL.iter().position(|view| *view == self);
        PairView::ALL[(at.unwrap_or(0) + 1) % PairView::ALL.len()]
    }
}

/// How two pictures are shown, and where the line between them is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairDisplay {
    /// What is visible.
    pub view: PairView,
    /// The share of the width, from the left, that shows the first picture.
    pub wipe: f32,
}

impl Default for PairDisplay {
    fn default() -> PairDisplay {
        PairDisplay {
            view: PairView::Wipe,
            wipe: 0.5,
        }
    }
}

impl PairDisplay {
    /// Flickers, or no longer.
    pub fn toggle_flicker(&mut self) {
        self.view = match self.view {
            PairView::Flicker => PairView::Wipe,
            _ => PairView::Flicker,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differing_pixels_are_counted_by_cause() {
        let first = Image::from_fn([2, 1], |x, _| [[0; 3], [9; 3]][x as usize]);
        let second = Image::filled([2, 1], [9; 3]);
        let pair = PicturePair::of(first.clone(), second, Differences::Normals).expect("one size");
        let [cause] = pair.legend.as_slice() else {
            panic!("one cause: {:?}", pair.legend)
        };
        assert_eq!((cause.label, cause.pixels), (Mark::FalseMiss.label(), 1));
        assert_eq!(pair.difference.get(0, 0), cause.color);
        let other = Image::filled([1, 1], [0; 3]);
        assert_eq!(PicturePair::of(first, other, Differences::Values), None);
    }

    #[test]
    fn the_key_goes_through_all_views() {
        let mut view = PairView::Wipe;
        for _ in PairView::ALL {
            view = view.next();
        }
        assert_eq!(view, PairView::Wipe);
    }
}
