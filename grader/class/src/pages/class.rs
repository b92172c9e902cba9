//! The page of the class.

use super::{escape, page as whole_page};
use crate::collect::{Class, Row, Status, points};
use crate::likeness::{self, EXPECTED};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The page. `page_names` are the file names of the students' pages, in the order of the rows.
pub fn page(class: &Class, page_names: &[String]) -> String {
    let settings = &class.plan.settings;
    let mut html = format!("<h1>{}: the class</h1>\n", escape(&settings.what));
    let _ = writeln!(html, "<p>{}. {}</p>", class.summary(), middle(class));
    let _ = writeln!(
        html,
        "<p class=\"soft\">Random inputs: seed {}.",
        settings.seed
    );
    if let Some(revision) = &settings.revision {
        let _ = write!(html, " Graded: {}.", escape(&revision.to_string()));
    }
    html.push_str("</p>\n");
    html.push_str(&without_score(class));
    html.push_str(&distributions(class));
    html.push_str(&mistakes(class));
    html.push_str(&pairs(class));
    html.push_str(&students(class, page_names));
    whole_page(&format!("{}, the class", settings.what), &html)
}

/// The mean and the median of the core points.
fn middle(class: &Class) -> String {
    let scores = class
        .rows
        .iter()
        .filter_map(|row| Some(row.score.as_ref()?.core));
    let mut scores: Vec<f64> = scores.collect();
    scores.sort_by(f64::total_cmp);
    if scores.is_empty() {
        return String::new();
    }
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    let half = scores.len() / 2;
    let median = match scores.len() % 2 {
        0 => (scores[half - 1] + scores[half]) / 2.0,
        _ => scores[half],
    };
    format!(
        "Points: mean {mean:.1}, median {median:.1} of {}.",
        points(class.max_score()[0])
    )
}

/// The submissions that a person has to look at.
fn without_score(class: &Class) -> String {
    let without = class.rows.iter().filter(|row| row.score.is_none());
    let unreadable = class
        .rows
        .iter()
        .filter(|row| matches!(row.status, Status::Unreadable(_)));
    listed("No score", without) + &listed("Could not be read: no points", unreadable)
}

/// A list of rows, each with what is wrong; empty if there are none.
fn listed<'a>(heading: &str, rows: impl Iterator<Item = &'a Row>) -> String {
    let mut rows = rows.peekable();
    if rows.peek().is_none() {
        return String::new();
    }
    let mut html = format!("<h2>{heading}</h2>\n<ul>");
    for row in rows {
        let why = row.status.detail().unwrap_or_default();
        let _ = write!(
            html,
            "<li><strong>{}</strong>: {}</li>",
            escape(&row.name),
            escape(why)
        );
    }
    html + "</ul>\n"
}

/// The number of bars of a distribution: those for 0 to 100 % in steps of 10 %; full points have
/// one of their own.
const BARS: usize = 11;

/// The size of a distribution in units of its drawing.
const PLOT: [f64; 2] = [260.0, 110.0];

fn distributions(class: &Class) -> String {
    let mut html = String::from(
        "<h2>Points by task</h2>\n<p class=\"soft\">Submissions by their share of the core points, in steps of 10 %. The last bar is for full points.</p>\n<div class=\"plots\">\n",
    );
    for task in &class.plan.tasks {
        let mut bars = [0_usize; BARS];
        let mut sum = 0.0;
        let scores = class.rows.iter().filter_map(|row| row.score.as_ref());
        let scores = scores.map(|score| score.tasks.get(&task.key).map_or(0.0, |[core, _]| *core));
        for score in scores {
            sum += score;
            let share = if task.max_score > 0.0 {
                score / task.max_score
            } else {
                1.0
            };
            bars[((share * 10.0 + 1e-9).floor() as usize).min(BARS - 1)] += 1;
        }
        let n: usize = bars.iter().sum();
        let _ = writeln!(
            html,
            "<figure>{}<figcaption><strong>{}</strong> {}: mean {:.1} of {}</figcaption></figure>",
            bar_chart(&bars, &task.key),
            escape(&task.key),
            escape(&task.title),
            sum / n.max(1) as f64,
            points(task.max_score)
        );
    }
    html + "</div>\n"
}

