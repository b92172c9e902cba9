//! Pictures in a terminal: as files or sixels in those that show them ([`shown`]), elsewhere two
//! pixels per character, one above the other, as `▀` in the colour of the upper one on the colour
//! of the lower one ([`half_blocks`]).

use crate::Image;
use crate::image::Rgb;
use crate::png;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeMap;
use std::fmt::Write;

/// How many colours a terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// 24 bits.
    True,
    /// The cube of 216 colours of the palette of 256.
    Cube,
}

/// The colours of the terminal that the environment describes; `None` where `NO_COLOR` is set or
/// the terminal is known to have none.
pub fn colours(environment: impl Fn(&str) -> Option<String>) -> Option<Colours> {
    let set = |name: &str| environment(name).filter(|value| !value.is_empty());
    if set("NO_COLOR").is_some() || set("TERM").as_deref() == Some("dumb") {
        return None;
    }
    match set("COLORTERM").as_deref() {
        Some("truecolor" | "24bit") => Some(Colours::True),
        _ => Some(Colours::Cube),
    }
}

/// The picture, `columns` wide, for the terminal that the environment describes; `None` where it
/// has no colours. `attributes` asks the terminal for its primary device attributes.
pub fn shown(
    picture: &Image,
    columns: u32,
    environment: impl Fn(&str) -> Option<String>,
    attributes: impl FnOnce() -> &'static [u32],
) -> Option<String> {
    let colours = colours(&environment)?;
    let is = |name: &str, values: &[&str]| {
        environment(name).is_some_and(|value| values.contains(&value.as_str()))
    };
    // Multiplexers do not pass these sequences on.
    let is_direct = environment("TMUX").is_none() && environment("STY").is_none();
    if is_direct && (is("TERM", &["xterm-kitty"]) || is("TERM_PROGRAM", &["ghostty"])) {
        return Some(as_kitty_reads(picture, columns));
    }
    if is_direct && is("TERM_PROGRAM", &["iTerm.app", "WezTerm"]) {
        let file = STANDARD.encode(png::encode(picture));
        return Some(format!(
            "\x1b]1337;File=inline=1;width={columns}:{file}\x07\n"
        ));
    }
    if attributes().contains(&SIXEL) {
        return Some(as_sixels(&scaled_to(picture, columns * COLUMN_WIDTH)));
    }
    Some(half_blocks(picture, columns, colours))
}

/// The device attribute of terminals that draw sixels.
const SIXEL: u32 = 4;

/// The width of a column in pixels, about: terminals draw sixels in their own pixels.
const COLUMN_WIDTH: u32 = 8;

/// The picture in the protocol of kitty: in pieces of at most 4,096 characters.
fn as_kitty_reads(picture: &Image, columns: u32) -> String {
    let file = STANDARD.encode(png::encode(picture));
    let mut pieces = file.as_bytes().chunks(4096).peekable();
    let mut keys = format!("a=T,f=100,q=2,c={columns},");
    let mut text = String::new();
    while let Some(piece) = pieces.next() {
        let is_more = u8::from(pieces.peek().is_some());
        let piece = String::from_utf8_lossy(piece);
        let _ = write!(text, "\x1b_G{keys}m={is_more};{piece}\x1b\\");
        keys.clear();
    }
    text + "\n"
}

/// The picture as sixels (VT330/VT340 Programmer Reference Manual, chapter 14): bands of six rows,
/// and for each colour of a band a character a column, whose bits are the rows that have it. The
/// colours are those of the cube of 216, dithered.
fn as_sixels(picture: &Image) -> String {
    let [w, h] = picture.size();
    // Zero pixels stay as they are; pixels are square.
    let mut text = format!("\x1bP0;1q\"1;1;{w};{h}");
    for colour in 0..216 {
        let [r, g, b] = [colour / 36, colour / 6 % 6, colour % 6].map(|level| level * 20);
        let _ = write!(text, "#{colour};2;{r};{g};{b}");
    }
    for top in (0..h).step_by(6) {
        let mut columns: BTreeMap<u32, Vec<u8>> = BTreeMap::new();
        for (row, y) in (top..h.min(top + 6)).enumerate() {
            for x in 0..w {
                let [r, g, b] = picture.get(x, y).map(|channel| dithered(channel, x, y));
                let bits = columns.entry(36 * r + 6 * g + b);
                bits.or_insert_with(|| vec![0; w as usize])[x as usize] |= 1 << row;
            }
        }
        for (colour, bits) in columns {
            let _ = write!(text, "#{colour}");
            for run in bits.chunk_by(|a, b| a == b) {
                let _ = write!(text, "!{}{}", run.len(), char::from(b'?' + run[0]));
            }
            text.push('$');
        }
        text.push('-');
    }
    text + "\x1b\\\n"
}

