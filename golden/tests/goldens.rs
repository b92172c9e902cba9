//! Every golden equals the reference's answer. The oracle judges every aspect of every answer and
//! must not refute it. `<task>/not_judged.txt` lists what it does not judge.
//!
//! If answers differ, the test writes each new snapshot beside its golden, as `.snap.new`, where
//! `cargo insta review` finds it. `cargo grader review` shows every difference on a page, and
//! `cargo grader bless` accepts them; neither command reads the `.snap.new` files.

use crate::shared::{AfterTheGoldens, BEGIN, SPECS, record, spec};
use base::Workspace;
use grader::course::{Course, Task};
use judge::pictures;
use judge::plural;
use review::bless::{Change, ChangeKind, Proposal, SNAPSHOT_HEADER};
use std::path::Path;
use wire::work::{NodeKind, SceneWork, VisitsWork};
use wire::{Answer, Outcome, Record, Work};

/// The lines about goldens that a failed test prints: with the test's own lines they fit a screen.
const LINES: usize = 12;

/// The length of such a line.
const WIDTH: usize = 100;

#[test]
fn the_goldens_are_what_the_reference_answers() {
    let (workspace, course) = course();
    let parts: Vec<&str> = ["part1", "part2", "part3", "part4", "part5"].to_vec();
    let proposal = std::thread::scope(|scope| {
        let run = |part| {
            let (workspace, course) = (&workspace, &course);
            scope.spawn(move || differences(workspace, course, part))
        };
        let threads: Vec<_> = parts.into_iter().map(run).collect();
        let mut all = Proposal::default();
        for thread in threads {
            all.append(thread.join().expect("the part can be checked"));
        }
        all
    });
    forget_pending(&workspace, &course);
    for change in &proposal.changes {
        if change.golden.extension().is_some_and(|end| end == "snap") {
            std::fs::write(change.pending(), &change.content).expect("the new file is written");
        }
    }
    assert!(proposal.is_empty(), "{}", summary(&workspace, &proposal));
}

/// Removes what an earlier run wrote for `cargo insta review`: the answers may be others now.
fn forget_pending(workspace: &Workspace, course: &Course) {
    for task in course.tasks() {
        for case in &task.cases {
            let pending = workspace
                .snapshot(&task.key, &case.name)
                .with_extension("snap.new");
            if pending.exists() {
                std::fs::remove_file(&pending).expect("an old file is removed");
            }
        }
    }
}

