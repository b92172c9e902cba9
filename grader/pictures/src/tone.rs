//! From the worker's colours to bytes.

use crate::Image;
use crate::image::Rgb;
use judge::pictures::TaskPicture;
use kit::math::pow;
use wire::picture::PictureAnswer;
use wire::{Answer, Work};

/// The colour of a pixel whose value is NaN: magenta.
pub const NAN_COLOUR: Rgb = [255, 0, 255];

/// Applies the tone curve of the assignment's program: `255 · min(1, (c·√2)^(1/2.2))`. A NaN gives
/// [`NAN_COLOUR`].
pub fn tone(colour: [f64; 3]) -> Rgb {
    bytes(colour, |c| pow(c * std::f64::consts::SQRT_2, 1.0 / 2.2))
}

fn bytes(colour: [f64; 3], curve: impl Fn(f64) -> f64) -> Rgb {
    if colour.iter().any(|c| c.is_nan()) {
        return NAN_COLOUR;
    }
    colour.map(|c| (255.0 * curve(c.max(0.0)).min(1.0)) as u8)
}

/// Converts `answer` to a picture of `width` by `height` pixels, in the colours of
/// [`judge::picture`]. The answers are in rows from the bottom left. Returns `None` if the number
/// of answers is not the number of pixels, or if this kind of answer has no colour.
pub fn of_answer([width, height]: [u32; 2], work: &Work, answer: &Answer) -> Option<Image> {
    let colours = judge::picture::colours(work, answer)?;
    if colours.len() != width as usize * height as usize {
        return None;
    }
    Some(Image::from_fn([width, height], |x, y| {
        tone(colours[((height - 1 - y) * width + x) as usize])
    }))
}

/// Whether black is the colour of a miss, and of nothing else: no unit normal is black, and no box
/// near the camera.
pub fn misses_are_black(work: &Work) -> bool {
    match work {
        Work::Boxes(_) | Work::BruteForce(_) => true,
        Work::SceneHits(work) => !work.any_hit,
        _ => false,
    }
}

/// The picture of a task from the worker's answer, which fits it: its panels, one below the other.
pub fn compose(picture: &TaskPicture, answer: &PictureAnswer) -> Image {
    let [w, h] = picture.work.size;
    let mut image = Image::filled(picture.size(), [0; 3]);
    for ((number, colours), kind) in (0..).zip(&answer.panels).zip(picture.panels) {
        let panel = Image::from_fn([w, h], |x, y| {
            let colour = colours[((h - 1 - y) * w + x) as usize].map(f64::from);
            let colour = match kind.plain {
                true => bytes(colour, |c| c),
                false => tone(colour),
            };
            colour.map(|byte| quantised(byte, kind.steps))
        });
        image.paste(&panel, 0, number * h);
    }
    image
}

/// The nearest of `steps + 1` regular values.
fn quantised(byte: u8, steps: u8) -> u8 {
    let steps = u32::from(steps);
    let step = (u32::from(byte) * steps + 127) / 255;
    (step * 255 / steps) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_white_and_nan() {
        assert_eq!(tone([0.0, -1.0, 1.0]), [0, 0, 255]);
        assert_eq!(tone([0.5, f64::NAN, 0.5]), NAN_COLOUR);
        // (0.5 √2)^(1/2.2) = 0.854.
        assert_eq!(tone([0.5; 3]), [217; 3]);
    }

    #[test]
    fn all_steps_keep_every_byte_and_few_keep_the_ends() {
        for byte in 0..=255 {
            assert_eq!(quantised(byte, 255), byte);
        }
        assert_eq!([0, 255].map(|byte| quantised(byte, 31)), [0, 255]);
        assert_eq!(quantised(100, 31), quantised(102, 31));
    }

    #[test]
    fn panels_are_below_each_other_and_start_at_the_bottom_left() {
        let mut picture = judge::pictures::of("part3.task1").expect("the task has a picture");
        picture.work.size = [2, 2];
        let mut panels = vec![vec![[0.0; 3]; 4]; 2];
        panels[0][0] = [1.0; 3];
        panels[1][3] = [1.0, 0.0, 0.0];
        let image = compose(&picture, &PictureAnswer { panels });
        assert_eq!(image.size(), [2, 4]);
        assert_eq!(image.get(0, 1), [255; 3]);
        assert_eq!(image.get(1, 2), [255, 0, 0]);
        assert_eq!(image.get(0, 3), [0; 3]);
    }

    #[test]
    fn answers_start_at_the_bottom_left_pixel() {
        let work = Work::Boxes(wire::work::BoxWork {
            boxes: Vec::new(),
            probes: Vec::new(),
        });
        let boxes = Answer::Boxes(vec![Some([0.0, 1.0]), None, None, None, None, None]);
        let picture = of_answer([3, 2], &work, &boxes).unwrap();
        assert_eq!(picture.get(0, 1), [255; 3]);
        assert_eq!(picture.get(0, 0), [0; 3]);
    }
}
