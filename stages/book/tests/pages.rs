//! The pages that `book build` writes: whole, and without a server.

use book::{chapter, html};
use std::fs;

/// The values of the attribute `name` in a page.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    let values = page.split(start.as_str()).skip(1);
    values.filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn pages_are_whole_and_ask_nothing_of_a_server() {
    let out = tempfile::tempdir().expect("a temporary folder");
    html::build(out.path()).expect("the book can be built");
    let chapters = chapter::all().expect("all chapters");
    assert!(out.path().join("index.html").exists());
    let mut formulas = 0;
    for chapter in chapters {
        let file = out.path().join(chapter.path.with_extension("html"));
        let page = fs::read_to_string(&file).expect("each chapter is a page");
        let at = file.display();
        formulas += page.matches("<math").count();
        for forbidden in ["<script", "<link", "@import", "url("] {
            assert!(!page.contains(forbidden), "{at} contains {forbidden}");
        }
        let folder = file.parent().expect("a folder");
        for picture in attributes(&page, "src") {
            assert!(folder.join(picture).exists(), "{at}: there is no {picture}");
        }
        for link in attributes(&page, "href") {
            let target = link.split('#').next().unwrap_or_default();
            let is_here = target.is_empty() || folder.join(target).exists();
            assert!(is_here || link.starts_with("https://"), "{at}: {link}");
        }
    }
    assert!(formulas > 500, "found {formulas} formulas");
}