fn bar_chart(bars: &[usize; BARS], name: &str) -> String {
    let [w, h] = PLOT;
    let (top, bottom) = (14.0, h - 14.0);
    let most = bars.iter().copied().max().unwrap_or(0).max(1) as f64;
    let step = w / BARS as f64;
    let spoken: Vec<String> = bars.iter().map(ToString::to_string).collect();
    let mut svg = format!(
        "<svg viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}: {}\">",
        escape(name),
        spoken.join(", ")
    );
    for (i, count) in bars.iter().enumerate().filter(|(_, count)| **count > 0) {
        let height = (bottom - top) * *count as f64 / most;
        let (x, y) = (i as f64 * step, bottom - height);
        let _ = write!(
            svg,
            "<rect class=\"bar\" x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{height:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{count}</text>",
            x + 1.5,
            step - 3.0,
            x + step / 2.0,
            y - 3.0
        );
    }
    let _ = write!(
        svg,
        "<line class=\"axis\" x1=\"0\" x2=\"{w}\" y1=\"{bottom}\" y2=\"{bottom}\"/>"
    );
    for (i, label) in [(0, "0"), (5, "50"), (10, "full")] {
        let x = (i as f64 + 0.5) * step;
        let _ = write!(
            svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
            h - 2.0
        );
    }
    svg + "</svg>"
}

/// What a task lost points by, with how many students.
#[derive(Default)]
struct Mistake<'a> {
    says: &'a str,
    likely: usize,
    perhaps: usize,
}

/// The most mistakes that are listed.
const MOST_MISTAKES: usize = 20;

fn mistakes(class: &Class) -> String {
    let mut known: BTreeMap<(&str, String), Mistake> = BTreeMap::new();
    let mut unnamed: BTreeMap<&str, usize> = BTreeMap::new();
    let reports = class.rows.iter().filter_map(|row| row.graded.as_ref());
    for task in reports.flat_map(|(_, report)| &report.tasks) {
        match &task.diagnosis {
            Some(diagnosis) => {
                let name = diagnosis.mistakes.join(" or ");
                let mistake = known.entry((&task.key, name)).or_default();
                mistake.says = &diagnosis.says;
                match diagnosis.certainty.as_str() {
                    "likely" => mistake.likely += 1,
                    _ => mistake.perhaps += 1,
                }
            }
            None if ["failed", "crashed"].contains(&task.status.as_str())
                && task.score < task.max_score =>
            {
                *unnamed.entry(&task.key).or_default() += 1;
            }
            None => {}
        }
    }
    let mut known: Vec<_> = known.into_iter().collect();
    known.sort_by_key(|(name, mistake)| {
        (
            std::cmp::Reverse(mistake.likely + mistake.perhaps),
            name.clone(),
        )
    });
    let mut html = String::from("<h2>The most frequent mistakes</h2>\n");
    if known.is_empty() {
        html.push_str("<p>None is known by name.</p>\n");
    } else {
        html.push_str("<div class=\"scroll\"><table>\n<thead><tr><th class=\"number\">students</th><th>task</th><th>mistake</th></tr></thead>\n<tbody>\n");
        for ((task, name), mistake) in known.iter().take(MOST_MISTAKES) {
            let perhaps = match mistake.perhaps {
                0 => String::new(),
                some => format!("<br><span class=\"soft\">{some} perhaps</span>"),
            };
            let _ = writeln!(
                html,
                "<tr><td class=\"number\">{}{perhaps}</td><td>{}</td><td class=\"note\"><code>{}</code><br>{}</td></tr>",
                mistake.likely + mistake.perhaps,
                escape(task),
                escape(name),
                escape(&about_code(mistake.says))
            );
        }
        html.push_str("</tbody></table></div>\n");
    }
    let unnamed: Vec<String> = unnamed
        .iter()
        .map(|(task, count)| format!("{count} in {}", escape(task)))
        .collect();
    if !unnamed.is_empty() {
        let _ = writeln!(
            html,
            "<p class=\"soft\">Points lost by mistakes without a name: {}.</p>",
            unnamed.join(", ")
        );
    }
    html
}

/// What a diagnosis says about the code, without the student's numbers: of "your answers equal
/// those of code that culls back faces: on 560 of 560 calls" the words "code that culls back
/// faces".
fn about_code(says: &str) -> String {
    let start = says.find("code that ").unwrap_or(0);
    let end = says.rfind(": on ").filter(|end| *end > start);
    says[start..end.unwrap_or(says.len())].to_string()
}

/// A small number of pairs, with two digits that count.
fn expected_pairs(pairs: f64) -> String {
    match pairs {
        1.0.. => format!("{pairs:.0}"),
        1e-6.. => {
            let digits = (-pairs.log10()).floor() as usize + 2;
            format!("{pairs:.digits$}")
        }
        _ => "less than 0.000001".to_string(),
    }
}

