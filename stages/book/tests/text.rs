//! The text is consistent in itself: links, figures, formulas, symbols, code blocks.

use book::chapter::{self, Chapter, Section};
use book::{figures, maths, paths};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn chapters() -> Vec<Chapter> {
    chapter::all().expect("all chapters of the summary can be read")
}

#[test]
fn figures_are_drawn_by_the_code_and_each_is_shown() {
    let shown: BTreeSet<String> = chapters()
        .iter()
        .flat_map(|chapter| &chapter.links)
        .filter_map(|link| {
            Some(
                link.split_once("figures/")?
                    .1
                    .strip_suffix(".svg")?
                    .to_string(),
            )
        })
        .collect();
    let mut drawn = BTreeSet::new();
    for (name, svg) in figures::all() {
        let stored = fs::read_to_string(figures::file(name)).unwrap_or_default();
        assert!(
            stored == svg,
            "src/figures/{name}.svg is not what the code draws: run `cargo run -p book -- figures` and look at it"
        );
        assert!(
            drawn.insert(name.to_string()),
            "two figures are called {name}"
        );
    }
    assert_eq!(drawn, shown);
    let files = fs::read_dir(book::folder().join("src/figures")).expect("the figures");
    assert_eq!(files.count(), drawn.len(), "a file that no code draws");
}

/// The chapter of each task can be followed from its first lines.
#[test]
fn chapters_of_tasks_begin_with_a_short_path() {
    const MOST_WORDS: usize = 150;
    let all = chapters();
    let is_of_task = |chapter: &&Chapter| book::paths::task_number(&chapter.path).is_some();
    let of_tasks: Vec<&Chapter> = all.iter().filter(is_of_task).collect();
    assert_eq!(of_tasks.len(), 17);
    for chapter in of_tasks {
        let at = chapter.path.display();
        let lines = chapter
            .text
            .lines()
            .skip_while(|line| !line.starts_with("> **In short**"));
        let lines: Vec<&str> = lines.take_while(|line| line.starts_with('>')).collect();
        let text = lines.join(" ");
        for item in [
            "*In:*",
            "*To do:*",
            "*Out:*",
            "(#the-figure)",
            "(#a-worked-example)",
            "*The trap:*",
        ] {
            assert!(text.contains(item), "{at}: no {item}");
        }
        let words = text
            .split_whitespace()
            .filter(|word| !matches!(*word, ">" | "-"));
        assert!(words.count() <= MOST_WORDS, "{at}");
    }
}

#[test]
fn the_index_of_symbols_is_that_of_the_chapters() {
    let glossary = chapters();
    let glossary = glossary
        .iter()
        .find(|chapter| chapter.path == Path::new(book::symbols::GLOSSARY));
    let text = &glossary.expect("SUMMARY.md lists the glossary").text;
    let expected = book::symbols::glossary().expect("the chapters can be read");
    assert!(
        *text == expected,
        "the index of symbols is old: run `cargo run -p book -- symbols`"
    );
}

#[test]
fn links_lead_somewhere() {
    for chapter in chapters() {
        let file = book::folder().join("src").join(&chapter.path);
        let folder = file.parent().expect("a folder");
        for link in &chapter.links {
            if link.starts_with("https://") {
                continue;
            }
            let (target, fragment) = link.split_once('#').unwrap_or((link, ""));
            let target = if target.is_empty() {
                file.clone()
            } else {
                paths::normal(&folder.join(target))
            };
            let at = chapter.path.display();
            assert!(target.exists(), "{at}: {link} leads nowhere");
            if !fragment.is_empty() {
                let text = fs::read_to_string(&target).expect("a chapter");
                let there = Chapter::parse(Path::new(""), text);
                let found = there
                    .sections
                    .iter()
                    .any(|s| paths::anchor(&s.title) == fragment);
                assert!(found, "{at}: {link} names no section");
            }
        }
    }
}

