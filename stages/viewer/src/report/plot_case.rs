//! Numbers of a case as a plot: what roulette does to a path, how a mean settles that a stopping
//! rule is asked about, and how much glass reflects.

use judge::right_reflectance;
use kit::{Aabb, Tally, Vec3};
use wire::adaptive::{StopAnswer, StopCall};
use wire::global::SpecularAnswer::Share;
use wire::global::SpecularCall::Fresnel;
use wire::global::{RouletteWork, SpecularAnswer, SpecularCall};
use wire::work::Xyz;

/// A plot in the plane z = 0: from (0, 0) to ([`WIDTH`], 1).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotCase {
    /// What is measured to the right and up.
    pub axes: [&'static str; 2],
    /// A curve of the stage's numbers, or of those that it was given.
    pub curve: Vec<Vec3>,
    /// A curve of the right numbers.
    pub right: Vec<Vec3>,
    /// Vertical bars: the standard errors along the curve.
    pub bars: Vec<[Vec3; 2]>,
    /// What the stage returned, one for each number.
    pub dots: Vec<Vec3>,
    /// Horizontal lines with their names.
    pub levels: Vec<Level>,
    /// Numbers for the side of the window.
    pub facts: Vec<(&'static str, String)>,
}

/// A horizontal line.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Its height.
    pub y: f64,
    /// Its name.
    pub name: String,
    /// Whether it is the right value, rather than the stage's.
    pub is_right: bool,
}

impl Level {
    fn new(y: f64, name: impl Into<String>, is_right: bool) -> Level {
        Level {
            y,
            name: name.into(),
            is_right,
        }
    }
}

/// The width of a plot of height 1.
pub const WIDTH: f64 = 1.6;

/// The most samples of a pixel that are added up to be drawn.
const MOST_SAMPLES: u64 = 200_000;

/// The points of a curve.
const POINTS: u64 = 64;

impl PlotCase {
    /// What `play_roulette` makes of one path for each number: the factor of its throughput, or 0
    /// where it ends the path. Whatever the chance to continue is, the mean of the factors is 1.
    pub fn of_roulette(
        work: &RouletteWork,
        answers: &[Option<Xyz>],
        call: usize,
    ) -> Option<PlotCase> {
        let count = work.numbers.len();
        let path = call.checked_div(count)?;
        let (throughput, bounces) = work.paths.get(path)?;
        let channel = (0..3).max_by(|&a, &b| throughput[a].total_cmp(&throughput[b]))?;
        let answers = answers.get(path * count..(path + 1) * count)?;
        let factor = |answer: &Option<Xyz>| match answer {
            Some(after) => after[channel] / throughput[channel],
            None => 0.0,
        };
        let factors: Vec<f64> = answers.iter().map(factor).collect();
        let finite = factors.iter().copied().filter(|factor| factor.is_finite());
        let highest = 1.2 * finite.fold(1.0, f64::max);
        let mean = factors.iter().sum::<f64>() / count as f64;
        let ended = answers.iter().filter(|answer| answer.is_none()).count();
        let dots = work.numbers.iter().zip(&factors);
        let mut levels = vec![Level::new(1.0 / highest, "the mean must be 1", true)];
        if mean.is_finite() {
            let name = format!("the mean of yours is {mean:.3}");
            levels.push(Level::new(mean / highest, name, false));
        }
        Some(PlotCase {
            axes: [
                "the random number, 0 to 1",
                "the throughput is multiplied by",
            ],
            dots: dots
                .map(|(u, factor)| Vec3::new(WIDTH * u, factor / highest, 0.0))
                .filter(|p| p.is_finite())
                .collect(),
            levels,
            facts: vec![
                (
                    "throughput",
                    throughput.map(|c| format!("{c:.6}")).join(" "),
                ),
                ("bounces", bounces.to_string()),
                ("ended", format!("{ended} of {count}")),
                ("highest point", format!("x {:.3}", highest / 1.2)),
            ],
            ..PlotCase::default()
        })
    }

