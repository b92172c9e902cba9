//! A build whose time grows with the square of the primitives, on another thread than the one that is
//! called: its time counts, too.

use crate::corpus::{Class, reference};
use std::path::Path;

const FUNCTION: &str = "pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {\n";

/// Work that takes as long as looking at all pairs.
const WORK: &str = "let n = bounds.len() as u64;
    let _ = std::thread::spawn(move || (0..n * n).for_each(|i| drop(std::hint::black_box(i)))).join();";

#[test]
#[ignore = "builds submissions and runs quadratic code: a minute"]
fn work_on_another_thread_counts_as_time_of_the_build() {
    let class = Class::open();
    let graded = |work: &str| {
        let mut files = reference("bvh");
        let file = files.get_mut(Path::new("construct.rs")).expect("it exists");
        let text = String::from_utf8(file.clone()).expect("sources are UTF-8");
        assert!(text.contains(FUNCTION), "the function has another head");
        *file = text
            .replace(FUNCTION, &format!("{FUNCTION}{work}\n"))
            .into_bytes();
        let graded = class.grade_stage("bvh", &files, "part2.task1", 1);
        let task = graded.expect("it is graded").report.scores.tasks.remove(0);
        let cases = task.result.cases.into_iter();
        let mut growth = cases.filter(|case| case.name == "growth_of_the_build_time");
        growth.next().expect("the case exists")
    };
    assert!(graded("").score > 0.0);
    let quadratic = graded(WORK);
    let is_judged = quadratic.undecided().next().is_none();
    eprintln!("The growth is judged: {is_judged}. A busy machine decides nothing, and says so.");
    assert!(!is_judged || quadratic.score == 0.0, "{quadratic:?}");
}
