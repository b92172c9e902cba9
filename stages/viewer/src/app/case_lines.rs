//! What is drawn of a case in 3D.

use super::colors;
use super::lines::{Hidden, Lines};
use super::ray_lines::{draw_walk, frustum};
use crate::report::case_view::is_drawn;
use crate::report::light_case::LightCase;
use crate::report::tree_case::TreeCase;
use crate::report::visit_case::VisitCase;
use crate::report::{CaseView, OpenCase, RayCase};
use crate::topology::corners;
use crate::tree_walk;
use egui::{Color32, Stroke, Ui};
use kit::{FilmSize, Scene, Vec3};
use pathtracer::RayRole;

/// The most boxes or triangles that are drawn.
const MAX_SHAPES: usize = 1500;
/// The most rays of an estimate that are drawn.
const MAX_RAYS: usize = 400;

/// What the colours mean.
pub(super) fn legend(view: &CaseView) -> Vec<(Color32, &'static str)> {
    let ray = colors::ray(RayRole::Camera);
    match view {
        CaseView::Ray(_) => vec![
            (ray, "the ray"),
            (colors::WRONG, "your answer"),
            (colors::RIGHT, "the exact answer"),
        ],
        CaseView::Tree(_) => vec![
            (colors::SELECTED, "the box of the node"),
            (colors::RIGHT, "what it must contain"),
            (colors::WRONG, "wrong nodes"),
            (Color32::from_gray(150), "primitives"),
        ],
        CaseView::Visits(_) => vec![
            (ray, "the ray"),
            (colors::RIGHT, "boxes that it enters, the exact hit"),
            (colors::WRONG, "your hit"),
            (colors::HOVERED, "behind a hit, or the walked test"),
        ],
        CaseView::Light(_) => vec![
            (colors::ray(RayRole::Bounce), "your rays that hit nothing"),
            (colors::WRONG, "your rays that hit something"),
            (colors::RIGHT, "right directions, where there is one"),
            (colors::HOVERED, "lights"),
        ],
    }
}

/// Draws a case.
pub(super) fn draw(lines: &Lines<'_>, ui: &Ui, opened: &OpenCase, view: &CaseView) {
    match view {
        CaseView::Ray(case) => ray(lines, ui, case),
        CaseView::Tree(case) => tree(lines, case, opened.walk.node()),
        CaseView::Visits(case) => visits(lines, ui, case, opened.step),
        CaseView::Light(case) => light(lines, ui, case),
    }
}

fn ray(lines: &Lines<'_>, ui: &Ui, case: &RayCase) {
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
    let color = colors::ray(RayRole::Camera);
    let start = ray.min_t.max(-reach);
    let stroke = Stroke::new(2.5, color);
    lines.line(ray.at(start), ray.at(end), stroke, Hidden::Shown);
    lines.disc(ray.o, 4.0, color);
    hits(lines, ray, &case.expected, &case.yours);
}

/// The exact hits, and over them those of the stage.
fn hits(lines: &Lines<'_>, ray: &kit::Ray, right: &[f64], student: &[f64]) {
    for (hits, radius, color) in [(right, 7.0, colors::RIGHT), (student, 4.5, colors::WRONG)] {
        for &t in hits {
            lines.disc(ray.at(t), radius, color);
        }
    }
}

fn tree(lines: &Lines<'_>, case: &TreeCase, node: u32) {
    let thin = |gray, opacity| Stroke::new(1.0, Color32::from_gray(gray).gamma_multiply(opacity));
    let below: Vec<_> = tree_walk::primitives(&case.tree, node).collect();
    let step = below.len().div_ceil(MAX_SHAPES).max(1);
    for prim in below.iter().step_by(step) {
        let Some(b) = case.primitives.get(prim.0 as usize) else {
            continue;
        };
        if is_drawn(b) {
            lines.aabb(b, thin(150, 0.7), Hidden::Shown);
        }
    }
    let bounds = |node: u32| case.tree.nodes.get(node as usize).map(|node| node.bounds);
    for wrong in case.wrong.iter().take(MAX_SHAPES) {
        if let Some(b) = bounds(wrong.node) {
            let stroke = Stroke::new(1.5, colors::WRONG.gamma_multiply(0.6));
            lines.aabb(&b, stroke, Hidden::Shown);
        }
    }
    for child in tree_walk::children(&case.tree, node).into_iter().flatten() {
        if let Some(b) = bounds(child) {
            lines.aabb(&b, thin(210, 0.9), Hidden::Shown);
        }
    }
    if let Some(b) = bounds(node) {
        lines.aabb(&b, Stroke::new(3.5, colors::SELECTED), Hidden::Shown);
    }
    if let Some(b) = case.exact.get(node as usize) {
        lines.aabb(b, Stroke::new(1.5, colors::RIGHT), Hidden::Shown);
    }
}

fn visits(lines: &Lines<'_>, ui: &Ui, case: &VisitCase, step: usize) {
    let thin = Stroke::new(1.0, colors::line(ui).gamma_multiply(0.6));
    let triangles = &case.scene.triangles;
    for triangle in triangles
        .iter()
        .step_by(triangles.len().div_ceil(MAX_SHAPES).max(1))
    {
        let [a, b, c] = corners(triangle);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            lines.line(from, to, thin, Hidden::Shown);
        }
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
    let stroke = Stroke::new(2.5, colors::ray(record.role));
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
            true => colors::HOVERED,
            false => ui.visuals().text_color(),
        };
        let [a, b, c, d] = panel.corners;
        let fill = color.gamma_multiply(0.15);
        for triangle in [[a, b, c], [a, c, d]] {
            lines.triangle(triangle, fill, Stroke::NONE);
        }
        for (from, to) in [(a, b), (b, c), (c, d), (d, a)] {
            lines.line(from, to, Stroke::new(1.5, color), Hidden::Shown);
        }
    }
    for &at in &case.lights {
        lines.disc(at, 6.0, colors::HOVERED);
    }
    let length = 0.12 * size;
    for traced in case.rays.iter().take(MAX_RAYS) {
        let color = match traced.is_hit {
            true => colors::WRONG,
            false => colors::ray(RayRole::Bounce),
        };
        let ray = &traced.ray;
        let end = ray.max_t.min(0.5 * size / ray.d.length());
        let stroke = Stroke::new(1.2, color.gamma_multiply(0.8));
        lines.line(ray.o, ray.at(end), stroke, Hidden::Shown);
    }
    for &(o, d) in &case.right {
        lines.arrow(o, d, 1.5 * length, colors::RIGHT, "");
    }
    for point in &case.points {
        lines.arrow(
            point.p,
            point.n,
            length,
            ui.visuals().strong_text_color(),
            "n",
        );
        lines.disc(point.p, 4.0, colors::SELECTED);
    }
    for &(p, wo) in &case.viewers {
        let color = colors::ray(RayRole::Camera);
        let towards: Vec3 = wo;
        lines.arrow(p, towards, length, color, "to the viewer");
    }
}
