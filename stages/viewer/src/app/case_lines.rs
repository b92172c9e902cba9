//! What is drawn of a case in 3D.

use super::colors::{self, Palette, Pattern};
use super::lines::{Hidden, Lines};
use super::ray_lines::{draw_walk, frustum, roulette};
use super::sample_lines;
use crate::digits;
use crate::project::is_drawn;
use crate::report::light_case::LightCase;
use crate::report::tree_case::TreeCase;
use crate::report::visit_case::VisitCase;
use crate::report::{CaseView, OpenCase, RayCase};
use crate::topology::corners;
use crate::tree_walk;
use egui::{Color32, Stroke, Ui};
use judge::shown::ShownRay;
use kit::{FilmSize, Scene, Vec3};
use pathtracer::RayRole;

/// The most boxes or triangles that are drawn.
const MAX_SHAPES: usize = 1500;
/// The most rays of an estimate that are drawn.
const MAX_RAYS: usize = 400;

/// What stands for a line of a legend.
#[derive(Clone, Copy)]
pub(super) enum Sample {
    Dot,
    Ring,
    Cross,
    Line(Pattern),
}

/// What the colours and marks mean.
pub(super) fn legend(view: &CaseView, palette: &Palette) -> Vec<(Sample, Color32, &'static str)> {
    let ray = (
        Sample::Line(Pattern::Solid),
        palette.ray(RayRole::Camera),
        "the ray",
    );
    let (right, wrong) = (palette.right, palette.wrong);
    let (solid, dashed) = (Sample::Line(Pattern::Solid), Sample::Line(Pattern::Dashed));
    match view {
        CaseView::Ray(_) => vec![
            ray,
            (Sample::Cross, wrong, "your answer"),
            (Sample::Ring, right, "the exact answer"),
        ],
        CaseView::Tree(_) => vec![
            (solid, palette.selected, "the box of the node"),
            (solid, right, "what it must contain"),
            (dashed, wrong, "wrong nodes"),
            (Sample::Line(Pattern::Dotted), palette.line, "primitives"),
        ],
        CaseView::Visits(_) => vec![
            ray,
            (solid, right, "boxes that it enters"),
            (Sample::Ring, right, "the exact hit"),
            (Sample::Cross, wrong, "your hit"),
            (
                dashed,
                palette.attention,
                "behind a hit, or the walked test",
            ),
        ],
        CaseView::Light(_) => vec![
            (
                dashed,
                palette.ray(RayRole::Bounce),
                "your rays that hit nothing",
            ),
            (solid, wrong, "your rays that hit something"),
            (solid, right, "right directions, where there is one"),
            (Sample::Dot, palette.attention, "lights"),
        ],
        CaseView::Pixel(case) => sample_lines::pixel_legend(case, palette),
        CaseView::Scatter(case) => sample_lines::scatter_legend(case, palette),
        CaseView::Plot(case) => sample_lines::plot_legend(case, palette),
    }
}

/// Draws a case.
pub(super) fn draw(lines: &Lines<'_>, ui: &Ui, opened: &OpenCase, view: &CaseView) {
    match view {
        CaseView::Ray(case) => ray(lines, ui, case),
        CaseView::Tree(case) => tree(lines, case, opened.walk.node()),
        CaseView::Visits(case) => visits(lines, ui, case, opened.step),
        CaseView::Light(case) => light(lines, ui, case),
        CaseView::Pixel(case) => sample_lines::pixel(lines, ui, case),
        CaseView::Scatter(case) => sample_lines::scatter(lines, ui, case),
        CaseView::Plot(case) => sample_lines::plot(lines, ui, case),
    }
}

