//! Every sentence of a contract, the text of a function that students write, and every convention
//! of the course stands in `grader/mutants/contracts.tsv`, with a mistake that negates it and a
//! case that sees it, or with the reason why no case judges it.

use authoring::mutants::table::Table;
use base::Workspace;
use grader::course::Course;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Where a convention comes from.
const CONVENTION: &str = "convention";

/// In the place of a mistake: no case judges the sentence.
const NOT_JUDGED: &str = "-";

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in a workspace")
}

/// The sentences of the conventions and of the text of each function with a hole, each with its
/// function.
fn sentences(workspace: &Workspace, course: &Course) -> Vec<[String; 2]> {
    let conventions = course.conventions.iter();
    let mut all: Vec<[String; 2]> = conventions
        .map(|sentence| [CONVENTION.to_string(), sentence.clone()])
        .collect();
    for task in course.tasks().filter(|task| !task.cases.is_empty()) {
        let files = rust_files(
            &workspace
                .root()
                .join("stages")
                .join(&task.stage)
                .join("src"),
        );
        for hole in &task.holes {
            let mut texts = files.iter().filter_map(|file| text_of(file, hole));
            let text = texts.next().unwrap_or_else(|| panic!("{hole} has no text"));
            let of = |sentence| [hole.clone(), sentence];
            all.extend(sentences_of(&text).into_iter().map(of));
        }
    }
    all
}

fn rust_files(folder: &Path) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).expect("the folder of a stage");
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                files.push(std::fs::read_to_string(&path).expect("a source file"));
            }
        }
    }
    files
}

/// The text above the function, if the file has it.
fn text_of(file: &str, function: &str) -> Option<String> {
    let lines: Vec<&str> = file.lines().collect();
    let starts = ["(", "<"].map(|end| format!("pub fn {function}{end}"));
    let is_start = |line: &&str| starts.iter().any(|start| line.starts_with(start));
    let at = lines.iter().position(is_start)?;
    let is_text = |line: &&&str| line.starts_with("///");
    let above = lines[..at].iter().rev().skip_while(|line| !is_text(line));
    let mut text: Vec<&str> = above.take_while(is_text).copied().collect();
    text.reverse();
    let plain = text
        .iter()
        .map(|line| line[3..].strip_prefix(' ').unwrap_or(&line[3..]));
    Some(plain.collect::<Vec<&str>>().join("\n"))
}

/// The sentences of a text: of its paragraphs and entries of lists, without code and links to the
/// book.
fn sentences_of(text: &str) -> Vec<String> {
    let without_code: Vec<&str> = text.split("```").step_by(2).collect();
    let text = without_code.join("\n").replace("\n- ", "\n\n");
    let paragraphs = text.split("\n\n").map(|paragraph| {
        let words: Vec<&str> = paragraph.split_whitespace().collect();
        words.join(" ")
    });
    let is_contract = |text: &String| {
        !["Chapter:", "See it:"]
            .iter()
            .any(|start| text.starts_with(start))
    };
    let mut all = Vec::new();
    for paragraph in paragraphs.filter(is_contract) {
        let mut sentence = String::new();
        for word in paragraph.split(' ').filter(|word| !word.is_empty()) {
            let begins = word.starts_with(|c: char| c.is_ascii_uppercase() || c == '`' || c == '[');
            if sentence.ends_with('.') && begins {
                all.push(std::mem::take(&mut sentence));
            }
            sentence.push_str(if sentence.is_empty() { "" } else { " " });
            sentence.push_str(word);
        }
        all.extend(Some(sentence).filter(|sentence| !sentence.is_empty()));
    }
    all
}

/// The rows of the table: of which function, sentence, mistake, case.
fn rows(workspace: &Workspace) -> Vec<[String; 4]> {
    let path: PathBuf = workspace.root().join("grader/mutants/contracts.tsv");
    let text = std::fs::read_to_string(path).expect("the table of contracts");
    let rows = text.lines().skip(1).map(|line| {
        let fields: Vec<String> = line.split('\t').map(str::to_string).collect();
        fields
            .try_into()
            .unwrap_or_else(|_| panic!("four fields: {line}"))
    });
    rows.collect()
}

