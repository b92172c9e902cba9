//! What an editor shows of a graded task: a warning for each wrong function, with what helps most.

use super::blame::Blame;
use crate::course::Task;
use crate::course::sources::SourceFile;
use crate::diagnosis::Certainty;
use crate::diagnosis::simplest::SimplestCall;
use crate::grade::one_by_one::{Graded, is_whole};
use crate::report::{HintLevel, TaskReport, message};
use crate::score::regularity;
use crate::score::{CaseResult, Status, TaskResult, order};
use crate::workers::crash::CrashKind;
use base::GraderError;
use judge::cases::checked;
use judge::findings::Finding as Counted;
use judge::{Tier, plural};
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;

/// What is wrong in a function of a task. It is stored until a file that it depends on changes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// The function to show it at, if the answers name one of those to write.
    pub function: Option<String>,
    /// Whether only cases fail that also run functions of other tasks, which may be wrong instead.
    pub only_with_others: bool,
    /// Whether a call did not end, so that other cases were not run.
    pub is_endless: bool,
    /// Which cases fail.
    cases: String,
    /// What each of the first cases tests.
    about: Vec<String>,
    /// What is wrong, or how the code crashed.
    wrong: String,
    /// The simplest call that shows it, with the result and the expected one.
    simplest: Option<String>,
    /// What else is known, such as what the wrong answers have in common.
    others: Vec<String>,
    /// The likely mistake.
    mistake: Option<String>,
    /// Where to look.
    remedy: Option<String>,
    /// Where the code panicked: file and line.
    panicked_at: Option<(String, usize)>,
}

/// The most failed cases that a message names.
const NAMED: usize = 4;

impl Finding {
    /// What is wrong in the core cases of a task, for each function that is to blame by itself;
    /// nothing if none of the cases fails. With `extra`, what is wrong in those of extra credit if
    /// no core case fails. `files` are those of its stage.
    pub fn all(
        graded: &Graded<'_>,
        task: &Task,
        files: &[SourceFile],
        extra: bool,
    ) -> Result<Vec<Finding>, GraderError> {
        let report = &graded.report;
        let mut failed = order::failed_cases_that_count(&report.result);
        // A loop ends the task, wherever it is met.
        let counts =
            |case: &CaseResult| case.tier == Tier::Core || ends_the_task(task, report, case);
        failed.retain(|case| extra || counts(case));
        let blame = Blame::new(task, files, &report.result.cases);
        let functions = blame.functions(&failed);
        if functions.len() < 2 || failed.iter().any(|case| case.crash().is_some()) {
            let only = match functions[..] {
                [function] => Some(function),
                _ => None,
            };
            let finding = Finding::of(report, task, &failed, only);
            return Ok(finding.into_iter().collect());
        }
        let mut findings = Vec::new();
        // How many of their wrong answers the likely mistake of the task explains.
        let mut explained = Vec::new();
        for function in functions {
            let choice = |findings| blame.only(function, findings);
            let of_function = failed.iter().map(|case| CaseResult {
                findings: choice(case.findings.clone()),
                ..(*case).clone()
            });
            let is_wrong = |case: &CaseResult| case.findings.iter().any(|of| of.wrong > 0);
            let result = TaskResult {
                cases: of_function.filter(is_wrong).collect(),
                ..report.result.clone()
            };
            // What is said of all wrong answers need not be true of those of this function.
            let alone = TaskReport {
                simplest: graded.simplest(&result, &choice)?,
                ..TaskReport::from(result)
            };
            let failed: Vec<&CaseResult> = alone.result.cases.iter().collect();
            if let Some(finding) = Finding::of(&alone, task, &failed, Some(function)) {
                findings.push(finding);
                explained.push(explained_by(report, &failed));
            }
        }
        let shown = report.simplest.as_ref().map(shown);
        let best = (0..findings.len())
            .max_by_key(|&at| (explained[at], findings[at].simplest == shown, Reverse(at)));
        if let Some(best) = best {
            findings[best].name_mistake(report);
        }
        Ok(findings)
    }

