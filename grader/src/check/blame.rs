//! Which function of a task is to blame for a wrong answer.
//!
//! A function that calls another one of its task gives its wrong answers on: `intersect_triangle`
//! misses where `test_triangle` does. What no case judges by itself is seen in the answers of its
//! caller only. And lists of shapes are met by `intersect_triangle` or `intersect_sphere`.

use crate::course::Task;
use crate::course::sources::{self, SourceFile};
use crate::score::CaseResult;
use judge::findings::{Aspect, Fault, Finding};
use std::collections::{BTreeMap, BTreeSet};

/// What a function that makes the record of a hit decides.
const OF_A_RECORD: [Aspect; 7] = [
    Aspect::Position,
    Aspect::Normal,
    Aspect::GeometricNormal,
    Aspect::Primitive,
    Aspect::Barycentrics,
    Aspect::T,
    Aspect::RayAfter,
];

/// The functions of a task, with what shows which of them is wrong.
pub struct Blame<'a> {
    functions: Vec<Function<'a>>,
}

/// A function of a task.
struct Function<'a> {
    name: &'a str,
    /// The other functions of the task that its code calls and cases judge.
    calls: Vec<Called<'a>>,
    /// One that it calls and no case judges.
    makes_record: Option<&'a str>,
    /// Whether its code sets the end of the ray's range itself.
    sets_max_t: bool,
}

/// A function that another one calls.
struct Called<'a> {
    name: &'a str,
    /// Whether it is wrong, and no case has a call in which both are: each gets inputs of its own.
    is_wrong_apart: bool,
    /// Whether it is wrong in a case.
    is_wrong: bool,
}

impl<'a> Blame<'a> {
    /// Of the functions of `task`, whose stage has these files and whose cases had these results.
    pub fn new(task: &'a Task, files: &[SourceFile], cases: &[CaseResult]) -> Blame<'a> {
        let body = |name: &str| {
            let mut files = files.iter();
            let body = files.find_map(|file| sources::body(&file.text, name));
            body.unwrap_or_default()
        };
        let wrong: Vec<WrongCalls<'_>> = cases.iter().map(|case| wrong(&case.findings)).collect();
        let is_judged = |name: &str| cases.iter().any(|case| judges(&case.findings, name));
        let called = |caller: &str, name: &'a str| {
            let is_wrong = wrong.iter().any(|wrong| wrong.contains_key(name));
            let are_wrong_together = wrong.iter().any(|wrong| {
                let [called, caller] = [name, caller].map(|function| wrong.get(function));
                called.zip(caller).is_some_and(|(a, b)| !a.is_disjoint(b))
            });
            Called {
                name,
                is_wrong,
                is_wrong_apart: is_wrong && !are_wrong_together,
            }
        };
        let functions = task.holes.iter().map(|name| {
            let code = body(name);
            let others = task.holes.iter().map(String::as_str);
            let others =
                others.filter(|other| other != name && code.contains(&format!("{other}(")));
            let (judged, others): (Vec<&str>, Vec<&str>) = others.partition(|name| is_judged(name));
            Function {
                name,
                calls: judged
                    .into_iter()
                    .map(|other| called(name, other))
                    .collect(),
                makes_record: others.first().copied(),
                sets_max_t: code.contains("max_t"),
            }
        });
        Blame {
            functions: functions.collect(),
        }
    }

    /// The names of the functions that are to blame for wrong answers of the cases `failed`, in the
    /// order of the task.
    pub fn functions(&self, failed: &[&CaseResult]) -> Vec<&'a str> {
        let mut blamed = BTreeSet::new();
        for case in failed {
            let wrong = wrong(&case.findings);
            for finding in &case.findings {
                let faults = finding.faults.iter();
                blamed.extend(
                    faults.filter_map(|fault| self.of(&case.findings, &wrong, finding, fault)),
                );
            }
        }
        let names = self.functions.iter().map(|function| function.name);
        names.filter(|name| blamed.contains(name)).collect()
    }

    /// The findings of a case or a question with only those wrong answers that `function` is to
    /// blame for.
    pub fn only(&self, function: &str, findings: Vec<Finding>) -> Vec<Finding> {
        let wrong = wrong(&findings);
        let chosen = findings.iter().map(|finding| {
            let is_own =
                |fault: &Fault| self.of(&findings, &wrong, finding, fault) == Some(function);
            finding.with_only(is_own)
        });
        chosen.collect()
    }

    /// The function that is to blame for a wrong answer of a case or a question with these
    /// findings; `None` if the answer is of no function in particular.
    fn of(
        &self,
        findings: &[Finding],
        wrong: &WrongCalls<'_>,
        finding: &Finding,
        fault: &Fault,
    ) -> Option<&'a str> {
        let is_of_record = OF_A_RECORD.contains(&finding.aspect);
        let of_lists = || {
            let mut names = self.functions.iter().map(|function| function.name);
            names.find(|name| is_of_record && name.starts_with("intersect_"))
        };
        let name = (fault.counts_for.or(fault.function)).or_else(of_lists)?;
        let function = self
            .functions
            .iter()
            .find(|function| function.name == name)?;
        let gives_on = |called: &&Called<'_>| {
            let is_wrong_here = wrong
                .get(called.name)
                .is_some_and(|calls| calls.contains(&fault.call));
            let is_unknown_here = called.is_wrong && !judges(findings, called.name);
            is_wrong_here || called.is_wrong_apart || is_unknown_here
        };
        if let Some(called) = function.calls.iter().find(gives_on) {
            return Some(called.name);
        }
        let is_set_here = finding.aspect == Aspect::RayAfter && function.sets_max_t;
        let record = (function.makes_record).filter(|_| is_of_record && !is_set_here);
        Some(record.unwrap_or(function.name))
    }
}

