//! The index of symbols at the end of the glossary, made of the chapters' tables.

use crate::chapter::{self, Chapter};
use crate::paths::task_number;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// What is before the index in the glossary.
const MARK: &str = "<!-- What follows is written by `cargo run -p book -- symbols`. -->\n";

/// The chapter with the index.
pub const GLOSSARY: &str = "glossary.md";

/// The glossary with the index as the chapters' tables have it.
pub fn glossary() -> Result<String, String> {
    let text = Chapter::read(Path::new(GLOSSARY))?.text;
    let (before, _) = text
        .split_once(MARK)
        .ok_or_else(|| format!("{GLOSSARY}: expected the line {MARK}"))?;
    Ok(format!("{before}{MARK}\n{}", index(&chapter::all()?)))
}

/// Writes the glossary.
pub fn write() -> Result<(), String> {
    let file = crate::folder().join("src").join(GLOSSARY);
    std::fs::write(&file, glossary()?)
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

/// A table with a row for each symbol: all its meanings, with the chapters that use them.
fn index(chapters: &[Chapter]) -> String {
    let mut symbols: BTreeMap<String, Vec<(String, Vec<String>)>> = BTreeMap::new();
    for chapter in chapters {
        let Some(figure) = chapter.section("The figure") else {
            continue;
        };
        // `1.3` for Part 1, Task 3, else the title.
        let name = task_number(&chapter.path).unwrap_or_else(|| chapter.title.clone());
        let link = format!("[{name}]({})", chapter.path.display());
        for row in figure.table_rows() {
            let meanings = symbols.entry(row[0].clone()).or_default();
            match meanings.iter_mut().find(|(known, _)| *known == row[1]) {
                Some((_, links)) => links.push(link.clone()),
                None => meanings.push((row[1].clone(), vec![link.clone()])),
            }
        }
    }
    // By letter: $\alpha$ stands at "alpha".
    let mut rows: Vec<_> = symbols.into_iter().collect();
    rows.sort_by_key(|(symbol, _)| {
        let letters: String = symbol.chars().filter(|c| c.is_alphanumeric()).collect();
        (letters.to_lowercase(), symbol.clone())
    });
    let mut table = String::from("| Symbol | Meanings |\n|---|---|\n");
    for (symbol, meanings) in rows {
        let meanings: Vec<String> = meanings
            .into_iter()
            .map(|(meaning, links)| format!("{meaning}: {}", links.join(", ")))
            .collect();
        let _ = writeln!(table, "| {symbol} | {} |", meanings.join("; "));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_meanings_share_a_row() {
        let chapter = |path: &str, row: &str| {
            let text = format!("# A\n\n## The figure\n\n| S | M |\n|---|---|\n{row}\n");
            Chapter::parse(Path::new(path), text)
        };
        let chapters = [
            chapter("part1/task3.md", "| $t$ | distance |"),
            chapter("part1/task4.md", "| $t$ | distance |"),
            chapter("light.md", "| $t$ | time |"),
        ];
        let found = index(&chapters);
        let row = "| $t$ | distance: [1.3](part1/task3.md), [1.4](part1/task4.md); time: [A](light.md) |\n";
        assert!(found.ends_with(row), "{found}");
    }
}
