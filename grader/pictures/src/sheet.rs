//! One picture of three: the golden, yours, and their difference.

use crate::Image;
use crate::image::Rgb;

/// Pixels between two pictures and around them.
const GAP: u32 = 8;

/// The colour of the gaps.
const PAPER: Rgb = [40, 42, 48];

/// Puts pictures of the same height beside each other, with gaps.
pub fn beside(pictures: &[&Image]) -> Image {
    let width: u32 = pictures.iter().map(|picture| picture.size()[0] + GAP).sum();
    let height = pictures.iter().map(|picture| picture.size()[1]).max();
    let size = [width + GAP, height.unwrap_or(0) + 2 * GAP];
    let mut sheet = Image::filled(size, PAPER);
    let mut left = GAP;
    for picture in pictures {
        sheet.paste(picture, left, GAP);
        left += picture.size()[0] + GAP;
    }
    sheet
}

/// The `N` pictures of this `size` that [`beside`] put on a sheet; `None` if its size is another.
pub fn parts<const N: usize>(sheet: &Image, [w, h]: [u32; 2]) -> Option<[Image; N]> {
    let count = N as u32;
    let fits = sheet.size() == [count * (w + GAP) + GAP, h + 2 * GAP];
    fits.then(|| {
        std::array::from_fn(|number| {
            let left = GAP + number as u32 * (w + GAP);
            Image::from_fn([w, h], |x, y| sheet.get(left + x, GAP + y))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_beside_each_other_with_gaps() {
        let [a, b] = [[10; 3], [20; 3]].map(|colour| Image::filled([4, 3], colour));
        let sheet = beside(&[&a, &b]);
        assert_eq!(sheet.size(), [4 + 4 + 3 * GAP, 3 + 2 * GAP]);
        assert_eq!(sheet.get(GAP, GAP), [10; 3]);
        assert_eq!(sheet.get(GAP + 4, GAP), PAPER);
        assert_eq!(sheet.get(2 * GAP + 4, GAP + 2), [20; 3]);
        assert_eq!(parts(&sheet, [4, 3]), Some([a, b]));
        assert_eq!(parts::<3>(&sheet, [4, 3]), None);
    }
}