fn pairs(class: &Class) -> String {
    let pairs = likeness::pairs(class);
    let mut html = String::from("<h2>Pairs to ask about</h2>\n");
    let shared = likeness::shared_by_many(class);
    for files in &shared {
        let _ = writeln!(
            html,
            "<p>{} submissions have the same files of {}. If they are not an example of the course, ask: {}.</p>",
            files.names.len(),
            escape(&files.stage),
            escape(&files.names.join(", "))
        );
    }
    if pairs.is_empty() {
        let other = if shared.is_empty() { "" } else { " other" };
        let _ = writeln!(
            html,
            "<p>No two submissions share more wrong answers than chance explains, nor{other} files.</p>"
        );
        return html;
    }
    let _ = writeln!(
        html,
        "<p>These submissions have the same wrong answers, or the same files. This is a question, not an accusation: they may come from one group, one tutor or one page on the web. Ask both to explain a line. A pair is listed if fewer than {EXPECTED} pairs of this class would be expected to agree so by chance, given how often its students make each mistake, or if the files of a stage are equal.</p>"
    );
    html.push_str("<div class=\"scroll\"><table>\n<thead><tr><th>who</th><th>the same wrong answers</th><th>the same files</th><th class=\"number\">pairs expected<br>by chance</th></tr></thead>\n<tbody>\n");
    for pair in &pairs {
        let tasks: Vec<String> = pair
            .tasks
            .iter()
            .map(|(task, count, others)| {
                let others = match others {
                    0 => "nobody else has them".to_string(),
                    1 => "one other student has them".to_string(),
                    others => format!("{others} others have them"),
                };
                format!("{}: {count} answers, {others}", escape(task))
            })
            .collect();
        let expected = match pair.tasks.is_empty() {
            true => String::new(),
            false => expected_pairs(pair.expected),
        };
        let _ = writeln!(
            html,
            "<tr><td class=\"name\">{}<br>{}</td><td class=\"note\">{}</td><td>{}</td><td class=\"number\">{expected}</td></tr>",
            escape(&pair.names[0]),
            escape(&pair.names[1]),
            tasks.join("<br>"),
            escape(&pair.stages.join(" "))
        );
    }
    html + "</tbody></table></div>\n"
}

fn students(class: &Class, page_names: &[String]) -> String {
    let mut html = String::from(
        "<h2>All submissions</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>submission</th><th>status</th><th class=\"number\">points</th><th class=\"number\">extra</th>",
    );
    for task in &class.plan.tasks {
        let _ = write!(html, "<th class=\"number\">{}</th>", escape(&task.key));
    }
    html.push_str("<th>notes</th></tr></thead>\n<tbody>\n");
    for (row, page) in class.rows.iter().zip(page_names) {
        let _ = write!(
            html,
            "<tr><td class=\"name\"><a href=\"students/{}.html\">{}</a></td><td class=\"status\">{}</td>",
            escape(page),
            escape(&row.name),
            row.status.label()
        );
        let cells = 2 + class.plan.tasks.len();
        match &row.score {
            Some(score) => {
                let _ = write!(
                    html,
                    "<td class=\"number\">{}</td><td class=\"number\">{}</td>",
                    points(score.core),
                    points(score.extra)
                );
                for task in &class.plan.tasks {
                    let core = score.tasks.get(&task.key).map_or(0.0, |[core, _]| *core);
                    let _ = write!(html, "<td class=\"number\">{}</td>", points(core));
                }
            }
            None => html.push_str(&"<td></td>".repeat(cells)),
        }
        let notes = row
            .status
            .detail()
            .into_iter()
            .chain(row.notes.iter().map(String::as_str));
        let notes: Vec<&str> = notes.collect();
        let _ = writeln!(
            html,
            "<td class=\"note\">{}</td></tr>",
            escape(&notes.join("; "))
        );
    }
    html + "</tbody></table></div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_is_named_without_the_numbers_of_one_student() {
        let says =
            "your answers nearly equal those of code that swaps x and y: on 230 of 231 calls";
        assert_eq!(about_code(says), "code that swaps x and y");
        assert_eq!(about_code("something else"), "something else");
    }

    #[test]
    fn expected_pairs_have_two_digits_that_count() {
        let numbers = [29.2, 0.0999, 6.66e-5, 0.0].map(expected_pairs);
        assert_eq!(numbers, ["29", "0.100", "0.000067", "less than 0.000001"]);
    }
}
