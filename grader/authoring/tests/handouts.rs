//! Tests of the text of this course's handouts. `grader course check` also builds, tests and grades
//! them.

use base::Workspace;
use files::members;
use grader::course::given::{self, GivenFiles};
use grader::course::{Course, packed};
use handout::Handout;
use handout::carve::Carver;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
}

/// The handout of a part, carved once for all tests.
pub(crate) fn handout(part: usize) -> &'static Handout {
    static HANDOUTS: [OnceLock<Handout>; 5] = [const { OnceLock::new() }; 5];
    HANDOUTS[part - 1].get_or_init(|| {
        let part = u32::try_from(part).expect("a small number");
        Handout::carve(&workspace(), part).expect("the course can be carved")
    })
}

fn text<'a>(handout: &'a Handout, path: &str) -> &'a str {
    let contents = handout.files.get(Path::new(path));
    std::str::from_utf8(contents.unwrap_or_else(|| panic!("no {path}"))).expect("it is text")
}

fn has(handout: &Handout, path: &str) -> bool {
    handout.files.keys().any(|file| file.starts_with(path))
}

#[test]
fn the_handout_of_part_1_contains_no_solution() {
    let handout = handout(1);
    let removed: BTreeSet<&str> = handout
        .removed
        .iter()
        .map(|removed| removed.key.as_str())
        .collect();
    for key in ["part1.task1", "part1.task4", "part2.task1", "part2.task3"] {
        assert!(removed.contains(key), "{key} was not removed");
    }
    let triangle = text(handout, "stages/intersect/src/triangle.rs");
    assert!(
        triangle.contains("kit::hole!(\"part1.task3\", tri, ray)\n}"),
        "{triangle}"
    );
    let tree = text(handout, "stages/bvh/src/construct.rs");
    assert!(
        tree.contains("kit::untouched!(\"part2.task1\");\n    let _ ="),
        "{tree}"
    );
    assert!(
        !has(handout, "stages/intersect/src/exact.rs"),
        "a file that contains only a solution"
    );
    assert!(
        !has(handout, "stages/intersect/tests/kernels"),
        "tests of removed solutions"
    );
}

#[test]
fn the_handout_of_part_2_contains_the_reference_of_part_1() {
    let handout = handout(2);
    assert!(
        handout
            .removed
            .iter()
            .all(|removed| !removed.key.starts_with("part1."))
    );
    assert!(has(handout, "stages/intersect/src/exact.rs"));
    assert!(has(handout, "stages/intersect/tests"));
    assert!(!has(handout, "stages/bvh/tests/tree"));
    assert!(text(handout, "stages/bbox/src/lib.rs").contains("kit::hole!(\"part2.task2\""));
}

/// The first test to make green is there from the start, with what cargo needs to run it, and is the
/// student's to change.
#[test]
fn every_stage_has_its_worked_example() {
    let handout = handout(1);
    let workspace = workspace();
    let course = Course::read(&workspace).expect("the course is sound");
    let given = GivenFiles::parse(text(handout, given::LIST));
    for stage in course.stages() {
        let path = format!("stages/{stage}/tests/worked_example.rs");
        let example = text(handout, &path);
        for task in course.tasks().filter(|task| task.stage == stage) {
            let name = format!("fn {}_", task.key.replace('.', "_"));
            assert!(example.contains(&name), "no {name} in {path}");
            let ignored = format!("ignore = \"{} is not written yet\"", task.key);
            assert!(example.contains(&ignored), "no {ignored} in {path}");
        }
        assert!(!given.decides(Path::new(&path)), "{path}");
        let manifest = text(handout, &format!("stages/{stage}/Cargo.toml"));
        assert!(!manifest.contains("autotests = false"), "{manifest}");
    }
}

/// The chapters of all parts and their figures, but not the code that draws and tests them, which
/// computes what students have to write.
#[test]
fn a_handout_contains_the_text_of_the_book_and_not_its_code() {
    for part in [1, 2] {
        let handout = handout(part);
        for file in [
            "SUMMARY.md",
            "part1/task1.md",
            "part5/task2.md",
            "figures/part1-triangle.svg",
        ] {
            assert!(has(handout, &format!("stages/book/src/{file}")), "{file}");
        }
        for file in ["Cargo.toml", "code", "tests", "theme"] {
            assert!(!has(handout, &format!("stages/book/{file}")), "{file}");
        }
        assert!(!text(handout, "Cargo.toml").contains("stages/book"));
        let readme = text(handout, "README.md");
        assert!(readme.contains("[Constructing the BVH](stages/book/src/part2/task1.md)"));
    }
}

