//! What grows has a ceiling: the code of each crate, the lists of mistakes, the documents.
//!
//! `sizes.tsv` has the ceilings, in lines of code: without blank lines and comments. A ceiling is
//! lowered when code goes, and raised for a reason that stands beside it.

use crate::modules::tokens::{self, Token};
use crate::student_loop::root;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The table of ceilings, below the root of the workspace.
const TABLE: &str = "grader/tests/sizes.tsv";

/// The environment variable with the reason why a ceiling is raised; the table is then written.
const REASON: &str = "SIZES_REASON";

/// A ceiling that is higher than what there is by more than this many lines has to be lowered.
const SLACK: usize = 100;

/// Rows of the table that are no crate: all Rust code, and lists of mistakes, as lines of text.
const ALL: &str = "all";
const MISTAKES: &str = "grader/mutants/part*.txt";
const OTHER_LISTS: &str = "grader/mutants, other lists";

/// The most lines of one task's list of mistakes.
const MOST_LINES: usize = 1_150;

/// The most bytes of a document in the root: it is read from beginning to end.
const DOCUMENTS: [(&str, usize); 3] = [
    ("README.md", 12_500),
    ("ARCHITECTURE.md", 20_000),
    ("CONTRIBUTING.md", 14_000),
];

/// Lines of product code and of tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Lines {
    product: usize,
    tests: usize,
}

impl Lines {
    fn add(&mut self, other: Lines) {
        self.product += other.product;
        self.tests += other.tests;
    }
}

/// The files that git has or would add; none in an archive of the course, which has no repository,
/// and where git refuses a repository of somebody else.
pub(crate) fn files_of_git() -> BTreeSet<PathBuf> {
    let output = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output();
    let stdout = output.map(|output| output.stdout).unwrap_or_default();
    let paths = String::from_utf8(stdout).expect("paths are text");
    paths.lines().map(PathBuf::from).collect()
}

/// The files that git has or would add, and that end in one of `endings`. Where git lists none, of
/// all files but those that are built.
pub(crate) fn files(endings: &[&str]) -> Vec<PathBuf> {
    let mut all = files_of_git();
    if all.is_empty() {
        add_files(Path::new(""), &mut all);
    }
    let wanted = |path: &PathBuf| {
        let path = path.to_string_lossy();
        endings.iter().any(|end| path.ends_with(end))
    };
    // What is removed and not yet committed is listed, too.
    all.retain(|path| wanted(path) && root().join(path).is_file());
    all.into_iter().collect()
}

/// Adds the files in `folder` of the course and below.
fn add_files(folder: &Path, files: &mut BTreeSet<PathBuf>) {
    for entry in fs::read_dir(root().join(folder)).expect("a folder") {
        let entry = entry.expect("an entry");
        let path = folder.join(entry.file_name());
        match entry.file_type().expect("a file") {
            kind if !kind.is_dir() => drop(files.insert(path)),
            _ if path == Path::new("target") || path == Path::new(".git") => {}
            _ => add_files(&path, files),
        }
    }
}

pub(crate) fn read(path: &Path) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The lines of code of a file, and the modules that it declares for tests only.
fn lines_of(text: &str) -> (Lines, Vec<String>) {
    let (tokens, places) = tokens::all(text);
    let items = tokens::items_of_tests(&tokens);
    let mut lines = Lines::default();
    let (mut counted, mut next) = ([0; 2], 0);
    for (at, place) in places.iter().enumerate() {
        next += usize::from(items.get(next).is_some_and(|item| item.end <= at));
        let tests = items.get(next).is_some_and(|item| item.contains(&at));
        let first = counted[usize::from(tests)].max(*place.start());
        let new = (place.end() + 1).saturating_sub(first);
        let sum = if tests {
            &mut lines.tests
        } else {
            &mut lines.product
        };
        *sum += new;
        counted[usize::from(tests)] = first + new;
    }
    let modules = items.iter().filter_map(|item| match &tokens[item.clone()] {
        [.., Token::Name(word), Token::Name(name), Token::Mark(';')] if word == "mod" => {
            Some(name.clone())
        }
        _ => None,
    });
    (lines, modules.collect())
}

