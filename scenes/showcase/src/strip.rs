//! Pictures beside each other, each with a label.

use crate::letters;
use image::{Rgb, RgbImage};

/// The width of the gaps between pictures in pixels.
pub const GAP: u32 = 5;
/// The pictures of a row.
pub const COLUMNS: u32 = 3;
/// The height of the label below a picture.
pub const LABEL: u32 = 32;
/// The pixels of a dot of a letter.
const DOT: u32 = 2;
const PAPER: Rgb<u8> = Rgb([255; 3]);
const INK: Rgb<u8> = Rgb([30; 3]);

/// The pictures in rows on white, with gaps, and below each its label. The error is a sentence.
pub fn labelled(pictures: &[(&str, RgbImage)]) -> Result<RgbImage, String> {
    let Some((_, first)) = pictures.first() else {
        return Err("there is no picture".to_owned());
    };
    let (w, h) = first.dimensions();
    if pictures
        .iter()
        .any(|(_, picture)| picture.dimensions() != (w, h))
    {
        return Err("the pictures have different sizes: render all with the same -r".to_owned());
    }
    let count = pictures.len() as u32;
    let (columns, rows) = (count.min(COLUMNS), count.div_ceil(COLUMNS));
    let width = columns * (w + GAP) - GAP;
    let height = rows * (h + LABEL + GAP) - GAP;
    let mut strip = RgbImage::from_pixel(width, height, PAPER);
    for (i, (label, picture)) in (0..).zip(pictures) {
        let (left, top) = place(i, (w, h));
        image::imageops::replace(&mut strip, picture, left.into(), top.into());
        let (_, letters) = letters::size(label, DOT);
        let below = top + h + (LABEL - letters) / 2;
        letters::write(&mut strip, label, (left + GAP, below), DOT, INK)?;
    }
    Ok(strip)
}

/// The left and the upper edge of a picture, where all have this size.
pub fn place(picture: u32, (w, h): (u32, u32)) -> (u32, u32) {
    let (column, row) = (picture % COLUMNS, picture / COLUMNS);
    (column * (w + GAP), row * (h + LABEL + GAP))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(w: u32, h: u32, color: u8) -> RgbImage {
        RgbImage::from_pixel(w, h, Rgb([color; 3]))
    }

    #[test]
    fn pictures_are_in_order_with_gaps_and_labels() {
        let pictures = [10, 20, 30, 40].map(|color| ("1", filled(20, 12, color)));
        let strip = labelled(&pictures).expect("one size");
        assert_eq!(
            strip.dimensions(),
            (3 * 20 + 2 * GAP, 2 * (12 + LABEL) + GAP)
        );
        for (i, (_, picture)) in (0..).zip(&pictures) {
            let (x, y) = place(i, (20, 12));
            assert_eq!(strip.get_pixel(x + 19, y + 11), picture.get_pixel(0, 0));
            let below = (0..LABEL).map(|row| strip.get_pixel(x + GAP + 2 * DOT, y + 12 + row));
            assert!(below.clone().any(|pixel| *pixel == INK), "label {i}");
            assert!(below.clone().any(|pixel| *pixel == PAPER));
        }
    }

    #[test]
    fn other_sizes_and_letters_are_refused() {
        let why = labelled(&[("", filled(3, 2, 10)), ("", filled(4, 2, 20))]);
        assert!(why.expect_err("other sizes").contains("-r"));
        assert!(labelled(&[("?", filled(30, 20, 10))]).is_err());
        assert!(labelled(&[]).is_err());
    }
}
