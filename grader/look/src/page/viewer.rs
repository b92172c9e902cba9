//! Two pictures, compared in several ways: wipe, side by side, blink, by cause, by magnitude.

use super::words::Words;
use crate::magnitude;
use pages::html::{chip, png_data_uri};
use pictures::Image;
use std::fmt::Write;

/// Formats the viewer. `difference` is the picture of the causes, `legend` the HTML below it. If
/// the sizes differ, the pictures are only shown beside each other.
pub fn viewer(
    golden: &Image,
    actual: &Image,
    difference: Option<&Image>,
    legend: &str,
    words: &Words,
) -> String {
    let magnitude = magnitude::image(golden, actual);
    let Words {
        golden: old,
        actual: new,
        ..
    } = words;
    let mut modes = Vec::new();
    if magnitude.is_some() {
        modes.extend([
            ("wipe", "wipe".to_string()),
            ("side", "side by side".into()),
            ("blink", "blink".into()),
        ]);
    } else {
        modes.push(("side", "side by side".to_string()));
    }
    modes.push(("golden", format!("{old} <kbd>a</kbd>")));
    modes.push(("actual", format!("{new} <kbd>b</kbd>")));
    if difference.is_some() {
        modes.push(("cause", "difference by cause".into()));
    }
    if magnitude.is_some() {
        modes.push(("magnitude", "by magnitude".into()));
    }
    let first = modes[0].0;
    let mut text = format!(
        "<div class=\"viewer\" data-show=\"{first}\">\n<div class=\"tools\" role=\"toolbar\" aria-label=\"how to compare the pictures\">"
    );
    for (mode, label) in &modes {
        let _ = write!(
            text,
            "<button type=\"button\" data-mode=\"{mode}\" aria-pressed=\"{}\">{label}</button>",
            *mode == first
        );
    }
    text.push_str(
        "<span class=\"zoom\"><button type=\"button\" data-zoom=\"0.5\" aria-label=\"zoom out\">−</button><output>1×</output>\
         <button type=\"button\" data-zoom=\"2\" aria-label=\"zoom in\">+</button><button type=\"button\" data-zoom=\"0\">fit</button></span></div>\n",
    );
    let [w, h] = actual.size();
    let image = |who: &str, name: &str, picture: &Image| {
        format!(
            "<b class=\"who\" data-of=\"{who}\">{name}</b><img data-who=\"{who}\" alt=\"{name}\" title=\"{name}\" src=\"{}\">",
            png_data_uri(picture)
        )
    };
    let _ = write!(
        text,
        "<div class=\"stage\" style=\"--ratio:{}\"><div class=\"screen\" tabindex=\"0\" role=\"application\" aria-label=\"picture: arrow keys choose a pixel, + and − zoom\" \
         style=\"aspect-ratio:{w}/{h}\"><div class=\"layer\">{}{}",
        f64::from(w) / f64::from(h),
        image("golden", old, golden),
        image("actual", new, actual),
    );
    if let Some(difference) = difference {
        text.push_str(&image("cause", "difference by cause", difference));
    }
    if let Some(magnitude) = &magnitude {
        text.push_str(&image("magnitude", "difference by magnitude", magnitude));
    }
    let _ = write!(
        text,
        "<span class=\"seam\"></span><svg viewBox=\"0 0 {w} {h}\" preserveAspectRatio=\"none\" aria-hidden=\"true\"></svg></div>\
         <span class=\"half\">{old}</span><span class=\"half right\">{new}</span></div></div>\n\
         <label class=\"slider\">{old} <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"how much of the {old} picture is shown\"> {new}</label>\n\
         <div class=\"caption cause\">{legend}</div>\n<div class=\"caption magnitude\">{}</div>\n</div>\n",
        magnitudes()
    );
    text
}

/// The legend of the differences by magnitude.
fn magnitudes() -> String {
    let mut text = String::from(
        "<p class=\"note\">The largest difference of a channel, of 255, is at least</p><ul class=\"legend\">",
    );
    for (least, colour) in magnitude::legend() {
        let _ = write!(text, "<li>{}{least}</li>", chip(colour));
    }
    text + "</ul>"
}