/// The file or the folder of the module `name` that `file` declares, without an ending.
fn place(file: &Path, name: &str) -> PathBuf {
    let is_root = ["mod.rs", "lib.rs", "main.rs"]
        .iter()
        .any(|it| file.ends_with(it));
    let folder = file.parent().unwrap_or(Path::new(""));
    match file.file_stem() {
        Some(stem) if !is_root => folder.join(stem).join(name),
        _ => folder.join(name),
    }
}

/// The lines of each crate, and of the other rows of the table.
fn counted() -> BTreeMap<String, Lines> {
    let manifests = files(&["Cargo.toml"]);
    let is_crate = |path: &&PathBuf| read(path).contains("[package]");
    let mut crates: Vec<&Path> = manifests
        .iter()
        .filter(is_crate)
        .filter_map(|path| path.parent())
        .collect();
    // Those in others come first. The versions of stages that are graded as mistakes are no crate.
    crates.push(Path::new("grader/mutants"));
    crates.sort_by_key(|folder| std::cmp::Reverse(folder.components().count()));

    let sources = files(&[".rs"]);
    let counts: Vec<(&PathBuf, (Lines, Vec<String>))> = sources
        .iter()
        .map(|file| (file, lines_of(&read(file))))
        .collect();
    let of_tests: BTreeSet<PathBuf> = counts
        .iter()
        .flat_map(|(file, (_, modules))| modules.iter().map(|name| place(file, name)))
        .collect();
    let mut rows: BTreeMap<String, Lines> = BTreeMap::new();
    let mut sum = Lines::default();
    for (file, (lines, _)) in counts {
        let mut owners = crates.iter().filter(|folder| file.starts_with(folder));
        let owner = owners
            .next()
            .unwrap_or_else(|| panic!("{} is in no crate", file.display()));
        let inside = file.strip_prefix(owner).expect("its folder");
        let is_test = ["tests", "benches"].iter().any(|it| inside.starts_with(it))
            || file
                .with_extension("")
                .ancestors()
                .any(|it| of_tests.contains(it));
        let all = lines.product + lines.tests;
        let lines = if is_test {
            Lines {
                product: 0,
                tests: all,
            }
        } else {
            lines
        };
        rows.entry(owner.display().to_string())
            .or_default()
            .add(lines);
        sum.add(lines);
    }
    rows.insert(ALL.into(), sum);
    for list in files(&[".txt", ".toml"]) {
        let name = list.to_string_lossy();
        let Some(inside) = name.strip_prefix("grader/mutants/") else {
            continue;
        };
        let is_of_a_task = inside.starts_with("part") && inside.ends_with(".txt");
        let row = if is_of_a_task { MISTAKES } else { OTHER_LISTS };
        let product = read(&list).lines().count();
        let lines = Lines { product, tests: 0 };
        rows.entry(row.into()).or_default().add(lines);
    }
    rows
}

/// A row of the table: the ceilings, and why they were raised last.
type Ceiling = (Lines, String);

fn ceilings() -> BTreeMap<String, Ceiling> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('\t').collect();
        let number = |at: usize| {
            let cell: &&str = cells
                .get(at)
                .unwrap_or_else(|| panic!("too few columns: {line}"));
            cell.parse()
                .unwrap_or_else(|e| panic!("{TABLE}: {line}: {e}"))
        };
        let lines = Lines {
            product: number(1),
            tests: number(2),
        };
        let reason = cells.get(3).copied().unwrap_or_default();
        (cells[0].to_string(), (lines, reason.to_string()))
    };
    let table = read(Path::new(TABLE));
    let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(row).collect()
}

/// The table with the lines of today; `reason` stands beside what is raised.
fn table(today: &BTreeMap<String, Lines>, old: &BTreeMap<String, Ceiling>, reason: &str) -> String {
    let mut text = format!(
        "# Ceilings of code lines: no blank line, no comment. This writes today's lines:\n\
         # {REASON}=\"why more is needed\" cargo test -p grader --test tests sizes\n\
         folder\tproduct\ttests\twhy it was raised\n"
    );
    for (row, lines) in today {
        let (ceiling, because) = old.get(row).cloned().unwrap_or_default();
        let raised = lines.product > ceiling.product || lines.tests > ceiling.tests;
        let because = if raised { reason } else { &because };
        let _ = writeln!(text, "{row}\t{}\t{}\t{because}", lines.product, lines.tests);
    }
    text
}

