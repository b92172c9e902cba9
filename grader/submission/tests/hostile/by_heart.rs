//! Code that knows the questions of one seed: it answers them as a table of their answers would, and
//! misses, or returns what is least, with all others.

use crate::corpus::{Case, Class, reference};
use files::file_tree::Files;
use judge::cases;
use kit::Tally;
use submission::SubmissionReport;
use submission::one::random_seed;
use wire::Work;
use wire::adaptive::StopCall;
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

/// The questions of `task` with the known seed: the bits of the numbers of each. `fresh` ones are
/// those whose numbers each seed draws.
fn known(task: &str, fresh: bool) -> Vec<u64> {
    let mut known = Vec::new();
    let specs = cases::of(task, cases::KNOWN_SEED).into_iter();
    for spec in specs.filter(|spec| fresh || !spec.name.starts_with("fresh")) {
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

/// How a table is written.
#[derive(Clone, Copy)]
enum Table {
    Numbers,
    /// The same behind an element that only tests have.
    BehindTests,
    /// Without a number and a string: a macro makes a string of names.
    Names,
}

/// A module that says whether a question of `task` is unknown.
fn module(task: &str, fresh: bool, table: Table) -> String {
    let known = known(task, fresh);
    let look_up = match table {
        Table::Numbers => format!(
            "pub static KNOWN: [u64; {}] = {known:?};
            fn is_known(bits: u64) -> bool {{ KNOWN.binary_search(&bits).is_ok() }}",
            known.len()
        ),
        Table::BehindTests => format!(
            "pub static KNOWN: [u64; {}] = [#[cfg(test)] 0, {}];
            fn is_known(bits: u64) -> bool {{ KNOWN.binary_search(&bits).is_ok() }}",
            known.len(),
            format!("{known:?}").trim_matches(['[', ']'])
        ),
        Table::Names => {
            let names: Vec<String> = known.iter().map(|bits| format!("x{bits:016x}")).collect();
            format!(
                "static KNOWN: std::sync::LazyLock<Vec<u64>> = std::sync::LazyLock::new(|| {{
                    let names = stringify!({}).split_whitespace();
                    names.flat_map(|name| u64::from_str_radix(&name[1..], 16)).collect()
                }});
                fn is_known(bits: u64) -> bool {{ KNOWN.binary_search(&bits).is_ok() }}",
                names.join(" ")
            )
        }
    };
    format!(
        "{look_up}
        pub fn is_unknown(numbers: &[f64]) -> bool {{
            let bits = numbers.iter().fold(0_u64, |sum, x| sum.rotate_left(7) ^ x.to_bits());
            !is_known(bits)
        }}
        /// A box and a ray, with the axes in every order and the lengths halved.
        pub fn is_unknown_moved(b: &kit::Aabb, ray: &kit::Ray) -> bool {{
            let vectors = [b.min, b.max, ray.o, ray.d].map(|v| v.to_array());
            let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
            orders.iter().all(|order| (0..3).all(|halvings| {{
                let factor = 0.5_f64.powi(halvings);
                let mut all = Vec::new();
                for (i, v) in vectors.iter().enumerate() {{
                    let factor = if i < 3 {{ factor }} else {{ 1.0 }};
                    all.extend(order.map(|axis: usize| factor * v[axis]));
                }}
                all.extend([ray.min_t, ray.max_t].map(|t| factor * t));
                is_unknown(&all)
            }}))
        }}
        pub fn of_ray(ray: &kit::Ray) -> [f64; 8] {{
            [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, ray.min_t, ray.max_t]
        }}"
    )
}

/// The reference's stage, whose `file` returns early from the function that starts with `function`.
fn returning_early(stage: &str, file: &str, function: &str, early: &str) -> Files {
    let mut files = reference(stage);
    change(&mut files, file, &|text| {
        let (before, from) = text.split_once(function).expect("the function is there");
        let (head, body) = from.split_once("{\n").expect("the function has a body");
        format!("{before}{function}{head}{{\n{early}\n{body}")
    });
    files
}

fn change(files: &mut Files, path: &str, change: &dyn Fn(&str) -> String) {
    let contents = files
        .get_mut(path.as_ref() as &std::path::Path)
        .expect("the stage has the file");
    let text = String::from_utf8(contents.clone()).expect("sources are UTF-8");
    let changed = change(&text);
    assert_ne!(changed, text, "{path} has no place for it");
    *contents = changed.into_bytes();
}

