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

    pub(super) fn color(self) -> Color {
        match self {
            CellClass::Correct => GREEN,
            CellClass::Within => SKY,
            CellClass::Beyond => YELLOW,
            CellClass::Wrong => VERMILION,
            CellClass::Leak => PURPLE,
        }
    }

    /// A sign that can be read without colour.
    pub(super) fn sign(self) -> &'static str {
        match self {
            CellClass::Correct => "=",
            CellClass::Within => "≈",
            CellClass::Beyond => ">",
            CellClass::Wrong => "✗",
            CellClass::Leak => "○",
        }
    }

    pub(super) fn meaning(self) -> &'static str {
        match self {
            CellClass::Correct => "correct to the last place",
            CellClass::Within => "within the bound",
            CellClass::Beyond => "t beyond the bound",
            CellClass::Wrong => "wrong decisions",
            CellClass::Leak => "leaks",
        }
    }

    /// What the number in a cell counts.
    pub(super) fn unit(self) -> &'static str {
        match self {
            CellClass::Correct | CellClass::Within => "bits",
            CellClass::Beyond | CellClass::Wrong | CellClass::Leak => "%",
        }
    }
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
    /// The sign and a whole number of [`CellClass::unit`], for narrow cells.
    pub(super) short: String,
    pub(super) tip: String,
}

/// Returns the cells of a kernel: the bits of t that are correct for half of the rays, or the
/// fraction of wrong rays.
pub(super) fn cells(row: &KernelRow) -> Vec<HeatmapCell> {
    let mut cells: Vec<HeatmapCell> = row
        .by_ray_family
        .iter()
        .map(|accuracy| {
            let class = CellClass::of(accuracy);
            let bits = accuracy.t.map(|t| t.correct_bits());
            let bits_text = || bits.map_or(String::new(), |bits| format!("{bits:.0}"));
            let (number, rounded, strength) = match class {
                CellClass::Wrong => {
                    let wrong = accuracy.wrong_per_million();
                    (share(wrong), whole_percent(wrong), degree(wrong))
                }
                CellClass::Beyond => {
                    let beyond = accuracy.beyond_bound_per_million;
                    (share(beyond), whole_percent(beyond), degree(beyond))
                }
                CellClass::Within => (bits_text(), bits_text(), bits.map_or(1.0, missing_bits)),
                _ => (bits_text(), bits_text(), 1.0),
            };
            let bits = bits.map_or(String::new(), |bits| format!(", {bits:.0} correct bits"));
            HeatmapCell {
                color: style::tint(class.color(), strength),
                text: format!("{} {number}", class.sign()),
                short: format!("{}{rounded}", class.sign()),
                tip: match class {
                    CellClass::Wrong | CellClass::Beyond => {
                        format!("{} on {number} of the rays{bits}", class.meaning())
                    }
                    _ => format!("{}{bits}", class.meaning()),
                },
            }
        })
        .collect();
    if let Some(leaks) = row.leaks_per_million {
        cells.push(if leaks > 0.0 {
            let class = CellClass::Leak;
            HeatmapCell {
                color: style::tint(class.color(), degree(leaks)),
                text: format!("{} {}", class.sign(), share(leaks)),
                short: format!("{}{}", class.sign(), whole_percent(leaks)),
                tip: format!("{} of the rays leave the mesh", share(leaks)),
            }
        } else {
            HeatmapCell {
                color: CellClass::Correct.color(),
                text: "= closed".into(),
                short: CellClass::Correct.sign().into(),
                tip: "no ray leaves the mesh".into(),
            }
        });
    }
    cells
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
