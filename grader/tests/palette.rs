//! The style sheets of pages and drawings have one palette.

use pictures::palette::OF_PAGES;
use std::path::{Path, PathBuf};

/// The style sheets below a folder.
fn style_sheets(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let (folders, files): (Vec<PathBuf>, Vec<PathBuf>) = paths.partition(|path| path.is_dir());
    let sheets = files
        .into_iter()
        .filter(|path| path.extension() == Some("css".as_ref()));
    let below = folders.iter().flat_map(|folder| style_sheets(folder));
    sheets.chain(below).collect()
}

/// The colours that a style sheet writes itself: "#fff", "rgb(0,0,0)".
fn colors(css: &str) -> Vec<&str> {
    let is_digit = |c: char| c.is_ascii_hexdigit();
    let hex = css.split('#').skip(1).filter(|rest| {
        let digits = rest.len() - rest.trim_start_matches(is_digit).len();
        let next = rest[digits..].chars().next();
        [3, 4, 6, 8].contains(&digits) && !next.is_some_and(|c| c.is_alphanumeric() || c == '-')
    });
    let functions = ["rgb(", "rgba(", "hsl(", "oklch("].into_iter();
    hex.map(|rest| &rest[..3])
        .chain(functions.filter(|name| css.contains(name)))
        .collect()
}

#[test]
fn pages_have_the_colors_of_the_palette() {
    let grader = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sheets = 0;
    for path in style_sheets(grader) {
        // The palette, and that of plots, whose colours stand in the SVG.
        if path.ends_with("src/palette.css") || path.ends_with("plots/src/colors.css") {
            continue;
        }
        sheets += 1;
        let css = std::fs::read_to_string(&path).expect("a style sheet");
        assert_eq!(colors(&css), Vec::<&str>::new(), "{}", path.display());
        for name in css.split("var(--").skip(1) {
            let name = name.split([')', ',']).next().expect("a name");
            let is_known = [OF_PAGES, &css]
                .iter()
                .any(|css| css.contains(&format!("--{name}:")));
            // Set by the page itself, for the position of a slider and the like.
            let is_place = ["at", "scale", "ratio", "depth"].contains(&name);
            assert!(is_known || is_place, "--{name} of {}", path.display());
        }
    }
    assert!(sheets > 0);
    assert_eq!(
        colors("#filter{color:#fff;background:rgb(1,2,3)}"),
        ["fff", "rgb("]
    );
}