fn course() -> (Workspace, Course) {
    let workspace =
        Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("golden is in a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    (workspace, course)
}

/// How the goldens of a part differ from what the reference answers.
fn differences(workspace: &Workspace, course: &Course, part: &str) -> Proposal {
    let mut proposal = Proposal::default();
    for task in course.tasks().filter(|task| task.part_key() == part) {
        let of_task = SPECS.iter();
        let of_task =
            of_task.filter(|spec| task.cases.iter().any(|case| spec.is(&task.key, &case.name)));
        let mut judged = Vec::new();
        for spec in of_task {
            match answer(record(spec)) {
                Ok(answer) => {
                    let case = proposal.add_case(workspace, spec, answer);
                    judged.push(case.expect("the golden can be read"));
                }
                Err(why) => proposal.refuse(spec.task, spec.name, &why),
            }
        }
        let list = proposal.add_not_judged(workspace, task, &SPECS, &judged);
        list.expect("the list can be read");
        add_picture(&mut proposal, workspace, task);
    }
    proposal
}

fn add_picture(proposal: &mut Proposal, workspace: &Workspace, task: &Task) {
    let Some(picture) = pictures::of(&task.key) else {
        return;
    };
    let actual = match answer(&worker::run(0, &picture.spec().case())) {
        Ok(Answer::Picture(answer)) => ::pictures::tone::compose(&picture, answer),
        Ok(other) => {
            let why = format!("the worker's answer is {}", other.kind());
            return proposal.refuse(&task.key, pictures::NAME, &why);
        }
        Err(why) => return proposal.refuse(&task.key, pictures::NAME, &why),
    };
    let added = proposal.add_picture(workspace, &picture, &actual);
    added.expect("the golden can be read");
}

/// The reference's answer, or why there is none.
fn answer(record: &Record) -> Result<&Answer, String> {
    match &record.outcome {
        Outcome::Answered(answer) if record.untouched.is_empty() => Ok(answer),
        outcome => Err(format!("no answer: {outcome:?}")),
    }
}

/// The first line of a text. Reasons fit in it.
fn in_one_line(text: &str) -> String {
    let first = text
        .lines()
        .next()
        .unwrap_or_default()
        .replace("the exact oracle refutes it: ", "");
    let short: String = first.chars().take(WIDTH).collect();
    let cut = if short.len() < first.len() { "…" } else { "" };
    format!("{short}{cut}")
}

/// How the file of a new answer ends.
const PENDING: &str = ".snap.new";

/// What differs, on one screen.
fn summary(workspace: &Workspace, proposal: &Proposal) -> String {
    let Proposal { changes, refused } = proposal;
    let mut tasks: Vec<&str> = changes.iter().map(|change| change.task.as_str()).collect();
    tasks.extend(refused.iter().filter_map(|line| line.split('/').next()));
    tasks.sort_unstable();
    tasks.dedup();
    let mut text = format!(
        "{} from the reference's answers, in {}",
        plural(changes.len(), "golden differs", "goldens differ"),
        tasks.join(", ")
    );
    if !refused.is_empty() {
        text.push_str(&format!(
            "; {} wrong or missing",
            plural(proposal.refused_cases(), "case", "cases")
        ));
    }
    let path = |change: &Change| {
        let golden = change.golden.strip_prefix(workspace.root());
        golden.unwrap_or(&change.golden).display().to_string()
    };
    let changes = changes
        .iter()
        .map(|change| format!("{}: {}", path(change), change.meaning));
    let lines: Vec<String> = refused.iter().cloned().chain(changes).collect();
    for line in lines.iter().take(LINES) {
        text.push_str(&format!("\n  {}", in_one_line(line)));
    }
    if lines.len() > LINES {
        text.push_str(&format!("\n  and {} more", lines.len() - LINES));
    }
    let keys = tasks.join(" ");
    let mut pending = proposal.changes.iter().map(Change::pending);
    if let Some(first) = pending.find(|path| path.to_string_lossy().ends_with(PENDING)) {
        let first = first.strip_prefix(workspace.root()).unwrap_or(&first);
        text.push_str(&format!(
            "\nNew answers lie beside their goldens, such as {}\nLine by line:         cargo insta review",
            first.display()
        ));
    }
    let next = match refused.is_empty() {
        true => format!("Accept them:          cargo grader bless {keys}"),
        false => "Mend what is wrong:   cargo grader bless accepts no golden before".into(),
    };
    text + &format!("\nSee every difference: cargo grader review {keys}\n{next}")
}

#[test]
fn a_summary_fits_a_screen() {
    let (workspace, _) = course();
    let change = Change {
        task: "part1.task3".into(),
        golden: workspace.snapshot("part1.task3", "front_face"),
        content: Vec::new(),
        meaning: "long ".repeat(100),
        not_judged: Vec::new(),
        kind: ChangeKind::Answers,
    };
    let reason = "hit or miss is wrong on 3 of 8 calls, worst in call 6";
    let wrong = |i| format!("part1.task4/case_{i}: the exact oracle refutes it: {reason}");
    let proposal = Proposal {
        changes: vec![change; 300],
        refused: (0..300).map(wrong).collect(),
    };
    let text = summary(&workspace, &proposal);
    let line = format!("  part1.task4/case_0: {reason}\n");
    assert!(text.contains(&line), "{text}");
    // `bless` accepts nothing while something is wrong.
    assert!(!text.contains("Accept"), "{text}");
    assert!(text.lines().count() <= 18, "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() < 120),
        "{text}"
    );
    for part in [
        "300 goldens differ from the reference's answers, in part1.task3, part1.task4; 300 cases wrong or missing",
        "and 588 more",
        "cargo grader review part1.task3 part1.task4\n",
        "beside their goldens, such as golden/part1.task3/front_face.snap.new\n",
        "cargo insta review\n",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
}

/// Tests that use the reference's answers fail with the goldens, and say where to begin.
#[test]
fn tests_beside_the_main_one_name_it() {
    let files = [
        include_str!("certainty.rs"),
        include_str!("claims.rs"),
        include_str!("goldens.rs"),
        include_str!("main_answers.rs"),
        include_str!("mistakes.rs"),
        include_str!("moves.rs"),
        include_str!("simple_questions.rs"),
        include_str!("untrusted_records.rs"),
    ];
    let main = "the_goldens_are_what_the_reference_answers";
    assert!(BEGIN.contains(main) && include_str!("goldens.rs").contains(main));
    let tests = files
        .iter()
        .flat_map(|file| file.split("#[test]\n").skip(1));
    let of_answers = tests.filter(|test| {
        let body = test.split("\n}\n").next().unwrap_or(test);
        let helpers = [
            "reference(",
            "record(",
            "worker::run(",
            "spoiled(",
            "right_answers(",
            "of_triangles(",
        ];
        helpers.iter().any(|helper| body.contains(helper)) && !body.contains(main)
    });
    let mut count = 0;
    for test in of_answers {
        count += 1;
        let name = test.lines().next().unwrap_or_default();
        assert!(test.contains("= AfterTheGoldens;"), "{name}");
    }
    assert!(count >= 10, "{count}");
}

/// `cargo insta review` reads the files that the grader writes. `.ci/nightly insta` runs it.
#[test]
fn insta_reads_the_goldens() {
    let (workspace, course) = course();
    let mut count = 0;
    for task in course.tasks() {
        for case in &task.cases {
            let path = workspace.snapshot(&task.key, &case.name);
            let text = std::fs::read_to_string(&path).expect("the golden exists");
            let rows = text.strip_prefix(SNAPSHOT_HEADER).expect("insta's header");
            let read = insta::Snapshot::from_file(&path).expect("insta reads it");
            let insta::internals::SnapshotContents::Text(contents) = read.contents() else {
                panic!("{}: it is not text", path.display())
            };
            assert_eq!(
                contents.to_string().trim_end(),
                rows.trim_end(),
                "{}",
                path.display()
            );
            count += 1;
        }
    }
    assert!(count > 150, "only {count} goldens were read");
}

#[test]
fn every_box_that_is_counted_is_a_visit() {
    let _begin = AfterTheGoldens;
    let case = spec("part2.task3", "mesh_in_cornell_box").case();
    let Work::SceneHits(SceneWork {
        scene, tree, rays, ..
    }) = case.work.clone()
    else {
        panic!("{case:?}")
    };
    let work = Work::Visits(VisitsWork {
        scene,
        tree: tree.clone(),
        rays,
    });
    let visits = match worker::run(
        0,
        &wire::Case {
            work,
            ..case.clone()
        },
    )
    .outcome
    {
        Outcome::Answered(Answer::Visits(visits)) => visits,
        // A handout: there is no tree to walk yet.
        Outcome::NotAttempted { .. } => return,
        outcome => panic!("{outcome:?}"),
    };
    let Outcome::Answered(Answer::SceneHits(hits)) = worker::run(0, &case).outcome else {
        panic!("the case has an answer")
    };
    let count: usize = visits.rays.iter().map(Vec::len).sum();
    assert_eq!(count as u64, hits.box_tests);
    for (visits, hit) in visits.rays.iter().zip(&hits.hits) {
        assert_eq!(visits[0].node, 0, "the root comes first");
        // Who hits something has met the box of a leaf.
        let is_leaf = |node: u32| matches!(tree.nodes[node as usize].kind, NodeKind::Leaf { .. });
        assert!(hit.is_none() || visits.iter().any(|visit| visit.met && is_leaf(visit.node)));
    }
}
