//! What a change of a golden means, in words.

use pictures::Image;

/// Two pictures: how many pixels differ.
pub(super) fn pixels(old: &Image, new: &Image) -> String {
    if old.size() != new.size() {
        let [[a, b], [c, d]] = [old.size(), new.size()];
        return format!("the size {a} x {b} became {c} x {d}");
    }
    let pairs = old.pixels().iter().zip(new.pixels());
    let differing = pairs.filter(|(a, b)| a != b).count();
    format!("{differing} of {} pixels changed", old.pixels().len())
}

/// Two lists: the lines that were removed and those that were added.
pub(super) fn lines(old: &str, new: &str) -> String {
    let only_in = |a: &str, b: &str, sign: char| {
        let lines = a
            .lines()
            .filter(|line| !b.lines().any(|other| other == *line));
        lines
            .map(|line| format!("\n  {sign} {line}"))
            .collect::<String>()
    };
    format!(
        "what the exact oracle does not judge{}{}",
        only_in(old, new, '-'),
        only_in(new, old, '+')
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_listed_with_their_signs() {
        let (old, new) = ("a: t: x\nb: t: y\n", "b: t: y\nc: t: z\n");
        let text = "what the exact oracle does not judge\n  - a: t: x\n  + c: t: z";
        assert_eq!(lines(old, new), text);
    }

    #[test]
    fn a_picture_of_another_size_has_no_pixels_to_count() {
        let image = |w| Image::filled([w, 1], [0; 3]);
        assert_eq!(pixels(&image(2), &image(3)), "the size 2 x 1 became 3 x 1");
        let mut other = image(2);
        other.set(1, 0, [1; 3]);
        assert_eq!(pixels(&image(2), &other), "1 of 2 pixels changed");
    }
}
