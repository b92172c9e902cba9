//! Accepting or refusing changes on the page: it writes the command and a line for the changelog.

/// The script of the decisions.
pub(super) const SCRIPT: &str = include_str!("decision.js");

/// The buttons of a case. `is_refuted` cannot be accepted: `grader bless` would refuse it.
pub(super) fn buttons(is_refuted: bool) -> String {
    let accept = match is_refuted {
        true => "disabled title=\"`grader bless` accepts no answer that the exact oracle refutes\"",
        false => "aria-pressed=\"false\"",
    };
    format!(
        "<div class=\"decide\"><button type=\"button\" data-decide=\"accept\" {accept}>accept <kbd>y</kbd></button>\
         <button type=\"button\" data-decide=\"refuse\" aria-pressed=\"false\">refuse <kbd>x</kbd></button></div>\n"
    )
}

/// The bar at the top of the page, with the keys.
pub(super) const BAR: &str = "<nav class=\"topbar\" aria-label=\"changed cases\">\
    <button type=\"button\" data-go=\"-1\">previous <kbd>p</kbd></button>\
    <button type=\"button\" data-go=\"1\">next <kbd>n</kbd></button>\
    <output></output><a href=\"#decision\">decision</a></nav>\n";

/// The section at the end of the page.
pub(super) const SECTION: &str = "<section id=\"decision\" class=\"decision\">\n<h2>Decision</h2>\n\
    <p class=\"note\">Accept or refuse each change above; this page then writes the command that stores \
    the accepted ones, and a line for the changelog.</p>\n\
    <p><button type=\"button\" data-all=\"accept\">accept all that the exact oracle does not refute</button></p>\n\
    <p><label>Why they change: <input type=\"text\" class=\"why\" placeholder=\"the triangle test rounds less\"></label></p>\n\
    <h3>Command</h3>\n<div class=\"copy\"><pre data-out=\"command\"># nothing is accepted yet</pre><button type=\"button\">copy</button></div>\n\
    <h3>CHANGELOG.md, under Reviewers</h3>\n<div class=\"copy\"><pre data-out=\"changelog\"># nothing is accepted yet</pre><button type=\"button\">copy</button></div>\n\
    <h3>Refused</h3>\n<div class=\"copy\"><pre data-out=\"refused\"># nothing is refused</pre><button type=\"button\">copy</button></div>\n\
    </section>\n";
