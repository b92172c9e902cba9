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
    let html = with_formulas(html, formulas).map_err(|why| format!("{}: {why}", path.display()))?;
    let html = html.replace(
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

/// Loads the script of the explorable figures, if the page has one. It loads what they need itself.
fn with_scripts(html: &str, to_book: &str) -> String {
    if !html.contains("data-explore=\"") {
        return html.to_string();
    }
    let script = format!("<script src=\"{to_book}explore/explore.js\" defer></script>\n</head>");
    html.replacen("</head>", &script, 1)
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
    fn only_pages_with_an_explorable_figure_load_the_script() {
        let html = "<head></head><body><figure data-explore=\"slabs\"></figure></body>";
        let at = |path: &str| complete(html, Path::new(path), &[], "").expect("a page");
        let script = "<script src=\"../explore/explore.js\" defer></script>";
        assert_eq!(at("part2/task2.html").matches(script).count(), 1);
        assert_eq!(at("print.html"), html);
        let without = "<body></body>";
        let page = complete(without, Path::new("a.html"), &[], "");
        assert_eq!(page.as_deref(), Ok(without));
    }
}
