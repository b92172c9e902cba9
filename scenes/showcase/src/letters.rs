//! A few letters as dots, for labels in pictures.

use image::{Rgb, RgbImage};

/// The width of a letter in dots.
const WIDTH: u32 = 5;
/// The height of a letter in dots.
const HEIGHT: u32 = 7;
/// From a letter to the next one, in dots.
const ADVANCE: u32 = WIDTH + 1;

/// Each letter and its rows from the top, the leftmost dot in the highest of five bits.
const LETTERS: [(char, [u8; 7]); 28] = [
    ('0', [14, 17, 19, 21, 25, 17, 14]),
    ('1', [4, 12, 4, 4, 4, 4, 14]),
    ('2', [14, 17, 1, 2, 4, 8, 31]),
    ('3', [31, 2, 4, 2, 1, 17, 14]),
    ('4', [2, 6, 10, 18, 31, 2, 2]),
    ('5', [31, 16, 30, 1, 1, 17, 14]),
    ('6', [6, 8, 16, 30, 17, 17, 14]),
    ('7', [31, 1, 2, 4, 8, 8, 8]),
    ('8', [14, 17, 17, 14, 17, 17, 14]),
    ('9', [14, 17, 17, 15, 1, 2, 12]),
    ('P', [30, 17, 17, 30, 16, 16, 16]),
    ('S', [15, 16, 16, 14, 1, 1, 30]),
    ('a', [0, 0, 14, 1, 15, 17, 15]),
    ('d', [1, 1, 13, 19, 17, 17, 15]),
    ('e', [0, 0, 14, 17, 31, 16, 14]),
    ('f', [6, 9, 8, 28, 8, 8, 8]),
    ('i', [4, 0, 12, 4, 4, 4, 14]),
    ('n', [0, 0, 22, 25, 17, 17, 17]),
    ('o', [0, 0, 14, 17, 17, 17, 14]),
    ('p', [0, 0, 30, 17, 30, 16, 16]),
    ('r', [0, 0, 22, 25, 16, 16, 16]),
    ('s', [0, 0, 15, 16, 14, 1, 30]),
    ('t', [8, 8, 28, 8, 8, 9, 6]),
    ('y', [0, 0, 17, 17, 15, 1, 14]),
    (':', [0, 12, 12, 0, 12, 12, 0]),
    (',', [0, 0, 0, 0, 12, 4, 8]),
    ('.', [0, 0, 0, 0, 0, 12, 12]),
    (' ', [0; 7]),
];

/// Writes `text` with dots of `dot` pixels, its top left corner at `(left, top)`. The error names a
/// letter that there is none of.
pub fn write(
    picture: &mut RgbImage,
    text: &str,
    (left, top): (u32, u32),
    dot: u32,
    ink: Rgb<u8>,
) -> Result<(), String> {
    for (i, letter) in (0..).zip(text.chars()) {
        let found = LETTERS.iter().find(|(of, _)| *of == letter);
        let (_, rows) = found.ok_or_else(|| format!("{text}: there is no letter {letter:?}"))?;
        for (y, row) in (0..HEIGHT).zip(rows) {
            for x in (0..WIDTH).filter(|x| row & (1 << (WIDTH - 1 - x)) != 0) {
                let corner = (left + dot * (i * ADVANCE + x), top + dot * y);
                for dy in 0..dot {
                    for dx in 0..dot {
                        let at = (corner.0 + dx, corner.1 + dy);
                        // Text that is too long ends at the edge.
                        if let Some(pixel) = picture.get_pixel_mut_checked(at.0, at.1) {
                            *pixel = ink;
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

/// The width and the height of a text.
pub fn size(text: &str, dot: u32) -> (u32, u32) {
    let letters = text.chars().count() as u32;
    (dot * (letters * ADVANCE).saturating_sub(1), dot * HEIGHT)
}

#[cfg(test)]
mod tests {
    use super::*;

    const INK: Rgb<u8> = Rgb([0; 3]);

    #[test]
    fn a_letter_has_its_dots() {
        let (w, h) = size("t1", 2);
        let mut picture = RgbImage::from_pixel(w, h, Rgb([255; 3]));
        write(&mut picture, "t1", (0, 0), 2, INK).expect("letters");
        let is_ink = |x: u32, y: u32| *picture.get_pixel(2 * x + 1, 2 * y + 1) == INK;
        let row = |y| (0..11).map(move |x| if is_ink(x, y) { '#' } else { '.' });
        assert_eq!(row(2).collect::<String>(), "###.....#..");
        assert_eq!(row(6).collect::<String>(), "..##...###.");
    }

    #[test]
    fn other_letters_are_named() {
        let mut picture = RgbImage::new(9, 9);
        let why = write(&mut picture, "a?", (0, 0), 1, INK).expect_err("no such letter");
        assert!(why.contains("'?'"), "{why}");
    }
}
