//! Words for people.

/// So many of them: `one` or `many` is what they are.
pub(crate) fn plural(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
