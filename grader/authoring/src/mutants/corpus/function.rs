//! Finds a function in a source file that rustfmt has formatted.

use std::ops::Range;

/// Where the first function `name` is, from the line of its `fn` to its closing brace. `None` if
/// there is no such function.
pub(super) fn range(text: &str, name: &str) -> Option<Range<usize>> {
    let heads = [format!("fn {name}("), format!("fn {name}<")];
    let at = heads.iter().filter_map(|head| text.find(head)).min()?;
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let line = &text[start..];
    let indent = &line[..line.len() - line.trim_start().len()];
    let close = format!("\n{indent}}}");
    let end = line.find(&close)? + close.len();
    Some(start..start + end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_ends_at_the_brace_below_its_first_letter() {
        let text =
            "fn ab() {\n    b();\n}\n\nimpl A {\n    pub fn b<T>() {\n        c();\n    }\n}\n";
        let of = |name| range(text, name).map(|range| &text[range]);
        assert_eq!(of("ab"), Some("fn ab() {\n    b();\n}"));
        assert_eq!(of("b"), Some("    pub fn b<T>() {\n        c();\n    }"));
        assert_eq!(of("c"), None);
    }
}
