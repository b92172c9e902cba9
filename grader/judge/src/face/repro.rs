//! Writes the worst answer as a Rust test, for a stage's `tests/` folder or a debugger.
//!
//! The test fails on the code that gave the answer and passes on code that earns the points. Its
//! body comes from the check of the case's kind of work; `numbers` and `hits` are shared between
//! checks.

use crate::tasks::check_of;
use crate::tools::Tier;
use crate::tools::findings::Finding;
use crate::tools::spec::Spec;
use std::fmt::Write;
use wire::Work;

/// A case that lost points, and its findings.
#[derive(Clone, Copy, Debug)]
pub struct FailedCase<'a> {
    /// Name of the case.
    pub name: &'a str,
    /// The tier of its points.
    pub tier: Tier,
    /// What was judged in it.
    pub findings: &'a [Finding],
    /// The call in which its code crashed, if it is known. Then there are no findings.
    pub crashed_call: Option<u32>,
}

/// Returns a test for the worst answer of a task's failed cases, or for the call that crashed, of
/// core cases if one fails; `None` if no answer fits in a short test.
pub fn worst<'a>(
    failed: impl IntoIterator<Item = FailedCase<'a>>,
    specs: &[Spec],
    task: &str,
) -> Option<String> {
    let mut failed: Vec<FailedCase<'a>> = failed.into_iter().collect();
    // A test of extra credit would pass before the mistake is mended.
    if failed.iter().any(|case| case.tier == Tier::Core) {
        failed.retain(|case| case.tier == Tier::Core);
    }
    failed.into_iter().find_map(|case| {
        let spec = specs.iter().find(|spec| spec.is(task, case.name))?;
        let worst = case
            .findings
            .iter()
            .filter_map(|finding| finding.worst.as_ref().map(|worst| (finding.aspect, worst)));
        let worst = worst.filter(|(aspect, _)| spec.check.repro_shows(*aspect));
        let test = |call| test(spec, case.tier, call as usize);
        let of_worst = worst.map(|(_, worst)| worst.call).find_map(test);
        let of_crash = || {
            test(case.crashed_call?).map(|test| as_file("The call that crashed in", task, &test))
        };
        of_worst
            .map(|test| as_file("The worst answer of", task, &test))
            .or_else(of_crash)
    })
}

/// Returns the test as a file of a stage's `tests/` folder, with the doc comment at the top that
/// `missing_docs` requires. `what` begins the comment, such as `The worst answer of`.
pub fn as_file(what: &str, task: &str, test: &str) -> String {
    format!("//! {what} {task} in the grader's cases.\n\n{test}")
}

/// Returns a test for one call of a case.
pub fn test(spec: &Spec, tier: Tier, call: usize) -> Option<String> {
    let name = format!("{}_{call}", spec.name);
    of_work(&spec.work, tier, call, spec.about, &name)
}

/// Returns a test for one call of any work, with the doc comment `about` and the name `name`.
pub fn of_work(work: &Work, tier: Tier, call: usize, about: &str, name: &str) -> Option<String> {
    let body = check_of(work).repro(tier, work, call)?;
    let mut text = format!("/// {about}\n#[test]\nfn {name}() {{\n");
    body.lines().for_each(|line| {
        let _ = writeln!(text, "    {line}");
    });
    text.push_str("}\n");
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    #[test]
    fn a_call_that_crashed_becomes_a_test() {
        let specs = cases::all(0);
        let worst_of = |crashed_call| {
            let failed = FailedCase {
                name: "front_face",
                tier: Tier::Core,
                findings: &[],
                crashed_call,
            };
            worst([failed], &specs, "part1.task3")
        };
        let test = worst_of(Some(3)).expect("the call has a test");
        assert!(
            test.starts_with("//! The call that crashed in part1.task3 in the grader's cases.\n"),
            "{test}"
        );
        assert!(test.contains("fn front_face_3() {"), "{test}");
        assert_eq!(worst_of(None), None);
    }
}
