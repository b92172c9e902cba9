//! A chapter as data: its title, sections, links and code blocks.

use crate::maths::{self, Formula};
use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Parser, Tag, TagEnd};
use std::path::{Path, PathBuf};

/// A chapter of the book.
#[derive(Clone, Debug)]
pub struct Chapter {
    /// Its path below `src`, such as `part1/task3.md`.
    pub path: PathBuf,
    /// Its Markdown.
    pub text: String,
    /// Its heading of the first level.
    pub title: String,
    /// What is below each heading of the second level, in order.
    pub sections: Vec<Section>,
    /// The targets of its links and images, in order.
    pub links: Vec<String>,
    /// Its fenced code blocks, in order.
    pub code: Vec<CodeBlock>,
}

/// The part of a chapter below one heading of the second level.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// The Markdown below the heading.
    pub text: String,
}

/// A fenced code block.
#[derive(Clone, Debug)]
pub struct CodeBlock {
    /// What follows the fence, such as `rust`.
    pub language: String,
    /// The code.
    pub text: String,
}

impl Chapter {
    /// Reads the chapter `path`, which is relative to `src`.
    pub fn read(path: &Path) -> Result<Chapter, String> {
        let file = crate::folder().join("src").join(path);
        let text = std::fs::read_to_string(&file)
            .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        Ok(Chapter::parse(path, text))
    }

    /// Parses the Markdown of a chapter.
    pub fn parse(path: &Path, text: String) -> Chapter {
        let mut chapter = Chapter {
            path: path.to_path_buf(),
            title: String::new(),
            sections: Vec::new(),
            links: Vec::new(),
            code: Vec::new(),
            text: String::new(),
        };
        let mut heading: Option<(HeadingLevel, String)> = None;
        let mut code: Option<CodeBlock> = None;
        let mut section_start = None;
        for (event, range) in Parser::new_ext(&text, maths::options()).into_offset_iter() {
            match event {
                Event::Start(Tag::Heading { level, .. }) => {
                    if level == HeadingLevel::H2 {
                        close_section(&mut chapter, &text, section_start.take(), range.start);
                    }
                    heading = Some((level, String::new()));
                }
                Event::End(TagEnd::Heading(_)) => match heading.take() {
                    Some((HeadingLevel::H1, title)) => chapter.title = title,
                    Some((HeadingLevel::H2, title)) => {
                        section_start = Some(range.end);
                        let text = String::new();
                        chapter.sections.push(Section { title, text });
                    }
                    _ => {}
                },
                Event::Start(Tag::CodeBlock(kind)) => {
                    let language = match kind {
                        CodeBlockKind::Fenced(language) => language.to_string(),
                        CodeBlockKind::Indented => String::new(),
                    };
                    let text = String::new();
                    code = Some(CodeBlock { language, text });
                }
                Event::End(TagEnd::CodeBlock) => chapter.code.extend(code.take()),
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    chapter.links.push(dest_url.to_string());
                }
                Event::Text(words) | Event::Code(words) => {
                    if let Some((_, title)) = &mut heading {
                        title.push_str(&words);
                    }
                    if let Some(code) = &mut code {
                        code.text.push_str(&words);
                    }
                }
                _ => {}
            }
        }
        close_section(&mut chapter, &text, section_start, text.len());
        chapter.text = text;
        chapter
    }

    /// The section with this title.
    pub fn section(&self, title: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.title == title)
    }
}

impl Section {
    /// The formulas of the section.
    pub fn formulas(&self) -> Vec<Formula> {
        maths::formulas(&self.text)
    }

    /// The cells of all rows of all tables in the section, without the heads, as Markdown.
    pub fn table_rows(&self) -> Vec<Vec<String>> {
        let lines: Vec<&str> = self.text.lines().collect();
        let is_row = |line: &str| line.starts_with('|');
        let is_rule = |line: &str| is_row(line) && line.chars().all(|c| "|-: ".contains(c));
        let mut rows = Vec::new();
        let mut in_body = false;
        for line in lines {
            if is_rule(line) {
                in_body = true;
            } else if !is_row(line) {
                in_body = false;
            } else if in_body {
                let cells = line.trim().trim_matches('|').split(" | ");
                rows.push(cells.map(|cell| cell.trim().to_string()).collect());
            }
        }
        rows
    }
}

fn close_section(chapter: &mut Chapter, text: &str, start: Option<usize>, end: usize) {
    if let (Some(start), Some(section)) = (start, chapter.sections.last_mut()) {
        section.text = text[start..end].to_string();
    }
}

/// The chapters that `src/SUMMARY.md` lists, in order.
pub fn all() -> Result<Vec<Chapter>, String> {
    let summary = Chapter::read(Path::new("SUMMARY.md"))?;
    let paths = summary.links.iter().map(Path::new);
    paths.map(Chapter::read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chapter_has_sections_links_code_and_tables() {
        let text = "# Title\n\n## One\n\n[a](b.md) $x$\n\n| h | i |\n|---|---|\n| $y$ | z |\n\n## Two\n\n```rust\nlet a;\n```\n";
        let chapter = Chapter::parse(Path::new("a.md"), text.into());
        assert_eq!(chapter.title, "Title");
        assert_eq!(chapter.links, ["b.md"]);
        let one = chapter.section("One").unwrap();
        assert_eq!(one.formulas().len(), 2);
        assert_eq!(one.table_rows(), [["$y$", "z"]]);
        assert_eq!(chapter.code[0].language, "rust");
        assert_eq!(chapter.code[0].text, "let a;\n");
        assert!(chapter.section("Two").unwrap().text.contains("let a;"));
    }
}
