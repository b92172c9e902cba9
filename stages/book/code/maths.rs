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

/// What the chapters use of Markdown: maths and tables beside CommonMark.
pub fn options() -> Options {
    Options::ENABLE_MATH | Options::ENABLE_TABLES
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
    // What version 0.8 of the library forgets: it writes operators as they are, and no space
    // before one attribute.
    Ok(markup
        .replace("><</", ">&lt;</")
        .replace(">></", ">&gt;</")
        .replace("\"minsize", "\" minsize"))
}

/// `markdown` with MathML in place of its formulas.
pub fn with_mathml(markdown: &str) -> Result<String, String> {
    let mut text = String::with_capacity(2 * markdown.len());
    let mut done = 0;
    for formula in formulas(markdown) {
        text.push_str(&markdown[done..formula.range.start]);
        text.push_str(&mathml(&formula.latex, formula.display)?);
        done = formula.range.end;
    }
    text.push_str(&markdown[done..]);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_mathml_and_code_stays() {
        let text = with_mathml("Let $x_1 = 2$; `$y$` is code.").unwrap();
        assert!(text.starts_with("Let <math"), "{text}");
        assert!(text.contains("<msub><mi>x</mi><mn>1</mn></msub>"), "{text}");
        assert!(text.ends_with("</math>; `$y$` is code."), "{text}");
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
    fn an_unknown_command_is_an_error() {
        let error = with_mathml(r"$$\nonsense x$$").unwrap_err();
        assert!(error.contains(r"\nonsense"), "{error}");
    }
}
