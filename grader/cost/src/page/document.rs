//! The HTML document around the figures.

use super::formatting::capital;
use super::{cdf, convergence, heatmap, leaks, pareto, trees};
use crate::report::{CostReport, KernelFamily, Shape};
use grader::error::GraderError;
use pages::html::escape;
use std::fmt::Write;

/// Black on white, one column; no figure is split between printed pages.
const STYLE: &str = "\
body{font:11pt/1.45 system-ui,'Liberation Sans',Arial,sans-serif;color:#111;background:#fff;max-width:900pt;margin:1.5em auto;padding:0 1.2em}\
h1{font-size:19pt;margin:.2em 0}h2{font-size:15pt;margin:1.6em 0 .3em;border-bottom:1px solid #bbb}h3{font-size:12pt;margin:1.2em 0 .3em}\
figure{margin:0 0 1em;break-inside:avoid}figcaption{max-width:62em}svg text{font-family:system-ui,'Liberation Sans',Arial,sans-serif}\
.machine{color:#333}.pair{display:flex;flex-wrap:wrap;gap:1em}.pair img{image-rendering:pixelated;width:100%;height:auto}\
.pair figure{flex:0 1 400pt}nav a{margin-right:1em}h2,h3{break-after:avoid}\
@page{size:A4 landscape;margin:12mm}@media print{body{font-size:10pt;margin:0;padding:0;max-width:none}nav{display:none}a{color:inherit;text-decoration:none}}";

/// Returns the HTML page of the results.
pub fn page(report: &CostReport) -> Result<String, GraderError> {
    let mut sections: Vec<(String, String)> = Vec::new();
    for family in report
        .families
        .iter()
        .filter(|family| !family.rows.is_empty())
    {
        sections.push((title(family.shape).into(), family_section(family)?));
    }
    if let Some(trees) = &report.bvh {
        let mut section = String::new();
        add(
            &mut section,
            "Build time and tracing time",
            Some(trees::figure(trees)?),
            None,
        );
        sections.push(("Trees".into(), section));
    }
    if let Some(pictures) = &report.pictures {
        let mut section = String::new();
        for experiment in &pictures.experiments {
            let shown = if experiment.curves.is_empty() {
                None
            } else {
                Some(convergence::figure(experiment)?)
            };
            add(
                &mut section,
                &experiment.title,
                shown,
                experiment.missing.as_deref(),
            );
        }
        if let Some(missing) = &pictures.missing {
            let _ = writeln!(section, "<p>No pictures: {}.</p>", escape(missing));
        }
        sections.push(("Pictures".into(), section));
    }
    let machine = &report.machine;
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>The cost of accuracy</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>The cost of accuracy</h1>\n\
         <p class=\"machine\">{} with {} threads, {}, built for {}; seed {}{}. Times depend on the machine; all other numbers \
         depend only on the seed.</p>\n<nav>",
        escape(&machine.cpu),
        machine.cores,
        escape(&machine.rustc),
        escape(&machine.target_features.join(" ")),
        report.seed,
        if report.quick {
            "; few rays and samples (--quick), so times and rates of rare events are less precise"
        } else {
            ""
        },
    );
    for (i, (title, _)) in sections.iter().enumerate() {
        let _ = write!(html, "<a href=\"#s{i}\">{title}</a>");
    }
    html.push_str("</nav>\n");
    for (i, (title, section)) in sections.iter().enumerate() {
        let _ = write!(html, "<h2 id=\"s{i}\">{title}</h2>\n{section}");
    }
    html.push_str("</body>\n</html>\n");
    Ok(html)
}

fn title(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "Triangles",
        Shape::Sphere => "Spheres",
        Shape::Box => "Boxes",
    }
}

fn family_section(family: &KernelFamily) -> Result<String, GraderError> {
    let mut section = String::new();
    let missing = family
        .student_missing
        .as_ref()
        .map(|why| format!("your code: {why}"));
    add(
        &mut section,
        "Accuracy against time",
        Some(pareto::figure(family)?),
        missing.as_deref(),
    );
    add(
        &mut section,
        "Accuracy by family of rays",
        Some(heatmap::figure(family)?),
        None,
    );
    add(&mut section, "Error of t", Some(cdf::figure(family)?), None);
    if family.shape == Shape::Triangle
        && let Some(figure) = leaks::figure(family)?
    {
        add(&mut section, "Leaks", Some(figure), None);
    }
    Ok(section)
}

/// Adds a figure with its heading, its caption and what is missing.
fn add(
    section: &mut String,
    heading: &str,
    figure: Option<(String, String)>,
    missing: Option<&str>,
) {
    let _ = writeln!(section, "<h3>{}</h3>", escape(&capital(heading)));
    if let Some((figure_html, caption)) = figure {
        let caption = escape(caption.trim_end());
        let _ = writeln!(
            section,
            "<figure>\n{figure_html}\n<figcaption>{caption}</figcaption>\n</figure>"
        );
    }
    if let Some(missing) = missing {
        let _ = writeln!(section, "<p>Missing: {}.</p>", escape(missing));
    }
}