/// The comments that `code/page.rs` shows on the published site.
#[test]
fn the_pictures_of_the_site_exist_and_each_is_shown() {
    let folder = book::folder().join("src").join(book::page::OWN_PICTURES);
    let mut shown = BTreeSet::new();
    for chapter in chapters() {
        for comment in chapter.text.split("<!-- picture: ").skip(1) {
            let at = chapter.path.display();
            let (file, text) = comment.split_once(" | ").expect("a file and a text");
            assert!(text.contains(" -->"), "{at}: {file}");
            let file = book::folder()
                .join("src")
                .join(&chapter.path)
                .join("..")
                .join(file);
            shown.insert(paths::normal(&file));
        }
    }
    let files: BTreeSet<_> = fs::read_dir(folder)
        .expect("the pictures")
        .map(|file| file.expect("a file").path())
        .collect();
    assert_eq!(files, shown);
}

#[test]
fn formulas_are_latex_and_code_blocks_have_a_language() {
    for chapter in chapters() {
        let at = chapter.path.display();
        for formula in maths::formulas(&chapter.text) {
            let markup = maths::mathml(&formula.latex, formula.display)
                .unwrap_or_else(|error| panic!("{at}: {error}"));
            // XML has no entity for the no-break space.
            let xml = markup.replace("&nbsp;", " ");
            let parsed = roxmltree::Document::parse(&xml);
            let parsed =
                parsed.unwrap_or_else(|e| panic!("{at}: {}: {e}: {markup}", formula.latex));
            for element in parsed.descendants().filter(roxmltree::Node::is_element) {
                let name = element.tag_name().name();
                let expected = maths::CHILDREN.iter().find(|(known, _)| *known == name);
                let children = element
                    .children()
                    .filter(roxmltree::Node::is_element)
                    .count();
                assert!(
                    expected.is_none_or(|(_, expected)| children == *expected),
                    "{at}: {}: <{name}> has {children} children in {markup}",
                    formula.latex
                );
            }
        }
        for code in &chapter.code {
            let known = ["rust", "rust,ignore", "text", "sh", "toml"];
            assert!(
                known.contains(&code.language.as_str()),
                "{at}: unknown language {:?} of\n{}",
                code.language,
                code.text
            );
        }
    }
}

const GREEK: [&str; 26] = [
    "alpha",
    "beta",
    "gamma",
    "delta",
    "epsilon",
    "varepsilon",
    "zeta",
    "eta",
    "theta",
    "kappa",
    "lambda",
    "mu",
    "nu",
    "xi",
    "pi",
    "rho",
    "sigma",
    "tau",
    "phi",
    "varphi",
    "chi",
    "psi",
    "omega",
    "Delta",
    "Omega",
    "Sigma",
];

/// The symbols of a formula: a letter or Greek letter with its index. Not the letters of words
/// (`\text`, `\operatorname`), of an upright `\mathrm{d}`, nor π.
fn symbols(latex: &str) -> Vec<String> {
    let chars: Vec<char> = latex.chars().collect();
    let mut found = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        let mut name = None;
        if chars[i] == '\\' {
            let start = i + 1;
            i = start;
            while i < chars.len() && chars[i].is_ascii_alphabetic() {
                i += 1;
            }
            let command: String = chars[start..i].iter().collect();
            if command.is_empty() {
                i += 1;
            } else if GREEK.contains(&command.as_str()) {
                name = Some(format!("\\{command}")).filter(|name| name != "\\pi");
            } else if ["text", "operatorname", "mathrm", "begin", "end"].contains(&command.as_str())
            {
                group(&chars, &mut i);
            }
        } else if chars[i].is_alphabetic() {
            name = Some(chars[i].to_string());
            i += 1;
        } else {
            i += 1;
        }
        let has_index = chars.get(i) == Some(&'_');
        if has_index {
            i += 1;
            let index = group(&chars, &mut i);
            name = name.map(|name| format!("{name}_{index}"));
        }
        if let Some(mut name) = name {
            while chars.get(i) == Some(&'\'') {
                name.push('\'');
                i += 1;
            }
            found.push(name);
        }
    }
    found
}

/// Reads a group in braces, a command or a single character at `i`, without braces and spaces.
fn group(chars: &[char], i: &mut usize) -> String {
    while chars.get(*i) == Some(&' ') {
        *i += 1;
    }
    let start = *i;
    match chars.get(*i) {
        Some('{') => {
            let mut depth = 0;
            while *i < chars.len() {
                match chars[*i] {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    _ => {}
                }
                *i += 1;
                if depth == 0 {
                    break;
                }
            }
        }
        Some('\\') => {
            *i += 1;
            while *i < chars.len() && chars[*i].is_ascii_alphabetic() {
                *i += 1;
            }
        }
        _ => *i = (*i + 1).min(chars.len()),
    }
    let text = chars[start..*i].iter();
    text.filter(|c| !"{} ".contains(**c)).collect()
}

