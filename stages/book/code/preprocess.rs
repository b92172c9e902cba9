//! The preprocessor of mdBook: formulas become MathML, and pictures of the project from outside the
//! book become a part of the page. So the built book needs no server and no other folder.
//!
//! mdBook writes the array `[context, book]` as JSON to the preprocessor and reads the changed book
//! back. Its version 0.5 calls the list of chapters `items`, versions before it `sections`; this
//! code changes the `content` of every chapter wherever it is.

use crate::html::{folder_of, normal};
use crate::maths::{self, with_mathml};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use pulldown_cmark::{Event, Parser, Tag};
use serde_json::Value;
use std::path::Path;

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
            if let Some(Value::Object(chapter)) = fields.get_mut("Chapter") {
                let path = chapter.get("path").and_then(Value::as_str);
                let path = path.unwrap_or_default().to_string();
                if let Some(Value::String(content)) = chapter.get_mut("content") {
                    *content = with_pictures(&with_mathml(content)?, Path::new(&path))?;
                }
            }
            fields.values_mut().try_for_each(convert)
        }
        _ => Ok(()),
    }
}

/// `markdown` of the chapter at `path` with data URIs in place of the pictures outside of `src`.
fn with_pictures(markdown: &str, path: &Path) -> Result<String, String> {
    let source = crate::folder().join("src");
    let mut text = markdown.to_string();
    let events = Parser::new_ext(markdown, maths::options()).into_offset_iter();
    let images = events.filter_map(|(event, range)| match event {
        Event::Start(Tag::Image { dest_url, .. }) => Some((dest_url.to_string(), range)),
        _ => None,
    });
    // From the end, so that the ranges before stay valid.
    for (link, range) in images.collect::<Vec<_>>().into_iter().rev() {
        let file = normal(&folder_of(path).join(&link));
        if link.contains("://") || file.starts_with(&source) {
            continue;
        }
        let bytes = std::fs::read(&file).map_err(|error| {
            format!(
                "{}: cannot read the picture {}: {error}",
                path.display(),
                file.display()
            )
        })?;
        let kind = match file.extension().and_then(|extension| extension.to_str()) {
            Some("svg") => "svg+xml",
            Some(other) => other,
            None => "png",
        };
        let uri = format!("data:image/{kind};base64,{}", STANDARD.encode(bytes));
        let image = markdown[range.clone()].replace(&link, &uri);
        text.replace_range(range, &image);
    }
    Ok(text)
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
    fn pictures_outside_of_the_book_become_part_of_the_page() {
        let chapter = Path::new("part4/README.md");
        let outside = "![A box](../../../../scenes/pictures/cornell_mirror_glass.png)";
        let page = with_pictures(outside, chapter).unwrap();
        assert!(page.starts_with("![A box](data:image/png;base64,iVBOR"));
        let inside = "![A path](../figures/part4-path.svg)";
        assert_eq!(with_pictures(inside, chapter).unwrap(), inside);
        let missing = with_pictures("![?](../../../../none.png)", chapter).unwrap_err();
        assert!(
            missing.starts_with("part4/README.md: cannot read the picture"),
            "{missing}"
        );
    }

    #[test]
    fn other_input_is_an_error() {
        for input in ["", "{}", "[1]"] {
            assert!(run(input).unwrap_err().starts_with("expected"), "{input}");
        }
    }
}
