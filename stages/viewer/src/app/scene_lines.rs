//! The lines of each mode over the traced picture: grid, selection, boxes, the scene as wires.

use super::colors::{self, Pattern};
use super::lines::{Hidden, Lines};
use super::ray_lines::{FILM_DISTANCE, camera_rays, frustum, replay};
use crate::session::{Mode, Session};
use crate::topology::{Element, corners};
use crate::tree_walk;
use egui::{Color32, Rect, Stroke, Ui};
use kit::Vec3;
use pathtracer::RayRole;

/// The number of boxes of the tree that are drawn.
const MAX_BOXES: usize = 400;
/// The number of edges that are drawn if the scene cannot be traced.
const MAX_EDGES: usize = 20_000;

/// The axes, of length 1, and the grid of ±4 in the plane y = 0.
fn axes_and_grid(lines: &Lines<'_>, ui: &Ui) {
    let faint = Stroke::new(1.0, colors::line(ui).gamma_multiply(0.55));
    for i in -4..=4 {
        let i = f64::from(i);
        lines.line(
            Vec3::new(i, 0.0, -4.0),
            Vec3::new(i, 0.0, 4.0),
            faint,
            Hidden::Left,
        );
        lines.line(
            Vec3::new(-4.0, 0.0, i),
            Vec3::new(4.0, 0.0, i),
            faint,
            Hidden::Left,
        );
    }
    let axes = [
        (Vec3::X, "x", lines.palette.wrong),
        (Vec3::Y, "y", lines.palette.right),
        (Vec3::Z, "z", lines.palette.ray(RayRole::Camera)),
    ];
    for (axis, name, color) in axes {
        lines.line(Vec3::ZERO, axis, Stroke::new(2.0, color), Hidden::Faint);
        lines.name_at(axis, color, name);
    }
}

/// What is selected, and what is under the mouse.
fn selection(lines: &Lines<'_>, session: &Session) {
    let hovered = session
        .hovered()
        .map(|element| (element, lines.palette.attention));
    let selected = session
        .selection()
        .map(|element| (element, lines.palette.selected));
    for (element, color) in hovered.into_iter().chain(selected) {
        let (Some(topology), Some(scene)) = (session.topology(), session.scene()) else {
            return;
        };
        let stroke = Stroke::new(3.0, color);
        match element {
            Element::Vertex(v) => {
                let moved = session
                    .selected_vertex_position()
                    .filter(|_| session.selection() == Some(element));
                lines.disc(moved.unwrap_or(topology.position(v)), 5.0, color);
            }
            Element::Edge(a, b) => {
                let ends = (topology.position(a), topology.position(b));
                lines.line(ends.0, ends.1, stroke, Hidden::Faint);
            }
            Element::Face(t) => {
                let points = topology.vertices_of(t).map(|v| topology.position(v));
                let fill = color.gamma_multiply(0.35);
                let is_tinted = lines.tint(t, fill);
                let fill = if is_tinted {
                    Color32::TRANSPARENT
                } else {
                    fill
                };
                lines.face(points, fill, Stroke::new(1.5, color));
            }
            Element::Sphere(s) => {
                if let (Some(sphere), Some(orbit)) =
                    (scene.scene().spheres.get(s as usize), session.view_orbit())
                {
                    lines.sphere(sphere.center, sphere.radius, &orbit.camera(), stroke);
                }
            }
        }
    }
}

/// The boxes of the tree: those around the selected node, its children, and itself.
fn tree_boxes(lines: &Lines<'_>, session: &Session) {
    let Some(tree) = session.scene().and_then(|scene| scene.bvh()) else {
        return;
    };
    if session.shows_wide_tree() {
        return wide_boxes(lines, session);
    }
    let node = session.walk().node();
    let grey = Stroke::new(1.0, Color32::from_gray(140).gamma_multiply(0.25));
    let below = tree_walk::subtree(tree, node).filter(|(_, depth)| *depth <= 4);
    for (other, _) in below.take(MAX_BOXES) {
        lines.aabb(&tree.nodes[other as usize].bounds, grey, Hidden::Shown);
    }
    for child in tree_walk::children(tree, node).into_iter().flatten() {
        if let Some(child) = tree.nodes.get(child as usize) {
            let white = Stroke::new(1.5, Color32::from_gray(200).gamma_multiply(0.8));
            lines.aabb(&child.bounds, white, Hidden::Faint);
        }
    }
    if let Some(selected) = tree.nodes.get(node as usize) {
        let stroke = Stroke::new(3.0, lines.palette.selected.gamma_multiply(0.8));
        lines.aabb(&selected.bounds, stroke, Hidden::Faint);
    }
}

/// The boxes of the wide tree down to the depth of the walk: the deepest ones in bold.
fn wide_boxes(lines: &Lines<'_>, session: &Session) {
    let depth = session.walk().depth();
    for (b, at) in session.wide_boxes().iter().filter(|(_, at)| *at <= depth) {
        let stroke = if *at == depth {
            Stroke::new(1.5, lines.palette.selected.gamma_multiply(0.8))
        } else {
            Stroke::new(1.0, Color32::from_gray(140).gamma_multiply(0.35))
        };
        lines.aabb(b, stroke, Hidden::Faint);
    }
}

/// The scene as lines, where it cannot be traced.
fn wireframe(lines: &Lines<'_>, session: &Session, ui: &Ui) {
    let (Some(scene), Some(orbit)) = (session.scene(), session.view_orbit()) else {
        return;
    };
    let stroke = Stroke::new(1.0, colors::line(ui));
    let triangles = &scene.scene().triangles;
    let step = (3 * triangles.len()).div_ceil(MAX_EDGES).max(1);
    for triangle in triangles.iter().step_by(step) {
        lines.outline(&corners(triangle), stroke, Hidden::Shown, Pattern::Solid);
    }
    for sphere in &scene.scene().spheres {
        lines.sphere(sphere.center, sphere.radius, &orbit.camera(), stroke);
    }
}

/// Everything of a mode, over the traced picture.
pub(super) fn of_session(ui: &Ui, rect: Rect, session: &Session) {
    let Some(request) = session.view_request((rect.width() as u32, rect.height() as u32)) else {
        return;
    };
    let picture = session
        .scene()
        .and_then(|scene| session.view.picture(scene));
    // The lines belong to the picture that is shown.
    let camera = picture.map_or(request.camera, |picture| picture.request.camera);
    let lines = Lines::new(ui, rect, &camera, picture);
    if picture.is_none() {
        wireframe(&lines, session, ui);
    }
    if session.mode() != Mode::Render {
        axes_and_grid(&lines, ui);
    }
    if let (Some(cut), Some(scene)) = (session.cut(), session.scene()) {
        let corners = cut.corners(&scene.bounds);
        let stroke = Stroke::new(1.5, lines.palette.attention);
        lines.outline(&corners, stroke, Hidden::Faint, Pattern::Dashed);
    }
    match session.mode() {
        Mode::Edit => selection(&lines, session),
        Mode::Bvh => tree_boxes(&lines, session),
        Mode::Render | Mode::Report => {}
    }
    if let Some(inspected) = session.inspector.inspected() {
        let job = &inspected.job;
        if session.mode() == Mode::Render || camera.pos != job.camera.pos {
            let depth = FILM_DISTANCE * inspected.scene.bounds.extent().length();
            let pixel = Some(inspected.replay.pixel);
            frustum(
                &lines,
                &job.camera,
                job.film,
                depth,
                colors::line(ui),
                pixel,
            );
        }
    }
    if session.mode() == Mode::Render {
        camera_rays(&lines, ui, session);
    }
    replay(&lines, &session.inspector);
}