fn ray(lines: &Lines<'_>, ui: &Ui, case: &RayCase) {
    let max_t = case.max_t.filter(|max_t| !max_t.is_right());
    let case = &case.shown;
    let edge = Stroke::new(1.5, ui.visuals().text_color());
    let fill = Color32::from_rgb(120, 140, 200).gamma_multiply(0.3);
    for triangle in &case.scene.triangles {
        lines.triangle(corners(triangle), fill, edge);
    }
    for sphere in &case.scene.spheres {
        lines.ball(sphere.center, sphere.radius, edge);
    }
    for b in &case.boxes {
        lines.aabb(b, edge, Hidden::Shown);
    }
    let size = case.bounds().extent().length().max(1e-300);
    if let Some((camera, _)) = &case.camera {
        let film = FilmSize { w: 10, h: 10 };
        frustum(lines, camera, film, 1.0, colors::line(ui), None);
    }
    let ray = &case.ray;
    let farthest = case.yours.iter().chain(&case.expected).copied();
    let reach = farthest.fold(1.5 * size / ray.d.length(), f64::max);
    let end = ray.max_t.min(reach);
    let color = lines.palette.ray(RayRole::Camera);
    let start = ray.min_t.max(-reach);
    let stroke = Stroke::new(2.5, color);
    lines.line(ray.at(start), ray.at(end), stroke, Hidden::Shown);
    lines.disc(ray.o, 4.0, color);
    if let Some([right, yours]) = case.normals {
        let at = case.expected.first().or(case.yours.first());
        normals(
            lines,
            ray.at(at.copied().unwrap_or(0.0)),
            right,
            yours,
            0.25 * shape_size(case),
        );
    }
    hits(lines, ray, &case.expected, &case.yours);
    if let Some(max_t) = max_t {
        for (t, name, color, side) in [
            (max_t.right, "exact max_t", lines.palette.right, 1.0),
            (max_t.yours, "your max_t", lines.palette.wrong, -1.0),
        ] {
            // An endless range is marked where the drawing of the ray ends.
            let name = format!("{name} = {}", digits::shortened(&format!("{t:?}")));
            lines.end_mark(ray.at(t.clamp(-reach, reach)), ray.d, color, &name, side);
        }
    }
}

/// The size of the shapes of a case.
fn shape_size(case: &ShownRay) -> f64 {
    let boxes = case.boxes.iter();
    let bounds = boxes.fold(case.scene.bounds(), |all, b| all.union(*b));
    match bounds.extent().length() {
        size if size.is_finite() && size > 0.0 => size,
        _ => 1.0,
    }
}

/// The exact normal and that of the stage as arrows, or one arrow if they are alike.
fn normals(lines: &Lines<'_>, p: Vec3, right: Vec3, yours: Vec3, length: f64) {
    let is_alike = right.distance(yours) < SAME_NORMAL;
    let name = if is_alike { "n" } else { "exact n" };
    lines.arrow(p, right, length, lines.palette.right, name);
    if !is_alike && yours.is_finite() {
        // The length of a normal may be what is wrong: it is drawn as it is, within reason.
        let shown = yours.clamp_length_max(3.0) * length;
        let color = lines.palette.wrong;
        lines.patterned_arrow(p, shown, color, "your n", Pattern::Dashed);
    }
}

/// Normals that are closer than this look alike.
const SAME_NORMAL: f64 = 1e-3;

/// The exact hits, and over them those of the stage.
fn hits(lines: &Lines<'_>, ray: &kit::Ray, right: &[f64], student: &[f64]) {
    for &t in right {
        lines.ring(ray.at(t), lines.palette.right);
    }
    for &t in student {
        lines.cross(ray.at(t), lines.palette.wrong);
    }
}

fn tree(lines: &Lines<'_>, case: &TreeCase, node: u32) {
    let below: Vec<_> = tree_walk::primitives(&case.tree, node).collect();
    let step = below.len().div_ceil(MAX_SHAPES).max(1);
    for prim in below.iter().step_by(step) {
        let Some(b) = case.primitives.get(prim.0 as usize) else {
            continue;
        };
        if is_drawn(b) {
            let stroke = Stroke::new(1.0, lines.palette.line);
            lines.patterned_box(b, stroke, Hidden::Shown, Pattern::Dotted);
        }
    }
    let bounds = |node: u32| case.tree.nodes.get(node as usize).map(|node| node.bounds);
    for wrong in case.wrong.iter().take(MAX_SHAPES) {
        if let Some(b) = bounds(wrong.node) {
            let stroke = Stroke::new(1.5, lines.palette.wrong);
            lines.patterned_box(&b, stroke, Hidden::Shown, Pattern::Dashed);
        }
    }
    for child in tree_walk::children(&case.tree, node).into_iter().flatten() {
        if let Some(b) = bounds(child) {
            lines.aabb(&b, Stroke::new(1.0, lines.palette.line), Hidden::Shown);
        }
    }
    if let Some(b) = bounds(node) {
        lines.aabb(&b, Stroke::new(3.5, lines.palette.selected), Hidden::Shown);
    }
    if let Some(b) = case.exact.get(node as usize) {
        lines.aabb(b, Stroke::new(1.5, lines.palette.right), Hidden::Shown);
    }
}

