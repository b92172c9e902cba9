//! The chapters say what the course says: titles, points, functions, signatures, conventions,
//! mistakes. What a handout does not contain (the mistakes) is not compared there.

use authoring::mutants::corpus::Corpus;
use authoring::mutants::table::Table;
use base::Workspace;
use book::chapter::{self, Chapter};
use book::paths;
use grader::course::chapter::{self as place, Section};
use grader::course::{Course, Task};
use judge::Tier;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The sections of a task's chapter, in order.
const SECTIONS: [&str; 11] = [
    "What you will see",
    "Predict",
    "The figure",
    "The derivation",
    "The contract",
    "Pseudo-code",
    "A worked example",
    "Checkpoint",
    "Mistakes",
    "Where the formulas break",
    "Exercises and reading",
];

fn workspace() -> Workspace {
    Workspace::above(book::folder()).expect("the book is in the project")
}

fn course() -> Course {
    Course::read(&workspace()).expect("course.toml can be read")
}

/// The path of the chapter of a task below `src`: `part1/task3.md` for `part1.task3`.
fn path_of(task: &Task) -> PathBuf {
    Path::new(&task.key.replace('.', "/")).with_extension("md")
}

/// All tasks with their chapters.
fn chapters() -> Vec<(Task, Chapter)> {
    let tasks: Vec<Task> = course().tasks().cloned().collect();
    let read = |task: Task| {
        let chapter = Chapter::read(&path_of(&task)).expect("each task has a chapter");
        (task, chapter)
    };
    tasks.into_iter().map(read).collect()
}

/// The source of the function `name` of `task`: its file and text.
fn source_of(task: &Task, name: &str) -> (PathBuf, String) {
    let folder = workspace()
        .root()
        .join("stages")
        .join(&task.stage)
        .join("src");
    let files = fs::read_dir(&folder).expect("the stage has sources");
    for file in files {
        let path = file.expect("the folder can be read").path();
        let Ok(text) = fs::read_to_string(&path) else {
            continue;
        };
        if text.contains(&format!("pub fn {name}(")) || text.contains(&format!("pub fn {name}<")) {
            return (path, text);
        }
    }
    panic!("no file of {} defines {name}", folder.display());
}

#[test]
fn the_summary_lists_the_chapter_of_each_part_and_task_with_its_title() {
    let listed: BTreeMap<PathBuf, String> = chapter::all()
        .expect("all chapters of the summary can be read")
        .into_iter()
        .map(|chapter| (chapter.path, chapter.title))
        .collect();
    for part in &course().parts {
        let n = part.number;
        let path = PathBuf::from(format!("part{n}/README.md"));
        assert_eq!(
            listed.get(&path),
            Some(&format!("Part {n}: {}", part.title))
        );
        for (i, task) in part.tasks.iter().enumerate() {
            let title = format!("Part {n}, Task {}: {}", i + 1, task.title);
            assert_eq!(listed.get(&path_of(task)), Some(&title));
        }
    }
    for path in ["", "part1", "part2", "part3", "part4", "part5", "part6"]
        .into_iter()
        .flat_map(markdown_in)
    {
        let is_listed = path == Path::new("SUMMARY.md") || listed.contains_key(&path);
        assert!(is_listed, "SUMMARY.md does not list {}", path.display());
    }
}

