//! The warnings about a file. Warnings of one kind are counted together.

use crate::diagnostic::{Diagnostic, Warning};
use std::collections::{BTreeSet, HashMap};

/// Maximum number of kinds. If there are more, one additional warning contains their number.
const MAX_KINDS: usize = 50;

/// Maximum number of lines that a warning about several places lists.
const MAX_LINES: usize = 3;

/// Warnings grouped by kind, in the order in which each kind was first found.
#[derive(Default)]
pub(super) struct WarningList {
    groups: Vec<Group>,
    by_kind: HashMap<String, usize>,
    /// Warnings of other kinds than the first [`MAX_KINDS`].
    omitted: usize,
}

/// Warnings of one kind.
struct Group {
    first: Diagnostic,
    /// The bytes at which the others start.
    others: BTreeSet<usize>,
}

impl WarningList {
    /// Adds a warning that starts at byte `start`. Calls `diagnostic` only for the first warning of
    /// a kind, because computing its line takes time. The same warning at the same place counts
    /// once.
    pub(super) fn add(
        &mut self,
        title: &str,
        start: usize,
        diagnostic: impl FnOnce() -> Diagnostic,
    ) {
        let kind = kind(title);
        if let Some(index) = self.by_kind.get(&kind) {
            let group = &mut self.groups[*index];
            if group.first.start() != Some(start) {
                group.others.insert(start);
            }
        } else if self.groups.len() < MAX_KINDS {
            self.by_kind.insert(kind, self.groups.len());
            self.groups.push(Group {
                first: diagnostic(),
                others: BTreeSet::new(),
            });
        } else {
            self.omitted += 1;
        }
    }

    /// The first warning of each kind.
    pub(super) fn found(&self) -> impl Iterator<Item = &Diagnostic> {
        self.groups.iter().map(|group| &group.first)
    }

    /// One warning for each kind. `source` is the text of the file.
    pub(super) fn into_warnings(self, file: &str, source: &str) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = Vec::with_capacity(self.groups.len() + 1);
        for Group { first, others } in self.groups {
            warnings.push(Warning(match others.len() {
                0 => first,
                _ => first.note(elsewhere(&others, source)),
            }));
        }
        if self.omitted > 0 {
            let title = format!("{} more warnings are not shown", self.omitted);
            warnings.push(Warning(Diagnostic::about_file(file, title)));
        }
        warnings
    }
}

/// The title without what differs between warnings of one kind: digits and quoted names.
fn kind(title: &str) -> String {
    let mut quote = None;
    let is_kept = |c: &char| match quote {
        Some(open) => {
            if open == *c {
                quote = None;
            }
            false
        }
        None if matches!(c, '"' | '`') => {
            quote = Some(*c);
            false
        }
        None => !c.is_ascii_digit(),
    };
    title.chars().filter(is_kept).collect()
}

/// How many more places there are, and the first of their lines.
fn elsewhere(others: &BTreeSet<usize>, source: &str) -> String {
    let line = |start: &usize| {
        source.as_bytes()[..*start]
            .split(|byte| *byte == b'\n')
            .count()
    };
    let mut lines: Vec<String> = others
        .iter()
        .take(MAX_LINES)
        .map(|start| line(start).to_string())
        .collect();
    lines.dedup();
    let noun = if lines.len() == 1 { "line" } else { "lines" };
    let and_so_on = if others.len() > MAX_LINES {
        ", ..."
    } else {
        ""
    };
    let lines = lines.join(", ");
    format!(
        "{} more like this, at {noun} {lines}{and_so_on}",
        others.len()
    )
}

#[cfg(test)]
mod tests {
    use super::kind;

    #[test]
    fn kinds_do_not_depend_on_names_and_numbers() {
        let title =
            |id: &str, count: u32| format!("<mesh id=\"{id}\"> has {count} numbers, `{id}`");
        assert_eq!(kind(&title("a", 1)), kind(&title("mesh has", 23)));
        assert_ne!(kind("<lines> is ignored"), kind("<linestrips> is ignored"));
    }
}
