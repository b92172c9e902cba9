//! The HTML document around the figures.

use super::{cdf, convergence, heatmap, leaks, pareto, trees};
use crate::report::{CostReport, KernelFamily, Shape};
use grader::error::GraderError;
use pages::html::escape;
use std::fmt::Write;

/// One column; no figure is split between printed pages. Plots are drawn in black on white; in a
/// dark page their ink, grid, rims and the darkest colours of the palette are replaced. On a narrow
/// screen, plots and tables scroll by themselves.
const STYLE: &str = "\
:root{--paper:#fcfcfa;--ink:#1c1d21;--soft:#5d6068;--line:#d9dadf;--accent:#0b62a8}\
@media (prefers-color-scheme:dark){:root{--paper:#16171b;--ink:#e9e9ec;--soft:#a2a5ae;--line:#34363e;--accent:#7cc0f4}\
svg [fill='#000000'],svg [fill='#3C3C3C']{fill:#e9e9ec}svg [stroke='#000000']{stroke:#e9e9ec}svg [stroke='#3C3C3C']{stroke:#b6b8be}\
svg [fill='#FFFFFF']{fill:#16171b}svg [stroke='#DEDEDE']{stroke:#34363e}svg [stroke='#AAAAAA']{stroke:#63666e}\
svg [fill='#0072B2']{fill:#4aa3e0}svg [stroke='#0072B2']{stroke:#4aa3e0}svg text[fill='#D55E00']{fill:#f08a3c}svg text[fill='#010101']{fill:#000}svg text[fill='#FEFEFE']{fill:#fff}}\
*{box-sizing:border-box}body{font:1rem/1.5 system-ui,'Liberation Sans',Arial,sans-serif;color:var(--ink);background:var(--paper);max-width:76rem;margin:0 auto;padding:2rem 1.25rem 4rem}\
h1{font-size:2rem;line-height:1.2;margin:.2em 0}h2{font-size:1.4rem;margin:2.5rem 0 .3rem;border-bottom:1px solid var(--line)}h3{font-size:1.1rem;margin:1.6rem 0 .5rem}\
a{color:var(--accent)}figure{margin:0 0 .4rem;break-inside:avoid}figcaption,.machine,details{color:var(--soft);font-size:.9rem;max-width:62rem}summary{cursor:pointer}\
svg text{font-family:system-ui,'Liberation Sans',Arial,sans-serif}.wide{overflow-x:auto;max-width:100%}.wide svg{min-width:46rem}svg.plot{background:none!important}\
.pair{display:flex;flex-wrap:wrap;gap:1rem}.pair img{image-rendering:pixelated;width:100%;height:auto;display:block}.pair figure{flex:1 1 14rem;max-width:25rem}\
.thumbnails{display:grid;grid-template-columns:repeat(auto-fit,minmax(8rem,1fr));gap:.6rem;margin-top:.5rem}.thumbnails img{image-rendering:pixelated;width:100%;height:auto;display:block}\
nav a{margin-right:1em}h2,h3{break-after:avoid}table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}\
th,td{text-align:right;padding:.15rem .7rem .15rem 0;border-bottom:1px solid var(--line);white-space:nowrap}th:first-child{text-align:left;font-weight:600}\
@media (max-width:46rem){body{padding:1.2rem .8rem 3rem}h1{font-size:1.5rem}}\
@page{size:A4 landscape;margin:12mm}@media print{:root{--paper:#fff;--ink:#000;--soft:#333;--line:#bbb}body{font-size:10pt;margin:0;padding:0;max-width:none}nav,details{display:none}\
.wide{overflow:visible}.wide svg{min-width:0;max-height:118mm}a{color:inherit;text-decoration:none}}";

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
        sections.push(("Trees".into(), trees::figure(trees)?.html()));
    }
    if let Some(pictures) = &report.pictures {
        let mut section = String::new();
        for experiment in &pictures.experiments {
            if !experiment.curves.is_empty() {
                section.push_str(&convergence::figure(experiment)?.html());
            }
            if let Some(missing) = &experiment.missing {
                let _ = writeln!(
                    section,
                    "<p>{}: missing: {}.</p>",
                    escape(&experiment.title),
                    escape(missing)
                );
            }
        }
        if let Some(missing) = &pictures.missing {
            let _ = writeln!(section, "<p>No pictures: {}.</p>", escape(missing));
        }
        sections.push(("Pictures".into(), section));
    }
    let machine = &report.machine;
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n<title>The cost of accuracy</title>\n\
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

/// Returns the plot of accuracy against time of the first shape, as an SVG file; `None` if there is
/// none.
pub fn plot(report: &CostReport) -> Result<Option<String>, GraderError> {
    let family = report
        .families
        .iter()
        .find(|family| !family.rows.is_empty());
    family.map(pareto::svg_file).transpose()
}

fn title(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "Triangles",
        Shape::Sphere => "Spheres",
        Shape::Box => "Boxes",
    }
}

fn family_section(family: &KernelFamily) -> Result<String, GraderError> {
    let mut section = pareto::figure(family)?.html();
    if let Some(why) = &family.student_missing {
        let _ = writeln!(section, "<p>Missing: your code: {}.</p>", escape(why));
    }
    section.push_str(&heatmap::figure(family)?.html());
    section.push_str(&cdf::figure(family)?.html());
    if family.shape == Shape::Triangle
        && let Some(figure) = leaks::figure(family)?
    {
        section.push_str(&figure.html());
    }
    Ok(section)
}