/// Links of the chapters to the project lead to files that the handout contains.
#[test]
fn links_of_the_book_lead_to_files_of_the_handout() {
    let handout = handout(1);
    let mut links = 0;
    for (path, contents) in &handout.files {
        if !path.starts_with("stages/book/src") || path.extension().is_none_or(|e| e != "md") {
            continue;
        }
        let chapter = String::from_utf8_lossy(contents);
        for link in chapter
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next())
        {
            let target = link.split('#').next().unwrap_or_default();
            if link.contains("://") || target.is_empty() {
                continue;
            }
            let mut file = path.parent().expect("a folder").to_path_buf();
            for name in target.split('/') {
                if name == ".." {
                    file.pop();
                } else {
                    file.push(name);
                }
            }
            let file = file.to_string_lossy().into_owned();
            assert!(has(handout, &file), "{}: {link}", path.display());
            links += 1;
        }
    }
    assert!(links > 100, "found {links} links");
}

#[test]
fn a_handout_contains_the_students_files_and_no_others() {
    let handout = handout(1);
    for path in [
        "README.md",
        "Cargo.lock",
        ".cargo/config.toml",
        ".vscode/settings.json",
        ".zed/settings.json",
        ".helix/languages.toml",
        ".devcontainer/devcontainer.json",
        "stages/course.toml",
        "stages/kit/src",
        "scenes/dae",
        "grader/src",
        "grader/worker/src",
        "golden/part1.task3.pack",
        "golden/signatures/part1.task3.bin",
        "golden/part1.task3/picture_of_a_ring.png",
    ] {
        assert!(has(handout, path), "no {path}");
    }
    for path in [
        ".git",
        ".ci",
        "CONTRIBUTING.md",
        "golden/Cargo.toml",
        "golden/tests",
        "golden/mutants",
        "scenes/pictures",
        "scenes/tests",
        "grader/mutants",
        "grader/review",
        "grader/submission",
        "grader/tests",
    ] {
        assert!(!has(handout, path), "{path} is for instructors only");
    }
    let manifest = text(handout, "Cargo.toml");
    assert!(!manifest.contains("\"golden\""), "{manifest}");
    assert!(!text(handout, "Cargo.lock").contains("name = \"insta\""));
}

/// The largest size of a handout in bytes. Whoever raises it says why: of 20,000 bytes that came
/// with shared vertices of the wide tree, empty pixels and telephone drawings of plots, 14,000 were
/// paid by a crate for tests that handouts had. 2,000 are the indentation of chains, where a name
/// was bound twice, and 2,200 examples of kit's types. 82,000 are pairs of mistakes and
/// distributions of directions in the signatures, and 100,000 goldens with larger leaves and more
/// rays, limits that grow with the slowness of a machine, and typed messages. 430,000 are pairs of
/// mistakes of eleven more tasks: of 72 fresh pairs 50 are named with both halves, where it was one
/// in three. 70,000 are the program that draws a student's own scenes, the short paths of the
/// chapters, two cases of grids with their results, and more pairs. Less by 238,000: what grades
/// submissions, stores goldens and reviews them is not in a handout. 21,000 are the cases of the
/// record of a hit and of a sphere's normals, with what mistakes answer there. 13,500 are walls
/// among triangles, classes of rays' origins and lamps' sides, and drawings of wrong hits. 14,000
/// are many lamps of which each sample chooses one, and samplers with points in pairs. 10,000 are
/// slips in boxes by signs and by early returns, with what they answer. 22,000 are slips in areas,
/// dot products, shears and matrices. 9,000 are files that come back with their old times,
/// libraries that do not compile, and parts of pictures that know their whole scene. 7,500 are
/// large meshes that are read, and exact answers that are computed, in less time. 19,000 are the
/// edges of lamps, files that came back after another build, and readers of odd meshes. 11,000 are
/// renamed folders, edges inside of lamps, paths with blanks in commands, and picture files. 21,000
/// are blocks of pixels that share paths, spare nodes of trees, and pictures of other programs.
/// 24,000 are rays towards caustics, hits that are close together, gaps in written code, and
/// processes that are left behind.
const LARGEST: usize = 8_327_000;