#[test]
fn symbols_are_found_in_formulas() {
    let found =
        symbols(r"t_{\min} \le \frac{e_1 \cdot d'}{\mathrm{det}} + \sin\theta_i^2 \text{ if } x");
    assert_eq!(found, ["t_\\min", "e_1", "d'", "\\theta_i", "x"]);
}

/// A component such as `d_x` is defined with its vector, and `w_1` and `w_{k-1}` with `w_k`.
fn is_defined(symbol: &str, defined: &BTreeSet<String>) -> bool {
    if let Some((name, index)) = symbol.split_once('_')
        && (index == "k-1" || index.bytes().all(|b| b.is_ascii_digit()))
        && defined.contains(&format!("{name}_k"))
    {
        return true;
    }
    let vector = symbol
        .strip_suffix("_x")
        .or_else(|| symbol.strip_suffix("_y"))
        .or_else(|| symbol.strip_suffix("_z"));
    defined.contains(symbol) || vector.is_some_and(|vector| defined.contains(vector))
}

/// In a chapter with a table of symbols, all symbols are in it, and none is used before it.
#[test]
fn every_symbol_is_defined_before_it_is_used() {
    let mut wrong = Vec::new();
    for chapter in chapters() {
        let Some(figure) = chapter.section("The figure") else {
            continue;
        };
        let at = chapter.path.display();
        let first_cells = figure.table_rows().into_iter().map(|row| row[0].clone());
        let defined: BTreeSet<String> = first_cells
            .flat_map(|cell| maths::formulas(&cell))
            .flat_map(|formula| symbols(&formula.latex))
            .collect();
        assert!(!defined.is_empty(), "{at}: no table of symbols");
        let mut is_before = true;
        for section in &chapter.sections {
            is_before &= section.title != "The figure";
            for symbol in used(section) {
                if is_before || !is_defined(&symbol, &defined) {
                    wrong.push(format!("{at}: {symbol}, used in \"{}\"", section.title));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "not in the chapter's table of symbols, or used before it:\n{}",
        wrong.join("\n")
    );
}

fn used(section: &Section) -> BTreeSet<String> {
    let formulas = section.formulas();
    formulas
        .iter()
        .flat_map(|formula| symbols(&formula.latex))
        .collect()
}

/// Commands name files that exist and commands of this course.
#[test]
fn commands_can_be_run() {
    let root = book::folder().join("../..");
    for chapter in chapters() {
        let at = chapter.path.display();
        for line in chapter
            .code
            .iter()
            .filter(|code| code.language == "sh")
            .flat_map(|code| code.text.lines())
        {
            let command = line.split(" # ").next().unwrap_or_default().trim();
            let known = [
                "cargo grader",
                "cargo run --release -p grader -- start ",
                "cargo run --release -p pathtracer -- -f ",
                "cargo run --release -p viewer -- ",
                "cargo run --release -p book -- site ",
                // In the folder of a term.
                "cargo run --release --manifest-path .first-light/Cargo.toml -p book -- site ",
                "cd ",
                "mkdir ",
            ];
            assert!(
                known.iter().any(|known| command.starts_with(known)),
                "{at}: {command}"
            );
            for scene in command
                .split(' ')
                .filter(|word| word.starts_with("scenes/"))
            {
                assert!(root.join(scene).exists(), "{at}: there is no {scene}");
            }
        }
    }
}

/// A dollar sign that is no formula means that one was not closed.
#[test]
fn no_formula_is_broken() {
    for chapter in chapters() {
        let mut text = chapter.text.clone();
        for formula in maths::formulas(&chapter.text).iter().rev() {
            text.replace_range(formula.range.clone(), "");
        }
        let prose = text.split("```").step_by(2).collect::<String>();
        if let Some(at) = prose.find('$') {
            let line = prose[..at].rsplit('\n').next().unwrap_or_default();
            panic!(
                "{}: a formula is not closed after: {line}",
                chapter.path.display()
            );
        }
    }
}
