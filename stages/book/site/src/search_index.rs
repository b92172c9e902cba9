//! Makes mdBook's index for the search smaller: it is the largest file of the site, and every
//! handout has it.
//!
//! The index knows the words of each section, and has its whole text beside them, from which the
//! results show some words. Only so many are kept. It also knows the words of the path of headings
//! to a section; the search finds them by the headings themselves.

use serde_json::{Value, json};

/// The words of a section that the results can show: `teaser-word-count` in book.toml.
const WORDS: usize = 24;

/// What is around the index in the script.
const START: &str = "JSON.parse('";
const END: &str = "')";

/// The script `js` with a shorter index.
pub(crate) fn shortened(js: &str) -> Result<String, String> {
    let other = || "mdBook writes another index than expected: adapt search_index.rs".to_string();
    let start = js.find(START).ok_or_else(other)? + START.len();
    let end = js
        .rfind(END)
        .filter(|end| *end >= start)
        .ok_or_else(other)?;
    // The string of the script has a quotation mark and a backslash behind another backslash.
    let json = unescaped(&js[start..end]);
    let mut index: Value =
        serde_json::from_str(&json).map_err(|error| format!("{}: {error}", other()))?;
    let docs = index.pointer_mut("/index/documentStore/docs");
    for doc in docs
        .and_then(Value::as_object_mut)
        .ok_or_else(other)?
        .values_mut()
    {
        let body = doc.get("body").and_then(Value::as_str).ok_or_else(other)?;
        let words: Vec<&str> = body.split_whitespace().take(WORDS).collect();
        doc["body"] = Value::from(words.join(" "));
    }
    let paths = index
        .pointer_mut("/index/index/breadcrumbs")
        .ok_or_else(other)?;
    *paths = json!({ "root": { "docs": {}, "df": 0 } });
    let json = index.to_string().replace('\\', "\\\\").replace('\'', "\\'");
    Ok(format!("{}{json}{}", &js[..start], &js[end..]))
}

fn unescaped(text: &str) -> String {
    let mut chars = text.chars();
    let mut plain = String::with_capacity(text.len());
    while let Some(c) = chars.next() {
        plain.push(if c == '\\' {
            chars.next().unwrap_or(c)
        } else {
            c
        });
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_texts_are_short_and_the_words_are_found() {
        let long = "word ".repeat(WORDS) + "last";
        let index = json!({
            "index": {
                "documentStore": { "docs": { "0": { "body": long, "title": "It's \\ a \"title\"" } } },
                "index": { "body": { "root": { "l": 1 } }, "breadcrumbs": { "root": { "x": 1 } } },
            },
        });
        let script = |json: &str| {
            let escaped = json.replace('\\', "\\\\").replace('\'', "\\'");
            format!("window.search = Object.assign(window.search, JSON.parse('{escaped}'));")
        };
        let short = shortened(&script(&index.to_string())).expect("an index");
        let start = short.find(START).expect("the start") + START.len();
        let json = unescaped(&short[start..short.rfind(END).expect("the end")]);
        let found: Value = serde_json::from_str(&json).expect("JSON");
        let doc = &found["index"]["documentStore"]["docs"]["0"];
        assert_eq!(doc["title"], "It's \\ a \"title\"");
        assert_eq!(
            doc["body"].as_str().map(|body| body.split(' ').count()),
            Some(WORDS)
        );
        assert_eq!(found["index"]["index"]["body"]["root"]["l"], 1);
        assert_eq!(
            found["index"]["index"]["breadcrumbs"]["root"]["docs"],
            json!({})
        );
        assert!(shortened("another script").is_err());
    }
}
