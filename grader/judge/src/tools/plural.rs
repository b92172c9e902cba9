//! Singular and plural.

/// `count` followed by `one` if it is 1, else by `many`.
pub fn plural(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
