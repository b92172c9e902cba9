//! The preprocessor of mdBook: formulas become MathML, so that the built book needs no server.
//!
//! mdBook writes the array `[context, book]` as JSON to the preprocessor and reads the changed book
//! back. The two first releases of its version 0.5 and all before call the list of chapters
//! differently; this code changes the `content` of every chapter wherever it is.

use crate::maths::with_mathml;
use serde_json::Value;

/// The book of mdBook's `input` with MathML in place of its formulas, as JSON.
pub fn run(input: &str) -> Result<String, String> {
    let value: Value = serde_json::from_str(input).map_err(|error| {
        format!("expected the JSON array [context, book] that mdBook writes, found something else: {error}")
    })?;
    let Value::Array(parts) = value else {
        return Err("expected the JSON array [context, book] that mdBook writes".into());
    };
    let [_, mut book] = <[Value; 2]>::try_from(parts).map_err(|parts| {
        format!(
            "expected the two values [context, book] of mdBook, found {}",
            parts.len()
        )
    })?;
    convert(&mut book)?;
    Ok(book.to_string())
}

/// Converts every chapter below `value`.
fn convert(value: &mut Value) -> Result<(), String> {
    match value {
        Value::Array(items) => items.iter_mut().try_for_each(convert),
        Value::Object(fields) => {
            if let Some(Value::Object(chapter)) = fields.get_mut("Chapter")
                && let Some(Value::String(content)) = chapter.get_mut("content")
            {
                *content = with_mathml(content)?;
            }
            fields.values_mut().try_for_each(convert)
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_of_chapters_and_of_chapters_within_chapters_are_converted() {
        let input = r#"[{"root": "/"}, {"items": [{"Chapter": {"content": "$a$",
            "sub_items": [{"Chapter": {"content": "$b$", "sub_items": []}}]}}, "Separator"]}]"#;
        let book = run(input).unwrap();
        assert!(
            book.contains("<mi>a</mi>") && book.contains("<mi>b</mi>"),
            "{book}"
        );
        assert!(!book.contains('$') && book.contains("Separator"));
    }

    #[test]
    fn other_input_is_an_error() {
        for input in ["", "{}", "[1]"] {
            assert!(run(input).unwrap_err().starts_with("expected"), "{input}");
        }
    }
}
