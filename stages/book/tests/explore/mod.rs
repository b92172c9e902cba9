//! The explorable figures: their scripts are whole and ask nothing of a server, and they compute
//! the bits of the course's code.

mod inputs;
mod kernels;

use book::chapter;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn scripts() -> PathBuf {
    book::folder().join("src/explore")
}

/// Runs `tests/explore/SCRIPT` with node, which `.ci/nightly` has looked for.
fn run_node(script: &str, arguments: &[&Path]) {
    let script = book::folder().join("tests/explore").join(script);
    let status = Command::new("node")
        .arg(script)
        .args(arguments)
        .status()
        .unwrap_or_else(|error| panic!("cannot run node: {error}"));
    assert!(
        status.success(),
        "node ended with {status}; its output says why"
    );
}

/// The names of the figures that the chapters show, such as `triangle`.
fn shown() -> BTreeSet<String> {
    let chapters = chapter::all().expect("all chapters of the summary can be read");
    let start = "data-explore=\"";
    let names = chapters.iter().flat_map(|chapter| {
        let rest = chapter.text.split(start).skip(1);
        rest.filter_map(|rest| Some(rest.split_once('"')?.0.to_string()))
    });
    names.collect()
}

#[test]
fn each_explorable_figure_has_its_script_and_each_script_is_used() {
    let mut used: BTreeSet<String> = ["explore.js".into(), "explore.css".into()].into();
    for name in shown() {
        let file = format!("{name}.js");
        let script = fs::read_to_string(scripts().join(&file))
            .unwrap_or_else(|error| panic!("a chapter shows {name}, but {file}: {error}"));
        let registers = format!("Explore.figure(\"{name}\", ");
        assert!(
            script.contains(&registers),
            "{file} does not register {name}"
        );
        let (_, needs) = script.split_once("needs: [").expect("a list of parts");
        let (needs, _) = needs.split_once(']').expect("the end of the list");
        let parts = needs.split(',').map(|part| part.trim().trim_matches('"'));
        used.extend(
            parts
                .filter(|part| !part.is_empty())
                .map(|part| format!("{part}.js")),
        );
        used.insert(file);
    }
    let files = fs::read_dir(scripts()).expect("the scripts");
    let found: BTreeSet<String> = files
        .map(|file| {
            file.expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    assert_eq!(
        found, used,
        "files of src/explore, and those that chapters use"
    );
}

/// A static picture and a caption, for readers without script and on paper.
#[test]
fn each_explorable_figure_contains_a_picture_and_a_caption() {
    for chapter in chapter::all().expect("all chapters of the summary can be read") {
        for figure in chapter.text.split("<figure class=\"explore\" ").skip(1) {
            let at = chapter.path.display();
            let (figure, _) = figure
                .split_once("</figure>")
                .expect("the end of the figure");
            assert!(figure.contains("\n\n!["), "{at}: no picture in {figure}");
            assert!(
                figure.contains("<figcaption>"),
                "{at}: no caption in {figure}"
            );
        }
    }
}

/// The pages work from a file, without a server: no module, no request, no address.
#[test]
fn scripts_ask_nothing_of_a_server() {
    for file in fs::read_dir(scripts()).expect("the scripts") {
        let file = file.expect("a file").path();
        let text = fs::read_to_string(&file)
            .expect("it is text")
            .replace("http://www.w3.org/2000/svg", "");
        for forbidden in [
            "://",
            "import ",
            "import(",
            "fetch(",
            "XMLHttpRequest",
            "eval(",
            "@import",
            "url(\"",
        ] {
            assert!(
                !text.contains(forbidden),
                "{} contains {forbidden}",
                file.display()
            );
        }
    }
}

#[test]
#[ignore = "needs node: 100,000 inputs for each kernel of the figures, in Rust and in JavaScript"]
fn the_scripts_compute_the_bits_of_the_kernels() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    kernels::write_all(folder.path());
    run_node("bits.js", &[folder.path()]);
}
