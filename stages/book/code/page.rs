//! The pages that mdBook rendered, completed: formulas, links to the project, scripts of figures.

use crate::source::{FORMULA, PROJECT};
use std::path::Path;

/// Completes `html`, the page at `path` in the book.
///
/// `formulas` are the MathML of all formulas. `to_project` is the relative path from the folder of
/// the book to the project.
pub fn complete(
    html: &str,
    path: &Path,
    formulas: &[String],
    to_project: &str,
) -> Result<String, String> {
    let depth = path.components().count().saturating_sub(1);
    let to_book = "../".repeat(depth);
    let html = with_formulas(html, formulas)
        .map_err(|why| format!("{}: {why}", path.display()))?
        .replace(
            &format!("href=\"{PROJECT}"),
            &format!("href=\"{to_book}{to_project}/"),
        );
    // The page to print shows the figures as they are without a script.
    if path == Path::new("print.html") {
        return Ok(html);
    }
    Ok(with_scripts(&html, &to_book))
}

/// Puts the formulas in their places.
fn with_formulas(html: &str, formulas: &[String]) -> Result<String, String> {
    let [before, after] = FORMULA;
    let mut parts = html.split(before);
    let mut page = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let found = part.split_once(after).and_then(|(number, rest)| {
            let number: usize = number.parse().ok()?;
            Some((formulas.get(number)?, rest))
        });
        let (formula, rest) = found.ok_or("mdBook changed the place of a formula")?;
        page.push_str(formula);
        page.push_str(rest);
    }
    Ok(page)
}

/// Loads the scripts that the page needs: that of the explorable figures, which loads the rest
/// itself, and that of the questions.
fn with_scripts(html: &str, to_book: &str) -> String {
    let mut scripts = String::new();
    for (mark, script) in [
        ("data-explore=\"", "explore/explore.js"),
        ("data-predict=\"", "predict.js"),
    ] {
        if html.contains(mark) {
            scripts += &format!("<script src=\"{to_book}{script}\" defer></script>\n");
        }
    }
    html.replacen("</head>", &format!("{scripts}</head>"), 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_and_links_are_put_in() {
        let html =
            "<p><span data-formula=\"1\"></span> <a href=\"project:stages/kit/a.rs\">a</a></p>";
        let formulas = ["<math>a</math>".to_string(), "<math>b</math>".to_string()];
        let page = complete(html, Path::new("part1/task1.html"), &formulas, "../../..");
        let expected = "<p><math>b</math> <a href=\"../../../../stages/kit/a.rs\">a</a></p>";
        assert_eq!(page.as_deref(), Ok(expected));
        let error = complete(html, Path::new("a.html"), &[], "").unwrap_err();
        assert!(error.starts_with("a.html: "), "{error}");
    }

    #[test]
    fn only_pages_that_need_a_script_load_it() {
        let html = "<head></head><body><figure data-explore=\"slabs\"></figure></body>";
        let at = |path: &str| complete(html, Path::new(path), &[], "").expect("a page");
        let script = "<script src=\"../explore/explore.js\" defer></script>";
        assert_eq!(at("part2/task2.html").matches(script).count(), 1);
        assert_eq!(at("print.html"), html);
        let asks = "<head></head><form data-predict=\"part1.task1\" hidden></form>";
        let page = complete(asks, Path::new("part1/task1.html"), &[], "").expect("a page");
        assert!(
            page.contains("<script src=\"../predict.js\" defer></script>\n</head>"),
            "{page}"
        );
        let without = "<body></body>";
        let page = complete(without, Path::new("a.html"), &[], "");
        assert_eq!(page.as_deref(), Ok(without));
    }
}
