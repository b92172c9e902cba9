//! Links in a terminal: the command that opens a chapter is also a link to its page.

use crate::book;
use base::Workspace;
use std::io::IsTerminal;
use std::path::Path;

/// The command before the name of a chapter.
const COMMAND: &str = "cargo grader book ";

/// The command that opens the chapter about a task, or the section of it that `anchor` names.
pub fn book_command(key: &str, anchor: &str) -> String {
    match anchor {
        "" => format!("{COMMAND}{key}"),
        anchor => format!("{COMMAND}{key}#{anchor}"),
    }
}

/// `text` for stdout: with links if that is a terminal.
pub fn for_stdout(text: String, workspace: &Workspace) -> String {
    let term = std::env::var("TERM").unwrap_or_default();
    if !std::io::stdout().is_terminal() || term == "dumb" || !text.contains(COMMAND) {
        return text;
    }
    match book::unpacked(workspace) {
        Some(folder) => with_links(&text, &folder),
        None => text,
    }
}

/// Makes each command that opens a chapter a link to the chapter's page in `folder`, with the
/// escape sequence OSC 8, which terminals that do not know it leave out.
fn with_links(text: &str, folder: &Path) -> String {
    let mut parts = text.split(COMMAND);
    let mut linked = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let is_of_name = |c: char| c.is_ascii_alphanumeric() || "._-#".contains(c);
        let end = part.find(|c| !is_of_name(c)).unwrap_or(part.len());
        let (name, rest) = part.split_at(end);
        // The full stop of a sentence is not part of the name.
        let (name, stop) = match name.strip_suffix('.') {
            Some(name) => (name, "."),
            None => (name, ""),
        };
        let address = book::address(&folder.join(book::page(name)));
        linked.push_str(&format!(
            "\x1b]8;;{address}\x1b\\{COMMAND}{name}\x1b]8;;\x1b\\{stop}{rest}"
        ));
    }
    linked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_become_links_to_pages() {
        let text = format!("a\n  Its chapter: {}.\nb", book_command("part1.task3", ""));
        let linked = with_links(&text, Path::new("/x y"));
        let expected = "a\n  Its chapter: \x1b]8;;file:///x%20y/part1/task3.html\x1b\\cargo grader book part1.task3\x1b]8;;\x1b\\.\nb";
        assert_eq!(linked, expected);
        let mistakes = with_links(&book_command("part1.task3", "mistakes"), Path::new("/x"));
        assert!(
            mistakes.contains("/x/part1/task3.html#mistakes\x1b"),
            "{mistakes:?}"
        );
        assert_eq!(
            with_links("cargo grader part1", Path::new("/x")),
            "cargo grader part1"
        );
    }

    #[test]
    fn without_a_terminal_there_are_no_links() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir_all(folder.path().join("stages")).expect("a folder");
        std::fs::write(folder.path().join("stages/course.toml"), "").expect("a file");
        let workspace = Workspace::above(folder.path()).expect("a workspace");
        let text = book_command("part1.task3", "");
        // Tests run without a terminal at stdout, or without the site.
        assert_eq!(for_stdout(text.clone(), &workspace), text);
    }
}
