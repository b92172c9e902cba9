//! The functions of a task: their shares of the points of each case, and whether they are right.

use super::{CaseResult, Status, WITHOUT_IDEA};
use crate::course::{Idea, Task};
use judge::Tier;
use judge::findings::{Aspect, Finding};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use wire::record::HoleCall;

/// A function that shares the points of a case equally with others.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionShare {
    /// The function; empty in tasks with one function.
    pub function: String,
    /// The fraction of its share that it earned.
    pub fraction: f64,
    /// The function that is not written yet: this one, or one that it calls.
    pub hole: Option<String>,
}

/// The result of one function of a task.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FunctionResult {
    /// Its name.
    pub name: String,
    /// Its status.
    #[serde(flatten)]
    pub status: FunctionStatus,
}

/// The status of a function.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "status")]
pub enum FunctionStatus {
    /// It is right in every core case that judges it.
    Right,
    /// It is wrong in some core cases.
    Wrong {
        /// The number of core cases that judge it.
        of: usize,
        /// How many of them it fails.
        wrong: usize,
    },
    /// It is not written yet.
    Hole,
    /// It is written, but reaches code that is not.
    Unfinished {
        /// The number of cases that call it.
        of: usize,
        /// How many of them have no answers of it for this reason.
        open: usize,
    },
    /// It cannot be judged in every case before another function is written.
    Needs {
        /// The other function.
        function: String,
    },
}

impl FunctionShare {
    pub(super) fn is_hole(&self) -> bool {
        self.hole.is_some()
    }

    /// Why the share is lost, if no answer is to blame.
    pub(crate) fn reduction(&self) -> Option<String> {
        let hole = self.hole.as_ref()?;
        Some(if *hole == self.function {
            format!("{hole} is not written yet")
        } else {
            format!("{} needs {hole}, which is not written yet", self.function)
        })
    }
}

/// The functions that share the points of a case: those that are judged in a main answer, and those
/// with holes. In tasks with one function it has no name.
pub(super) fn shares(findings: &[Finding], holes: &[HoleCall]) -> Vec<FunctionShare> {
    let main = findings.iter().filter(|finding| finding.main);
    let mut names: Vec<&str> = Vec::new();
    for count in main.flat_map(|finding| &finding.functions) {
        if !names.contains(&count.function) {
            names.push(count.function);
        }
    }
    if findings.is_empty() {
        // The case has no answers.
        names.extend(holes.iter().map(|hole| hole.called.as_str()));
    }
    if names.is_empty() {
        names.push("");
    }
    let shares = names.into_iter().map(|function| {
        let hole = holes.iter().find(|hole| hole.called == function);
        FunctionShare {
            function: function.to_string(),
            fraction: match hole {
                Some(_) => 0.0,
                None => earned_fraction(findings, function),
            },
            hole: hole.map(|hole| hole.hole.clone()),
        }
    });
    shares.collect()
}

/// The fraction of its share of a case's points that a function earned: none if a main answer is
/// wrong. The main answers weigh as much as all others together, which have the same weight each.
fn earned_fraction(findings: &[Finding], function: &str) -> f64 {
    let passed = |main: bool| {
        let findings = findings.iter().filter(move |finding| finding.main == main);
        findings.filter_map(|finding| finding.passed_by(function))
    };
    let (main, others) = (passed(true), passed(false));
    if findings.is_empty() || !main.into_iter().all(|passed| passed) {
        return 0.0;
    }
    let others: Vec<f64> = others.map(|passed| f64::from(u8::from(passed))).collect();
    match others.is_empty() {
        true => 1.0,
        false => 0.5 + 0.5 * mean(others),
    }
}

/// The mean; 0 of no numbers.
pub(super) fn mean(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0_u32);
    for number in numbers {
        sum += number;
        count += 1;
    }
    sum / f64::from(count.max(1))
}

