//! The site: a page for each chapter, one with all of them to print, and what they need.
//!
//! The site is read from a folder, so no page asks for another file but scripts, styles and
//! pictures. The search reads `search.js`, a list of all sections with their text.

use crate::chapter::Chapter;
use crate::page::{self, LARGE_SHEETS, OWN_PICTURES, Page, Place, escaped};
use crate::{maths, paths};
use pulldown_cmark::{Event, Parser, Tag, TagEnd};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// The page around a chapter; words in double braces are replaced.
const TEMPLATE: &str = include_str!("../theme/page.html");

/// The page with all chapters.
const WHOLE_BOOK: &str = "print.html";

/// A chapter in the list of chapters.
#[derive(Debug, PartialEq, Eq)]
struct Entry {
    title: String,
    /// Its Markdown below `src`.
    path: PathBuf,
    /// 1, or 2 for a chapter below another.
    depth: usize,
}

/// Writes the site to the folder `out`. What is in the folder is removed first.
///
/// A published site is read alone: links to files of the project are left out, and pictures that
/// are too large for handouts are in it.
pub fn write(out: &Path, is_published: bool) -> Result<(), String> {
    let out = std::path::absolute(out).map_err(|error| failed("find", out, &error))?;
    let out = paths::normal(&out);
    let to_project = paths::relative(&out, &paths::project());
    let to_project = (!is_published).then_some(to_project.as_str());
    let entries = entries(&Chapter::read(Path::new("SUMMARY.md"))?.text);
    if out.exists() {
        fs::remove_dir_all(&out).map_err(|error| failed("remove", &out, &error))?;
    }
    copy_files(&out, is_published)?;
    let mut search = String::from("window.sections = [\n");
    let mut whole = String::new();
    for (number, entry) in entries.iter().enumerate() {
        let text = Chapter::read(&entry.path)?.text;
        let place = Place {
            at: &entry.path,
            to_project,
            is_whole_book: false,
        };
        let chapter = page::render(&text, place)?;
        for (copy, picture) in &chapter.pictures {
            copy_file(picture, &out.join(copy))?;
        }
        add_to_search(&mut search, entry, &chapter);
        let html = filled(&entries, Some(number), &place, &chapter);
        write_file(&out.join(entry.page()), &html)?;
        if number == 0 {
            write_file(&out.join("index.html"), &html)?;
        }
        let place = Place {
            is_whole_book: true,
            ..place
        };
        let _ = writeln!(
            whole,
            "<section id=\"{}\">\n{}</section>",
            place.id(""),
            page::render(&text, place)?.html
        );
    }
    write_file(&out.join("search.js"), &(search + "];\n"))?;
    let place = Place {
        at: Path::new(WHOLE_BOOK),
        to_project,
        is_whole_book: true,
    };
    let whole = Page {
        html: whole,
        ..Page::default()
    };
    write_file(
        &out.join(WHOLE_BOOK),
        &filled(&entries, None, &place, &whole),
    )
}

impl Entry {
    /// The path of the chapter's page in the site, with slashes.
    fn page(&self) -> String {
        let page = self.path.with_extension("html");
        page.display().to_string().replace('\\', "/")
    }
}

/// The chapters that the text of `SUMMARY.md` lists, in order.
fn entries(summary: &str) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    let mut depth = 0;
    let mut is_title = false;
    for event in Parser::new_ext(summary, maths::options()) {
        match event {
            Event::Start(Tag::List(_)) => depth += 1,
            Event::End(TagEnd::List(_)) => depth -= 1,
            Event::Start(Tag::Link { dest_url, .. }) => {
                is_title = true;
                let (title, path) = (String::new(), PathBuf::from(&*dest_url));
                entries.push(Entry { title, path, depth });
            }
            Event::End(TagEnd::Link) => is_title = false,
            Event::Text(text) | Event::Code(text) if is_title => {
                if let Some(entry) = entries.last_mut() {
                    entry.title.push_str(&text);
                }
            }
            _ => {}
        }
    }
    entries
}