/// The level of a channel in the cube of colours, 0 to 5, by an ordered dither (Bayer).
fn dithered(channel: u8, x: u32, y: u32) -> u32 {
    const ORDER: [[u32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
    let threshold = 16 * ORDER[(y % 4) as usize][(x % 4) as usize] + 7;
    (u32::from(channel) * 5 + threshold) / 255
}

/// The picture as text of at most `columns` columns, scaled down if it is wider.
pub fn half_blocks(picture: &Image, columns: u32, colours: Colours) -> String {
    let small = scaled_to(picture, columns);
    let [w, h] = small.size();
    let mut text = String::new();
    for y in (0..h).step_by(2) {
        for x in 0..w {
            let above = code(small.get(x, y), colours);
            match y + 1 < h {
                true => {
                    let below = code(small.get(x, y + 1), colours);
                    let _ = write!(text, "\x1b[38;{above};48;{below}m▀");
                }
                false => {
                    let _ = write!(text, "\x1b[0;38;{above}m▀");
                }
            }
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

/// A square in a colour, for a legend.
pub fn chip(colour: Rgb, colours: Colours) -> String {
    format!("\x1b[38;{}m■\x1b[0m", code(colour, colours))
}

/// The parameters that follow `38;` (foreground) or `48;` (background) in the escape sequence for
/// this colour.
fn code([r, g, b]: Rgb, colours: Colours) -> String {
    match colours {
        Colours::True => format!("2;{r};{g};{b}"),
        Colours::Cube => {
            let [r, g, b] = [r, g, b].map(|channel| (u32::from(channel) * 5 + 127) / 255);
            format!("5;{}", 16 + 36 * r + 6 * g + b)
        }
    }
}

/// The picture, `width` pixels wide if it is wider: each pixel is the mean of those that it covers.
fn scaled_to(picture: &Image, width: u32) -> Image {
    let [w, h] = picture.size();
    if w <= width || width == 0 {
        return picture.clone();
    }
    let height = (u64::from(h) * u64::from(width) / u64::from(w)).max(1) as u32;
    let range = |place: u32, count: u32, all: u32| {
        let edge = |place: u32| (u64::from(place) * u64::from(all) / u64::from(count)) as u32;
        edge(place)..edge(place + 1)
    };
    Image::from_fn([width, height], |x, y| {
        let (columns, rows) = (range(x, width, w), range(y, height, h));
        let count = (columns.len() * rows.len()) as u32;
        let mut sums = [0_u32; 3];
        for row in rows {
            for column in columns.clone() {
                for (sum, channel) in sums.iter_mut().zip(picture.get(column, row)) {
                    *sum += u32::from(channel);
                }
            }
        }
        sums.map(|sum| (sum / count) as u8)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_rows_are_one_line() {
        let picture = Image::from_fn([1, 3], |_, y| [y as u8 * 100, 0, 0]);
        let text = half_blocks(&picture, 80, Colours::True);
        assert_eq!(
            text,
            "\x1b[38;2;0;0;0;48;2;100;0;0m▀\x1b[0m\n\x1b[0;38;2;200;0;0m▀\x1b[0m\n"
        );
    }

    #[test]
    fn terminals_that_show_files_get_the_file() {
        let picture = Image::from_fn([100, 100], |x, y| [(x * y) as u8, (x ^ y) as u8, 9]);
        let shown = |set: &'static [(&str, &str)]| {
            let of = |name: &str| {
                let found = set.iter().find(|(known, _)| *known == name);
                found.map(|(_, value)| (*value).to_string())
            };
            shown(&picture, 64, of, || &[62, 22])
        };
        let kitty = shown(&[("TERM", "xterm-kitty")]).expect("a picture");
        assert!(
            kitty.starts_with("\x1b_Ga=T,f=100,q=2,c=64,m=1;iVBOR"),
            "{kitty}"
        );
        assert!(kitty.contains("\x1b_Gm=0;"), "{kitty}");
        let iterm = shown(&[("TERM_PROGRAM", "iTerm.app")]).expect("a picture");
        assert!(iterm.starts_with("\x1b]1337;File=inline=1;width=64:iVBOR"));
        let inside = shown(&[("TERM", "xterm-kitty"), ("TMUX", "1")]);
        assert!(inside.is_some_and(|text| text.contains('▀')));
        assert_eq!(shown(&[("TERM", "xterm-kitty"), ("NO_COLOR", "1")]), None);
    }

    #[test]
    fn terminals_that_draw_sixels_get_sixels() {
        let picture = Image::from_fn([5, 7], |x, y| match (x, y) {
            (0, 0) => [0, 0, 255],
            (_, 6) => [255; 3],
            _ => [255, 0, 0],
        });
        let sixels = as_sixels(&picture);
        assert!(sixels.starts_with("\x1bP0;1q\"1;1;5;7#0;2;0;0;0#1;2;0;0;20"));
        // Blue has one pixel, the first; red has the other rows of its column, and then all six.
        let bands = "#215;2;100;100;100#5!1@!4?$#180!1}!4~$-#215!5@$-\x1b\\\n";
        assert!(sixels.ends_with(bands), "{sixels}");
        let in_terminal = |attributes: &'static [u32]| {
            let of = |name: &str| (name == "COLORTERM").then(|| "truecolor".to_string());
            shown(&picture, 80, of, || attributes).expect("a picture")
        };
        assert_eq!(in_terminal(&[62, 4, 22]), sixels);
        assert!(in_terminal(&[62, 22]).contains('▀'));
    }

    /// The size that `sixels` give, and the pixels that a terminal draws of them, row by row. This
    /// reader follows the manual and shares nothing with [`as_sixels`].
    fn drawn(sixels: &str) -> ([usize; 2], Vec<Option<[u8; 3]>>) {
        let body = sixels.strip_prefix("\x1bP0;1q").expect("it begins");
        let content = body.strip_suffix("\x1b\\\n").expect("it ends");
        let mut controls = content.chars().peekable();
        let mut size = [0, 0];
        let mut pixels = Vec::new();
        let mut palette = BTreeMap::new();
        let (mut x, mut top, mut colour, mut times) = (0, 0, 0, 1);
        while let Some(control) = controls.next() {
            let mut parameters = String::new();
            while let Some(c) = controls.next_if(|c| c.is_ascii_digit() || *c == ';') {
                parameters.push(c);
            }
            let numbers: Vec<usize> = (parameters.split(';'))
                .filter_map(|number| number.parse().ok())
                .collect();
            match (control, &numbers[..]) {
                ('"', &[1, 1, w, h]) => {
                    size = [w, h];
                    pixels = vec![None; w * h];
                }
                ('#', &[number]) => colour = number,
                ('#', &[number, 2, r, g, b]) => {
                    let channel = |percent: usize| (percent * 255 / 100) as u8;
                    palette.insert(number, [r, g, b].map(channel));
                }
                ('!', &[count]) => times = count,
                ('$', []) => x = 0,
                ('-', []) => (x, top) = (0, top + 6),
                ('?'..='~', []) => {
                    let bits = control as usize - '?' as usize;
                    for _ in 0..times {
                        for y in (0..6).filter(|row| bits >> row & 1 == 1) {
                            pixels[(top + y) * size[0] + x] = Some(palette[&colour]);
                        }
                        x += 1;
                    }
                    times = 1;
                }
                other => panic!("{other:?}"),
            }
        }
        (size, pixels)
    }

    #[test]
    fn sixels_are_the_pixels_of_the_picture() {
        // The levels of the palette, which no dither changes.
        let colour = |x: u32, y: u32| [x % 6, (x + y) % 6, y % 6].map(|level| 51 * level as u8);
        for [w, h] in [[1, 1], [13, 6], [40, 20], [7, 12]] {
            let picture = Image::from_fn([w, h], colour);
            let (size, pixels) = drawn(&as_sixels(&picture));
            assert_eq!(size, [w as usize, h as usize]);
            let expected = (0..h).flat_map(|y| (0..w).map(move |x| Some(colour(x, y))));
            assert!(pixels.into_iter().eq(expected), "{w} x {h}");
        }
    }

    #[test]
    fn a_dithered_grey_has_its_mean() {
        for grey in [0_u8, 1, 64, 128, 200, 254, 255] {
            let levels = (0..16).map(|i| dithered(grey, i % 4, i / 4));
            let mean = f64::from(levels.sum::<u32>()) / 16.0 / 5.0;
            assert!(
                (mean - f64::from(grey) / 255.0).abs() < 0.02,
                "{grey}: {mean}"
            );
        }
    }

    #[test]
    fn a_wide_picture_is_scaled_to_the_mean_of_its_pixels() {
        let picture = Image::from_fn([160, 40], |x, _| [if x % 2 == 0 { 100 } else { 200 }; 3]);
        let small = scaled_to(&picture, 80);
        assert_eq!(small, Image::filled([80, 20], [150; 3]));
    }

    #[test]
    fn the_environment_says_which_colours_there_are() {
        let of = |name: &'static str, value: &'static str| {
            colours(move |asked| (asked == name).then(|| value.to_string()))
        };
        assert_eq!(of("NO_COLOR", "1"), None);
        assert_eq!(of("NO_COLOR", ""), Some(Colours::Cube));
        assert_eq!(of("TERM", "dumb"), None);
        assert_eq!(of("COLORTERM", "truecolor"), Some(Colours::True));
        assert_eq!(code([255, 0, 0], Colours::Cube), "5;196");
    }
}
