//! The pictures of the page, and their data for the page's script.

use super::rows::rows;
use super::words::Words;
use crate::case::Case;
use crate::cause::Cause;
use crate::picture::{Picture, Pixels};
use judge::whole::Verdict;
use pages::html::{base64, escape, json_in_script, png_data_uri};
use pictures::Image;
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Formats a case with its picture, below the HTML `about` it.
pub(crate) fn article(case: &Case, picture: &Picture, about: &str, words: &Words) -> String {
    let id = escape(&case.path());
    let mut text = format!("<article class=\"case picture\" id=\"{id}\">\n<h3>{id}</h3>\n{about}");
    let image = |who: &str, picture: &Image| {
        format!(
            "<img data-who=\"{who}\" alt=\"{who} picture\" src=\"{}\">",
            png_data_uri(picture)
        )
    };
    let [w, h] = picture.actual.size();
    let overlay = format!(
        "<svg viewBox=\"0 0 {w} {h}\" preserveAspectRatio=\"none\" aria-hidden=\"true\"></svg>"
    );
    let screen = "<div class=\"screen\" tabindex=\"0\" role=\"application\" aria-label=\"picture: arrow keys choose a pixel\">";
    let _ = write!(
        text,
        "<div class=\"panels\">\n<figure>{screen}{}{}<span class=\"seam\"></span>{overlay}</div>\n\
         {}</figure>\n",
        image("golden", &picture.golden),
        image("actual", &picture.actual),
        slider(words),
    );
    match &picture.pixels {
        None => text.push_str("<p class=\"bad\">The two pictures differ in size, so their pixels cannot be compared.</p>\n</div>\n"),
        Some(pixels) => {
            let _ = write!(
                text,
                "<figure>{screen}{}{overlay}</div>\n{}</figure>\n\
                 <div class=\"inspector\" aria-live=\"polite\"><p class=\"note\">Click a pixel to see its ray, both records and the box tests. \
                 Or select a picture with Tab and use the arrow keys.</p></div>\n</div>\n\
                 <script type=\"application/json\">{}</script>\n",
                image("difference", &pixels.difference),
                legend(pixels),
                json_in_script(&data(case, picture, pixels, words).to_string()),
            );
        }
    }
    if !case.rows.is_empty() {
        let _ = write!(
            text,
            "<details><summary>The calls that differ</summary>\n{}</details>\n",
            rows(case)
        );
    }
    text.push_str("</article>\n");
    text
}

/// The slider between two pictures that are one on top of the other.
pub(crate) fn slider(words: &Words) -> String {
    let Words { golden, actual, .. } = words;
    format!(
        "<label class=\"slider\">{golden} <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"how much of the {golden} picture is shown\"> {actual}</label>"
    )
}

fn legend(pixels: &Pixels) -> String {
    let counts = pixels.counts();
    if counts.is_empty() {
        return "<figcaption>No differences.</figcaption>".into();
    }
    let mut text = String::from(
        "<figcaption>Differences, by the first field that differs. Each button goes to the next such pixel.</figcaption>\n<ul class=\"legend\">",
    );
    for (cause, count) in counts {
        let [r, g, b] = cause.colour();
        let _ = write!(
            text,
            "<li><button type=\"button\" data-cause=\"{}\"><span class=\"chip\" style=\"background:rgb({r},{g},{b})\"></span>{}: {count}</button></li>",
            cause as u8,
            escape(cause.label())
        );
    }
    text + "</ul>"
}

/// The data of a picture for the script.
fn data(case: &Case, picture: &Picture, pixels: &Pixels, words: &Words) -> serde_json::Value {
    let [width, height] = picture.actual.size();
    let causes: Vec<u8> = pixels.causes.iter().map(|cause| *cause as u8).collect();
    let mut labels = vec![Cause::Same.label()];
    labels.extend(Cause::DIFFERENCES.map(Cause::label));
    let (wrong, not_judged) = verdicts(case, pixels);
    let exact = pixels.exact.as_ref();
    let hits = pixels.golden.hits.as_ref();
    let hits: Option<Vec<u8>> = hits.map(|hits| hits.iter().map(|&hit| u8::from(hit)).collect());
    json!({
        "width": width,
        "height": height,
        "labels": labels,
        "words": words,
        "causes": base64(&causes),
        "question": pixels.question,
        "golden": json!({
            "calls": pixels.golden.calls,
            "records": pixels.golden.records,
            "hits": hits.map(|hits| base64(&hits)),
        }),
        "actual": pixels.actual,
        "exact": exact.map(|exact| json!({ "calls": exact.calls, "records": exact.records })),
        "wrong": wrong,
        "notJudged": not_judged,
        "boxes": pixels.boxes,
    })
}

/// Texts for some calls.
type Texts = BTreeMap<usize, Vec<String>>;

/// The wrong aspects of the pixels that differ, and those that are not judged.
fn verdicts(case: &Case, pixels: &Pixels) -> (Texts, Texts) {
    let (mut wrong, mut not_judged) = (Texts::new(), Texts::new());
    let causes = pixels.causes.iter().enumerate();
    for (call, _) in causes.filter(|(_, cause)| **cause != Cause::Same) {
        match case.whole.verdict(call as u32) {
            Verdict::Confirmed => {}
            Verdict::Refused(aspects) => {
                let labels = aspects.iter().map(|aspect| aspect.label().to_string());
                wrong.insert(call, labels.collect());
            }
            Verdict::NotJudged(open) => {
                let open = open
                    .iter()
                    .map(|open| format!("{} ({})", open.aspect.label(), open.why));
                not_judged.insert(call, open.collect());
            }
        }
    }
    (wrong, not_judged)
}