fn visits(lines: &Lines<'_>, ui: &Ui, case: &VisitCase, step: usize) {
    let thin = Stroke::new(1.0, colors::line(ui).gamma_multiply(0.6));
    let triangles = &case.scene.triangles;
    for triangle in triangles
        .iter()
        .step_by(triangles.len().div_ceil(MAX_SHAPES).max(1))
    {
        lines.outline(&corners(triangle), thin, Hidden::Shown, Pattern::Solid);
    }
    // Where only the results of tests are given, the boxes are all that there is to see.
    if case.scene.is_empty() {
        let nodes = &case.tree.nodes;
        for node in nodes
            .iter()
            .take(MAX_SHAPES)
            .filter(|n| is_drawn(&n.bounds))
        {
            lines.aabb(&node.bounds, thin, Hidden::Shown);
        }
    }
    let record = &case.record;
    let with_shapes = (!case.scene.is_empty()).then_some(&case.scene);
    draw_walk(
        lines,
        record,
        step,
        with_shapes.unwrap_or(&Scene::default()),
    );
    let reach = reach(case);
    let student = match record.outcome {
        pathtracer::replay::Outcome::Hit(hit) => vec![hit.t],
        _ => Vec::new(),
    };
    let right: Vec<f64> = case.right.iter().map(|(_, t)| *t).collect();
    let ray = &record.ray;
    let end = student.first().copied().unwrap_or(ray.max_t).min(reach);
    let stroke = Stroke::new(2.5, lines.palette.ray(record.role));
    lines.line(
        ray.at(ray.min_t.max(-reach)),
        ray.at(end),
        stroke,
        Hidden::Shown,
    );
    let before = Stroke::new(1.0, stroke.color.gamma_multiply(0.4));
    lines.line(ray.o, ray.at(ray.min_t.max(-reach)), before, Hidden::Shown);
    lines.disc(ray.o, 4.0, stroke.color);
    hits(lines, ray, &right, &student);
}

/// How far the ray of a traversal is drawn.
fn reach(case: &VisitCase) -> f64 {
    let bounds = CaseView::Visits(case.clone()).bounds();
    1.2 * bounds.extent().length() / case.record.ray.d.length()
}

fn light(lines: &Lines<'_>, ui: &Ui, case: &LightCase) {
    let size = case.bounds().extent().length().max(1e-3);
    for panel in &case.panels {
        let color = match panel.shines {
            true => lines.palette.attention,
            false => ui.visuals().text_color(),
        };
        let [a, b, c, d] = panel.corners;
        let fill = color.gamma_multiply(0.15);
        for triangle in [[a, b, c], [a, c, d]] {
            lines.triangle(triangle, fill, Stroke::NONE);
        }
        let stroke = Stroke::new(1.5, color);
        lines.outline(&panel.corners, stroke, Hidden::Shown, Pattern::Solid);
    }
    for &at in &case.lights {
        lines.disc(at, 6.0, lines.palette.attention);
    }
    let length = 0.12 * size;
    for traced in case.rays.iter().take(MAX_RAYS) {
        let (color, pattern) = match traced.is_hit {
            true => (lines.palette.wrong, Pattern::Solid),
            false => (lines.palette.ray(RayRole::Bounce), Pattern::Dashed),
        };
        let ray = &traced.ray;
        let end = ray.max_t.min(0.5 * size / ray.d.length());
        let stroke = Stroke::new(1.2, color.gamma_multiply(0.8));
        lines.patterned(ray.o, ray.at(end), stroke, Hidden::Shown, pattern);
    }
    for &(o, d) in &case.right {
        lines.arrow(o, d, 1.5 * length, lines.palette.right, "");
    }
    for point in &case.points {
        lines.arrow(
            point.p,
            point.n,
            length,
            ui.visuals().strong_text_color(),
            "n",
        );
        lines.disc(point.p, 4.0, lines.palette.selected);
    }
    for &(p, factor) in &case.roulettes {
        roulette(lines, p, factor);
    }
    for &(p, wo) in &case.viewers {
        let color = lines.palette.ray(RayRole::Camera);
        let towards: Vec3 = wo;
        lines.arrow(p, towards, length, color, "to the viewer");
    }
}
