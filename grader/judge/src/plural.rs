//! Singular and plural.

/// `count` with the word that fits it: `one` for 1, else `many`.
pub fn plural(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