/// The whole page of `chapter`, the entry with the number `current`; `None` for the page with all
/// chapters.
fn filled(entries: &[Entry], current: Option<usize>, place: &Place, chapter: &Page) -> String {
    let to_book = place.to_book();
    let title = current.map_or("All chapters", |number| &entries[number].title);
    let neighbour = |number: Option<usize>, relation: &str, word: &str| {
        let entry = number.and_then(|number| entries.get(number));
        entry.map_or(String::new(), |entry| {
            format!(
                "<a rel=\"{relation}\" href=\"{to_book}{}\"><small>{word}</small> {}</a>",
                entry.page(),
                escaped(&entry.title)
            )
        })
    };
    let previous = current.and_then(|number| number.checked_sub(1));
    let mut scripts = String::new();
    for (mark, script) in [
        ("data-explore=\"", "explore/explore.js"),
        ("data-predict=\"", "predict.js"),
    ] {
        // The page to print shows figures and questions as they are without a script.
        if current.is_some() && chapter.html.contains(mark) {
            let _ = write!(
                scripts,
                "\n<script src=\"{to_book}{script}\" defer></script>"
            );
        }
    }
    let mut html = TEMPLATE.to_string();
    for (word, value) in [
        ("title", escaped(title)),
        ("scripts", scripts),
        ("chapters", list(entries, current, &to_book, chapter)),
        ("previous", neighbour(previous, "prev", "Previous")),
        (
            "next",
            neighbour(current.map(|number| number + 1), "next", "Next"),
        ),
        ("to-book", to_book.clone()),
        // Last: a chapter may contain double braces.
        ("chapter", chapter.html.clone()),
    ] {
        html = html.replace(&format!("{{{{{word}}}}}"), &value);
    }
    html
}

/// The list of chapters. Below the current one are its sections.
fn list(entries: &[Entry], current: Option<usize>, to_book: &str, chapter: &Page) -> String {
    let mut html = String::new();
    let mut depth = 0;
    for (number, entry) in entries.iter().enumerate() {
        html += &"<ul>".repeat(entry.depth.saturating_sub(depth));
        html += &"</ul>".repeat(depth.saturating_sub(entry.depth));
        depth = entry.depth;
        let (page, title) = (entry.page(), escaped(&entry.title));
        if current != Some(number) {
            let _ = writeln!(html, "<li><a href=\"{to_book}{page}\">{title}</a>");
            continue;
        }
        let _ = writeln!(
            html,
            "<li><a href=\"{to_book}{page}\" aria-current=\"page\">{title}</a><ul class=\"sections\">"
        );
        for section in chapter.sections.iter().filter(|section| section.level == 2) {
            let title = escaped(&section.title);
            let _ = writeln!(html, "<li><a href=\"#{}\">{title}</a>", section.id);
        }
        html += "</ul>";
    }
    html + &"</ul>".repeat(depth)
}

/// Adds a line for each section: address, chapter, heading, text.
fn add_to_search(search: &mut String, entry: &Entry, chapter: &Page) {
    for section in &chapter.sections {
        let address = match section.level {
            1 => entry.page(),
            _ => format!("{}#{}", entry.page(), section.id),
        };
        let parts = [&address, &entry.title, &section.title, &section.text];
        let parts = parts.map(|part| string(part));
        let _ = writeln!(search, "[{}],", parts.join(","));
    }
}

/// `text` as a string of a script, with one blank for each run of blanks.
fn string(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ").replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{text}\"")
}

/// Copies what is no chapter: figures, scripts, styles, pictures.
fn copy_files(out: &Path, is_published: bool) -> Result<(), String> {
    let unused: &[&str] = match is_published {
        true => &["mistakes"],
        false => &[OWN_PICTURES, LARGE_SHEETS],
    };
    let source = crate::folder().join("src");
    for file in files_below(&source)? {
        let path = file.strip_prefix(&source).unwrap_or(&file);
        let is_text = path
            .extension()
            .is_some_and(|ending| ending == "md" || ending == "toml");
        if !is_text && !unused.iter().any(|folder| path.starts_with(folder)) {
            copy_file(&file, &out.join(path))?;
        }
    }
    for name in ["book.css", "book.js"] {
        copy_file(&crate::folder().join("theme").join(name), &out.join(name))?;
    }
    Ok(())
}

fn files_below(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let entries = fs::read_dir(folder).map_err(|e| failed("read", folder, &e))?;
    for entry in entries {
        let path = entry.map_err(|e| failed("read", folder, &e))?.path();
        match path.is_dir() {
            true => files.extend(files_below(&path)?),
            false => files.push(path),
        }
    }
    Ok(files)
}

