//! The colours of pages, and those of differences: those that Okabe and Ito chose so that everybody
//! can distinguish them ("Color Universal Design", 2008).

use crate::image::Rgb;

/// The colours of pages and drawings, as variables that their style sheets use.
pub const OF_PAGES: &str = include_str!("palette.css");

/// Vermilion.
pub const VERMILION: Rgb = [213, 94, 0];
/// Sky blue.
pub const SKY_BLUE: Rgb = [86, 180, 233];
/// Blue.
pub const BLUE: Rgb = [0, 114, 178];
/// Bluish green.
pub const GREEN: Rgb = [0, 158, 115];
/// Yellow.
pub const YELLOW: Rgb = [240, 228, 66];
/// Reddish purple.
pub const PURPLE: Rgb = [204, 121, 167];
/// Orange.
pub const ORANGE: Rgb = [230, 159, 0];

/// The brightness of grey pixels is multiplied by this, so that colours are easy to see.
const DIMMED: f64 = 0.5;

/// The grey in which a pixel is shown that does not differ.
pub fn dimmed(colour: Rgb) -> Rgb {
    let [r, g, b] = colour.map(f64::from);
    // Luma (Rec. 709).
    [(DIMMED * (0.2126 * r + 0.7152 * g + 0.0722 * b)) as u8; 3]
}