/// Takes points away from the functions that do not have the idea of their task.
pub(super) fn require_idea(task: &Task, cases: &mut [CaseResult]) {
    let functions: BTreeSet<String> = cases
        .iter()
        .flat_map(|case| case.shares.iter().map(|share| share.function.clone()))
        .collect();
    let lacking = functions.into_iter().filter_map(|function| {
        let idea = lacking_idea(task, cases, &function)?;
        Some((function, idea))
    });
    let lacking: BTreeMap<String, &Idea> = lacking.collect();
    let with_answers = cases.iter().filter(|case| !case.findings.is_empty());
    let answered: BTreeSet<String> = with_answers.map(|case| case.name.clone()).collect();
    for case in cases {
        let lacks = |share: &FunctionShare| lacking.get(&share.function);
        let Some(idea) = case.shares.iter().find_map(lacks) else {
            continue;
        };
        let what = format!(
            "counts a quarter until {}",
            what_is_missing(idea, &answered)
        );
        let fractions = case.shares.iter().map(|share| match lacks(share) {
            Some(_) => WITHOUT_IDEA * share.fraction,
            None => share.fraction,
        });
        let earned = mean(fractions);
        if matches!(case.status, Status::Passed | Status::Failed) {
            case.earned = case.earned.min(earned);
            case.reduce(case.max_score * earned, what);
        }
    }
}

/// What would give the points, to end the sentence "counts a quarter until ...".
fn what_is_missing(idea: &Idea, answered: &BTreeSet<String>) -> String {
    let Idea { case, aspect, .. } = idea;
    match answered.contains(case) {
        true => format!("the case {case} is right, too ({})", aspect.label()),
        false => format!("the case {case} has answers ({})", aspect.label()),
    }
}

/// The aspect that shows that `function` does not have the idea of its task, if there is one.
fn lacking_idea<'a>(task: &'a Task, cases: &[CaseResult], function: &str) -> Option<&'a Idea> {
    let is_of_function = |idea: &&Idea| idea.function.as_deref().is_none_or(|of| of == function);
    task.idea.iter().filter(is_of_function).find(|idea| {
        let is_right = |case: &String| is_right(cases, case, idea.aspect, function);
        let elsewhere = idea.or_in.as_ref().and_then(is_right);
        is_right(&idea.case) == Some(false) && elsewhere != Some(true)
    })
}

/// Whether `function` has the `aspect` right in the case. Code that crashes there, does not end or
/// is not written has not: otherwise this would earn more than a wrong answer. `None` if the case
/// shows nothing: it was not run, waits for another task, or judges other functions.
fn is_right(cases: &[CaseResult], case: &str, aspect: Aspect, function: &str) -> Option<bool> {
    let case = cases.iter().find(|other| other.name == case)?;
    if case.waits_for_others() {
        return None;
    }
    let is_own = |share: &&FunctionShare| share.function == function;
    let has_hole = case
        .shares
        .iter()
        .filter(is_own)
        .any(FunctionShare::is_hole);
    let finding = case
        .findings
        .iter()
        .find(|finding| finding.aspect == aspect);
    match finding {
        Some(finding) if !has_hole => finding.mostly_right_by(function),
        _ => Some(false),
    }
}

