//! How points are distributed: histograms as SVG.

use crate::collect::{Class, points};
use judge::Tier;
use maud::{Markup, html};

/// The number of bars of a distribution: those for 0 to 100 % in steps of 10 %; full points have
/// one of their own.
const BARS: usize = 11;

/// The size of a distribution in units of its drawing.
const PLOT: [f64; 2] = [260.0, 110.0];

/// The distributions of all points and of each task's.
pub(super) fn all(class: &Class) -> Markup {
    let [max_score, _] = class.plan.max_score();
    let scores = class.rows.iter().filter_map(|row| row.score.as_ref());
    let whole = scores.clone().map(|score| score.core).collect();
    let of_task = |key: &str| {
        let scores = scores.clone();
        let points = scores.map(|score| score.tasks.get(key).map_or(0.0, |[core, _]| *core));
        points.collect()
    };
    html! {
        h2 id="points" { "Points" }
        p.soft {
            "Submissions by their share of the core points, in steps of 10 %. The last bar is for full points."
        }
        div.plots {
            (figure("All tasks", "", whole, max_score))
            @for task in &class.plan.tasks {
                (figure(&task.key, &task.title, of_task(&task.key), task.max(Tier::Core)))
            }
        }
    }
}

fn figure(name: &str, title: &str, scores: Vec<f64>, max: f64) -> Markup {
    let mut bars = [0_usize; BARS];
    for score in &scores {
        let share = if max > 0.0 { score / max } else { 1.0 };
        bars[((share * 10.0 + 1e-9).floor() as usize).min(BARS - 1)] += 1;
    }
    let mean = scores.iter().sum::<f64>() / scores.len().max(1) as f64;
    html! {
        figure {
            (bar_chart(&bars, name))
            figcaption {
                strong { (name) } @if !title.is_empty() { " " (title) } ": mean " (format!("{mean:.1}")) " of " (points(max))
            }
        }
    }
}

fn bar_chart(bars: &[usize; BARS], name: &str) -> Markup {
    let [w, h] = PLOT;
    let (top, bottom) = (14.0, h - 14.0);
    let most = bars.iter().copied().max().unwrap_or(0).max(1) as f64;
    let step = w / BARS as f64;
    let spoken: Vec<String> = bars.iter().map(ToString::to_string).collect();
    let number = |x: f64| format!("{x:.1}");
    let bars = bars.iter().enumerate().filter(|(_, count)| **count > 0);
    html! {
        svg viewBox=(format!("0 0 {w} {h}")) role="img" aria-label=(format!("{name}: {}", spoken.join(", "))) {
            @for (i, count) in bars {
                @let height = (bottom - top) * *count as f64 / most;
                @let (x, y) = (i as f64 * step, bottom - height);
                rect.bar x=(number(x + 1.5)) y=(number(y)) width=(number(step - 3.0)) height=(number(height)) {}
                text x=(number(x + step / 2.0)) y=(number(y - 3.0)) text-anchor="middle" { (count) }
            }
            line.axis x1="0" x2=(w) y1=(bottom) y2=(bottom) {}
            @for (i, label) in [(0, "0"), (5, "50"), (10, "full")] {
                text x=(number((i as f64 + 0.5) * step)) y=(number(h - 2.0)) text-anchor="middle" { (label) }
            }
        }
    }
}
