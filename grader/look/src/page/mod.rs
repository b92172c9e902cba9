//! What the pages of `grader look` and `grader review` consist of: pictures beside each other, and
//! what is known of their pixels.

mod call;
pub mod pictures;
pub mod viewer;
pub mod words;

pub use call::call;

use pages::PALETTE;
use pages::html::escape;

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");

/// The scripts, in their order: each uses those before it.
const SCRIPTS: [&str; 3] = [
    include_str!("projection.js"),
    include_str!("viewer.js"),
    include_str!("pixels.js"),
];

/// A whole page: `title` is text, `header` and `content` are HTML. The page's own
/// rules of style, and its own script, come after those that all pages share.
pub fn whole([style, script]: [&str; 2], title: &str, header: &str, content: &str) -> String {
    // Inserts our own texts first, because the text of an answer may contain a placeholder.
    TEMPLATE
        .replace("<!-- style -->", &format!("{PALETTE}{STYLE}{style}"))
        .replace("<!-- script -->", &(SCRIPTS.concat() + script))
        .replace("<!-- version -->", base::VERSION)
        .replace("<!-- title -->", &escape(title))
        .replace("<!-- header -->", header)
        .replace("<!-- content -->", content)
}

#[cfg(test)]
mod tests {
    use super::STYLE;

    /// The names golden, actual and exact in records have the class of captions of pictures.
    #[test]
    fn only_captions_of_pictures_are_hidden_where_names_of_values_are_shown() {
        let hidden: Vec<&str> = STYLE
            .lines()
            .filter(|line| line.contains("{ display: none"))
            .filter_map(|line| line.split('{').next())
            .flat_map(|selectors| selectors.split(','))
            .map(str::trim)
            .collect();
        assert!(hidden.contains(&".layer .who"), "{hidden:?}");
        assert!(!hidden.contains(&".who"), "{hidden:?}");
    }
}
