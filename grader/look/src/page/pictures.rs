//! The pictures of cases, and the data of their pixels for the page's script.

use super::call;
use super::viewer::viewer;
use super::words::Words;
use crate::box_walk::Step;
use crate::case::Case;
use crate::picture::{Picture, Pixels};
use ::pictures::cause::Cause;
use pages::html::{chip, compressed, escape};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Formats the pictures of a case, with an inspector of their pixels.
pub fn panels(case: &Case, picture: &Picture, words: &Words) -> String {
    let Picture {
        golden,
        actual,
        pixels,
    } = picture;
    let difference = pixels.as_ref().map(|pixels| &pixels.difference);
    let legend = pixels.as_ref().map(legend).unwrap_or_default();
    let mut text = viewer(golden, actual, difference, &legend, words);
    if golden.size() != actual.size() {
        text.push_str("<p class=\"bad\">The two pictures differ in size, so their pixels cannot be compared.</p>\n");
    }
    if let Some(pixels) = pixels {
        let _ = write!(
            text,
            "<div class=\"inspector\" aria-live=\"polite\"><p class=\"note\">Click a pixel to see its ray, all answers and the box tests. \
             Or select the picture with Tab and use the arrow keys.</p></div>\n\
             <script type=\"text/plain\" class=\"pixels\">{}</script>\n",
            compressed(data(case, picture, pixels, words).to_string().as_bytes()),
        );
    }
    text
}

fn legend(pixels: &Pixels) -> String {
    let counts = pixels.counts();
    if counts.is_empty() {
        return "<p class=\"note\">No differences.</p>".into();
    }
    let mut text = String::from(
        "<p class=\"note\">Differences, by the first field that differs. Each button goes to the next such pixel.</p>\n<ul class=\"legend\">",
    );
    for (cause, count) in counts {
        let _ = write!(
            text,
            "<li><button type=\"button\" data-cause=\"{}\">{}{}: {count}</button></li>",
            cause as u8,
            chip(cause.colour()),
            escape(cause.label())
        );
    }
    text + "</ul>"
}

/// The data of a picture for the script: for each pixel the number of its cause; for each pixel
/// with records its HTML and its box tests; the boxes that are tested.
fn data(case: &Case, picture: &Picture, pixels: &Pixels, words: &Words) -> Value {
    let [width, height] = picture.actual.size();
    let causes: Vec<u8> = pixels.causes.iter().map(|cause| *cause as u8).collect();
    let mut labels = vec![Cause::Same.label()];
    labels.extend(Cause::DIFFERENCES.map(Cause::label));
    let calls: Vec<u32> = pixels.rows.iter().map(|row| row.call).collect();
    let html = pixels.rows.iter().map(|row| {
        let [x, y] = [row.call % width, row.call / width];
        let heading = format!("Pixel {x}, {y}: {}", row.cause.label());
        call(row, &heading, &case.whole.verdict(row.call), words)
    });
    let mut boxes = BTreeMap::new();
    let mut walks = Vec::new();
    if let Some(tests) = &pixels.boxes {
        for walk in &tests.walks {
            for step in walk {
                let tested = &tests.boxes[step.number as usize];
                let [min, max] = tested.corners;
                boxes.entry(step.number).or_insert_with(
                    || json!({ "corners": [min, max], "depth": tested.depth, "leaf": tested.leaf }),
                );
            }
            let steps: Vec<[u32; 3]> = walk.iter().map(numbers).collect();
            walks.push(steps);
        }
    }
    json!({
        "width": width,
        "height": height,
        "labels": labels,
        "causes": causes,
        "calls": calls,
        "html": html.collect::<Vec<String>>(),
        "walks": pixels.boxes.as_ref().map(|_| walks),
        "boxes": boxes,
        "corners": pixels.corners,
        "noRecords": words.no_records,
        "names": [words.golden, words.actual],
    })
}

/// A step for the script: the box, what the needed walk says and what the code says: 0 for a miss,
/// 1 for a hit, 2 for no test.
fn numbers(step: &Step) -> [u32; 3] {
    let code = |hit: Option<bool>| hit.map_or(2, u32::from);
    [step.number, code(step.needed), code(step.actual)]
}
