//! What `grader bless` would do if the reference made a mistake: the answers of each mutant are
//! judged whole, as the goldens' test judges those of the reference.

use grader::workers::runner::Ending;
use judge::Tier;
use judge::cases::Spec;
use judge::snapshot::{self, Line, Snapshot};
use judge::whole::{Counts, Verdict, Whole, judge_whole};
use std::collections::BTreeMap;
use std::fmt::Write;
use wire::{Answer, Outcome};

/// What the exact oracle says about a mutant's answers to a case, where they differ from those of
/// the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Blessing {
    /// The name of the case.
    pub case: String,
    /// The verdicts on the answers that differ.
    pub changed: Counts,
    /// Whether an answer of the case is wrong, or there is none: then nothing is blessed.
    pub refused: bool,
    /// The answers that differ and are confirmed.
    pub confirmed: Option<ConfirmedChange>,
}

/// The answers to a case that differ from the reference's, and are right.
#[derive(Clone, Debug, PartialEq)]
pub struct ConfirmedChange {
    /// The largest difference of a number, relative to the largest number of its field.
    pub difference: f64,
    /// The number of the call with this difference.
    pub call: u32,
    /// The reference's answer there.
    pub golden: String,
    /// The mutant's answer there.
    pub actual: String,
}

/// What becomes of a changed case, or of all of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BlessVerdict {
    /// Every changed answer is confirmed: nothing tells the reviewer of a mistake.
    Confirmed,
    /// No answer is found wrong, and `grader bless` lists what is not judged.
    NotJudged,
    /// `grader bless` writes nothing.
    Refused,
}

impl Blessing {
    /// What becomes of the case.
    pub fn verdict(&self) -> BlessVerdict {
        if self.refused {
            BlessVerdict::Refused
        } else if self.changed.not_judged > 0 {
            BlessVerdict::NotJudged
        } else {
            BlessVerdict::Confirmed
        }
    }
}

/// What becomes of a mutant that changes these cases: the worst for its chances. `None` if it
/// changes none.
pub fn verdict(blessings: &[Blessing]) -> Option<BlessVerdict> {
    blessings.iter().map(Blessing::verdict).max()
}

/// The answers of the reference to the cases of a task.
#[derive(Debug)]
pub(super) struct ReferenceAnswers(Vec<Option<Snapshot>>);

impl ReferenceAnswers {
    pub(super) fn of(specs: &[&Spec], endings: &[Result<Ending, String>]) -> ReferenceAnswers {
        let pairs = specs.iter().zip(endings);
        let rows = pairs.map(|(spec, ending)| snapshot::full(&spec.work, answer(ending)?));
        ReferenceAnswers(rows.collect())
    }

    /// Judges the answers that differ from the reference's.
    pub(super) fn bless(
        &self,
        specs: &[&Spec],
        endings: &[Result<Ending, String>],
    ) -> Vec<Blessing> {
        let cases = specs.iter().zip(endings).zip(&self.0);
        cases
            .filter_map(|((spec, ending), golden)| bless(spec, ending, golden.as_ref()?))
            .collect()
    }
}

fn bless(spec: &Spec, ending: &Result<Ending, String>, golden: &Snapshot) -> Option<Blessing> {
    let Some(answer) = answer(ending) else {
        // The goldens' test fails.
        return Some(Blessing {
            case: spec.name.into(),
            changed: Counts::default(),
            refused: true,
            confirmed: None,
        });
    };
    let actual = snapshot::full(&spec.work, answer)?;
    let changes = snapshot::changes(golden, &actual);
    // An answer may be wrong in a part that no golden shows.
    let whole = judge_whole(spec, Tier::Robust, answer);
    if changes.is_empty() && !whole.is_refused() {
        return None;
    }
    let [short, long] = [golden.calls, actual.calls].map(|calls| calls as u32);
    let (short, long) = (short.min(long), short.max(long));
    let mut differing: Vec<u32> = changes.differing.clone();
    differing.extend(short..long);
    // The totals are of all calls.
    if changes.totals && differing.is_empty() {
        differing.extend(0..long);
    }
    Some(Blessing {
        case: spec.name.into(),
        changed: whole.count(differing.iter().copied()),
        refused: whole.is_refused(),
        confirmed: confirmed(&whole, &differing, [golden, &actual]),
    })
}

/// Of the confirmed rows, the one that differs most.
fn confirmed(
    whole: &Whole,
    differing: &[u32],
    snapshots: [&Snapshot; 2],
) -> Option<ConfirmedChange> {
    let mut most: Option<ConfirmedChange> = None;
    let confirmed = differing
        .iter()
        .filter(|row| whole.verdict(**row) == Verdict::Confirmed);
    for &call in confirmed {
        let lines = snapshots.map(|snapshot| snapshot.row(call));
        let difference = match lines {
            [Some(golden), Some(actual)] => difference(golden, actual),
            _ => f64::INFINITY,
        };
        if most
            .as_ref()
            .is_none_or(|most| difference > most.difference)
        {
            let [golden, actual] =
                lines.map(|line| line.map_or("no row".into(), Line::answer_text));
            most = Some(ConfirmedChange {
                difference,
                call,
                golden,
                actual,
            });
        }
    }
    most
}

