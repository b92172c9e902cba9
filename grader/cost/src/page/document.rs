//! The HTML document around the figures.

use super::{cdf, convergence, exactness, heatmap, leaks, pareto, trees};
use crate::report::{CostReport, KernelFamily, Shape};
use crate::world;
use pages::html::escape;
use plots::canvas::file;
use plots::document::Document;
use std::fmt::Write;

/// The pictures of pages: of leaks side by side, and of equal time.
const STYLE: &str = include_str!("pictures.css");

/// Returns the HTML page of the results.
pub fn page(report: &CostReport) -> String {
    let mut sections: Vec<(String, String)> = Vec::new();
    let families = report.families.iter();
    for family in families.filter(|family| !family.rows.is_empty()) {
        sections.push((title(family.shape).into(), family_section(family)));
    }
    if let Some(trees) = &report.bvh {
        let mut section = String::new();
        if let Some(figure) = exactness::figure(trees) {
            section.push_str(&figure.html());
        }
        section.push_str(&trees::figure(trees).html());
        sections.push(("Trees".into(), section));
    }
    if let Some(rows) = &report.world {
        let figure = world::plot::figure(rows);
        let section = figure.map_or(String::new(), |figure| figure.html());
        sections.push(("Ray casters".into(), section));
    }
    if let Some(pictures) = &report.pictures {
        let mut section = String::new();
        for experiment in &pictures.experiments {
            if !experiment.curves.is_empty() {
                section.push_str(&convergence::figure(experiment).html());
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
    let document = Document {
        title: "The cost of accuracy".into(),
        about: format!(
            "{} with {} threads, {}, built for {}; seed {}{}. Times depend on the machine; all other numbers depend only on the seed.",
            machine.cpu,
            machine.cores,
            machine.rustc,
            machine.target_features.join(" "),
            report.seed,
            if report.quick {
                "; few rays and samples (--quick), so times and rates of rare events are less precise"
            } else {
                ""
            },
        ),
        style: STYLE.into(),
        sections,
    };
    document.html()
}

/// Returns a plot as an SVG file: accuracy against time of the first shape, or else what exactness
/// costs a tree, or else what real ray casters answer; `None` if there is none.
pub fn plot(report: &CostReport) -> Option<String> {
    let mut families = report.families.iter();
    if let Some(family) = families.find(|family| !family.rows.is_empty()) {
        return Some(file(&pareto::figure(family).drawing));
    }
    let trees = report.bvh.as_ref().and_then(exactness::svg_file);
    let casters = || report.world.as_ref().and_then(world::plot::svg_file);
    trees.or_else(casters)
}

fn title(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "Triangles",
        Shape::Sphere => "Spheres",
        Shape::Box => "Boxes",
    }
}

fn family_section(family: &KernelFamily) -> String {
    let mut section = pareto::figure(family).html();
    if let Some(why) = &family.student_missing {
        let _ = writeln!(section, "<p>Missing: your code: {}.</p>", escape(why));
    }
    section.push_str(&heatmap::figure(family).html());
    section.push_str(&cdf::figure(family).html());
    if family.shape == Shape::Triangle
        && let Some(figure) = leaks::figure(family)
    {
        section.push_str(&figure.html());
    }
    section
}
