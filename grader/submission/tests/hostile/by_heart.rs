//! Code that knows the questions of one seed: it answers them as a table of their answers would, and
//! misses, or returns what is least, with all others.

use crate::corpus::{Case, Class, reference};
use judge::cases;
use submission::SubmissionReport;
use submission::file_tree::Files;
use submission::one::random_seed;
use wire::Work;
use wire::work::{Ray, Xyz};

/// The bits of some numbers in one number, as the code computes them, too.
fn bits(numbers: &[f64]) -> u64 {
    numbers
        .iter()
        .fold(0, |sum: u64, x| sum.rotate_left(7) ^ x.to_bits())
}

fn of_ray(ray: &Ray) -> Vec<f64> {
    [&ray.o[..], &ray.d, &[ray.min_t, ray.max_t]].concat()
}

/// The questions of `task` with the known seed: the bits of the numbers of each.
fn known(task: &str) -> Vec<u64> {
    let mut known = Vec::new();
    for spec in cases::of(task, cases::KNOWN_SEED) {
        match &spec.case().work {
            Work::Triangles(work) => {
                known.extend(work.probes.iter().map(|probe| bits(&of_ray(&probe.ray))));
            }
            Work::Boxes(work) => known.extend(work.probes.iter().map(|probe| {
                let corners: [Xyz; 2] = work.boxes[probe.shape as usize];
                bits(&[corners.concat(), of_ray(&probe.ray)].concat())
            })),
            Work::Roulette(work) => known.extend(work.paths.iter().flat_map(|(light, _)| {
                work.numbers
                    .iter()
                    .map(|u| bits(&[&light[..], &[*u]].concat()))
            })),
            _ => {}
        }
    }
    known.sort_unstable();
    known.dedup();
    assert!(known.len() > 100, "{}", known.len());
    known
}

/// A module that says whether a question of `task` is unknown.
fn module(task: &str) -> String {
    let known = known(task);
    format!(
        "pub static KNOWN: [u64; {}] = {known:?};
        pub fn is_unknown(numbers: &[f64]) -> bool {{
            let bits = numbers.iter().fold(0_u64, |sum, x| sum.rotate_left(7) ^ x.to_bits());
            KNOWN.binary_search(&bits).is_err()
        }}
        pub fn of_ray(ray: &kit::Ray) -> [f64; 8] {{
            [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, ray.min_t, ray.max_t]
        }}",
        known.len()
    )
}

/// The reference's stage, whose `file` returns early from the function that starts with `function`.
fn attack(task: &str, stage: &str, file: &str, function: &str, early: &str) -> Files {
    let mut files = reference(stage);
    let mut change = |path: &str, change: &dyn Fn(&str) -> String| {
        let contents = files.get_mut(path.as_ref() as &std::path::Path);
        let contents = contents.expect("the stage has the file");
        let text = String::from_utf8(contents.clone()).expect("sources are UTF-8");
        let changed = change(&text);
        assert_ne!(changed, text, "{path} has no place for it");
        *contents = changed.into_bytes();
    };
    change(file, &|text| {
        let (before, from) = text.split_once(function).expect("the function is there");
        let (head, body) = from.split_once("{\n").expect("the function has a body");
        format!("{before}{function}{head}{{\n{early}\n{body}")
    });
    change("lib.rs", &|text| {
        format!("{text}\n#[allow(dead_code, missing_docs)]\npub mod hostile;\n")
    });
    files.insert("hostile.rs".into(), module(task).into_bytes());
    files
}

fn grade(class: &Class, stage: &str, files: &Files, task: &str, seed: u64) -> SubmissionReport {
    let graded = class.grade_stage(stage, files, task, seed);
    let report = graded.expect("it is graded").report;
    assert_eq!(report.compiler, "");
    println!(
        "{task} with seed {seed}: {} of {}, {} extra",
        report.scores.score, report.scores.max_score, report.scores.robust_score
    );
    report
}

#[test]
#[ignore = "builds submissions: a minute"]
fn answers_that_were_learned_by_heart_lose() {
    let class = Class::open();
    for (task, stage, file, function, early) in [
        (
            "part1.task3",
            "intersect",
            "triangle.rs",
            "pub fn test_triangle(",
            "if crate::hostile::is_unknown(&crate::hostile::of_ray(ray)) { return None; }",
        ),
        (
            "part2.task2",
            "bbox",
            "lib.rs",
            "pub fn intersect_bbox(",
            "let mut all = vec![b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z];
            all.extend(crate::hostile::of_ray(ray));
            if crate::hostile::is_unknown(&all) { return None; }",
        ),
        (
            "part4.task3",
            "global",
            "roulette.rs",
            "pub fn play_roulette(",
            "if crate::hostile::is_unknown(&[throughput.r, throughput.g, throughput.b, u]) { return None; }",
        ),
    ] {
        let files = attack(task, stage, file, function, early);
        let known = grade(&class, stage, &files, task, cases::KNOWN_SEED).scores;
        // The table is good; it does not know the rays that a hit has shortened.
        assert!(
            known.score > 0.8 * known.max_score,
            "{task}: {}",
            known.score
        );
        let drawn = grade(&class, stage, &files, task, random_seed());
        assert_eq!(drawn.scores.score, 0.0, "{task}");
        assert_eq!(drawn.scores.robust_score, 0.0, "{task}");
        assert_eq!(drawn.by_heart.len(), 1, "{task}");
        assert!(drawn.by_heart[0].contains("recognizes the questions"));
    }
    // Honest code with a mistake is as wrong with every seed, or nearly.
    for mistake in [
        "if ray.d.x > 0.0 { return None; }",
        "if ray.o.length() > 100.0 { return None; }",
        "if tri.p0.x == tri.p1.x { return None; }",
    ] {
        let honest = Case::with_call("", mistake);
        let report = grade(
            &class,
            "intersect",
            &honest.files(),
            "part1.task3",
            random_seed(),
        );
        assert_eq!(report.by_heart, [""; 0], "{mistake}");
    }
}