/// The Markdown files in a folder of `src`.
fn markdown_in(folder: &str) -> Vec<PathBuf> {
    let files = fs::read_dir(book::folder().join("src").join(folder)).expect("a folder");
    files
        .map(|file| Path::new(folder).join(file.expect("a file").file_name()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect()
}

#[test]
fn every_task_chapter_has_all_sections_in_order() {
    for (task, chapter) in chapters() {
        let titles: Vec<&str> = chapter.sections.iter().map(|s| s.title.as_str()).collect();
        assert_eq!(titles, SECTIONS, "{}", task.key);
        let predict = &chapter.section("Predict").expect("checked above").text;
        assert!(
            predict.contains("<details>") && predict.contains("\n2. "),
            "{}: expected two questions with folded answers",
            task.key
        );
    }
}

#[test]
fn functions_files_and_points_are_those_of_the_course() {
    for (task, chapter) in chapters() {
        let mut links = BTreeSet::new();
        for hole in &task.holes {
            let (path, _) = source_of(&task, hole);
            let name = path
                .file_name()
                .expect("a file")
                .to_string_lossy()
                .into_owned();
            links.insert(format!("[`{name}`](../../../{}/src/{name})", task.stage));
        }
        let functions: Vec<String> = task.holes.iter().map(|hole| format!("`{hole}`")).collect();
        let row = format!(
            "| {} | {} | {} | {} |",
            functions.join(", "),
            links.into_iter().collect::<Vec<_>>().join(", "),
            task.points(Tier::Core),
            task.points(Tier::Robust)
        );
        assert!(
            chapter.text.lines().any(|line| line == row),
            "{}: expected the row\n{row}",
            task.key
        );
        let checkpoint = &chapter.section("Checkpoint").expect("a section").text;
        for expected in [
            format!("cargo grader {}", task.key),
            format!("cargo grader picture {}", task.key),
            format!("{} core points", task.points(Tier::Core)),
        ] {
            assert!(checkpoint.contains(&expected), "{}: {expected}", task.key);
        }
    }
}

/// A signature without what formatting changes.
fn compact(signature: &str) -> String {
    let dense: String = signature.split_whitespace().collect();
    dense.replace(",)", ")")
}

#[test]
fn signatures_are_those_of_the_sources() {
    for (task, chapter) in chapters() {
        let contract = Chapter::parse(
            &chapter.path,
            chapter
                .section("The contract")
                .expect("a section")
                .text
                .clone(),
        );
        let shown = contract
            .code
            .iter()
            .find(|code| code.language == "rust,ignore");
        let shown = compact(&shown.expect("the contract shows the signatures").text);
        let mut expected = String::new();
        for hole in &task.holes {
            let (_, source) = source_of(&task, hole);
            let start = [format!("pub fn {hole}("), format!("pub fn {hole}<")]
                .iter()
                .find_map(|start| source.find(start.as_str()))
                .expect("source_of has found it");
            let signature = source[start..]
                .split(" {\n")
                .next()
                .expect("a body follows");
            expected.push_str(&compact(signature));
        }
        assert_eq!(shown, expected, "{}", task.key);
    }
}

#[test]
fn quoted_conventions_are_those_of_the_course_and_none_is_missing() {
    let conventions: BTreeSet<String> = course().conventions.into_iter().collect();
    let mut quoted = BTreeSet::new();
    for (task, chapter) in chapters() {
        let contract = &chapter.section("The contract").expect("a section").text;
        for quote in contract.lines().filter_map(|line| line.strip_prefix("> ")) {
            assert!(conventions.contains(quote), "{}: {quote}", task.key);
            quoted.insert(quote.to_string());
        }
    }
    assert_eq!(quoted, conventions);
}

#[test]
fn general_chapters_agree_with_the_course() {
    let text = |path: &str| Chapter::read(Path::new(path)).expect("the chapter").text;
    let (grading, hosting) = (text("grading.md"), text("hosting.md"));
    for convention in course().conventions {
        assert!(
            grading.contains(&format!("\n- {convention}\n")),
            "{convention}"
        );
    }
    for part in &course().parts {
        let core: f64 = part.tasks.iter().map(|task| task.points(Tier::Core)).sum();
        let cell = format!("| [{0}](part{0}/README.md) | {core} |", part.number);
        assert!(hosting.contains(&cell), "hosting.md has no {cell}");
    }
    assert_eq!(course().tasks().count(), 15);
    assert!(text("introduction.md").contains("There are fifteen tasks"));
}

/// Handouts have another README and no mistakes.
#[test]
fn what_is_said_of_the_full_checkout_is_true_there() {
    let root = workspace().root().to_path_buf();
    if workspace().ensure_full("").is_err() {
        return;
    }
    let mistakes =
        |task: &Task| Corpus::read(&workspace(), task).map(|corpus| corpus.mistakes.len());
    let mistakes = course().tasks().map(mistakes).sum::<Result<usize, _>>();
    let mistakes = mistakes.expect("the lists of mistakes");
    assert!(
        mistakes > 1000,
        "grading.md says more than a thousand, found {mistakes}"
    );
    let readme = fs::read_to_string(root.join("README.md")).expect("the README");
    let grading = Chapter::read(Path::new("grading.md")).expect("the chapter");
    let report = grading
        .code
        .iter()
        .find(|code| code.text.contains("$ cargo grader part1.task3"));
    let report = report.expect("a report, line by line");
    assert!(
        readme.contains(&report.text),
        "the report in grading.md is not that of the README"
    );
    let accuracy = Chapter::read(Path::new("accuracy.md")).expect("the chapter");
    let mut rows = accuracy.text.lines();
    let row = rows.find_map(|line| line.strip_prefix("| Möller-Trumbore, f64 | "));
    let cell = row.and_then(|row| row.split(" | ").nth(1));
    let leaks: f64 = cell
        .expect("the number of leaks")
        .parse()
        .expect("a number");
    let triangles = Chapter::read(Path::new("part1/task3.md"))
        .expect("the chapter")
        .text;
    let sentence = format!("{:.1} % leak", leaks / 1e4);
    let flat: String = triangles.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat.contains(&sentence),
        "part1/task3.md does not say: {sentence}"
    );
}

/// The text of inline code or emphasis: `` `x` `` or `*x*`.
fn marked(cell: &str, mark: char) -> &str {
    cell.strip_prefix(mark)
        .and_then(|cell| cell.strip_suffix(mark))
        .unwrap_or_else(|| panic!("expected {mark}...{mark}, found {cell}"))
}

#[test]
fn mistakes_are_named_as_the_grader_names_them_and_fail_the_cases_shown() {
    for (task, chapter) in chapters() {
        let rows = chapter.section("Mistakes").expect("a section").table_rows();
        assert!(rows.len() >= 4, "{}: too few mistakes", task.key);
        for row in &rows {
            let case = marked(&row[2], '`');
            let is_case = task.cases.iter().any(|entry| entry.name == case);
            assert!(is_case, "{} has no case {case}", task.key);
        }
        if !Corpus::file(&workspace(), &task).is_file() {
            continue;
        }
        let corpus = Corpus::read(&workspace(), &task).expect("the list of mistakes");
        let table = Table::read(&workspace(), &task.key).expect("the mistakes were graded");
        for row in rows {
            let (name, case) = (marked(&row[1], '*'), marked(&row[2], '`'));
            let mistakes = corpus.mistakes.iter();
            let ids: Vec<&str> = mistakes
                .filter(|mistake| mistake.description == name)
                .map(|mistake| mistake.id.as_str())
                .collect();
            assert!(
                !ids.is_empty(),
                "{}: no mistake is called: {name}",
                task.key
            );
            let makes_it =
                |version: &str| ids.contains(&version.split(" on ").next().unwrap_or_default());
            let fails = table
                .mutants
                .iter()
                .any(|(version, failed)| makes_it(version) && failed.iter().any(|of| of == case));
            assert!(fails, "{}: \"{name}\" does not fail {case}", task.key);
        }
    }
}

/// The pictures are rendered by `grader mutants all --pictures`; handouts do not have the list.
#[test]
fn pictures_of_mistakes_are_shown_and_named() {
    let root = workspace().root().to_path_buf();
    let Ok(list) = fs::read_to_string(root.join("grader/mutants/pictures.toml")) else {
        return;
    };
    let list: toml::Table = list.parse().expect("the list of pictures is TOML");
    let sheets = list["sheet"].as_array().expect("a list");
    let mut shown = BTreeSet::new();
    for (task, chapter) in chapters() {
        let sheet = sheets
            .iter()
            .find(|s| s["task"].as_str() == Some(&task.key));
        let sheet = sheet.unwrap_or_else(|| panic!("{}: no picture of mistakes", task.key));
        let names = sheet["mutants"].as_array().expect("a list").iter();
        let descriptions: Vec<String> = names
            .map(|name| {
                let name = name.as_str().expect("a name");
                let id = name.split(" on ").next().unwrap_or(name);
                format!("*{}*", description(&task, id))
            })
            .collect();
        let section = &chapter.section("Mistakes").expect("a section").text;
        let flat: String = section.split_whitespace().collect::<Vec<_>>().join(" ");
        let file = format!("{}.png", task.key.replace('.', "-"));
        let expected = format!(
            "](../mistakes/{file}) From the left: the right picture, then the pictures of code that {}.",
            descriptions.join("; ")
        );
        assert!(flat.contains(&expected), "{}: {expected}", task.key);
        shown.insert(file);
    }
    let files = fs::read_dir(book::folder().join("src/mistakes")).expect("the pictures");
    let name = |file: std::io::Result<fs::DirEntry>| file.expect("a file").file_name();
    let files: BTreeSet<String> = files
        .map(|file| name(file).to_string_lossy().into_owned())
        .collect();
    assert_eq!(files, shown);
}

/// What the grader says about the mistake `id` of a task.
fn description(task: &Task, id: &str) -> String {
    let corpus = Corpus::read(&workspace(), task).expect("the list of mistakes");
    let found = corpus
        .mistake(id)
        .unwrap_or_else(|| panic!("{}: there is no mistake {id}", task.key));
    found.description.clone()
}

/// The hints of the grader end with such links.
#[test]
fn the_sections_that_the_grader_links_to_exist() {
    for (task, chapter) in chapters() {
        for section in Section::ALL {
            let link = place::section(&task.key, section).expect("the key names part and task");
            let (path, anchor) = link.split_once('#').expect("a section");
            let below = Path::new("stages/book/src").join(&chapter.path);
            assert_eq!(Path::new(path), below);
            let mut titles = chapter.sections.iter().map(|section| &section.title);
            assert!(
                titles.any(|title| paths::anchor(title) == anchor),
                "{link} names no section"
            );
        }
    }
}

#[test]
fn doc_comments_name_their_chapter() {
    for (task, chapter) in chapters() {
        let line = format!("/// Chapter: stages/book/src/{}", chapter.path.display());
        for hole in &task.holes {
            let (path, source) = source_of(&task, hole);
            let comment = source
                .split("pub fn ")
                .zip(source.split("pub fn ").skip(1))
                .filter(|(_, after)| {
                    after.starts_with(&format!("{hole}(")) || after.starts_with(&format!("{hole}<"))
                })
                .map(|(before, _)| before.rsplit("\n}\n").next().unwrap_or(before))
                .next()
                .expect("source_of has found it");
            assert!(
                comment.lines().any(|found| found == line),
                "{}: the comment of {hole} has no line\n{line}",
                path.display()
            );
        }
    }
}
