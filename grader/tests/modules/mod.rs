//! How the files of a crate import each other: no large circles, and in the judge no import from an
//! upper floor.
//!
//! A file of a circle can be understood only together with all others of it, so circles are small.
//! What only tests import does not count.

mod circles;
mod source_tree;
pub(crate) mod tokens;

use cargo_metadata::MetadataCommand;
use source_tree::SourceTree;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The largest number of files that may import each other in a circle.
const LARGEST_CIRCLE: usize = 3;

/// The larger circles that remain: the folder that has all files of the circle, and their number. A
/// line goes when its circle is opened; none is added.
const REMAINING: &[(&str, usize)] = &[
    ("grader/class/src/reading", 6),
    ("grader/cost/src", 14),
    ("grader/driver/src/picture", 12),
    ("scenes/src/collada", 4),
    ("stages/pathtracer/src", 4),
    ("stages/simd_bvh/src", 5),
    ("stages/simd_paths/src", 19),
    ("stages/viewer/src", 11),
    ("stages/viewer/src", 9),
];

/// The floors of the judge, from the ground: a file imports from its own floor and those below.
const JUDGE_FLOORS: [&str; 3] = ["tools", "tasks", "face"];

/// Which file imports from which, in the crate with the root `root`.
fn imports_of(root: &Path) -> BTreeMap<PathBuf, BTreeSet<PathBuf>> {
    SourceTree::new(root, &|path| std::fs::read_to_string(path).ok()).imports()
}

/// The roots of all libraries and programs of the workspace, and its folder.
fn roots() -> (Vec<PathBuf>, PathBuf) {
    let metadata = MetadataCommand::new()
        .no_deps()
        .other_options(["--offline".to_string()])
        .exec()
        .expect("cargo metadata runs");
    let targets = metadata
        .packages
        .iter()
        .flat_map(|package| &package.targets);
    let of_product = targets.filter(|target| target.is_lib() || target.is_bin());
    let roots = of_product.map(|target| target.src_path.clone().into_std_path_buf());
    (roots.collect(), metadata.workspace_root.into_std_path_buf())
}

/// The circles of more than [`LARGEST_CIRCLE`] files: the folder that has all files of a circle, and
/// the files.
fn large_circles() -> Vec<(String, Vec<PathBuf>)> {
    let (roots, workspace) = roots();
    assert!(roots.len() > 30, "{roots:?}");
    let mut files = 0;
    let mut large = BTreeSet::new();
    for root in roots {
        let imports = imports_of(&root);
        files += imports.len();
        let circles = circles::of(&imports).into_iter();
        large.extend(circles.filter(|circle| circle.len() > LARGEST_CIRCLE));
    }
    assert!(files > 800, "only {files} files were read");
    let inside = |path: &Path| path.strip_prefix(&workspace).unwrap_or(path).to_path_buf();
    let named = large.into_iter().map(|circle| {
        let circle: Vec<PathBuf> = circle.iter().map(|path| inside(path)).collect();
        (common_folder(&circle), circle)
    });
    named.collect()
}

/// The deepest folder that contains all `files`.
fn common_folder(files: &[PathBuf]) -> String {
    let folders = files
        .first()
        .into_iter()
        .flat_map(|file| file.ancestors().skip(1));
    let mut common = folders.filter(|folder| files.iter().all(|file| file.starts_with(folder)));
    common
        .next()
        .map_or(String::new(), |folder| folder.display().to_string())
}

#[test]
fn no_circle_of_imports_has_more_than_three_files() {
    let mut remaining = REMAINING.to_vec();
    let mut too_large = Vec::new();
    for (folder, circle) in large_circles() {
        let is_known = |(known, files): &(&str, usize)| *known == folder && circle.len() <= *files;
        if let Some(known) = remaining.iter().position(is_known) {
            remaining.remove(known);
        } else {
            too_large.push(format!("{folder}, {} files: {circle:#?}", circle.len()));
        }
    }
    assert!(
        too_large.is_empty(),
        "these files import each other in circles; move what they share into a file below them:\n{}",
        too_large.join("\n")
    );
    assert!(
        remaining.is_empty(),
        "these circles are open: remove their lines from REMAINING: {remaining:?}"
    );
}

