//! The labels of figures, laid out with the widths of two families of fonts: none leaves its
//! drawing or covers another one. What `sans-serif` and `serif` are depends on the reader's
//! machine; DejaVu is among the widest, Liberation has the widths of Arial and Times.

mod widths;

use roxmltree::{Document, Node};
use widths::WIDTHS;

const FAMILIES: [&str; 2] = ["DejaVu", "Liberation"];

/// The sizes of symbols and of words, in pixels: the classes `m` and `s` of `code/drawing.rs`.
const SYMBOL: f64 = 19.0;
const WORDS: f64 = 13.0;

/// What of a line of text is above its base line, and what below, relative to its size.
const ABOVE: f64 = 0.74;
const BELOW: f64 = 0.22;

/// A label: its text and the rectangle that it covers.
#[derive(Clone, Debug)]
struct Label {
    text: String,
    low: [f64; 2],
    high: [f64; 2],
}

impl Label {
    /// The text of an element, in a family of fonts.
    fn of(element: Node, family: usize) -> Label {
        let number = |name: &str| {
            let value = element.attribute(name).expect("an attribute");
            value.parse::<f64>().expect("a number")
        };
        let classes = element.attribute("class").unwrap_or_default();
        let is_symbol = classes.split(' ').any(|class| class == "m");
        let (size, font) = match is_symbol {
            true => (SYMBOL, 2 + family),
            false => (WORDS, family),
        };
        let (mut text, mut width, mut below) = (String::new(), 0.0, BELOW * size);
        for part in element.descendants().filter(Node::is_text) {
            let part_text = part.text().unwrap_or_default();
            let parent = part.parent().expect("an element");
            let of_part = parent
                .attribute("font-size")
                .and_then(|size| size.parse().ok());
            if parent
                .attribute("dy")
                .is_some_and(|dy| !dy.starts_with('-'))
            {
                below = 5.0 + BELOW * of_part.unwrap_or(size);
            }
            width += of_part.unwrap_or(size) * width_of(part_text, font);
            text += part_text;
        }
        let left = number("x")
            - match element.attribute("text-anchor") {
                Some("start") => 0.0,
                Some("middle") => 0.5 * width,
                other => {
                    assert_eq!(other, Some("end"));
                    width
                }
            };
        Label {
            text,
            low: [left, number("y") - ABOVE * size],
            high: [left + width, number("y") + below],
        }
    }

    fn is_inside(&self, size: [f64; 2]) -> bool {
        (0..2).all(|i| self.low[i] >= 0.0 && self.high[i] <= size[i])
    }

    fn covers(&self, other: &Label) -> bool {
        (0..2).all(|i| self.low[i] < other.high[i] && other.low[i] < self.high[i])
    }
}

/// The width of a text relative to the size of the font.
fn width_of(text: &str, font: usize) -> f64 {
    let of = |c: char| {
        let found = WIDTHS.iter().find(|(known, _)| *known == c);
        let (_, widths) = found.unwrap_or_else(|| panic!("add {c:?} to tests/labels/widths.rs"));
        f64::from(widths[font]) / 1000.0
    };
    text.chars().map(of).sum()
}

/// What is wrong with the labels of a figure.
fn faults(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).expect("SVG");
    let root = document.root_element();
    let size = ["width", "height"].map(|name| {
        let size = root.attribute(name).expect("a size");
        size.parse::<f64>().expect("a number")
    });
    let mut faults = Vec::new();
    for (family, name) in FAMILIES.into_iter().enumerate() {
        let texts = root.descendants().filter(|node| node.has_tag_name("text"));
        let labels: Vec<Label> = texts.map(|text| Label::of(text, family)).collect();
        for (i, label) in labels.iter().enumerate() {
            if !label.is_inside(size) {
                faults.push(format!(
                    "{name}: \"{}\" leaves the drawing: {label:?}",
                    label.text
                ));
            }
            let others = labels[i + 1..].iter().filter(|other| label.covers(other));
            faults.extend(
                others.map(|other| format!("{name}: \"{}\" covers \"{}\"", label.text, other.text)),
            );
        }
    }
    faults
}

#[test]
fn no_label_leaves_its_figure_or_covers_another_one() {
    let mut all = Vec::new();
    for (name, svg) in book::figures::all() {
        all.extend(
            faults(&svg)
                .into_iter()
                .map(|fault| format!("{name}: {fault}")),
        );
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}

#[test]
fn wide_and_close_labels_are_found() {
    let figure = |x: f64, text: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\">\
             <text class=\"s ink\" x=\"10\" y=\"20\" text-anchor=\"start\">lamp</text>\
             <text class=\"m ink\" x=\"{x}\" y=\"22\" text-anchor=\"middle\">{text}</text></svg>"
        )
    };
    let index = "ω<tspan dy=\"5\" font-size=\"13\">i</tspan>";
    assert_eq!(faults(&figure(70.0, index)), [""; 0]);
    assert_eq!(faults(&figure(45.0, index)).len(), 2, "in both families");
    let wide = faults(&figure(80.0, "mmmmmm"));
    assert!(
        wide.iter().any(|fault| fault.contains("leaves")),
        "{wide:?}"
    );
}