    /// What is wrong in the `failed` cases of the task `graded`, which `function` is to blame for
    /// if it is known; `None` if none of them fails by itself.
    fn of(
        report: &TaskReport,
        graded: &Task,
        failed: &[&CaseResult],
        function: Option<&str>,
    ) -> Option<Finding> {
        let task = &report.result;
        let mut of_all = failed.iter().copied();
        let endless = of_all.find(|case| ends_the_task(graded, report, case));
        let is_endless = endless.is_some();
        let first = endless.or(failed.first().copied())?;
        let simplest = report.simplest.as_ref();
        let crash = match &first.status {
            Status::Crashed(ended) if simplest.is_some() => Some(ended.without_input()),
            Status::Crashed(ended) => Some(ended.clone()),
            _ => None,
        };
        let wrong = match (&crash, simplest) {
            (Some(how), _) if is_endless => {
                let extra = match first.tier {
                    Tier::Core => "",
                    Tier::Robust => " (extra credit)",
                };
                format!("{}{extra}: a call does not end: it {how}", first.name)
            }
            (Some(how), _) => format!("{} {how}", first.name),
            (None, Some(call)) => counted(task, call).unwrap_or_else(|| worst(first)),
            (None, None) => worst(first),
        };
        let named = || {
            let of_worst = || first.worst().and_then(|(_, worst)| worst.function);
            let name = simplest.map_or_else(of_worst, |call| call.function)?;
            let mut functions = graded.holes.iter();
            functions.find(|hole| *hole == name).cloned()
        };
        let mut finding = Finding {
            function: function.map(str::to_owned).or_else(named),
            only_with_others: task.fails_only_with_neighbours(),
            is_endless,
            cases: match is_endless {
                true => format!("{}; the cases after it were not run", listed(failed)),
                false => listed(failed),
            },
            about: failed
                .iter()
                .take(NAMED)
                .map(|case| format!("{} tests: {}", case.name, checked(&case.about)))
                .collect(),
            wrong,
            simplest: simplest.map(shown),
            others: others(report),
            mistake: None,
            remedy: None,
            panicked_at: crash.and_then(|ended| ended.panicked_at),
        };
        finding.name_mistake(report);
        Some(finding)
    }

    /// Adds the likely mistake of the task, if there is one.
    fn name_mistake(&mut self, report: &TaskReport) {
        let diagnosis = report.diagnosis.as_ref();
        self.mistake = diagnosis.map(|found| {
            let label = found.certainty.label().to_lowercase();
            format!("{label}: {}", found.says)
        });
        self.remedy = diagnosis.map(|found| match found.certainty {
            Certainty::Likely => found.hint.clone(),
            Certainty::Perhaps => format!("{}: {}", found.certainty.before_hint(), found.hint),
        });
    }

    /// The message in a line, as far as `hint` reveals it.
    pub fn title(&self, hint: HintLevel) -> String {
        match hint {
            HintLevel::Cases => self.cases.clone(),
            _ => self.wrong.clone(),
        }
    }

    /// Notes about it, as far as `hint` reveals them.
    pub fn notes(&self, hint: HintLevel) -> Vec<String> {
        if hint == HintLevel::Cases {
            return self.about.clone();
        }
        let simplest = self.simplest.iter().cloned();
        let others = self.others.iter().cloned();
        simplest.chain(others).chain([self.cases.clone()]).collect()
    }

    /// Advice, as far as `hint` reveals it.
    pub fn advice(&self, hint: HintLevel) -> Vec<String> {
        let mistake = self.mistake.iter().filter(|_| hint >= HintLevel::Mistake);
        let remedy = self.remedy.iter().filter(|_| hint >= HintLevel::Remedy);
        mistake.chain(remedy).cloned().collect()
    }

    /// Where the code panicked: file and line.
    pub fn panicked_at(&self) -> Option<(&str, usize)> {
        let (file, line) = self.panicked_at.as_ref()?;
        Some((file, *line))
    }

    /// The words that say what is meant, for the search for its line; only if `hint` may say where
    /// to look.
    pub fn clue(&self, hint: HintLevel) -> Option<String> {
        let remedy = self.remedy.as_ref().filter(|_| hint >= HintLevel::Remedy)?;
        Some(format!(
            "{} {remedy}",
            self.mistake.as_deref().unwrap_or_default()
        ))
    }
}

/// Whether a call of the case does not end, so that the cases after it were not run.
fn ends_the_task(task: &Task, report: &TaskReport, case: &CaseResult) -> bool {
    let kind = case.crash().map(|crash| crash.kind);
    kind == Some(CrashKind::Endless) && !is_whole(task, report)
}

/// How many wrong answers of `cases` are in places that the mistake of the task explains.
fn explained_by(report: &TaskReport, cases: &[&CaseResult]) -> usize {
    let Some(diagnosis) = &report.diagnosis else {
        return 0;
    };
    let findings = cases.iter().flat_map(|case| &case.findings);
    let faults = findings.flat_map(|of| of.faults.iter().map(|fault| (of.aspect, fault)));
    faults
        .filter(|(aspect, fault)| diagnosis.explains(*aspect, fault.named_function()))
        .count()
}

