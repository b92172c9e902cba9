//! Which code in common is found, and what is said about it.

use base::Workspace;
use class::alike::page;
use class::alike::pairs::{self, Pair, Student};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use submission::code::passages::Known;
use submission::code::source::Source;
use submission::code::{given, known, tokens};

/// A test that nobody's textbook has, so that who has it as well has it from somewhere.
const SHARED: &str = "
fn slope(triangle: &Triangle, ray: &Ray) -> f64 {
    let mut sum = 0.25;
    for (i, corner) in triangle.corners().iter().enumerate() {
        let height = (corner - ray.o).dot(ray.d) * 0.75;
        if height > sum && i != 1 {
            sum = sum.max(height) - 0.125 / (1.0 + height);
        }
    }
    sum
}
";

/// Code that is like nobody else's: statements of operators and numbers drawn from `seed`.
fn own_code(seed: u64, statements: u64) -> String {
    let mut code = format!("fn own_{seed}(x: f64) -> f64 {{\n    let mut y = x;\n");
    let mut state = seed * 977 + 13;
    for i in 0..statements {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let operator = ["+", "-", "*", "/"][(state >> 40) as usize % 4];
        code += &format!("    y = y {operator} {}.{i};\n", (state >> 20) % 9973);
    }
    code + "    y\n}\n"
}

/// A class of 20, each with own code; `extra` says what some have besides.
fn class(extra: &dyn Fn(u64) -> String) -> Vec<Student> {
    let student = |i: u64| {
        let text = own_code(i, 30) + &extra(i);
        let files = BTreeMap::from([(PathBuf::from("lib.rs"), text.into_bytes())]);
        let source = Source::new(&files, &Known::default());
        Student {
            name: format!("{i:02}").into(),
            stages: BTreeMap::from([("intersect".to_string(), source)]),
        }
    };
    (0..20).map(student).collect()
}

fn names(pairs: &[Pair]) -> Vec<[&str; 2]> {
    let names = pairs
        .iter()
        .map(|pair| [pair.names[0].raw(), pair.names[1].raw()]);
    names.collect()
}

#[test]
fn code_of_ones_own_is_in_no_pair() {
    let students = class(&|_| String::new());
    assert_eq!(pairs::pairs(&students), []);
    assert_eq!(pairs::common(&students), []);
}

#[test]
fn a_copy_with_other_blanks_comments_and_names_is_found() {
    let renamed = SHARED
        .replace("height", "h")
        .replace("sum", "total")
        .replace("\n    ", "\n  // Adds up.\n  ");
    let students = class(&|i| match i {
        4 => SHARED.to_string() + &own_code(100, 9),
        9 => own_code(200, 9) + &renamed,
        _ => String::new(),
    });
    // One passage that two of twenty have may be chance.
    assert_eq!(pairs::pairs(&students), []);
    let students = class(&|i| match i {
        4 => SHARED.to_string() + &own_code(100, 9) + &own_code(300, 9),
        9 => own_code(300, 9) + &own_code(200, 9) + &renamed,
        _ => String::new(),
    });
    let found = pairs::pairs(&students);
    assert_eq!(names(&found), [["04", "09"]]);
    let stage = &found[0].stages[0];
    assert_eq!(stage.passages.len(), 2, "{stage:?}");
    let passage = &stage.passages[0];
    assert!(
        !passage.has_same_names && passage.others == 0,
        "{passage:?}"
    );
    assert!(
        passage.excerpts[0].text.raw().contains("let height ="),
        "{passage:?}"
    );
    assert!(
        passage.excerpts[1].text.raw().contains("let h ="),
        "{passage:?}"
    );
    // Each passage: (0 + 1/2) / 19; 190 pairs.
    let expected = 190.0 * (0.5_f64 / 19.0).powi(2);
    assert!(
        (found[0].expected - expected).abs() < 1e-12,
        "{}",
        found[0].expected
    );
    let page = page::page(students.len(), &found, &[], &[]);
    assert!(
        page.contains("let total = ") || page.contains("let mut total = "),
        "{page}"
    );
}