    /// The mean of the samples that a stopping rule is asked about, with its standard error;
    /// `None` for too many samples.
    pub fn of_stop(call: &StopCall, answer: &StopAnswer) -> Option<PlotCase> {
        let total: u64 = call.runs.iter().map(|(count, _)| u64::from(*count)).sum();
        if total == 0 || total > MOST_SAMPLES {
            return None;
        }
        let step = total.div_ceil(POINTS);
        let mut tally = Tally::default();
        let mut points = Vec::new();
        let runs = call.runs.iter();
        for luminance in runs.flat_map(|(count, l)| (0..*count).map(move |_| *l)) {
            tally.push(luminance);
            if tally.count() % step == 0 || tally.count() == total {
                points.push((tally.count(), tally.mean(), tally.standard_error()));
            }
        }
        // The first points may be far off.
        let settled = points.iter().skip(points.len() / 3);
        let ends =
            settled.map(|(_, mean, error)| mean + if error.is_finite() { *error } else { 0.0 });
        let highest = 1.2 * ends.filter(|y| y.is_finite()).fold(1e-300, f64::max);
        let at = |count: u64, y: f64| {
            let x = count as f64 / total as f64;
            Vec3::new(WIDTH * x, (y / highest).clamp(0.0, 1.0), 0.0)
        };
        let allowed = call.tolerance * tally.mean();
        let level = |y: f64, name| Level::new((y / highest).clamp(0.0, 1.0), name, true);
        Some(PlotCase {
            axes: ["samples", "their mean and its standard error"],
            curve: points.iter().map(|(n, mean, _)| at(*n, *mean)).collect(),
            bars: points
                .iter()
                .filter(|(_, mean, error)| (mean + error).is_finite())
                .map(|(n, mean, error)| [at(*n, mean - error), at(*n, mean + error)])
                .collect(),
            levels: vec![
                level(tally.mean() + allowed, "upper end of the tolerance"),
                level(tally.mean() - allowed, "lower end of the tolerance"),
            ],
            facts: vec![
                ("samples", total.to_string()),
                ("mean", format!("{:.6}", tally.mean())),
                ("standard error", format!("{:.6}", tally.standard_error())),
                ("tolerance", format!("{} of the mean", call.tolerance)),
                (
                    "your rule",
                    if answer.stop { "stops" } else { "goes on" }.to_owned(),
                ),
            ],
            ..PlotCase::default()
        })
    }

    /// The Fresnel reflectances of the case over the cosine, for the ratio of indices of this call;
    /// `None` for a call of another function.
    pub fn of_fresnel(
        calls: &[SpecularCall],
        answers: &[SpecularAnswer],
        call: usize,
    ) -> Option<PlotCase> {
        let of = |call: usize| match (calls.get(call)?, answers.get(call)?) {
            (Fresnel { cos_i, eta }, Share(share)) => Some((*cos_i, *eta, *share)),
            _ => None,
        };
        let (cos_i, eta, yours) = of(call)?;
        let expected = right_reflectance(&calls[call])?;
        let at = |cos_i: f64, share: f64| Vec3::new(WIDTH * cos_i, share.clamp(0.0, 1.0), 0.0);
        let mut same_glass: Vec<(f64, f64, f64)> = (0..calls.len())
            .filter_map(|i| Some((of(i)?, right_reflectance(&calls[i])?)))
            .filter(|((_, other, _), _)| *other == eta)
            .map(|((cos_i, _, yours), right)| (cos_i, yours, right))
            .collect();
        same_glass.sort_by(|a, b| a.0.total_cmp(&b.0));
        let level = |share: f64, whose: &str, is_right| {
            Level::new(
                share.clamp(0.0, 1.0),
                format!("{whose}: {share:.4}"),
                is_right,
            )
        };
        let mut levels = vec![level(expected, "right", true)];
        if yours != expected && yours.is_finite() {
            levels.push(level(yours, "yours", false));
        }
        let dots = same_glass
            .iter()
            .map(|(cos_i, yours, _)| at(*cos_i, *yours));
        Some(PlotCase {
            axes: ["the cosine, 0 grazing to 1 straight", "reflectance, 0 to 1"],
            right: same_glass
                .iter()
                .map(|(x, _, right)| at(*x, *right))
                .collect(),
            dots: dots.filter(|p| p.is_finite()).collect(),
            levels,
            facts: vec![
                ("cosine", format!("{cos_i}")),
                ("eta", format!("{eta:.6}")),
                ("right", format!("{expected:?}")),
                ("yours", format!("{yours:?}")),
            ],
            ..PlotCase::default()
        })
    }

