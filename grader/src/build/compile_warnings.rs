//! The compiler's warnings while a report is on its way: counted, so that they do not push it off
//! the screen.

use std::collections::BTreeMap;

/// The numbers of warnings, by crate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings(BTreeMap<String, usize>);

impl Warnings {
    /// Counts a warning about the crate `of_crate`.
    pub fn add(&mut self, of_crate: &str) {
        *self.0.entry(of_crate.to_owned()).or_default() += 1;
    }

    /// A line for each crate with warnings: how many, and the command that shows the code.
    pub fn summary(&self) -> String {
        let lines = self.0.iter().map(|(name, count)| {
            let count = judge::plural(*count, "warning", "warnings");
            format!(
                "{count} of the compiler about {name}: `cargo check -p {name}` shows the code\n"
            )
        });
        lines.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_a_line_for_each_crate() {
        let mut warnings = Warnings::default();
        assert_eq!(warnings.summary(), "");
        for name in ["raygen", "bvh", "raygen"] {
            warnings.add(name);
        }
        assert_eq!(
            warnings.summary(),
            "1 warning of the compiler about bvh: `cargo check -p bvh` shows the code\n\
             2 warnings of the compiler about raygen: `cargo check -p raygen` shows the code\n"
        );
    }
}