#[test]
fn the_list_of_given_files_says_what_decides_points() {
    let handout = handout(2);
    let given = GivenFiles::parse(text(handout, given::LIST));
    let decides = |path: &str| given.decides(Path::new(path));
    for path in [
        "Cargo.toml",
        "stages/course.toml",
        "stages/kit/src/ray.rs",
        "stages/intersect/Cargo.toml",
        "scenes/meshes/src/lib.rs",
        "golden/part1.task3.pack",
        "grader/judge/src/lib.rs",
    ] {
        assert!(decides(path), "{path}");
    }
    for path in [
        "stages/viewer/src/main.rs",
        "stages/book/src/introduction.md",
    ] {
        assert!(has(handout, path) && !decides(path), "{path}");
    }
    let course = Course::read(&workspace()).expect("the course");
    let stages = course.stages();
    for (path, contents) in &handout.files {
        let is_written = |stage: &&str| {
            let folder = Path::new("stages").join(stage);
            path.starts_with(folder.join("src")) || path.starts_with(folder.join("tests"))
        };
        let is_given = !stages.iter().any(is_written) && path != Path::new(given::LIST);
        let listed = given.is_original(path, contents);
        assert_eq!(listed, is_given.then_some(true), "{}", path.display());
    }
}

#[test]
fn a_handout_is_small() {
    for part in [1, 2] {
        let files = handout(part).files.values();
        let bytes: usize = files.map(Vec::len).sum();
        assert!(bytes <= LARGEST, "part {part}: {bytes} bytes");
    }
}

/// What a handout has of the crates most of whose files are solutions, beside their manifests.
const BESIDE_SOLUTIONS: [&str; 22] = [
    "grader/kernels/src/counting.rs",
    "grader/kernels/src/instructions.rs",
    "grader/kernels/src/kernel.rs",
    "grader/kernels/src/lib.rs",
    "grader/kernels/src/shapes.rs",
    "grader/kernels/src/tree.rs",
    "stages/lanes/src/instruction_sets.rs",
    "stages/lanes/src/lib.rs",
    "stages/lanes/src/real.rs",
    "stages/lanes/src/scalar.rs",
    "stages/lanes/src/shapes.rs",
    "stages/lanes/src/vec3.rs",
    "stages/lanes/src/wide.rs",
    "stages/simd_bvh/src/intersect.rs",
    "stages/simd_bvh/src/lib.rs",
    "stages/simd_bvh/src/ray_tile.rs",
    "stages/simd_bvh/src/stream.rs",
    "stages/simd_bvh/src/wide.rs",
    "stages/simd_paths/src/caustic_guide.rs",
    "stages/simd_paths/src/fallback.rs",
    "stages/simd_paths/src/lib.rs",
    "stages/simd_paths/src/scene.rs",
];

/// A file that is moved out of a folder of `whole_solutions`, or a new one beside it, would be
/// handed out: who adds one lists it there, or here if it is given.
#[test]
fn nothing_else_of_crates_with_whole_solutions_is_handed_out() {
    let crates = [
        "grader/kernels",
        "stages/lanes",
        "stages/simd_bvh",
        "stages/simd_paths",
    ];
    let files = handout(1).files.keys();
    let of_crates = files
        .filter(|path| crates.iter().any(|folder| path.starts_with(folder)))
        .filter(|path| !path.ends_with("Cargo.toml"));
    let found: Vec<&Path> = of_crates.map(|path| path.as_path()).collect();
    assert_eq!(found, BESIDE_SOLUTIONS.map(Path::new));
}

/// `grader start` copies what cargo built of the grader. In its crates stubs compute what the
/// solutions do, and no file is missing: cargo would compile all that depends on this crate again.
#[test]
fn the_grader_of_a_handout_is_that_of_the_checkout() {
    let root = workspace().root().to_path_buf();
    let members = members::read(&root).expect("cargo lists them");
    let linked = members::with_tests_of(&members, &["grader"], |_| false);
    for removed in &handout(1).removed {
        let owner = members::containing_member(&members, &removed.path);
        let name = owner.map_or("", |owner| owner.name.as_str());
        let has_stub = handout(1).files.contains_key(&removed.path);
        let path = removed.path.display();
        assert!(
            !linked.contains(name) || has_stub,
            "{}: {path}",
            removed.key
        );
    }
}

#[test]
fn the_goldens_of_a_handout_are_read_from_its_packs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (path, contents) in &handout(1).files {
        let is_needed = path.starts_with("golden") || path.ends_with("course.toml");
        if is_needed {
            files::file_tree::write(&folder.path().join(path), contents).expect("it is new");
        }
    }
    let unpacked = Workspace::above(folder.path()).expect("it is a workspace");
    let full = workspace();
    let [theirs, ours] = [&unpacked, &full].map(|workspace| {
        let snapshot = packed::read_snapshot(workspace, "part1.task3", "back_face");
        let known = grader::diagnosis::known(workspace, "part1.task3");
        (
            snapshot.expect("it can be read"),
            known.expect("they can be read"),
        )
    });
    assert!(ours.0.is_some() && !ours.1.is_empty());
    assert!(theirs == ours);
}

