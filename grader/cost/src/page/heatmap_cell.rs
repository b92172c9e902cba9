//! The cells of the heat map: what a kernel does on a family of rays, and how it is shaded.

use crate::report::{Accuracy, KernelRow};
use plots::numbers::percent;
use plots::style::Color;
use plots::style::{self, GREEN, PURPLE, SKY, VERMILION, YELLOW};

/// Largest median error of `t`, in units in the last place, of [`CellClass::Correct`].
const LAST_PLACE: f64 = 1.0;

/// The class of a kernel on one family of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellClass {
    /// No wrong decision, `t` correct to the last place.
    Correct,
    /// No wrong decision, `t` within the forward error bound.
    Within,
    /// No wrong decision, `t` beyond the bound for some rays.
    Beyond,
    /// Wrong decisions.
    Wrong,
    /// Rays leave a closed mesh.
    Leak,
}

impl CellClass {
    pub(super) const ALL: [CellClass; 5] = [
        CellClass::Correct,
        CellClass::Within,
        CellClass::Beyond,
        CellClass::Wrong,
        CellClass::Leak,
    ];

    fn of(accuracy: &Accuracy) -> CellClass {
        if accuracy.wrong_per_million() > 0.0 {
            CellClass::Wrong
        } else if accuracy.beyond_bound_per_million > 0.0 {
            CellClass::Beyond
        } else if accuracy.t.is_some_and(|t| t.ulp.p50 > LAST_PLACE) {
            CellClass::Within
        } else {
            CellClass::Correct
        }
    }

    /// How its cells look.
    pub(super) fn look(self) -> CellLook {
        let (color, sign, meaning, unit) = match self {
            CellClass::Correct => (GREEN, "=", "correct to the last place", "bits"),
            CellClass::Within => (SKY, "≈", "within the bound", "bits"),
            CellClass::Beyond => (YELLOW, ">", "t beyond the bound", "%"),
            CellClass::Wrong => (VERMILION, "✗", "wrong decisions", "%"),
            CellClass::Leak => (PURPLE, "○", "leaks", "%"),
        };
        CellLook {
            color,
            sign,
            meaning,
            unit,
        }
    }
}

/// How the cells of a class look.
pub(super) struct CellLook {
    pub(super) color: Color,
    /// A sign that can be read without colour.
    pub(super) sign: &'static str,
    pub(super) meaning: &'static str,
    /// What the number in a cell counts.
    pub(super) unit: &'static str,
}

/// The smallest and the largest share of rays, per million, between which a cell is shaded by
/// degree, in equal steps for equal factors.
const SHADED: [f64; 2] = [10.0, 500_000.0];

/// The strength of the shade of a share of rays.
fn degree(per_million: f64) -> f64 {
    let [from, to] = SHADED;
    ((per_million / from).ln() / (to / from).ln()).clamp(0.0, 1.0)
}

/// The strength of the shade of a number of correct bits: the fewer, the stronger.
fn missing_bits(bits: f64) -> f64 {
    1.0 - bits / 53.0
}

/// A cell of the map.
pub(super) struct HeatmapCell {
    pub(super) color: Color,
    pub(super) text: String,
    /// The sign and a whole number of [`CellLook::unit`], for narrow cells.
    pub(super) short: String,
    pub(super) tip: String,
}

/// Returns the cells of a kernel: the bits of t that are correct for half of the rays, or the
/// fraction of wrong rays.
pub(super) fn cells(row: &KernelRow) -> Vec<HeatmapCell> {
    let families = row.by_ray_family.iter().map(cell);
    let leaks = row.leaks_per_million.map(|leaks| match leaks > 0.0 {
        true => HeatmapCell {
            tip: format!("{} of the rays leave the mesh", share(leaks)),
            ..HeatmapCell::of_share(CellClass::Leak, leaks)
        },
        false => {
            let CellLook { color, sign, .. } = CellClass::Correct.look();
            HeatmapCell {
                color,
                text: format!("{sign} closed"),
                short: sign.into(),
                tip: "no ray leaves the mesh".into(),
            }
        }
    });
    families.chain(leaks).collect()
}

/// The cell of one family of rays.
fn cell(accuracy: &Accuracy) -> HeatmapCell {
    let class = CellClass::of(accuracy);
    let meaning = class.look().meaning;
    let bits = accuracy.t.map(|t| t.correct_bits());
    let number = bits.map_or(String::new(), |bits| format!("{bits:.0}"));
    let of_bits = bits.map_or(String::new(), |_| format!(", {number} correct bits"));
    let of_share = |per_million| HeatmapCell {
        tip: format!("{meaning} on {} of the rays{of_bits}", share(per_million)),
        ..HeatmapCell::of_share(class, per_million)
    };
    let strength = match class {
        CellClass::Wrong => return of_share(accuracy.wrong_per_million()),
        CellClass::Beyond => return of_share(accuracy.beyond_bound_per_million),
        CellClass::Within => bits.map_or(1.0, missing_bits),
        CellClass::Correct | CellClass::Leak => 1.0,
    };
    HeatmapCell {
        tip: format!("{meaning}{of_bits}"),
        ..HeatmapCell::new(class, strength, &number, &number)
    }
}

impl HeatmapCell {
    fn new(class: CellClass, strength: f64, number: &str, short: &str) -> HeatmapCell {
        let CellLook { color, sign, .. } = class.look();
        HeatmapCell {
            color: style::tint(color, strength),
            text: format!("{sign} {number}"),
            short: format!("{sign}{short}"),
            tip: String::new(),
        }
    }

    /// A cell with a share of rays.
    fn of_share(class: CellClass, per_million: f64) -> HeatmapCell {
        let (number, short) = (share(per_million), whole_percent(per_million));
        HeatmapCell::new(class, degree(per_million), &number, &short)
    }
}

/// Formats a count per million in percent.
fn share(per_million: f64) -> String {
    percent(per_million / 1e6)
}

/// Formats a count per million as the number of whole percents.
fn whole_percent(per_million: f64) -> String {
    match per_million / 1e4 {
        percent if percent < 1.0 => "<1".into(),
        percent => format!("{percent:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rare_error_is_shaded_less_than_a_frequent_one() {
        let shade = |per_million| style::tint(VERMILION, degree(per_million));
        // 0.0017 % and 49 %.
        let [rare, frequent] = [17.0, 490_000.0].map(shade);
        let distance = |color: Color| 255 - u32::from(color.2);
        assert!(
            3 * distance(rare) < distance(frequent),
            "{rare:?} {frequent:?}"
        );
        assert_ne!(rare, Color(255, 255, 255));
        assert_eq!(shade(1e6), VERMILION);
    }
}
