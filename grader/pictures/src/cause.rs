//! Why a pixel differs.

use crate::image::{Image, Rgb};
use crate::palette;
use judge::findings::Aspect;
use judge::snapshot::Line;
use serde::Serialize;

/// The first difference of a call's answer from the golden, in this order. "False" means different
/// from the golden; which of the two is wrong is decided separately, by the exact oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// Nothing differs.
    Same,
    /// A hit where the golden misses.
    FalseHit,
    /// A miss where the golden hits.
    FalseMiss,
    /// A hit of another primitive.
    Primitive,
    /// The same primitive at another `t`; of a box, another interval.
    T,
    /// The same hit with another normal.
    Normal,
    /// Another value: a direction, a radiance.
    Value,
}

impl Cause {
    /// All causes of a difference, in the order of the legend.
    pub const DIFFERENCES: [Cause; 6] = [
        Cause::FalseHit,
        Cause::FalseMiss,
        Cause::Primitive,
        Cause::T,
        Cause::Normal,
        Cause::Value,
    ];

    /// Why `actual` differs from `golden`. Compares the lines and the colours of the pixel.
    pub fn of(golden: &Line, actual: &Line, same_colour: bool) -> Cause {
        let differs = |name: &str| golden.get(name) != actual.get(name);
        match (golden.is_miss(), actual.is_miss()) {
            (true, false) => Cause::FalseHit,
            (false, true) => Cause::FalseMiss,
            _ if differs("prim") => Cause::Primitive,
            _ if differs("t") || differs("inside") => Cause::T,
            _ if golden == actual && same_colour => Cause::Same,
            _ if actual.get("prim").is_some() && (differs("n") || !same_colour) => Cause::Normal,
            _ => Cause::Value,
        }
    }

    /// Why `actual` differs from a golden that has no row for the call: by the hit or
    /// miss that the golden picture's colour shows, by what the exact oracle finds wrong, then by
    /// the colours.
    pub fn without_row(
        golden_hits: Option<bool>,
        actual: &Line,
        wrong: &[Aspect],
        same_colour: bool,
    ) -> Cause {
        let is_hit = !actual.is_miss();
        let is_wrong = |aspects: &[Aspect]| aspects.iter().any(|aspect| wrong.contains(aspect));
        if golden_hits.is_some_and(|hits| hits != is_hit) || is_wrong(&[Aspect::HitOrMiss]) {
            return if is_hit {
                Cause::FalseHit
            } else {
                Cause::FalseMiss
            };
        }
        let is_record = actual.get("prim").is_some();
        if is_wrong(&[Aspect::Primitive]) {
            Cause::Primitive
        } else if is_wrong(&[Aspect::T, Aspect::Interval]) {
            Cause::T
        } else if is_wrong(&[Aspect::Normal]) {
            Cause::Normal
        } else if !wrong.is_empty() {
            Cause::Value
        } else if same_colour {
            Cause::Same
        } else if is_record {
            Cause::Normal
        } else if actual.get("inside").is_some() {
            Cause::T
        } else {
            Cause::Value
        }
    }

    /// The text in the legend.
    pub fn label(self) -> &'static str {
        match self {
            Cause::Same => "the same",
            Cause::FalseHit => "false hit",
            Cause::FalseMiss => "false miss",
            Cause::Primitive => "wrong primitive",
            Cause::T => "t",
            Cause::Normal => "normal",
            Cause::Value => "another value",
        }
    }

    /// Its colour in the picture of differences.
    pub fn colour(self) -> Rgb {
        match self {
            Cause::Same => [128, 128, 128],
            Cause::FalseHit => palette::VERMILION,
            Cause::FalseMiss => palette::SKY_BLUE,
            Cause::Primitive => palette::BLUE,
            Cause::T => palette::YELLOW,
            Cause::Normal => palette::PURPLE,
            Cause::Value => palette::ORANGE,
        }
    }
}

/// The number of pixels for each cause that occurs.
pub fn counts(causes: &[Cause]) -> Vec<(Cause, usize)> {
    let count = |cause| causes.iter().filter(|c| **c == cause).count();
    let counts = Cause::DIFFERENCES.map(|cause| (cause, count(cause)));
    counts.into_iter().filter(|(_, count)| *count > 0).collect()
}

/// The actual picture in grey, with the colour of the cause where it differs: a cause for each
/// pixel, in rows from the bottom left.
pub fn difference(actual: &Image, causes: &[Cause]) -> Image {
    let [w, h] = actual.size();
    Image::from_fn([w, h], |x, y| {
        match causes[((h - 1 - y) * w + x) as usize] {
            Cause::Same => palette::dimmed(actual.get(x, y)),
            cause => cause.colour(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::snapshot::parse;

    fn cause(golden: &str, actual: &str, same_colour: bool) -> Cause {
        let line = |text: &str| parse(&format!("0: -> {text}\n")).unwrap().lines[0].clone();
        Cause::of(&line(golden), &line(actual), same_colour)
    }

    #[test]
    fn without_a_row_the_oracle_and_the_colours_decide() {
        let line = |text: &str| parse(&format!("0: -> {text}\n")).unwrap().lines[0].clone();
        let [hit, miss, inside] = ["t=1 prim=2", "miss", "inside=[0,1]"].map(line);
        let cause = Cause::without_row;
        assert_eq!(cause(Some(true), &hit, &[], true), Cause::Same);
        assert_eq!(cause(Some(false), &hit, &[], false), Cause::FalseHit);
        assert_eq!(cause(Some(true), &miss, &[], false), Cause::FalseMiss);
        assert_eq!(
            cause(None, &miss, &[Aspect::HitOrMiss], false),
            Cause::FalseMiss
        );
        let wrong = [Aspect::Normal, Aspect::T];
        assert_eq!(cause(Some(true), &hit, &wrong, true), Cause::T);
        assert_eq!(cause(Some(true), &hit, &[], false), Cause::Normal);
        assert_eq!(cause(Some(true), &inside, &[], false), Cause::T);
        assert_eq!(cause(None, &line("d=(0,0,1)"), &[], false), Cause::Value);
    }

    #[test]
    fn the_first_difference_that_applies_is_the_cause() {
        let hit = "t=1 prim=2";
        assert_eq!(cause(hit, hit, true), Cause::Same);
        assert_eq!(cause("miss", hit, false), Cause::FalseHit);
        assert_eq!(cause(hit, "miss", false), Cause::FalseMiss);
        assert_eq!(cause(hit, "t=1.5 prim=3", false), Cause::Primitive);
        assert_eq!(cause(hit, "t=1.0000000000000002 prim=2", true), Cause::T);
        assert_eq!(cause(hit, hit, false), Cause::Normal);
        let full = "t=1 prim=2 n=(0,0,1) p=(0,0,0)";
        assert_eq!(
            cause(full, "t=1 prim=2 n=(0,1,0) p=(0,0,0)", true),
            Cause::Normal
        );
        assert_eq!(
            cause(full, "t=1 prim=2 n=(0,0,1) p=(0,0,1)", true),
            Cause::Value
        );
        assert_eq!(cause("inside=[0,1]", "inside=[0,2]", true), Cause::T);
        assert_eq!(cause("d=(0,0,1)", "d=(0,1,0)", false), Cause::Value);
    }
}