/// What is wrong with the ceilings of one kind of lines.
fn complaint(row: &str, kind: &str, lines: usize, ceiling: usize) -> Option<String> {
    let ends = if lines > ceiling {
        format!("and may have {ceiling}: take away as much, or raise the ceiling for a reason")
    } else if lines + SLACK < ceiling && row != ALL {
        format!("and could have {ceiling}: lower the ceiling")
    } else {
        return None;
    };
    Some(format!("{row} has {lines} lines of {kind}, {ends}"))
}

#[test]
fn code_does_not_outgrow_its_ceilings() {
    let (today, old) = (counted(), ceilings());
    let (all, judge) = (today[ALL], today["grader/judge"]);
    assert!(
        judge.product > judge.tests && judge.tests > 500,
        "{judge:?}"
    );
    println!(
        "{} lines of product code and {} of tests",
        all.product, all.tests
    );
    if let Ok(reason) = std::env::var(REASON) {
        let file = root().join(TABLE);
        fs::write(file, table(&today, &old, &reason)).expect("the table can be written");
        return;
    }
    let folders = |rows: Vec<&String>| rows.into_iter().cloned().collect::<BTreeSet<_>>();
    let (have, had) = (
        folders(today.keys().collect()),
        folders(old.keys().collect()),
    );
    let mut wrong: Vec<String> = have
        .symmetric_difference(&had)
        .map(|row| format!("{row} is a row of the table or a folder, and not both"))
        .collect();
    for (row, lines) in &today {
        let Some((ceiling, _)) = old.get(row) else {
            continue;
        };
        wrong.extend(complaint(
            row,
            "product code",
            lines.product,
            ceiling.product,
        ));
        wrong.extend(complaint(row, "tests", lines.tests, ceiling.tests));
    }
    assert!(
        wrong.is_empty(),
        "{TABLE}, which {REASON}=\"why more is needed\" cargo test -p grader --test tests sizes \
         writes:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn lines_of_code_are_counted() {
    let text = "//! Docs.\n\nuse a::b; // why\n/* x\n\n y */\nfn f() {\n    let s = \"// no comment\n    two\";\n}\n\n\
                #[cfg(test)]\nmod far;\n#[cfg(all(test, unix))]\nmod tests {\n    // why\n    use c;\n}\nfn g() {}\n";
    let (lines, modules) = lines_of(text);
    assert_eq!((lines.product, lines.tests), (6, 6));
    assert_eq!(modules, ["far"]);
    assert_eq!(place(Path::new("src/a.rs"), "b"), Path::new("src/a/b"));
    assert_eq!(place(Path::new("src/a/mod.rs"), "b"), Path::new("src/a/b"));
}

#[test]
fn a_ceiling_is_raised_with_a_reason_only() {
    let lines = |product, tests| Lines { product, tests };
    assert_eq!(complaint("a", "tests", 7, 7), None);
    assert_eq!(complaint("a", "tests", 7, 7 + SLACK), None);
    assert!(complaint("a", "tests", 8, 7).is_some());
    assert!(complaint("a", "tests", 7, 8 + SLACK).is_some());
    let today = [("a", lines(8, 1)), ("b", lines(1, 1))].map(|(row, it)| (row.to_string(), it));
    let old = [("a", 7), ("b", 2)].map(|(row, it)| (row.into(), (lines(it, 1), "old".into())));
    let text = table(&today.into(), &old.into(), "new");
    assert!(text.ends_with("a\t8\t1\tnew\nb\t1\t1\told\n"), "{text}");
}

/// A mistake that is another form of a known one is nested under it; a slip that `grader mutants
/// --families` makes by itself needs no entry.
#[test]
fn lists_of_mistakes_stay_short() {
    for list in files(&[".txt"])
        .iter()
        .filter(|list| list.starts_with("grader/mutants"))
    {
        let lines = read(list).lines().count();
        assert!(
            lines <= MOST_LINES,
            "{} has {lines} lines, more than {MOST_LINES}: nest forms, merge what has one hint",
            list.display()
        );
    }
}

/// Whoever adds to one of these moves something else to where it is needed: into a chapter of the
/// book, or beside the code.
#[test]
fn documents_stay_short() {
    for (name, most) in DOCUMENTS {
        let bytes = read(Path::new(name)).len();
        assert!(
            bytes <= most,
            "{name} has {bytes} bytes, and may have {most}"
        );
    }
}