/// The floor of a file of the judge, and its folder on the floor.
fn judge_floor<'a>(source: &Path, file: &'a Path) -> (usize, Option<&'a str>) {
    let inside = file.strip_prefix(source).expect("a file of the judge");
    let mut parts = inside.iter().filter_map(|part| part.to_str());
    let floor = parts.next();
    let floor = JUDGE_FLOORS.iter().position(|name| Some(*name) == floor);
    // The root of the crate shows what the face has to other crates.
    (floor.unwrap_or(JUDGE_FLOORS.len()), parts.next())
}

#[test]
fn no_floor_of_the_judge_imports_from_one_above() {
    let source = roots().1.join("grader/judge/src");
    let imports = imports_of(&source.join("lib.rs"));
    let mut seen = BTreeSet::new();
    for (from, to) in imports
        .iter()
        .flat_map(|(from, to)| to.iter().map(move |to| (from, to)))
    {
        let ((floor, folder), (below, other)) =
            (judge_floor(&source, from), judge_floor(&source, to));
        seen.insert((floor, below));
        let arrow = format!("{} imports from {}", from.display(), to.display());
        assert!(below <= floor, "upwards: {arrow}");
        let is_task = |folder: Option<&str>| folder.is_some_and(|folder| folder != "mod.rs");
        let between_tasks = floor == 1 && below == 1 && is_task(folder) && folder != other;
        assert!(
            !between_tasks,
            "from task to task: {arrow}; what both need belongs into `tools`"
        );
    }
    assert!(seen.contains(&(2, 1)) && seen.contains(&(1, 0)), "{seen:?}");
}

/// The imports among the files of a small crate.
fn imports_among(files: &[(&str, &str)]) -> Vec<(String, String)> {
    let text = |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, text)| (*text).to_string())
    };
    let imports = SourceTree::new(Path::new("src/lib.rs"), &text).imports();
    let name = |path: &Path| path.display().to_string().replace("src/", "");
    let arrows = imports
        .iter()
        .flat_map(|(from, to)| to.iter().map(move |to| (name(from), name(to))));
    arrows.collect()
}

#[test]
fn an_import_leads_to_the_file_that_defines_the_name() {
    let arrows = imports_among(&[
        (
            "src/lib.rs",
            "mod a;\nmod b;\npub use b::{Deep, deep as low};\nfn f() { a::g(); }",
        ),
        (
            "src/a.rs",
            "use crate::{Deep, low};\nuse std::fmt;\nfn g() { super::b::h(); }",
        ),
        (
            "src/b/mod.rs",
            "mod deep;\npub use deep::*;\npub use deep::Deep;\nmod deeper { use super::super::a; }",
        ),
        (
            "src/b/deep.rs",
            "pub struct Deep;\n#[cfg(test)]\nmod tests { use crate::a; }",
        ),
    ]);
    let arrow = |from: &str, to: &str| (from.to_string(), to.to_string());
    assert_eq!(
        arrows,
        [
            arrow("a.rs", "b/deep.rs"),
            arrow("a.rs", "b/mod.rs"),
            arrow("b/mod.rs", "a.rs"),
            arrow("b/mod.rs", "b/deep.rs"),
            arrow("lib.rs", "a.rs"),
            arrow("lib.rs", "b/deep.rs"),
        ]
    );
}

#[test]
fn files_that_import_each_other_are_a_circle() {
    let imports = |arrows: &[(&str, &str)]| {
        let mut imports: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
        for (from, to) in arrows {
            imports.entry(from.into()).or_default().insert(to.into());
        }
        circles::of(&imports)
    };
    assert_eq!(
        imports(&[("a", "b"), ("b", "c"), ("a", "c")]),
        Vec::<Vec<PathBuf>>::new()
    );
    let circle = imports(&[("a", "b"), ("b", "c"), ("c", "d"), ("d", "b"), ("d", "e")]);
    assert_eq!(circle, [["b", "c", "d"].map(PathBuf::from)]);
}
