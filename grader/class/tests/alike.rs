//! Which code in common is found, and what is said about it.

use base::Workspace;
use class::alike::common;
use class::alike::owners::Owners;
use class::alike::page::{self, Contents};
use class::alike::pairs::{self, Pair, Student};
use class::alike::table;
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
            owner: None,
            stages: BTreeMap::from([("intersect".to_string(), source)]),
        }
    };
    (0..20).map(student).collect()
}

/// Who hand in together are no pair, and count as one for others.
#[test]
fn those_of_a_team_are_not_compared_with_each_other() {
    let of = |sharing: &[u64], team: &[usize]| -> Vec<[String; 2]> {
        // In another order, so that two have two passages.
        let shared = |i: u64| match (sharing.contains(&i), i) {
            (true, 4) => SHARED.to_string() + &own_code(100, 9) + &own_code(300, 9),
            (true, _) => own_code(300, 9) + &own_code(200 + i, 9) + SHARED,
            (false, _) => String::new(),
        };
        let mut students = class(&shared);
        for i in team {
            students[*i].owner = Some(4);
        }
        let found = pairs(&students);
        let names = names(&found).into_iter();
        names.map(|both| both.map(str::to_owned)).collect()
    };
    assert_eq!(of(&[4, 9], &[]), [["04", "09"]]);
    assert!(of(&[4, 9], &[4, 9]).is_empty());
    // What three of twenty have may be chance, what a team and one other have is none.
    assert!(of(&[4, 9, 11], &[]).is_empty());
    let found = of(&[4, 9, 11], &[4, 9]);
    let has = |a: &str, b: &str| found.contains(&[a.to_owned(), b.to_owned()]);
    assert!(has("04", "11") && !has("04", "09"), "{found:?}");
}

/// The largest share of a stage.
fn share(pair: &Pair) -> f64 {
    let shares = pair.stages.iter().map(|stage| stage.share);
    shares.fold(0.0, f64::max)
}

/// All pairs of a class, with their passages.
fn pairs(students: &[Student]) -> Vec<Pair> {
    let owners = Owners::new(students);
    let found = pairs::pairs(students, &owners, pairs::COMPARED);
    assert_eq!(found.not_compared, 0);
    let pairs = found.listed.iter().map(|found| {
        let pair = pairs::pair(students, &owners, found);
        assert_eq!((share(&pair), pair.expected), (found.share, found.expected));
        pair
    });
    pairs.collect()
}

fn common(students: &[Student]) -> Vec<common::Common> {
    common::common(students, &Owners::new(students), 100).0
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
    assert_eq!(pairs(&students), []);
    assert_eq!(common(&students), []);
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
    assert_eq!(pairs(&students), []);
    let students = class(&|i| match i {
        4 => SHARED.to_string() + &own_code(100, 9) + &own_code(300, 9),
        9 => own_code(300, 9) + &own_code(200, 9) + &renamed,
        _ => String::new(),
    });
    let found = pairs(&students);
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
    let page = page::page(&Contents {
        pairs: found,
        ..Contents::default()
    });
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
    assert_eq!(names(&pairs(&students)), [["03", "07"]]);
    assert!(share(&pairs(&students)[0]) > 0.9);
}

/// A passage that a group of friends has is what the teacher asks about; one of a book is not.
#[test]
fn passages_of_a_few_are_open() {
    let of_group = |i| {
        [300, 100 + i, 400, 200 + i, 500, 600 + i]
            .map(|seed| own_code(seed, 9))
            .concat()
    };
    let students = class(&|i| match i {
        4 | 9 | 12 => of_group(i) + SHARED,
        13.. => SHARED.to_string(),
        _ => String::new(),
    });
    let pairs = pairs(&students);
    assert_eq!(pairs.len(), 3);
    let of_few = pairs
        .iter()
        .flat_map(|pair| &pair.stages[0].passages)
        .filter(|passage| passage.others == 1)
        .count();
    let page = page::page(&Contents {
        pairs,
        ..Contents::default()
    });
    assert!(of_few > 0 && page.contains("7 others have it"), "{page}");
    let open = page.matches("<details class=\"card\" open>").count();
    assert_eq!(open, of_few, "{page}");
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
    assert_eq!(pairs(&students), []);
    let common = common(&students);
    assert_eq!(common.len(), 1, "{common:?}");
    assert_eq!(common[0].names.len(), 11);
    assert!(
        common[0].excerpt.text.raw().contains("corner - ray.o"),
        "{common:?}"
    );
}