#[test]
fn a_whole_copy_is_found_even_if_it_is_one_passage() {
    let students = class(&|i| {
        if i == 7 {
            own_code(3, 30) + "fn own_7() {}"
        } else {
            String::new()
        }
    });
    // Student 7 has all of student 3's code beside code of the same length.
    assert_eq!(names(&pairs::pairs(&students)), [["03", "07"]]);
    assert!(pairs::pairs(&students)[0].share() > 0.9);
}

#[test]
fn what_many_have_is_told_once_and_accuses_no_pair() {
    let students = class(&|i| {
        if i < 11 {
            SHARED.to_string()
        } else {
            String::new()
        }
    });
    assert_eq!(pairs::pairs(&students), []);
    let common = pairs::common(&students);
    assert_eq!(common.len(), 1, "{common:?}");
    assert_eq!(common[0].names.len(), 11);
    assert!(
        common[0].excerpt.text.raw().contains("corner - ray.o"),
        "{common:?}"
    );
}

#[test]
fn the_handout_and_textbook_code_of_the_course_are_nobodys() {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the course");
    let stage = "intersect";
    let known = known(workspace.root(), stage).expect("files");
    let given = given(workspace.root(), stage).expect("files");
    assert_eq!(Source::new(&given, &known).text.own(), 0);
    let variant = workspace
        .root()
        .join("grader/mutants/variants/intersect/moller_trumbore.rs");
    let variant = std::fs::read(variant).expect("a variant");
    let files = BTreeMap::from([(PathBuf::from("lib.rs"), variant)]);
    assert_eq!(Source::new(&files, &known).text.own(), 0);
    let text = String::from_utf8(given[Path::new("lib.rs")].clone()).expect("UTF-8");
    assert!(tokens::of(&text).is_some_and(|tokens| tokens.len() > 20));
    let solution = std::fs::read(workspace.root().join("stages/intersect/src/triangle.rs"));
    if let Ok(solution) = solution {
        let files = BTreeMap::from([(PathBuf::from("triangle.rs"), solution)]);
        assert!(
            Source::new(&files, &known).text.own() > 100,
            "the solution is nobody's"
        );
    }
}

/// Whoever pastes the exact arithmetic or the walk through a tree from a handout is shown, whatever
/// the names are; correct variants and the reference are not.
#[test]
fn code_of_the_grader_in_a_stage_is_shown() {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a workspace");
    let graders = submission::code::of_the_grader(workspace.root()).expect("it can be read");
    let known = known(workspace.root(), "bvh").expect("it can be read");
    let student = |name: &str, files: &submission::file_tree::Files| Student {
        name: name.into(),
        stages: BTreeMap::from([("bvh".to_string(), Source::new(files, &known))]),
    };
    let walk = &graders[Path::new("grader/judge/src/tools/truth/tree_tests.rs")];
    let walk = String::from_utf8_lossy(walk);
    let start = walk.find("impl TracedRay").expect("the walk is there");
    let renamed = walk[start..]
        .replace("tests", "count")
        .replace("next", "todo");
    let pasted = BTreeMap::from([(PathBuf::from("lib.rs"), renamed.into_bytes())]);
    let reference =
        submission::file_tree::Files::from_iter(["construct.rs", "traverse.rs"].map(|name| {
            let path = workspace.root().join("stages/bvh/src").join(name);
            (
                PathBuf::from(name),
                std::fs::read(path).expect("it can be read"),
            )
        }));
    let students = [student("honest", &reference), student("pasted", &pasted)];
    let found = pairs::pasted(&student("the grader", &graders), &students);
    assert_eq!(names(&found), [["pasted", "the grader"]]);
    let page = page::page(2, &[], &[], &found);
    assert!(page.contains("Passages of the grader's own code"));
    assert!(page.contains("tree_tests.rs"));
}