#[test]
fn cargo_test_tests_only_the_stages_to_write() {
    let manifest = text(handout(2), "Cargo.toml");
    let defaults = manifest
        .split_once("default-members = [")
        .expect("a list")
        .1;
    let defaults = defaults.split_once(']').expect("the end of the list").0;
    for (folder, is_tested) in [
        ("stages/bvh", true),
        ("stages/adaptive", true),
        ("stages/intersect", false),
        ("grader", false),
    ] {
        assert_eq!(defaults.contains(folder), is_tested, "{folder}: {defaults}");
    }
    assert!(!text(handout(1), "stages/intersect/Cargo.toml").contains("proptest"));
}

#[test]
fn the_readme_lists_the_folders_to_hand_in() {
    for (part, stages) in [
        (
            1,
            "stages/{raygen,intersect,bvh,bbox,direct,global,adaptive}/src`",
        ),
        (2, "stages/{bvh,bbox,direct,global,adaptive}/src`"),
    ] {
        let readme = text(handout(part), "README.md");
        assert!(readme.contains(stages), "{readme}");
    }
}

#[test]
fn a_handout_has_no_markers_and_carving_it_again_changes_nothing() {
    for part in [1, 2] {
        let handout = handout(part);
        let keys: BTreeSet<String> = handout
            .removed
            .iter()
            .map(|removed| removed.key.clone())
            .collect();
        let carver = Carver {
            all_keys: keys.clone(),
            carved_keys: keys,
        };
        let code = handout
            .files
            .iter()
            .filter(|(path, _)| path.starts_with("stages"));
        for (path, contents) in code.filter(|(path, _)| path.extension().is_some_and(|e| e == "rs"))
        {
            let text = String::from_utf8_lossy(contents);
            assert!(!text.contains("SOLUTION("), "{}", path.display());
            let again = carver
                .carve(&path.to_string_lossy(), &text)
                .expect("it has no broken marker");
            assert!(
                again.removed.is_empty() && again.text == text,
                "{}",
                path.display()
            );
        }
    }
}

#[test]
fn no_handout_contains_a_copy_of_its_solutions() {
    for part in [1, 2] {
        assert_eq!(
            authoring::check::solution_copies::find(handout(part)),
            [""; 0],
            "part {part}"
        );
    }
}

#[test]
fn the_readme_lists_every_task_with_its_file() {
    let handout = handout(2);
    let readme = text(handout, "README.md");
    for text in [
        "cargo grader part2",
        "| part2.task2 |",
        "`intersect_bbox`",
        "`stages/bbox/src/lib.rs`",
        "min_t <= t <= max_t",
        "Part 1 is already complete",
    ] {
        assert!(readme.contains(text), "no {text:?} in\n{readme}");
    }
    assert!(
        !readme.contains('{') || readme.contains("stages/{"),
        "a placeholder is left:\n{readme}"
    );
    assert!(!readme.contains("| part1.task1 |"));
}

#[test]
fn the_readme_greets_in_three_lines() {
    let readme = text(handout(1), "README.md");
    let greeting: Vec<&str> = readme.lines().skip(2).take(4).collect();
    assert!(
        greeting[0].starts_with("You write a ray tracer"),
        "{readme}"
    );
    assert!(greeting[1].contains("`cargo grader`"), "{readme}");
    assert!(greeting[2].contains("`cargo grader look`"), "{readme}");
    assert!(greeting[2].contains("`cargo grader book`"), "{readme}");
    assert_eq!(greeting[3], "");
}

#[test]
fn the_readme_lists_what_is_not_graded_but_needed() {
    let readme = text(handout(1), "README.md");
    let mis = "- `estimate_direct_lighting_mis` in `stages/direct/src/mis.rs`, with part3.task3: ";
    assert!(readme.contains(mis), "{readme}");
    assert!(readme.contains("`pathtracer --mis` needs it."), "{readme}");
    // Functions that are graded are listed above only.
    assert!(!readme.contains("- `test_triangle`"), "{readme}");
}