#[test]
fn every_sentence_of_a_contract_has_a_row() {
    let workspace = workspace();
    let course = Course::read(&workspace).expect("the course is valid");
    let rows = rows(&workspace);
    let of_rows: BTreeSet<[&String; 2]> = rows.iter().map(|[of, says, ..]| [of, says]).collect();
    let sentences = sentences(&workspace, &course);
    let of_texts: BTreeSet<[&String; 2]> = sentences.iter().map(|[of, says]| [of, says]).collect();
    let list = |missing: Vec<&[&String; 2]>| {
        let lines = missing
            .iter()
            .map(|[of, says]| format!("{of}\t{says}\tMISTAKE\tCASE"));
        lines.collect::<Vec<String>>().join("\n")
    };
    let missing = list(of_texts.difference(&of_rows).collect());
    assert!(
        missing.is_empty(),
        "grader/mutants/contracts.tsv lacks these rows:\n{missing}"
    );
    let gone = list(of_rows.difference(&of_texts).collect());
    assert!(
        gone.is_empty(),
        "no contract has these sentences of grader/mutants/contracts.tsv:\n{gone}"
    );
    assert!(sentences.len() > 150, "only {} sentences", sentences.len());
}

#[test]
fn each_mistake_loses_points_in_the_case_beside_it() {
    let workspace = workspace();
    let mut tables: BTreeMap<String, Table> = BTreeMap::new();
    let mut wrong = Vec::new();
    let mut judged = 0;
    for [of, says, mistake, case] in rows(&workspace) {
        if mistake == NOT_JUDGED {
            if case.is_empty() {
                wrong.push(format!("{of}, \"{says}\": no reason"));
            }
            continue;
        }
        judged += 1;
        let (task, name) = mistake.split_once('/').unwrap_or_default();
        let table = tables.entry(task.to_string()).or_insert_with(|| {
            Table::read(&workspace, task).unwrap_or_else(|why| panic!("{mistake}: {why}"))
        });
        let made_alone = |version: &str| version.split(" on ").next() == Some(name);
        let mut forms = table
            .mutants
            .iter()
            .filter(|(version, _)| made_alone(version));
        if !forms.any(|(_, cases)| cases.contains(&case)) {
            wrong.push(format!(
                "{of}, \"{says}\": {mistake} loses nothing in {case}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(judged > 150, "only {judged} rows are judged");
}

/// The public functions of a source file whose solution a handout of the task replaces by a hole.
fn functions_with_holes(text: &str, key: &str) -> BTreeSet<String> {
    let of_task = ["hole", "untouched"].map(|name| format!("kit::{name}!(\"{key}\""));
    let mut function = "";
    let mut with_holes = BTreeSet::new();
    for line in text.lines() {
        if let Some((_, after)) = line.split_once("pub fn ") {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            function = &after[..after.find(|c| !is_of_name(c)).unwrap_or(after.len())];
        }
        if line.contains("// STUB:") && of_task.iter().any(|hole| line.contains(hole)) {
            with_holes.insert(function.to_string());
        }
    }
    with_holes
}

#[test]
fn what_a_handout_lets_students_write_is_judged_or_said_not_to_be() {
    let workspace = workspace();
    let course = Course::read(&workspace).expect("the course is valid");
    for task in course.tasks().filter(|task| !task.cases.is_empty()) {
        let folder = workspace.root().join("stages").join(&task.stage);
        let files = rust_files(&folder.join("src"));
        let written: BTreeSet<String> = files
            .iter()
            .flat_map(|file| functions_with_holes(file, &task.key))
            .collect();
        let names = task.holes.iter().chain(&task.not_judged);
        // `Type::function` is a function of a type.
        let listed = names.map(|name| name.rsplit("::").next().unwrap_or(name).to_string());
        assert_eq!(written, listed.collect(), "{}", task.key);
    }
}

#[test]
fn a_text_is_divided_into_sentences() {
    let text = "Adds `a` and `b`.\n\nChapter: x.md\n\n- The sum\n  is exact. `a` may be 1.5.\n- A NaN is a NaN.\n```text\nno\n```\n";
    assert_eq!(
        sentences_of(text),
        [
            "Adds `a` and `b`.",
            "The sum is exact.",
            "`a` may be 1.5.",
            "A NaN is a NaN."
        ]
    );
}
