//! Pictures with few colours, so that their files are small.

use pictures::Image;
use pictures::image::Rgb;
use std::collections::BTreeMap;

/// Colours and how many pixels have each.
type Group = Vec<(Rgb, u64)>;

/// The picture with at most `most` colours: median cut (Heckbert, "Color Image Quantization for
/// Frame Buffer Display", 1982). A picture that has no more stays as it is. The same picture always
/// gives the same colours.
pub(super) fn few_colours(picture: &Image, most: usize) -> Image {
    let mut counts: BTreeMap<Rgb, u64> = BTreeMap::new();
    for pixel in picture.pixels() {
        *counts.entry(*pixel).or_default() += 1;
    }
    let mut groups: Vec<Group> = vec![counts.into_iter().collect()];
    while groups.len() < most {
        // The group whose error is largest: its spread, times the number of its pixels.
        let cost = |group: &Group| {
            let (_, spread) = widest(group);
            u64::from(spread) * pixels(group)
        };
        let numbered = groups.iter().enumerate();
        let Some((worst, _)) = numbered
            .filter(|(_, group)| group.len() > 1)
            .max_by_key(|(i, group)| (cost(group), std::cmp::Reverse(*i)))
        else {
            break;
        };
        let (low, high) = halves(groups.swap_remove(worst));
        groups.extend([low, high]);
    }
    let mean_of: BTreeMap<Rgb, Rgb> = groups
        .iter()
        .flat_map(|group| {
            let mean = mean(group);
            group.iter().map(move |(colour, _)| (*colour, mean))
        })
        .collect();
    let [w, h] = picture.size();
    Image::from_fn([w, h], |x, y| mean_of[&picture.get(x, y)])
}

fn pixels(group: &[(Rgb, u64)]) -> u64 {
    group.iter().map(|(_, count)| count).sum()
}

/// The channel in which the colours of a group spread most, and how far.
fn widest(group: &[(Rgb, u64)]) -> (usize, u8) {
    let spread = |channel: usize| {
        let values = group.iter().map(|(colour, _)| colour[channel]);
        let (low, high) = values.fold((u8::MAX, u8::MIN), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        high.saturating_sub(low)
    };
    let spreads = [0, 1, 2].map(|channel| (spread(channel), channel));
    let (spread, channel) = spreads.into_iter().max().unwrap_or_default();
    (channel, spread)
}

/// Cuts a group of at least two colours where half of its pixels are on each side, in the channel
/// of its spread. Neither side is empty.
fn halves(mut group: Group) -> (Group, Group) {
    let (channel, _) = widest(&group);
    group.sort_by_key(|(colour, _)| (colour[channel], *colour));
    let half = pixels(&group) / 2;
    let mut before = 0;
    let reached = group.iter().position(|(_, count)| {
        before += count;
        before > half
    });
    let at = reached.unwrap_or(0).clamp(1, group.len() - 1);
    let high = group.split_off(at);
    (group, high)
}

fn mean(group: &[(Rgb, u64)]) -> Rgb {
    let all = pixels(group).max(1);
    [0, 1, 2].map(|channel| {
        let sum: u64 = group
            .iter()
            .map(|(colour, count)| u64::from(colour[channel]) * count)
            .sum();
        ((sum + all / 2) / all) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn colours(picture: &Image) -> BTreeSet<Rgb> {
        picture.pixels().iter().copied().collect()
    }

    #[test]
    fn few_colours_stay_and_many_become_few() {
        let four = Image::from_fn([4, 1], |x, _| [60 * x as u8, 0, 7]);
        assert_eq!(few_colours(&four, 4), four);
        let ramp = Image::from_fn([256, 2], |x, _| [x as u8; 3]);
        let coarse = few_colours(&ramp, 16);
        assert_eq!(colours(&coarse).len(), 16);
        for (fine, coarse) in ramp.pixels().iter().zip(coarse.pixels()) {
            assert!(fine[0].abs_diff(coarse[0]) <= 8);
        }
    }

    #[test]
    fn a_rare_colour_far_from_the_others_stays() {
        let spot = |x, y| x == 3 && y == 3;
        let picture = Image::from_fn([64, 64], |x, y| match spot(x, y) {
            true => [255, 0, 0],
            false => [0, 0, (x + y) as u8 / 16],
        });
        assert_eq!(few_colours(&picture, 16).get(3, 3), [255, 0, 0]);
    }
}