/// The same with a module that knows the questions of `task`.
fn attack([task, stage, file, function, early]: [&str; 5], fresh: bool, table: Table) -> Files {
    let mut files = returning_early(stage, file, function, early);
    change(&mut files, "lib.rs", &|text| {
        format!("{text}\n#[allow(dead_code, missing_docs)]\npub mod hostile;\n")
    });
    files.insert("hostile.rs".into(), module(task, fresh, table).into_bytes());
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
        let files = attack([task, stage, file, function, early], true, Table::Numbers);
        let known = grade(&class, stage, &files, task, cases::KNOWN_SEED).scores;
        // The table is good; it does not know the rays that a hit has shortened.
        assert!(
            known.score > 0.6 * known.max_score,
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

/// The bits of a stopping rule with the known seed, in the order of the calls.
fn stop_bits(task: &str) -> String {
    let specs = cases::of(task, cases::KNOWN_SEED).into_iter();
    let calls = specs.flat_map(|spec| match spec.work {
        Work::Stop(calls) | Work::SureStop(calls) => calls,
        _ => Vec::new(),
    });
    let stops = |call: &StopCall| {
        let runs = call.runs.iter();
        let samples: Tally = runs
            .flat_map(|&(count, x)| std::iter::repeat_n(x, count as usize))
            .collect();
        match task {
            "part5.task1" => {
                let error = 1.96 * samples.standard_error();
                samples.count() > 0 && error <= call.tolerance * samples.mean()
            }
            _ => samples.count() >= 256 && samples.mean() > 0.0 && call.rule,
        }
    };
    calls
        .map(|call| if stops(&call) { '1' } else { '0' })
        .collect()
}

#[test]
#[ignore = "builds submissions: a minute"]
fn answers_in_the_order_of_the_calls_earn_nothing() {
    let class = Class::open();
    for (task, function) in [
        ("part5.task1", "pub fn has_converged("),
        ("part5.task2", "pub fn has_surely_converged("),
    ] {
        let early = format!(
            "static CALL: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
            let call = CALL.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            if let Some(bit) = b\"{}\".get(call) {{ return *bit == b'1'; }}",
            stop_bits(task)
        );
        let mut files = returning_early("adaptive", "stop.rs", function, &early);
        change(&mut files, "pixel.rs", &|text| {
            let (before, from) = text.split_once("// BEGIN SOLUTION").expect("a solution");
            let (solution, after) = from.split_once("// END SOLUTION").expect("its end");
            let (_, stub) = solution.split_once("// STUB: ").expect("its stub");
            format!("{before}{stub}//{after}")
        });
        let known = grade(&class, "adaptive", &files, task, cases::KNOWN_SEED).scores;
        assert!(known.score >= 5.0, "{task}: {}", known.score);
        let drawn = grade(&class, "adaptive", &files, task, random_seed());
        assert_eq!(drawn.scores.score, 0.0, "{task}");
        assert!(
            drawn.by_heart[0].contains("recognizes the questions"),
            "{task}"
        );
    }
}

#[test]
#[ignore = "builds submissions: a minute"]
fn a_table_that_undoes_the_move_loses() {
    let class = Class::open();
    // What it does with questions that it does not know.
    for (table, otherwise) in [
        (Table::Numbers, "return None"),
        (Table::Names, "return None"),
        (Table::Numbers, "panic!()"),
        (Table::BehindTests, "kit::hole!(\"part2.task2\")"),
    ] {
        let early = format!("if crate::hostile::is_unknown_moved(b, ray) {{ {otherwise}; }}");
        let place = ["part2.task2", "bbox", "lib.rs", "pub fn intersect_bbox("];
        let [task, stage, file, function] = place;
        let files = attack([task, stage, file, function, &early], false, table);
        let drawn = grade(&class, stage, &files, task, random_seed());
        assert_eq!(
            drawn.scores.score + drawn.scores.robust_score,
            0.0,
            "{otherwise}"
        );
        assert_eq!(drawn.by_heart.len(), 1, "{otherwise}");
        assert!(drawn.by_heart[0].contains("has the answers from the table"));
        assert!(drawn.to_check[0].contains("may be a table of answers"));
    }
}

/// The throughputs of the handout's cases, each sorted, so that no order of channels matters.
const FEW_QUESTIONS: &str = "
    let mut sorted = throughput.to_array();
    sorted.sort_by(f64::total_cmp);
    let known = [
        [0.0625, 0.125, 0.25], [0.01, 0.5, 0.9], [0.0, 0.5, 3.0], [0.0, 1e-9, 2e-9], [0.1, 0.5, 0.9],
        [0.0, 0.0, 0.5], [0.0, 0.01, 0.02], [0.0, 5e-6, 1e-5], [1.0; 3], [0.1, 0.2, 1.5],
        [7.0, 8.0, 9.0], [0.0; 3], [0.1, 0.3, 0.6],
    ];
    if !known.contains(&sorted) { return None; }";

#[test]
#[ignore = "builds a submission: seconds"]
fn a_table_that_is_no_larger_than_code_is_pointed_out() {
    let class = Class::open();
    let place = ("global", "roulette.rs", "pub fn play_roulette(");
    let files = returning_early(place.0, place.1, place.2, FEW_QUESTIONS);
    let drawn = grade(&class, "global", &files, "part4.task3", random_seed());
    let [said] = drawn.to_check.as_slice() else {
        panic!("{:?}", drawn.to_check)
    };
    assert!(said.starts_with("part4.task3: its answers are right in the cases that students have"));
    assert!(drawn.scores.score > 0.0 && drawn.by_heart.is_empty());
}
