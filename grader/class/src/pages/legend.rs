//! The legend of a task's picture.

use pictures::difference::{Mark, compare};
use pictures::{png, sheet};
use std::collections::BTreeSet;

/// What differs in the picture of `task`, of which the PNG file has the golden, yours and their
/// difference, in the order of the legend. Empty for another file.
pub(super) fn marks(task: &str, file: &[u8]) -> BTreeSet<Mark> {
    let comparison = judge::pictures::of(task).and_then(|picture| {
        let sheet = png::decode(file).ok()?;
        let [golden, yours, difference] = sheet::parts(&sheet, picture.size())?;
        let comparison = compare(&picture, &golden, &yours);
        // Without a picture of yours, both are black.
        (comparison.difference == difference).then_some(comparison)
    });
    let counts = comparison.into_iter().flat_map(|it| it.counts).flatten();
    counts.map(|(mark, _)| mark).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pictures::Image;
    use pictures::sheet::beside;

    #[test]
    fn the_legend_is_of_what_differs_in_the_picture() {
        let task = "part1.task3";
        let picture = judge::pictures::of(task).expect("a picture");
        let black = Image::filled(picture.size(), [0; 3]);
        let mut yours = black.clone();
        yours.paste(&Image::filled([2, 2], [200, 180, 160]), 0, 0);
        let difference = compare(&picture, &black, &yours).difference;
        let sheet = beside(&[&black, &yours, &difference]);
        assert_eq!(
            marks(task, &png::encode(&sheet)),
            BTreeSet::from([Mark::FalseHit])
        );
        let none = beside(&[&yours, &black, &black]);
        assert_eq!(marks(task, &png::encode(&none)), BTreeSet::new());
        assert_eq!(marks(task, &png::encode(&black)), BTreeSet::new());
    }
}
