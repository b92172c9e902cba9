//! Examples of pixels with one sample.
//!
//! A point is right if it is in the middle of its pixel: it is turned into pixels, and its distance
//! from the pixel's corner is compared with a half. So a handout judges examples without the code
//! that makes the point.

use kit::Vec2;
use wire::Work;
use wire::work::{PixelWork, PixelWorld};

/// A pixel, and the point of the film that a student expects `generate_ray` to get for its only
/// sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelExample {
    /// Width and height of the film.
    pub film: [u32; 2],
    /// Column and row, counted from the bottom left.
    pub pixel: [u32; 2],
    /// The point of the film, from (0, 0) to (1, 1).
    pub expected: Vec2,
}

/// The situations of pixels.
pub(super) const SITUATIONS: &[&str] = &[
    "a film of one pixel",
    "the first pixel of several",
    "the last pixel of several",
    "another column than the first",
    "another row than the first",
    "a film that is not a square",
];

/// How far a point that is written by hand may be from the middle, in pixels.
const ALLOWED: f64 = 0.02;

fn of_pair([x, y]: [u32; 2]) -> Vec2 {
    Vec2::new(x.into(), y.into())
}

pub(super) fn verdict(example: &PixelExample) -> Option<String> {
    let PixelExample {
        film,
        pixel,
        expected,
    } = *example;
    if (0..2).any(|i| pixel[i] >= film[i]) {
        return Some("its pixel is not on the film: columns and rows begin with 0".into());
    }
    let inside = expected * of_pair(film) - of_pair(pixel);
    let is_middle = (inside - 0.5).abs().max_element() <= ALLOWED;
    (!is_middle).then(|| {
        format!(
            "its point is {:.2} pixels to the right of the pixel's left edge and {:.2} above its lower edge: a single sample is in the middle",
            inside.x, inside.y
        )
    })
}

impl PixelExample {
    pub(super) fn situations(&self) -> Vec<&'static str> {
        let ([w, h], [x, y]) = (self.film, self.pixel);
        let is_one = w == 1 && h == 1;
        let touched = [
            is_one,
            !is_one && x == 0 && y == 0,
            !is_one && x + 1 == w && y + 1 == h,
            x > 0,
            y > 0,
            w != h,
        ];
        let each = SITUATIONS.iter().zip(touched);
        each.filter(|(_, is)| *is).map(|(name, _)| *name).collect()
    }

    pub(super) fn work(&self) -> Work {
        Work::Pixels(PixelWork {
            film: self.film,
            pixels: vec![self.pixel],
            ns_aa: 1,
            seeds: vec![0],
            world: PixelWorld::Ramp,
            gain: [1.0; 3],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(film: [u32; 2], pixel: [u32; 2], expected: [f64; 2]) -> PixelExample {
        PixelExample {
            film,
            pixel,
            expected: expected.into(),
        }
    }

    #[test]
    fn a_point_in_the_middle_of_the_pixel_is_right() {
        let third = example([3, 1], [1, 0], [0.5, 0.5]);
        assert_eq!(verdict(&third), None);
        let rounded = example([3, 1], [0, 0], [0.167, 0.5]);
        assert_eq!(verdict(&rounded), None);
        let corner = verdict(&example([4, 2], [1, 0], [0.25, 0.0]));
        assert!(corner.is_some_and(|why| why.contains("0.00 pixels to the right")));
        // The same point for all pixels of a film that is seen as if it were a square.
        assert!(verdict(&example([4, 2], [1, 1], [0.375, 0.375])).is_some());
        let outside = verdict(&example([2, 2], [2, 0], [1.25, 0.25]));
        assert!(outside.is_some_and(|why| why.contains("not on the film")));
    }

    #[test]
    fn each_situation_is_touched_by_some_example() {
        let at = |film, pixel| example(film, pixel, [0.5; 2]).situations();
        let one = at([1, 1], [0, 0]);
        assert_eq!(one, ["a film of one pixel"]);
        let touched = [one, at([2, 2], [0, 0]), at([4, 2], [3, 1])].concat();
        for situation in SITUATIONS {
            assert!(
                touched.contains(situation),
                "no {situation:?} in {touched:?}"
            );
        }
    }
}
