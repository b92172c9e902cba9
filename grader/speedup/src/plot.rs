//! A plot in characters: millions of rays per second over the number of triangles.

use crate::measure::Ladder;
use crate::rays::RayKind;
use crate::rung::RungKind;
use std::fmt::Write;

/// Width and height in characters.
const SIZE: [usize; 2] = [64, 14];

/// The mark of each step.
fn mark(kind: RungKind) -> char {
    match kind {
        RungKind::BruteForce => 'o',
        RungKind::Student => 'b',
        RungKind::Sah => 's',
        RungKind::Wide => 'w',
    }
}

/// Plots bounce rays, both axes logarithmic. Empty if there are fewer than two sizes.
pub(crate) fn show(ladder: &Ladder) -> String {
    let points: Vec<(f64, f64, char)> = ladder
        .rows
        .iter()
        .map(|row| {
            let rate = 1e-6 / row.rays[RayKind::Bounce as usize].seconds;
            ((row.triangles as f64).log10(), rate.log10(), mark(row.kind))
        })
        .filter(|(x, y, _)| x.is_finite() && y.is_finite())
        .collect();
    let (x_range, y_range) = (
        range(points.iter().map(|p| p.0)),
        range(points.iter().map(|p| p.1)),
    );
    if x_range[1] - x_range[0] < 0.5 {
        return String::new();
    }
    let y_range = [y_range[0].floor(), y_range[1].ceil()];
    let column = |x: f64| place(x, x_range, SIZE[0]);
    let row = |y: f64| SIZE[1] - 1 - place(y, y_range, SIZE[1]);
    let mut grid = vec![vec![' '; SIZE[0]]; SIZE[1]];
    for kind in RungKind::ALL {
        let line: Vec<_> = points
            .iter()
            .filter(|point| point.2 == mark(kind))
            .collect();
        for pair in line.windows(2) {
            let [from, to] = [column(pair[0].0), column(pair[1].0)];
            let height = |i: usize| {
                let share = (i - from) as f64 / (to - from) as f64;
                row(pair[0].1 + share * (pair[1].1 - pair[0].1))
            };
            (from..to).for_each(|i| grid[height(i)][i] = '.');
        }
    }
    for &(x, y, mark) in &points {
        grid[row(y)][column(x)] = mark;
    }
    let marks: Vec<String> = RungKind::ALL
        .map(|kind| format!("{} {}", mark(kind), kind.name()))
        .into();
    let mut text = format!(
        "\nMrays/s of bounce rays, over triangles\n({})\n",
        marks.join(", ")
    );
    for (i, line) in grid.iter().enumerate() {
        let decade = (y_range[0] as i32..=y_range[1] as i32).find(|&y| row(f64::from(y)) == i);
        let label = decade.map_or(String::new(), |y| format!("{}", 10.0_f64.powi(y)));
        let line: String = line.iter().collect();
        let _ = writeln!(text, "{label:>9} |{}", line.trim_end());
    }
    let ends = x_range.map(|x| format!("{:.0}", 10.0_f64.powf(x)));
    let gap = SIZE[0].saturating_sub(ends[0].len() + ends[1].len());
    let _ = writeln!(text, "{:>9} +{}", "", "-".repeat(SIZE[0]));
    let _ = writeln!(text, "{:>11}{}{}{}", "", ends[0], " ".repeat(gap), ends[1]);
    text
}

/// The place of `x` among `count` characters.
fn place(x: f64, [from, to]: [f64; 2], count: usize) -> usize {
    let share = (x - from) / (to - from).max(1e-9);
    (share * (count - 1) as f64).round() as usize
}

fn range(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{RayCost, RungCost};

    #[test]
    fn a_faster_step_is_higher_and_a_larger_mesh_farther_right() {
        let row = |kind, triangles, seconds| RungCost {
            kind,
            triangles,
            build_s: 1.0,
            bytes: 0,
            rays: [RayCost {
                seconds,
                ..RayCost::default()
            }; 3],
            checked_rays: 0,
            differing_hits: 0,
            first_differing: None,
        };
        let ladder = Ladder {
            mesh: "smooth".into(),
            rows: vec![
                row(RungKind::BruteForce, 1000, 1e-5),
                row(RungKind::Wide, 1000, 1e-7),
                row(RungKind::BruteForce, 10_000, 1e-4),
                row(RungKind::Wide, 10_000, 2e-7),
            ],
            missing: Default::default(),
        };
        let text = show(&ladder);
        let lines: Vec<&str> = text.lines().collect();
        // A step's mark at its two sizes: line and column.
        let places = |mark: char| -> Vec<(usize, usize)> {
            let lines = lines
                .iter()
                .enumerate()
                .filter(|(_, line)| line.contains('|'));
            let mut places: Vec<_> = lines
                .flat_map(|(i, line)| {
                    line.char_indices()
                        .filter(|&(_, c)| c == mark)
                        .map(move |(at, _)| (at, i))
                })
                .collect();
            places.sort_unstable();
            places
        };
        let (brute, wide) = (places('o'), places('w'));
        assert_eq!([brute.len(), wide.len()], [2, 2], "{text}");
        assert!(wide[0].1 < brute[0].1 && wide[1].1 < brute[1].1, "{text}");
        assert!(brute[0].0 < brute[1].0 && brute[0].1 < brute[1].1, "{text}");
        assert!(lines.iter().all(|line| line.len() <= 80), "{text}");
    }
}
