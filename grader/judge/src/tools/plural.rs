//! Singular and plural.

use std::fmt::Display;

/// `count` followed by `one` if it is 1, else by `many`.
pub fn plural<N: Display + PartialEq + From<u8>>(count: N, one: &str, many: &str) -> String {
    let noun = if count == N::from(1) { one } else { many };
    format!("{count} {noun}")
}

#[cfg(test)]
mod tests {
    use super::plural;

    #[test]
    fn one_is_singular_and_none_is_plural() {
        let texts = [0, 1, 2_u32].map(|count| plural(count, "ray", "rays"));
        assert_eq!(texts, ["0 rays", "1 ray", "2 rays"]);
    }
}
