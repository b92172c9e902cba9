//! Where the book explains a task.

/// A section of a task's chapter that the grader's messages link to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The typical mistakes, by the names that the diagnosis gives them.
    Mistakes,
    /// What a function must do: for answers that are wrong like those of no known mistake.
    Contract,
    /// Rounding errors and extreme input: what extra credit is lost by.
    Limits,
}

impl Section {
    /// All of them.
    pub const ALL: [Section; 3] = [Section::Mistakes, Section::Contract, Section::Limits];

    /// The anchor of its heading, as forges and the built book name it.
    pub fn anchor(self) -> &'static str {
        match self {
            Section::Mistakes => "mistakes",
            Section::Contract => "the-contract",
            Section::Limits => "where-the-formulas-break",
        }
    }
}

/// The chapter of the book about a task: `stages/book/src/part2/task1.md` for `part2.task1`. `None`
/// for a key that is not made of a part and a task.
pub fn chapter(key: &str) -> Option<String> {
    let (part, task) = key.split_once('.')?;
    Some(format!("stages/book/src/{part}/{task}.md"))
}

/// The page of that chapter in the rendered book, such as `part2/task1.html`.
pub fn page(key: &str) -> Option<String> {
    let (part, task) = key.split_once('.')?;
    Some(format!("{part}/{task}.html"))
}

/// A section of the chapter about a task, such as `stages/book/src/part2/task1.md#mistakes`.
pub fn section(key: &str, section: Section) -> Option<String> {
    Some(format!("{}#{}", chapter(key)?, section.anchor()))
}

/// The text of a chapter below a heading of the second level; empty if it has no such heading.
pub fn under<'a>(chapter: &'a str, heading: &str) -> &'a str {
    let start = format!("\n## {heading}\n");
    let below = chapter.split_once(&start).map_or("", |(_, below)| below);
    below.split("\n## ").next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_ends_at_the_next_heading() {
        let text = "# T\n\n## One\n\n1\n\n### More\n\n2\n\n## Two\n\n3\n";
        assert_eq!(under(text, "One"), "\n1\n\n### More\n\n2\n");
        assert_eq!(under(text, "Two"), "\n3\n");
        assert_eq!(under(text, "Three"), "");
    }

    #[test]
    fn the_chapter_is_in_the_key() {
        let path = "stages/book/src/part2/task1.md";
        assert_eq!(chapter("part2.task1").as_deref(), Some(path));
        assert_eq!(chapter("toy"), None);
        let mistakes = section("part2.task1", Section::Mistakes);
        assert_eq!(mistakes, Some(format!("{path}#mistakes")));
    }
}
