//! Formulas: LaTeX in dollar signs, as MathML.

use pulldown_cmark::{Event, Options, Parser as Markdown};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};
use std::ops::Range;

/// A formula of a chapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Its LaTeX, without the dollar signs.
    pub latex: String,
    /// Whether it stands on a line of its own.
    pub display: bool,
    /// Its bytes in the chapter, with the dollar signs.
    pub range: Range<usize>,
}

/// What the chapters may use of Markdown: maths, tables and footnotes beside CommonMark.
pub fn options() -> Options {
    Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES
}

/// All formulas of a chapter, in order.
pub fn formulas(markdown: &str) -> Vec<Formula> {
    let events = Markdown::new_ext(markdown, options()).into_offset_iter();
    let formula = |(event, range)| match event {
        Event::InlineMath(latex) => Some(Formula {
            latex: latex.to_string(),
            display: false,
            range,
        }),
        Event::DisplayMath(latex) => Some(Formula {
            latex: latex.to_string(),
            display: true,
            range,
        }),
        _ => None,
    };
    events.filter_map(formula).collect()
}

/// The MathML of a formula. The error quotes the part of the formula that is not LaTeX.
pub fn mathml(latex: &str, display: bool) -> Result<String, String> {
    let storage = Storage::new();
    if let Some(error) = Parser::new(latex, &storage).find_map(Result::err) {
        return Err(format!("cannot read the formula `{latex}`: {error}"));
    }
    let display_mode = if display {
        DisplayMode::Block
    } else {
        DisplayMode::Inline
    };
    let config = RenderConfig {
        display_mode,
        ..RenderConfig::default()
    };
    let mut markup = String::new();
    let parser = Parser::new(latex, &storage);
    push_mathml(&mut markup, parser, config)
        .map_err(|error| format!("cannot write the formula `{latex}` as MathML: {error}"))?;
    // What version 0.8 of the library forgets: it writes operators as they are, no space before one
    // attribute, and the space before `\sin^2` as the base of the exponent.
    let mut markup = markup
        .replace("><</", ">&lt;</")
        .replace(">></", ">&gt;</")
        .replace("\"minsize", "\" minsize");
    for script in ["<msub>", "<msup>", "<msubsup>"] {
        markup = markup.replace(
            &format!("{script}{SPACE_OF_FUNCTION}"),
            &format!("{SPACE_OF_FUNCTION}{script}"),
        );
    }
    Ok(markup)
}

/// The space that the library writes before the name of a function.
const SPACE_OF_FUNCTION: &str = "<mspace width=\"0.1667em\" />";

/// The elements of MathML that have a fixed number of children, and that number.
pub const CHILDREN: [(&str, usize); 8] = [
    ("mfrac", 2),
    ("mroot", 2),
    ("msub", 2),
    ("msup", 2),
    ("munder", 2),
    ("mover", 2),
    ("msubsup", 3),
    ("munderover", 3),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_found_and_code_stays() {
        let found = formulas("Let $x_1 = 2$; `$y$` is code.");
        assert_eq!(found.len(), 1);
        assert_eq!(
            (found[0].latex.as_str(), found[0].range.clone()),
            ("x_1 = 2", 4..13)
        );
        let markup = mathml("x_1 = 2", false).unwrap();
        assert!(
            markup.contains("<msub><mi>x</mi><mn>1</mn></msub>"),
            "{markup}"
        );
    }

    #[test]
    fn mathml_is_well_formed() {
        for latex in [r"a < b > c", r"\big( x \big)", r"\frac{1}{2}"] {
            let markup = mathml(latex, true).unwrap();
            // XML has no entity for the no-break space.
            let xml = markup.replace("&nbsp;", " ");
            assert!(roxmltree::Document::parse(&xml).is_ok(), "{markup}");
        }
    }

    #[test]
    fn the_exponent_of_a_function_has_its_name_as_base() {
        let markup = mathml(r"\eta^2 \sin^2 \theta_o", false).unwrap();
        assert!(
            markup.contains("<msup><mi>sin</mi><mn>2</mn></msup>"),
            "{markup}"
        );
    }

    #[test]
    fn an_unknown_command_is_an_error() {
        let error = mathml(r"\nonsense x", true).unwrap_err();
        assert!(error.contains(r"\nonsense"), "{error}");
    }
}