    /// A box around the plot.
    pub fn bounds(&self) -> Aabb {
        Aabb::of([Vec3::ZERO, Vec3::new(WIDTH, 1.0, 0.0)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_a_biased_roulette_is_not_where_it_must_be() {
        let work = RouletteWork {
            paths: vec![([1.0; 3], 0), ([0.5, 0.25, 0.0], 5)],
            numbers: vec![0.25, 0.75],
        };
        // The second path survives with one number, without being made brighter.
        let answers = [Some([1.0; 3]), Some([1.0; 3]), Some([0.5, 0.25, 0.0]), None];
        let plot = PlotCase::of_roulette(&work, &answers, 3).expect("a path");
        let names: Vec<&str> = plot
            .levels
            .iter()
            .map(|level| level.name.as_str())
            .collect();
        assert_eq!(names, ["the mean must be 1", "the mean of yours is 0.500"]);
        assert_eq!(plot.dots[1], Vec3::new(0.75 * WIDTH, 0.0, 0.0));
        assert!(plot.levels[0].y > plot.levels[1].y);
        let first = PlotCase::of_roulette(&work, &answers, 1).expect("a path");
        assert_eq!(first.levels[0].y, first.levels[1].y);
        assert_eq!(PlotCase::of_roulette(&work, &answers, 4), None);
    }

    #[test]
    fn reflectances_of_one_glass_are_beside_the_right_ones() {
        let calls = [(1.0, 1.5), (0.0, 1.5), (1.0, 2.0), (0.5, 1.5)]
            .map(|(cos_i, eta)| Fresnel { cos_i, eta });
        let answers = [0.25, 1.0, 0.0, f64::NAN].map(Share);
        let plot = PlotCase::of_fresnel(&calls, &answers, 0).expect("a call of this function");
        // From grazing to straight: all of the light, and ((1.5 - 1) / (1.5 + 1))².
        assert_eq!(plot.right.len(), 3);
        assert!((plot.right[0].y - 1.0).abs() < 1e-12 && (plot.right[2].y - 0.04).abs() < 1e-12);
        assert_eq!(plot.dots, [Vec3::Y, Vec3::new(WIDTH, 0.25, 0.0)]);
        let names: Vec<&str> = plot.levels.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["right: 0.0400", "yours: 0.2500"]);
        let reflect = [SpecularCall::Reflect {
            wo: [0.0, 0.0, 1.0],
        }];
        assert_eq!(PlotCase::of_fresnel(&reflect, &answers[..1], 0), None);
    }

    #[test]
    fn a_mean_settles_between_its_tolerances() {
        let call = StopCall {
            runs: vec![(500, 1.0), (500, 3.0)],
            tolerance: 0.25,
            rule: false,
        };
        let answer = StopAnswer {
            stop: true,
            rule_calls: Vec::new(),
        };
        let plot = PlotCase::of_stop(&call, &answer).expect("a plot");
        let last = plot.curve.last().expect("points");
        assert!(last.x == WIDTH && plot.curve.len() <= 1 + POINTS as usize);
        assert!(plot.levels[1].y < last.y && last.y < plot.levels[0].y);
        assert!(plot.facts.contains(&("your rule", "stops".to_owned())));
        let endless = StopCall {
            runs: vec![(u32::MAX, 1.0)],
            ..call
        };
        assert_eq!(PlotCase::of_stop(&endless, &answer), None);
    }
}