/// The largest difference of two numbers in a field, relative to the largest number of the field;
/// infinite if the fields themselves differ.
fn difference(golden: &Line, actual: &Line) -> f64 {
    let names = |line: &Line| {
        line.answer
            .iter()
            .map(|(name, _)| name.clone())
            .collect::<Vec<_>>()
    };
    if names(golden) != names(actual) {
        return f64::INFINITY;
    }
    let mut most: f64 = 0.0;
    for ((name, golden), (_, actual)) in golden.answer.iter().zip(&actual.answer) {
        let (golden, actual) = (golden.numbers(), actual.numbers());
        if golden.len() != actual.len() {
            return f64::INFINITY;
        }
        // Barycentric weights are shares of 1.
        let smallest_scale = if name == "uv" { 1.0 } else { 0.0 };
        let both = golden.iter().chain(&actual);
        let scale = both.fold(smallest_scale, |scale: f64, x| scale.max(x.abs()));
        for (a, b) in golden.iter().zip(&actual) {
            let same = a == b || a.is_nan() && b.is_nan();
            most = most.max(if same { 0.0 } else { (a - b).abs() / scale });
        }
    }
    most
}

fn answer(ending: &Result<Ending, String>) -> Option<&Answer> {
    match ending.as_ref().ok()?.outcome()? {
        Outcome::Answered(answer) => Some(answer),
        _ => None,
    }
}

/// The table of mistakes and cases, in Markdown: for each mutant the numbers of changed cases that
/// are refused, not judged and confirmed, and the names of those that are not refused.
pub fn markdown(task: &str, mutants: &[(&str, &[Blessing])]) -> String {
    let mut text = format!(
        "\n| {task}: mistake | bless | cases refused | not judged | confirmed | changed answers | confirmed ones differ by | cases that are not refused |\n\
         |---|---|--:|--:|--:|---|--:|---|\n"
    );
    for (name, blessings) in mutants {
        let mut cases: BTreeMap<BlessVerdict, Vec<String>> = BTreeMap::new();
        let mut answers = Counts::default();
        let differences = blessings
            .iter()
            .filter_map(|blessing| blessing.confirmed.as_ref());
        let differences = differences.map(|change| change.difference);
        let difference = differences
            .reduce(f64::max)
            .map_or(String::new(), |most| format!("{most:.0e}"));
        for blessing in *blessings {
            let Blessing { case, changed, .. } = blessing;
            let named = format!("{case} ({changed})");
            cases.entry(blessing.verdict()).or_default().push(named);
            answers.confirmed += changed.confirmed;
            answers.refused += changed.refused;
            answers.not_judged += changed.not_judged;
        }
        let count = |verdict| cases.get(&verdict).map_or(0, Vec::len);
        let of = [BlessVerdict::Confirmed, BlessVerdict::NotJudged];
        let others: Vec<&str> = of
            .iter()
            .flat_map(|verdict| cases.get(verdict).into_iter().flatten())
            .map(String::as_str)
            .collect();
        let said = match verdict(blessings) {
            None => "nothing to bless",
            Some(BlessVerdict::Refused) => "refuses",
            Some(BlessVerdict::NotJudged) => "lists what is not judged",
            Some(BlessVerdict::Confirmed) => "**accepts**",
        };
        let _ = writeln!(
            text,
            "| {name} | {said} | {} | {} | {} | {answers} | {difference} | {} |",
            count(BlessVerdict::Refused),
            count(BlessVerdict::NotJudged),
            count(BlessVerdict::Confirmed),
            others.join(", ")
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blessing(case: &str, [confirmed, refused, not_judged]: [usize; 3]) -> Blessing {
        Blessing {
            case: case.into(),
            changed: Counts {
                confirmed,
                refused,
                not_judged,
            },
            refused: refused > 0,
            confirmed: None,
        }
    }

    #[test]
    fn one_refused_case_refuses_all() {
        let confirmed = blessing("a", [3, 0, 0]);
        let open = blessing("b", [3, 0, 1]);
        let refused = blessing("c", [0, 1, 0]);
        assert_eq!(verdict(&[]), None);
        let all = [confirmed, open, refused];
        assert_eq!(verdict(&all[..1]), Some(BlessVerdict::Confirmed));
        assert_eq!(verdict(&all[..2]), Some(BlessVerdict::NotJudged));
        assert_eq!(verdict(&all), Some(BlessVerdict::Refused));
        let table = markdown("part1.task3", &[("culled", &all), ("accepted", &all[..1])]);
        let row = "| culled | refuses | 1 | 1 | 1 | 1 wrong, 6 confirmed, 1 not judged |  | \
                   a (3 confirmed), b (3 confirmed, 1 not judged) |";
        assert!(table.contains(row), "{table}");
        assert!(
            table.contains("| accepted | **accepts** | 0 | 0 | 1 |"),
            "{table}"
        );
    }
}