/// Cargo builds nothing of a workspace in which a manifest names a program that is not there.
#[test]
fn the_programs_that_manifests_name_are_in_the_handout() {
    for part in [1, 2] {
        let handout = handout(part);
        let manifests = handout
            .files
            .keys()
            .filter(|path| path.ends_with("Cargo.toml"));
        for manifest in manifests {
            let paths = text(handout, manifest.to_str().expect("a path"));
            let paths = paths
                .lines()
                .filter_map(|line| line.strip_prefix("path = \""));
            for path in paths.filter_map(|path| path.strip_suffix('"')) {
                let file = manifest.with_file_name(path);
                assert!(
                    handout.files.contains_key(&file),
                    "part {part}: {}",
                    file.display()
                );
            }
        }
    }
}

#[test]
fn the_error_for_an_unknown_part_lists_the_parts() {
    let error = Handout::carve(&workspace(), 9).unwrap_err().to_string();
    assert!(error.contains("no part 9"), "{error}");
    assert!(error.contains("1, 2"), "{error}");
}

/// The largest size of a handout with its rendered book, in bytes.
const LARGEST_WITH_BOOK: usize = 8_621_000;

/// The handout of part 1 with the rendered book of this checkout.
#[test]
#[ignore = "compiles the program of the book in release: half a minute"]
fn the_rendered_book_of_a_handout_is_small_and_holds_no_solution() {
    let workspace = workspace();
    let site = grader::book::make_current(&workspace).expect("the book can be rendered");
    let mut handout = handout(1).clone();
    handout.add_book(&site).expect("it can be packed");
    let bytes: usize = handout.files.values().map(Vec::len).sum();
    assert!(bytes <= LARGEST_WITH_BOOK, "{bytes} bytes");
    let pack = handout.files.remove(Path::new(grader::book::PACK));
    let pages = packed::unpack(&pack.expect("the pack")).expect("it can be unpacked");
    let mut texts = 0;
    for (path, contents) in pages {
        let is_text = path.extension().is_some_and(|e| e == "html" || e == "js");
        if is_text {
            // Below the folder of the chapters, so that half a statement is found.
            let text = text_of_page(&String::from_utf8_lossy(&contents));
            let path = Path::new("stages/book/src").join(path);
            handout.files.insert(path, text.into_bytes());
            texts += 1;
        }
    }
    assert!(texts > 25, "found {texts} pages");
    assert_eq!(authoring::check::solution_copies::find(&handout), [""; 0]);
}

/// A page without its tags.
fn text_of_page(html: &str) -> String {
    let mut text = String::new();
    for part in html.split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, text)| text));
    }
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&amp;", "&")
}

/// A packed book is unpacked as it was, and is one of the given files that decide no points.
#[test]
fn the_book_of_a_handout_is_packed_and_given() {
    let site = tempfile::tempdir().expect("a temporary folder");
    std::fs::create_dir_all(site.path().join("part1")).expect("a folder");
    for (path, text) in [
        ("index.html", "i"),
        ("part1/task1.html", "t"),
        (".made-of", "0"),
    ] {
        std::fs::write(site.path().join(path), text).expect("a file");
    }
    let mut handout = handout(1).clone();
    // The site has a copy of a task's picture, and one of another that was changed.
    let picture = "part1.task3/task.png";
    let golden = &handout.files[&Path::new("golden").join(picture)];
    let changed = "pictures/part1.task4/task.png";
    for (path, bytes) in [
        (&*format!("pictures/{picture}"), &**golden),
        (changed, b"png"),
    ] {
        files::file_tree::write(&site.path().join(path), bytes).expect("a file");
    }
    handout.add_book(site.path()).expect("it can be packed");
    let pack = &handout.files[Path::new(grader::book::PACK)];
    let names: Vec<_> = packed::unpack(pack)
        .expect("a pack")
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    assert_eq!(
        names,
        ["index.html", "part1/task1.html", changed].map(PathBuf::from)
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (path, contents) in &handout.files {
        files::file_tree::write(&folder.path().join(path), contents).expect("it is new");
    }
    let unpacked = Workspace::above(folder.path()).expect("it is a workspace");
    let book = grader::book::make_current(&unpacked).expect("it can be unpacked");
    let read = |path: &str| std::fs::read(book.join(path)).expect("it is there");
    assert_eq!(
        read(&format!("pictures/{picture}")),
        handout.files[&Path::new("golden").join(picture)]
    );
    assert_eq!(read(changed), b"png");
    assert!(book.join("figures").is_dir());
    let given = GivenFiles::parse(text(&handout, given::LIST));
    let path = Path::new(grader::book::PACK);
    assert_eq!(given.is_original(path, pack), Some(true));
    assert!(!given.decides(path));
}