/// The wrong calls of each function.
type WrongCalls<'a> = BTreeMap<&'a str, BTreeSet<u32>>;

fn wrong(findings: &[Finding]) -> WrongCalls<'static> {
    let mut wrong = WrongCalls::new();
    for fault in findings.iter().flat_map(|finding| &finding.faults) {
        if let Some(function) = fault.counts_for {
            wrong.entry(function).or_default().insert(fault.call);
        }
    }
    wrong
}

/// Whether answers of `function` are among those that were judged.
fn judges(findings: &[Finding], function: &str) -> bool {
    let mut counts = findings.iter().flat_map(|finding| &finding.functions);
    counts.any(|count| count.function == function)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use judge::findings::Findings;

    const CALLER: &str = "pub fn intersect_triangle(r: &mut Ray) -> Option<Hit> {\n    let hit = test_triangle(r)?;\n    Some(record_triangle(r, hit))\n}\n";
    const ALONE: &str = "pub fn intersect_triangle(r: &mut Ray) -> Option<Hit> {\n    r.max_t = 1.0;\n    None\n}\n";

    /// Who is to blame if these answers are wrong: function, call, aspect. With `in_list`, also a
    /// case that judges the caller only has a wrong answer.
    fn blamed(code: &str, wrong: &[(&'static str, usize, Aspect)], in_list: bool) -> Vec<String> {
        let text = include_str!("../../../stages/course.toml");
        let course = Course::parse(text).expect("it is valid");
        let mut tasks = course.tasks();
        let task = tasks.find(|task| task.key == "part1.task3");
        let mut findings = Findings::default();
        for function in ["test_triangle", "intersect_triangle"] {
            findings.count_for(function);
            findings.judge(Aspect::HitOrMiss, 9, true, 0.0, String::new);
        }
        for (function, call, aspect) in wrong {
            findings.count_for(function);
            findings.judge(*aspect, *call, false, 1.0, String::new);
        }
        let mut list = Findings::default();
        list.count_for("intersect_triangle");
        list.judge(Aspect::HitOrMiss, 0, !in_list, 1.0, String::new);
        let cases = [findings, list].map(|found| CaseResult::failed("", found.into_vec()));
        let files = [SourceFile {
            path: "a.rs".into(),
            text: code.into(),
        }];
        let blame = Blame::new(task.expect("it has triangles"), &files, &cases);
        let functions = blame.functions(&cases.each_ref());
        // What is left for a function alone is its fault, and nothing is left out.
        let all = cases.iter().flat_map(|case| &case.findings);
        let left = functions.iter().flat_map(|function| {
            let only = |case: &CaseResult| blame.only(function, case.findings.clone());
            cases.iter().flat_map(only).collect::<Vec<_>>()
        });
        let count = |faults: Vec<usize>| faults.iter().sum::<usize>();
        assert_eq!(
            count(left.map(|finding| finding.faults.len()).collect()),
            count(all.map(|finding| finding.faults.len()).collect())
        );
        functions.into_iter().map(str::to_owned).collect()
    }

    #[test]
    fn what_a_caller_gives_on_is_the_fault_of_the_called_function() {
        use Aspect::{HitOrMiss, Normal, RayAfter};
        let [test, intersect, record] = ["test_triangle", "intersect_triangle", "record_triangle"];
        let both = [(test, 1, HitOrMiss), (intersect, 1, HitOrMiss)];
        assert_eq!(blamed(CALLER, &both, false), [test]);
        assert_eq!(blamed(CALLER, &both, true), [test]);
        assert_eq!(blamed(ALONE, &both, false), [test, intersect]);
        // In another call the caller is wrong by itself.
        let more = [both[0], both[1], (intersect, 2, HitOrMiss)];
        assert_eq!(blamed(CALLER, &more, false), [test, intersect]);
        // The cases call each with inputs of its own.
        let apart = [(test, 1, HitOrMiss), (intersect, 2, HitOrMiss)];
        assert_eq!(blamed(CALLER, &apart, false), [test]);
        // The record is made by a function that no case judges.
        let normal = [(intersect, 2, Normal)];
        assert_eq!(blamed(CALLER, &normal, false), [record]);
        assert_eq!(blamed(ALONE, &normal, false), [intersect]);
        assert_eq!(blamed(CALLER, &[(intersect, 2, RayAfter)], false), [record]);
        assert_eq!(
            blamed(ALONE, &[(intersect, 2, RayAfter)], false),
            [intersect]
        );
        // A list of shapes names no function.
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let task = (course.tasks().find(|task| task.key == "part1.task4")).expect("spheres");
        let mut list = Findings::default();
        list.judge(Normal, 0, false, 1.0, String::new);
        let case = CaseResult::failed("", list.into_vec());
        let blame = Blame::new(task, &[], std::slice::from_ref(&case));
        assert_eq!(blame.functions(&[&case]), ["intersect_sphere"]);
        let two = [both[0], both[1], normal[0]];
        assert_eq!(blamed(CALLER, &two, false), [test, record]);
    }
}