fn copy_file(from: &Path, to: &Path) -> Result<(), String> {
    let bytes = fs::read(from).map_err(|error| failed("read", from, &error))?;
    write_file(to, &bytes)
}

/// Writes a file and the folder that it is in.
fn write_file(file: &Path, contents: &(impl AsRef<[u8]> + ?Sized)) -> Result<(), String> {
    let folder = file.parent().unwrap_or(file);
    fs::create_dir_all(folder).map_err(|error| failed("create", folder, &error))?;
    fs::write(file, contents).map_err(|error| failed("write", file, &error))
}

fn failed(what: &str, path: &Path, error: &std::io::Error) -> String {
    format!("cannot {what} {}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The text of an attribute of all elements of `html`.
    fn attributes<'a>(html: &'a str, name: &str) -> Vec<&'a str> {
        let pieces = html.split(name).skip(1);
        pieces.filter_map(|piece| piece.split('"').next()).collect()
    }

    #[test]
    fn the_list_of_chapters_has_depths() {
        let found = entries(
            "# S\n\n- [A `b`](a.md)\n- [P](part1/README.md)\n  - [T](part1/task1.md)\n- [Z](z.md)\n",
        );
        let expected = [
            ("A b", "a.html", 1),
            ("P", "part1/README.html", 1),
            ("T", "part1/task1.html", 2),
            ("Z", "z.html", 1),
        ];
        let found: Vec<_> = found
            .iter()
            .map(|e| (e.title.as_str(), e.page(), e.depth))
            .collect();
        assert_eq!(
            found,
            expected.map(|(title, page, depth)| (title, page.to_string(), depth))
        );
    }

    #[test]
    fn strings_of_the_search_are_escaped() {
        assert_eq!(string("a\n \"b\"\t\\c"), r#""a \"b\" \\c""#);
    }

    /// The whole book, as a handout has it and as it is published.
    #[test]
    fn links_of_all_pages_resolve_anchors_are_unique_and_the_search_has_all_text() {
        for is_published in [false, true] {
            let folder = tempfile::tempdir().expect("a temporary folder");
            let site = folder.path().join("site");
            fs::create_dir_all(site.join("old")).expect("a folder");
            write(&site, is_published).expect("the book can be rendered");
            assert!(!site.join("old").exists());
            let site = fs::canonicalize(site).expect("the folder");
            let files = files_below(&site).expect("files");
            let pages: Vec<_> = files
                .iter()
                .filter(|file| file.extension().is_some_and(|e| e == "html"))
                .collect();
            assert!(pages.len() > 30, "{} pages", pages.len());
            let mut wrong = Vec::new();
            let text = |file: &Path| fs::read_to_string(file).expect("a page");
            let ids: std::collections::BTreeMap<_, _> = pages
                .iter()
                .map(|page| {
                    let text = text(page);
                    let all = attributes(&text, " id=\"")
                        .into_iter()
                        .map(str::to_string)
                        .collect::<Vec<_>>();
                    let unique: BTreeSet<String> = all.iter().cloned().collect();
                    if unique.len() < all.len() || text.contains("{{") {
                        wrong.push(format!(
                            "{}: an anchor twice, or a word in braces",
                            page.display()
                        ));
                    }
                    (page.to_path_buf(), unique)
                })
                .collect();
            for page in &pages {
                let html = text(page);
                for link in attributes(&html, " href=\"")
                    .into_iter()
                    .chain(attributes(&html, " src=\""))
                {
                    if link.contains("://") || link.starts_with("data:") {
                        continue;
                    }
                    let (path, fragment) = link.split_once('#').unwrap_or((link, ""));
                    let target = match path {
                        "" => page.to_path_buf(),
                        path => paths::normal(&page.parent().expect("a folder").join(path)),
                    };
                    let is_inside = target.starts_with(&site);
                    if !target.exists()
                        || is_published && !is_inside
                        || is_inside && !fragment.is_empty() && !ids[&target].contains(fragment)
                    {
                        wrong.push(format!("{}: {link}", page.display()));
                    }
                }
            }
            assert_eq!(wrong, [""; 0]);
            let search = text(&site.join("search.js"));
            let line = search.lines().find(|line| {
                line.contains("intersecting-triangles")
                    || line.contains("part1/task3.html#where-the-formulas-break")
            });
            assert!(
                line.is_some_and(|line| line.contains("watertight")),
                "{line:?}"
            );
        }
    }
}