/// Two who hand in everybody's code make a group with each passage of three others, and each group
/// takes as long as their code.
#[test]
fn not_every_group_of_those_who_copy_all_is_looked_at() {
    let students = class(&|i| {
        let has = |s: &u64| i < 2 || [2 + s % 6, 8 + s / 6 % 6, 14 + s / 36].contains(&i);
        let passages = (0..108).filter(has).map(|s| own_code(1000 + s, 9));
        passages.collect()
    });
    let owners = Owners::new(&students);
    let (common, not_looked_at) = common::common(&students, &owners, 2);
    assert_eq!(common.len(), 1);
    assert!(not_looked_at > 0);
}

/// Of a class in which everybody copied, a bounded number of pairs is compared and shown, the
/// strongest first, and the page says what is not.
#[test]
fn many_pairs_are_a_table_and_the_strongest_of_them_a_page() {
    // Three have each text; what two of them share grows with their number.
    let students = class(&|i| own_code(500 + i / 3, 60 + 10 * (i / 3)));
    let owners = Owners::new(&students);
    let all = pairs::pairs(&students, &owners, pairs::COMPARED);
    assert_eq!((all.listed.len(), all.not_compared), (6 * 3 + 1, 0));
    let shares: Vec<f64> = all.listed.iter().map(|found| found.share).collect();
    assert!(shares.is_sorted_by(|a, b| a >= b), "{shares:?}");
    let few = pairs::pairs(&students, &owners, 4);
    assert_eq!((few.listed.len(), few.not_compared), (4, 15));
    // The longest texts are compared first: those of 18 and 19, and of 15, 16 and 17.
    let members: Vec<usize> = few.listed.iter().flat_map(|found| found.both).collect();
    assert!(members.iter().all(|i| *i >= 15), "{members:?}");

    let shown = all.listed[..4]
        .iter()
        .map(|found| pairs::pair(&students, &owners, found));
    let page = page::page(&Contents {
        students: students.len(),
        pairs: shown.collect(),
        found: all.listed.len(),
        not_compared: few.not_compared,
        ..Contents::default()
    });
    let says = |words: &str| assert!(page.contains(words), "no {words:?} in {page}");
    says("19 pairs were found. The 4 with the largest shares are shown, the other 15 are lines of");
    says("15 with less were not");
    // A passage of two stands twice, one of three students three times and not six times.
    assert_eq!(page.matches("<pre>").count(), 2 + 3, "{page}");
    assert_eq!(page.matches("shown above").count(), 3, "{page}");

    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("alike.csv");
    table::write(&path, &students, &all.listed).expect("it is written");
    let table = std::fs::read_to_string(path).expect("a table");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 1 + 19, "{table}");
    assert_eq!(rows[0], "first,second,share,expected,passages,tokens");
    let [a, b] = all.listed[0].both;
    assert!(rows[1].starts_with(&format!("{a:02},{b:02},0.")), "{table}");
}

/// Two students with much code on one line: each passage would show all of it.
#[test]
fn a_long_line_and_many_passages_are_cut() {
    let line = |i: u64| -> String {
        let passages =
            (0..60).map(|passage| own_code(900 + passage, 8) + &own_code(1000 * i + passage, 1));
        passages.collect::<String>().replace('\n', " ")
    };
    let students = class(&|i| match i {
        2 | 5 => line(i),
        _ => String::new(),
    });
    let found = pairs(&students);
    assert_eq!(names(&found), [["02", "05"]]);
    let stage = &found[0].stages[0];
    assert_eq!(stage.passages.len(), pairs::SHOWN);
    assert!(stage.more >= 30, "{}", stage.more);
    let page = page::page(&Contents {
        pairs: found.clone(),
        ..Contents::default()
    });
    assert!(
        page.contains(&format!("and {} are not.", stage.more)),
        "{page}"
    );
    assert!(page.len() < 100_000, "{} bytes", page.len());
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
    let student = |name: &str, files: &files::file_tree::Files| Student {
        name: name.into(),
        owner: None,
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
        files::file_tree::Files::from_iter(["construct.rs", "traverse.rs"].map(|name| {
            let path = workspace.root().join("stages/bvh/src").join(name);
            (
                PathBuf::from(name),
                std::fs::read(path).expect("it can be read"),
            )
        }));
    let students = [student("honest", &reference), student("pasted", &pasted)];
    let (found, all) = pairs::pasted(&student("the grader", &graders), &students, 9);
    assert_eq!(all, 1);
    assert_eq!(names(&found), [["pasted", "the grader"]]);
    let page = page::page(&Contents {
        pasted: found,
        ..Contents::default()
    });
    assert!(page.contains("Passages of the grader's own code"));
    assert!(page.contains("tree_tests.rs"));
}
