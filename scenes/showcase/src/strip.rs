//! Pictures side by side.

use image::{Rgb, RgbImage};

/// The width of the gap between two pictures in pixels.
const GAP: u32 = 5;

/// The pictures from left to right on white, with gaps. `None` without pictures, or if they have
/// not all the same height.
pub fn side_by_side(pictures: &[RgbImage]) -> Option<RgbImage> {
    let height = pictures.first()?.height();
    if pictures.iter().any(|picture| picture.height() != height) {
        return None;
    }
    let gaps = GAP * (pictures.len() as u32 - 1);
    let width = pictures.iter().map(RgbImage::width).sum::<u32>() + gaps;
    let mut strip = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let mut x = 0;
    for picture in pictures {
        image::imageops::replace(&mut strip, picture, i64::from(x), 0);
        x += picture.width() + GAP;
    }
    Some(strip)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(w: u32, h: u32, color: u8) -> RgbImage {
        RgbImage::from_pixel(w, h, Rgb([color; 3]))
    }

    #[test]
    fn pictures_are_in_order_with_gaps() {
        let strip = side_by_side(&[filled(3, 2, 10), filled(4, 2, 20)]).expect("one height");
        assert_eq!(strip.dimensions(), (3 + GAP + 4, 2));
        let at = |x| strip.get_pixel(x, 1).0[0];
        assert_eq!(
            [at(2), at(3), at(3 + GAP - 1), at(3 + GAP)],
            [10, 255, 255, 20]
        );
    }

    #[test]
    fn other_heights_are_refused() {
        assert_eq!(side_by_side(&[filled(3, 2, 10), filled(4, 3, 20)]), None);
        assert_eq!(side_by_side(&[]), None);
    }
}
