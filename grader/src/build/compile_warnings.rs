//! The compiler's warnings while a report is on its way: a few lines, so that they do not push it
//! off the screen.

use std::collections::BTreeMap;

/// The places and first sentences of warnings, by crate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings(BTreeMap<String, Vec<String>>);

/// The most warnings about a crate that are shown.
const MOST: usize = 3;

impl Warnings {
    /// Adds a warning about the crate `of_crate`, which `says` this.
    pub fn add(&mut self, of_crate: &str, says: String) {
        let of_crate = self.0.entry(of_crate.to_owned()).or_default();
        of_crate.push(says);
    }

    /// For each crate with warnings how many, the command that shows the code, and the first of
    /// them: a variable that is never used often is the mistake.
    pub fn summary(&self) -> String {
        let lines = self.0.iter().map(|(name, all)| {
            let count = judge::plural(all.len(), "warning", "warnings");
            let first: String = all
                .iter()
                .take(MOST)
                .map(|says| format!("  {says}\n"))
                .collect();
            format!(
                "{count} of the compiler about {name}: `cargo check -p {name}` shows the code\n{first}"
            )
        });
        lines.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_few_lines_for_each_crate() {
        let mut warnings = Warnings::default();
        assert_eq!(warnings.summary(), "");
        warnings.add("bvh", "a.rs:1: unused variable: `k`".into());
        for line in 2..6 {
            warnings.add("raygen", format!("b.rs:{line}: unused import"));
        }
        assert_eq!(
            warnings.summary(),
            "1 warning of the compiler about bvh: `cargo check -p bvh` shows the code\n  \
             a.rs:1: unused variable: `k`\n\
             4 warnings of the compiler about raygen: `cargo check -p raygen` shows the code\n  \
             b.rs:2: unused import\n  b.rs:3: unused import\n  b.rs:4: unused import\n"
        );
    }
}