/// The simplest call with the result and the expected one.
fn shown(call: &SimplestCall) -> String {
    let (input, found) = (message::input(call), message::found(call));
    let only: String = call.only.iter().map(|only| format!(" ({only})")).collect();
    format!("simplest case: {input}: {found}{only}")
}

/// How many calls of the simplest call's case are wrong in its aspect.
fn counted(task: &TaskResult, call: &SimplestCall) -> Option<String> {
    let case = task.cases.iter().find(|case| case.name == call.case)?;
    let mut findings = case.findings.iter();
    let found = findings.find(|finding| Some(finding.aspect) == call.aspect)?;
    Some(wrong_calls(case, found))
}

fn wrong_calls(case: &CaseResult, found: &Counted) -> String {
    let (label, wrong) = (found.aspect.label(), found.wrong);
    let calls = judge::plural(found.judged, "call", "calls");
    format!("{label} wrong on {wrong} of {calls} of {}", case.name)
}

/// The first wrong aspect of a case with its worst answer, or what else costs its points.
fn worst(case: &CaseResult) -> String {
    match case.findings.iter().find(|finding| finding.wrong > 0) {
        Some(found) => {
            let wrong = wrong_calls(case, found);
            match &found.worst {
                Some(worst) => {
                    format!("{wrong}: {}", message::with_telling_digits(&worst.message))
                }
                None => wrong,
            }
        }
        None => match case.reductions.first() {
            Some(why) => format!("{}: {why}", case.name),
            None => format!("{} fails", case.name),
        },
    }
}

fn listed(failed: &[&CaseResult]) -> String {
    let names: Vec<&str> = failed
        .iter()
        .take(NAMED)
        .map(|case| case.name.as_str())
        .collect();
    let more = match failed.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let fail = plural(failed.len(), "case fails", "cases fail");
    format!("{fail}: {}{more}", names.join(", "))
}

/// What the wrong answers have in common, and what else may be wrong instead.
fn others(report: &TaskReport) -> Vec<String> {
    let mut notes = Vec::new();
    if !report.regularities.is_empty() {
        notes.push(format!(
            "in common: {}",
            regularity::joined(&report.regularities)
        ));
    }
    if report.result.fails_only_with_neighbours() {
        notes.push(message::WITH_NEIGHBOURS.to_owned());
    }
    notes
}

#[cfg(test)]
impl Finding {
    pub(super) fn for_tests(only_with_others: bool) -> Finding {
        Finding {
            only_with_others,
            ..Finding::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use crate::diagnosis::Diagnosis;
    use judge::findings::{Aspect, Findings};
    use std::collections::BTreeSet;

    /// Two mistakes, of which the likely one explains the second: it is named there, not at the
    /// first function.
    #[test]
    fn a_mistake_is_named_at_the_function_whose_answers_it_explains() {
        const CODE: &str = "pub fn intersect_triangle(r: &mut Ray) -> Option<Hit> {\n    let hit = test_triangle(r)?;\n    Some(record_triangle(r, hit))\n}\n";
        let text = include_str!("../../../stages/course.toml");
        let course = Course::parse(text).expect("it is valid");
        let mut tasks = course.tasks().filter(|task| task.key == "part1.task3");
        let task = tasks.next().expect("it has triangles");
        let mut found = Findings::default();
        for (function, call, aspect) in [
            ("test_triangle", 1, Aspect::HitOrMiss),
            ("intersect_triangle", 1, Aspect::HitOrMiss),
            ("intersect_triangle", 2, Aspect::Normal),
            ("intersect_triangle", 3, Aspect::Normal),
        ] {
            found.count_for(function);
            found.judge(aspect, call, false, 1.0, String::new);
        }
        let mut result = TaskResult::new(task, Vec::new());
        result.cases = vec![CaseResult::failed("front_face", found.into_vec())];
        let files = [SourceFile {
            path: "a.rs".into(),
            text: CODE.into(),
        }];
        let named_at = |place| {
            let mut report = TaskReport::from(result.clone());
            report.diagnosis = Some(Diagnosis {
                hint: "Look.".into(),
                places: BTreeSet::from([place]),
                ..Diagnosis::default()
            });
            let graded = Graded::for_tests(report);
            let findings = Finding::all(&graded, task, &files, false).expect("nothing is asked");
            let named = findings.into_iter().filter(|one| one.remedy.is_some());
            named.filter_map(|one| one.function).collect::<Vec<_>>()
        };
        assert_eq!(named_at((Aspect::Normal, None)), ["record_triangle"]);
        assert_eq!(named_at((Aspect::HitOrMiss, None)), ["test_triangle"]);
    }
}