/// The results of the functions of a task that are judged or have holes, in the order of the task.
pub(super) fn results(task: &Task, cases: &[CaseResult]) -> Vec<FunctionResult> {
    let results = task.holes.iter().filter_map(|name| {
        let own = |share: &&FunctionShare| match task.holes.len() {
            1 => share.function.is_empty() || share.function == *name,
            _ => share.function == *name,
        };
        let core = cases.iter().filter(|case| case.tier == Tier::Core);
        let is_open = |case: &&CaseResult| {
            let alone = task.holes.len() == 1 && case.status == Status::NotAttempted;
            let is_hole = |share: &FunctionShare| share.hole.as_ref() == Some(name);
            alone || case.shares.iter().any(is_hole)
        };
        let calls = |case: &&CaseResult| is_open(case) || case.shares.iter().any(|s| own(&s));
        let open = cases.iter().filter(is_open).count();
        if open > 0 {
            let status = match cases.iter().filter(calls).count() {
                of if of > open => FunctionStatus::Unfinished { of, open },
                _ => FunctionStatus::Hole,
            };
            let name = name.clone();
            return Some(FunctionResult { name, status });
        }
        let own_shares: Vec<&FunctionShare> = core
            .flat_map(|case| case.shares.iter().filter(own))
            .collect();
        let needs = own_shares.iter().find_map(|share| share.hole.clone());
        let wrong = own_shares.iter().filter(|share| share.fraction < 1.0);
        let status = match (needs, own_shares.len(), wrong.count()) {
            (_, 0, _) => return None,
            (Some(function), ..) => FunctionStatus::Needs { function },
            (None, _, 0) => FunctionStatus::Right,
            (None, of, wrong) => FunctionStatus::Wrong { of, wrong },
        };
        let name = name.clone();
        Some(FunctionResult { name, status })
    });
    results.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use crate::score::TaskResult;
    use judge::findings::Findings;

    /// A task of two functions and 20 core points; `shows` shows its idea.
    const COURSE: &str = r#"
conventions = []
[[part]]
number = 1
title = ""
[[part.task]]
key = "part1.task1"
title = ""
stage = "s"
holes = ["test", "record"]
idea = [{ case = "shows", aspect = "decision" }]
cases = [
    { name = "shows", tier = "core", points = 8 },
    { name = "edges", tier = "core", points = 12 },
    { name = "hard", tier = "robust", points = 2 },
]
"#;

    fn task() -> Task {
        task_of(COURSE)
    }

    fn task_of(course: &str) -> Task {
        let course = Course::parse(course).expect("it is valid");
        course.tasks().next().expect("it has a task").clone()
    }

    /// The findings about ten calls of both functions: hit or miss, which is main, and `t`. The
    /// numbers of wrong hits and of wrong `t` of each function.
    fn findings(test: [u32; 2], record: [u32; 2]) -> Vec<Finding> {
        let mut findings = Findings::default();
        for call in 0..10 {
            for (name, [misses, wrong_t]) in [("test", test), ("record", record)] {
                findings.count_for(name);
                let aspects = [(Aspect::HitOrMiss, misses), (Aspect::T, wrong_t)];
                for (aspect, wrong) in aspects {
                    findings.judge(aspect, call as usize, call >= wrong, 1.0, String::new);
                }
            }
        }
        let mut list = findings.into_vec();
        list[0].main = true;
        list
    }

    const RIGHT: [u32; 2] = [0, 0];

    /// Core and robust points for these findings in each of the three cases.
    fn graded(each: [Vec<Finding>; 3], holes: &[HoleCall]) -> TaskResult {
        graded_as(&task(), each, holes)
    }

    fn graded_as(task: &Task, each: [Vec<Finding>; 3], holes: &[HoleCall]) -> TaskResult {
        let cases =
            task.cases.iter().zip(each).map(|(entry, findings)| {
                CaseResult::new(entry, "", Status::Passed, findings, holes)
            });
        let cases = cases.collect();
        TaskResult::new(task, cases)
    }

    fn points(each: [Vec<Finding>; 3]) -> (f64, f64) {
        let result = graded(each, &[]);
        (result.score, result.robust_score)
    }

    #[test]
    fn functions_share_the_points_of_a_case() {
        let right = || findings(RIGHT, RIGHT);
        assert_eq!(points([right(), right(), right()]), (20.0, 2.0));
        // `record` misses one hit: its half of the 12 points is lost.
        let edge = findings(RIGHT, [1, 0]);
        assert_eq!(points([right(), edge, right()]), (14.0, 2.0));
        // A wrong `t`, which is not main, costs half of that.
        let off = findings(RIGHT, [0, 1]);
        assert_eq!(points([right(), off, right()]), (17.0, 2.0));
    }

    #[test]
    fn a_function_without_the_idea_gets_a_quarter() {
        let right = || findings(RIGHT, RIGHT);
        let misses_most = findings(RIGHT, [9, 0]);
        // `test`: 4 + 6; `record`: nothing, and a quarter of 6. Too little for extra credit.
        assert_eq!(points([misses_most, right(), right()]), (11.5, 0.0));
        let neither = findings([9, 0], [9, 0]);
        assert_eq!(points([neither, right(), right()]), (3.0, 0.0));
    }

    /// A case that the code of these functions did not answer.
    #[derive(Clone, Copy, Debug)]
    enum Without {
        Crash,
        /// It runs into the gap of another task, which is in another stage or in this code.
        Needs {
            with_neighbours: bool,
        },
        Gap(&'static str),
    }

    /// The points of `task`, whose cases have these answers: `without` them in some.
    fn points_without(task: &Task, without: &[(&str, Without)]) -> f64 {
        let cases = task.cases.iter().map(|entry| {
            let of_case = without.iter().find(|(case, _)| *case == entry.name);
            let case = |status, findings, holes: &[HoleCall]| {
                CaseResult::new(entry, "", status, findings, holes)
            };
            // `record` lacks the idea.
            let is_idea = task.cases_of_idea().any(|case| *case == entry.name);
            let mut answers = match is_idea {
                true => findings(RIGHT, [9, 0]),
                false => findings(RIGHT, RIGHT),
            };
            match of_case.map(|(_, without)| *without) {
                None => case(Status::Passed, answers, &[]),
                Some(Without::Crash) => case(Status::Crashed("panicked".into()), Vec::new(), &[]),
                Some(Without::Needs { with_neighbours }) => CaseResult {
                    with_neighbours,
                    ..case(Status::Needs("part1.task2".into()), Vec::new(), &[])
                },
                Some(Without::Gap(name)) => {
                    for finding in &mut answers {
                        finding.functions.retain(|count| count.function != name);
                        let mut hole = Findings::without(&[name.to_string()]);
                        let _ = hole.is_written(name, &[finding.aspect]);
                        finding
                            .functions
                            .extend(hole.into_vec().remove(0).functions);
                    }
                    let hole = HoleCall {
                        called: name.into(),
                        hole: name.into(),
                    };
                    case(Status::Passed, answers, &[hole])
                }
            }
        });
        let result = TaskResult::new(task, cases.collect());
        result.score + result.robust_score
    }

    #[test]
    fn code_that_crashes_or_has_a_gap_where_the_idea_shows_does_not_have_it() {
        use Without::{Crash, Gap, Needs};
        let task = task();
        // `test`: 4 + 6; `record`: a quarter of 6.
        assert_eq!(points_without(&task, &[]), 11.5);
        let without = |what| points_without(&task, &[("shows", what)]);
        assert_eq!(without(Gap("record")), 11.5);
        assert_eq!(without(Crash), 3.0);
        assert_eq!(without(Gap("test")), 3.0);
        let needs = |with_neighbours| without(Needs { with_neighbours });
        // The code of another task is missing; `hole!` of another task in this code.
        assert_eq!([true, false].map(needs), [12.0, 3.0]);
        let mut of_test = task.clone();
        of_test.idea[0].function = Some("record".into());
        // The crash says nothing about `test`: 6.
        assert_eq!(points_without(&of_test, &[("shows", Crash)]), 7.5);
    }

    #[test]
    fn no_crash_and_no_gap_earns_anything() {
        use Without::{Crash, Gap, Needs};
        let tasks = [
            COURSE.to_string(),
            COURSE.replace(r#""decision" }"#, r#""decision", or_in = "edges" }"#),
            COURSE.replace(r#""decision" }"#, r#""decision", function = "record" }"#),
            COURSE.replace("points = 2 }", r#"points = 2, only_with = "edges" }"#),
        ];
        let needs = Needs {
            with_neighbours: false,
        };
        let ways = [Crash, needs, Gap("test"), Gap("record")].map(Some);
        let ways = || [None].into_iter().chain(ways);
        for task in tasks.map(|course| task_of(&course)) {
            let all = ways().flat_map(|a| ways().flat_map(move |b| ways().map(move |c| [a, b, c])));
            let of_cases = |ways: [Option<Without>; 3]| {
                let each = ["shows", "edges", "hard"].into_iter().zip(ways);
                let missing = each.filter_map(|(case, way)| Some((case, way?)));
                points_without(&task, &missing.collect::<Vec<_>>())
            };
            for without in all {
                for i in 0..3 {
                    let mut answered = without;
                    answered[i] = None;
                    let (less, more) = (of_cases(without), of_cases(answered));
                    assert!(
                        less <= more,
                        "{without:?}: {less}, {more} with an answer in case {i}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_case_counts_only_with_the_other_that_it_names() {
        let only_with = COURSE.replace("points = 2 }", r#"points = 2, only_with = "edges" }"#);
        let task = task_of(&only_with);
        let graded = |edges| {
            let [shows, hard] = [0, 1].map(|_| findings(RIGHT, RIGHT));
            graded_as(&task, [shows, edges, hard], &[])
        };
        assert_eq!(graded(findings(RIGHT, RIGHT)).robust_score, 2.0);
        let one_wrong = graded(findings(RIGHT, [0, 1]));
        assert_eq!((one_wrong.score, one_wrong.robust_score), (17.0, 0.0));
        assert_eq!(
            one_wrong.cases[2].reductions,
            ["counts only if the case edges passes, too"]
        );
        assert!(Course::parse(&only_with.replace(r#"h = "edges""#, r#"h = "corners""#)).is_err());
    }

    #[test]
    fn the_idea_is_not_missing_if_it_shows_in_another_case() {
        let or_in = COURSE.replace(
            r#"aspect = "decision" }"#,
            r#"aspect = "decision", or_in = "edges" }"#,
        );
        let course = Course::parse(&or_in).expect("it is valid");
        let task = course.tasks().next().expect("it has a task");
        let score = |each: [Vec<Finding>; 3]| {
            let cases =
                task.cases.iter().zip(each).map(|(entry, findings)| {
                    CaseResult::new(entry, "", Status::Passed, findings, &[])
                });
            TaskResult::new(task, cases.collect()).score
        };
        let right = || findings(RIGHT, RIGHT);
        let wrong = || findings([9, 0], [9, 0]);
        assert_eq!(score([wrong(), right(), right()]), 12.0);
        assert_eq!(score([wrong(), wrong(), right()]), 0.0);
        let unknown = or_in.replace(r#"or_in = "edges""#, r#"or_in = "edge""#);
        assert!(Course::parse(&unknown).is_err());
    }

    #[test]
    fn each_reduction_is_named() {
        let right = || findings(RIGHT, RIGHT);
        let result = graded([findings([9, 0], [9, 0]), right(), right()], &[]);
        let [_, edges, hard] = &result.cases[..] else {
            panic!("three cases")
        };
        assert_eq!(edges.status, Status::Failed);
        assert_eq!(
            edges.reductions,
            ["counts a quarter until the case shows is right, too (hit or miss)"]
        );
        assert_eq!(
            hard.reductions.last().map(String::as_str),
            Some("extra credit counts from two thirds of the core points of the task on")
        );
    }

    #[test]
    fn a_hole_costs_the_share_of_its_function() {
        let mut only_test = findings(RIGHT, RIGHT);
        for finding in &mut only_test {
            finding.functions.retain(|count| count.function == "test");
        }
        let lost: Vec<Finding> = {
            let mut findings = Findings::without(&["record".to_string()]);
            let _ = findings.is_written("record", &[Aspect::HitOrMiss]);
            findings.into_vec()
        };
        only_test[0].functions.extend(lost[0].functions.clone());
        let hole = HoleCall {
            called: "record".into(),
            hole: "record".into(),
        };
        let each = [only_test.clone(), only_test.clone(), only_test];
        let result = graded(each, &[hole]);
        assert_eq!((result.score, result.robust_score), (10.0, 0.0));
        assert_eq!(result.status, Status::Failed);
        let status = |i: usize| (&result.functions[i].name[..], &result.functions[i].status);
        assert_eq!(status(0), ("test", &FunctionStatus::Right));
        assert_eq!(status(1), ("record", &FunctionStatus::Hole));
        assert_eq!(result.cases[0].reductions, ["record is not written yet"]);
    }

    #[test]
    fn a_task_whose_functions_all_have_holes_is_not_attempted() {
        let holes = ["test", "record"].map(|name| HoleCall {
            called: name.into(),
            hole: name.into(),
        });
        let result = graded([Vec::new(), Vec::new(), Vec::new()], &holes);
        assert_eq!(result.status, Status::NotAttempted);
        assert_eq!(result.score, 0.0);
    }

    #[test]
    fn a_function_is_unfinished_if_only_some_cases_reach_a_gap() {
        let mut task = task();
        task.holes.truncate(1);
        let entries = task.cases.iter();
        let case = |entry| CaseResult::new(entry, "", Status::NotAttempted, Vec::new(), &[]);
        let mut cases: Vec<CaseResult> = entries.map(case).collect();
        assert_eq!(results(&task, &cases)[0].status, FunctionStatus::Hole);
        cases[0].status = Status::Passed;
        let some = FunctionStatus::Unfinished { of: 3, open: 2 };
        assert_eq!(results(&task, &cases)[0].status, some);
    }

    #[test]
    fn an_idea_of_an_unknown_case_is_refused() {
        let text = COURSE.replace("case = \"shows\"", "case = \"show\"");
        let error = Course::parse(&text).unwrap_err().to_string();
        assert!(error.contains("names the case `show`"), "{error}");
    }
}
