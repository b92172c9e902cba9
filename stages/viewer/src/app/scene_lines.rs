//! Lines in a 3D view: projected here, hidden by the surfaces of the traced picture.

use super::colors;
use crate::inspector::Inspector;
use crate::project::Projection;
use crate::session::{Mode, Session};
use crate::topology::{Element, corners};
use crate::tree_walk;
use crate::view_picture::ViewPicture;
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Ui};
use kit::camera::half_tan;
use kit::{Aabb, Camera, FilmSize, Vec2, Vec3};
use pathtracer::RayRole;
use pathtracer::replay::{Outcome, RayRecord, Test, Visit};

/// What happens to the hidden part of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hidden {
    /// It is drawn as if it were visible.
    Shown,
    /// It is drawn faintly.
    Faint,
    /// It is not drawn.
    Left,
}

/// Draws lines of world space into a view.
pub(super) struct Lines<'a> {
    painter: Painter,
    rect: Rect,
    projection: Projection,
    /// The surfaces that hide lines.
    picture: Option<&'a ViewPicture>,
}

/// The length of the pieces of a line that are visible or hidden as a whole, in points.
const PIECE: f32 = 5.0;
/// The opacity of hidden lines.
const FAINT: f32 = 0.22;
/// The number of boxes of the tree that are drawn.
const MAX_BOXES: usize = 400;
/// The number of edges that are drawn if the scene cannot be traced.
const MAX_EDGES: usize = 20_000;

impl<'a> Lines<'a> {
    pub(super) fn new(
        ui: &Ui,
        rect: Rect,
        camera: &Camera,
        picture: Option<&'a ViewPicture>,
    ) -> Lines<'a> {
        Lines {
            painter: ui.painter_at(rect),
            rect,
            projection: Projection::new(camera),
            // Surfaces of another camera would hide the wrong lines.
            picture: picture.filter(|picture| picture.request.camera == *camera),
        }
    }

    /// Where a position on the film is in the window.
    fn at(&self, film: Vec2) -> Pos2 {
        let rect = self.rect;
        Pos2::new(
            rect.left() + rect.width() * film.x as f32,
            rect.bottom() - rect.height() * film.y as f32,
        )
    }

    /// Where a point appears in the window; `None` behind the camera.
    pub(super) fn point(&self, p: Vec3) -> Option<Pos2> {
        self.projection.point(p).map(|film| self.at(film))
    }

    fn hides(&self, p: Vec3) -> bool {
        let film = self.projection.point(p);
        let (Some(picture), Some(film)) = (self.picture, film) else {
            return false;
        };
        picture.hides(film, self.projection.distance(p))
    }

    /// A line from `a` to `b`.
    pub(super) fn line(&self, a: Vec3, b: Vec3, stroke: Stroke, hidden: Hidden) {
        let Some((a, b)) = self.projection.segment(a, b) else {
            return;
        };
        let (Some(from), Some(to)) = (self.point(a), self.point(b)) else {
            return;
        };
        if hidden == Hidden::Shown || self.picture.is_none() {
            self.painter.line_segment([from, to], stroke);
            return;
        }
        let visible = self
            .rect
            .expand(1.0)
            .intersects(Rect::from_two_pos(from, to));
        if !visible {
            return;
        }
        let pieces = ((from.distance(to) / PIECE).ceil() as usize).clamp(1, 600);
        let share = |i: usize| i as f64 / pieces as f64;
        // The middle of a piece decides; equal neighbours become one stroke.
        let is_hidden = |i: usize| self.hides(self.between(a, b, share(i) + 0.5 / pieces as f64));
        let mut start = 0;
        let mut state = is_hidden(0);
        for i in 1..=pieces {
            let next = i < pieces && is_hidden(i);
            if i < pieces && next == state {
                continue;
            }
            let ends = [share(start), share(i)].map(|s| from.lerp(to, s as f32));
            if !state {
                self.painter.line_segment(ends, stroke);
            } else if hidden == Hidden::Faint {
                let color = stroke.color.gamma_multiply(FAINT);
                self.painter.line_segment(ends, Stroke { color, ..stroke });
            }
            (start, state) = (i, next);
        }
    }

    /// The point of the segment that appears at this share of its length in the window.
    fn between(&self, a: Vec3, b: Vec3, share: f64) -> Vec3 {
        let (za, zb) = (self.projection.depth(a), self.projection.depth(b));
        // Perspective: what is even in the window is even in 1/z.
        let t = share * za / (zb + share * (za - zb));
        a + t * (b - a)
    }

    /// The twelve edges of a box.
    pub(super) fn aabb(&self, b: &Aabb, stroke: Stroke, hidden: Hidden) {
        if b.is_empty() || !(b.min.is_finite() && b.max.is_finite()) {
            return;
        }
        let corner = |i: usize| {
            Vec3::new(
                if i & 1 == 0 { b.min.x } else { b.max.x },
                if i & 2 == 0 { b.min.y } else { b.max.y },
                if i & 4 == 0 { b.min.z } else { b.max.z },
            )
        };
        for i in 0..8 {
            for axis in [1, 2, 4].into_iter().filter(|axis| i & axis == 0) {
                self.line(corner(i), corner(i | axis), stroke, hidden);
            }
        }
    }

    /// A point as a disc.
    pub(super) fn disc(&self, p: Vec3, radius: f32, color: Color32) {
        if let Some(at) = self.point(p) {
            self.painter.circle_filled(at, radius, color);
        }
    }

    /// A filled triangle.
    pub(super) fn triangle(&self, points: [Vec3; 3], fill: Color32, stroke: Stroke) {
        let points: Option<Vec<Pos2>> = points.iter().map(|p| self.point(*p)).collect();
        if let Some(points) = points {
            self.painter
                .add(Shape::convex_polygon(points, fill, stroke));
        }
    }

    /// The outline of a sphere: a circle around its centre, facing the camera.
    pub(super) fn sphere(&self, center: Vec3, radius: f64, camera: &Camera, stroke: Stroke) {
        let circle = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 64.0).sin_cos();
            center + radius * (cos * camera.c2w.x_axis + sin * camera.c2w.y_axis)
        };
        for i in 0..64 {
            self.line(circle(i), circle(i + 1), stroke, Hidden::Shown);
        }
    }

    /// A sphere as three circles.
    pub(super) fn ball(&self, center: Vec3, radius: f64, stroke: Stroke) {
        for (u, v) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
            let at = |i: u32| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 64.0).sin_cos();
                center + radius * (cos * u + sin * v)
            };
            for i in 0..64 {
                self.line(at(i), at(i + 1), stroke, Hidden::Shown);
            }
        }
    }

    /// An arrow along `d` from `o`, as long as `length` points in the window if possible.
    pub(super) fn arrow(&self, o: Vec3, d: Vec3, length: f64, color: Color32, name: &str) {
        let end = o + length * d;
        self.line(o, end, Stroke::new(2.0, color), Hidden::Shown);
        if let Some(at) = self.point(end) {
            self.painter.circle_filled(at, 3.0, color);
            let font = egui::FontId::proportional(12.0);
            let offset = egui::vec2(6.0, -6.0);
            self.painter
                .text(at + offset, egui::Align2::LEFT_BOTTOM, name, font, color);
        }
    }
}

/// The axes, of length 1, and the grid of ±4 in the plane y = 0.
pub(super) fn axes_and_grid(lines: &Lines<'_>, ui: &Ui) {
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
        (Vec3::X, Color32::from_rgb(220, 70, 70)),
        (Vec3::Y, Color32::from_rgb(80, 180, 80)),
        (Vec3::Z, Color32::from_rgb(80, 120, 240)),
    ];
    for (axis, color) in axes {
        lines.line(Vec3::ZERO, axis, Stroke::new(2.0, color), Hidden::Faint);
    }
}

/// What is selected, and what is under the mouse.
pub(super) fn selection(lines: &Lines<'_>, session: &Session) {
    let hovered = session.hovered().map(|element| (element, colors::HOVERED));
    let selected = session
        .selection()
        .map(|element| (element, colors::SELECTED));
    for (element, color) in hovered.into_iter().chain(selected) {
        let (Some(topology), Some(scene)) = (session.topology(), session.scene()) else {
            return;
        };
        let stroke = Stroke::new(3.0, color);
        match element {
            Element::Vertex(v) => {
                let moved = session.selected_vertex_position();
                let moved = moved.filter(|_| session.selection() == Some(element));
                lines.disc(moved.unwrap_or(topology.position(v)), 5.0, color);
            }
            Element::Edge(a, b) => {
                let ends = (topology.position(a), topology.position(b));
                lines.line(ends.0, ends.1, stroke, Hidden::Shown);
            }
            Element::Face(t) => {
                let points = topology.vertices_of(t).map(|v| topology.position(v));
                lines.triangle(points, color.gamma_multiply(0.35), Stroke::new(1.5, color));
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
pub(super) fn tree_boxes(lines: &Lines<'_>, session: &Session) {
    let Some(tree) = session.scene().and_then(|scene| scene.bvh()) else {
        return;
    };
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
        let stroke = Stroke::new(3.0, colors::SELECTED.gamma_multiply(0.8));
        lines.aabb(&selected.bounds, stroke, Hidden::Faint);
    }
}

/// The scene as lines, where it cannot be traced.
pub(super) fn wireframe(lines: &Lines<'_>, session: &Session, ui: &Ui) {
    let (Some(scene), Some(orbit)) = (session.scene(), session.view_orbit()) else {
        return;
    };
    let stroke = Stroke::new(1.0, colors::line(ui));
    let triangles = &scene.scene().triangles;
    let step = (3 * triangles.len()).div_ceil(MAX_EDGES).max(1);
    for triangle in triangles.iter().step_by(step) {
        let [a, b, c] = corners(triangle);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            lines.line(from, to, stroke, Hidden::Shown);
        }
    }
    for sphere in &scene.scene().spheres {
        lines.sphere(sphere.center, sphere.radius, &orbit.camera(), stroke);
    }
}

/// A camera: its pyramid of view up to `depth`, and the grid of its pixels if there are few.
pub(super) fn frustum(
    lines: &Lines<'_>,
    camera: &Camera,
    film: FilmSize,
    depth: f64,
    color: Color32,
    pixel: Option<(u32, u32)>,
) {
    let half = Vec2::new(half_tan(camera.h_fov), half_tan(camera.v_fov));
    let at = |x: f64, y: f64| {
        let on_plane = (2.0 * Vec2::new(x, y) - 1.0) * half;
        camera.pos + depth * (camera.c2w * Vec3::new(on_plane.x, on_plane.y, -1.0))
    };
    let stroke = Stroke::new(1.5, color);
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    for (i, corner) in corners.iter().enumerate() {
        lines.line(camera.pos, *corner, stroke, Hidden::Faint);
        lines.line(*corner, corners[(i + 1) % 4], stroke, Hidden::Faint);
    }
    let rectangle = |x0: f64, y0: f64, x1: f64, y1: f64, stroke: Stroke| {
        let corners = [at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)];
        for (i, corner) in corners.iter().enumerate() {
            lines.line(*corner, corners[(i + 1) % 4], stroke, Hidden::Shown);
        }
    };
    let (w, h) = (f64::from(film.w), f64::from(film.h));
    // The grid: every pixel of a small film, else every tenth of a film's edge.
    let (columns, rows) = (w.min(10.0), h.min(10.0));
    let thin = Stroke::new(0.7, color.gamma_multiply(0.45));
    for i in 1..columns as u32 {
        let x = f64::from(i) / columns;
        lines.line(at(x, 0.0), at(x, 1.0), thin, Hidden::Faint);
    }
    for i in 1..rows as u32 {
        let y = f64::from(i) / rows;
        lines.line(at(0.0, y), at(1.0, y), thin, Hidden::Faint);
    }
    if let Some((x, y)) = pixel {
        let (x, y) = (f64::from(x), f64::from(y));
        let stroke = Stroke::new(2.0, colors::SELECTED);
        rectangle(x / w, y / h, (x + 1.0) / w, (y + 1.0) / h, stroke);
    }
}

/// The rays of the replay, the selected one with the boxes of its walk.
pub(super) fn replay(lines: &Lines<'_>, inspector: &Inspector) {
    let Some(inspected) = inspector.inspected() else {
        return;
    };
    let (sample, ray, step) = inspector.position();
    let size = inspected.scene.bounds.extent().length();
    for (s, record) in inspected.replay.samples.iter().enumerate() {
        if inspector.filter.one_sample && s != sample {
            continue;
        }
        for (r, record) in record.rays.iter().enumerate() {
            let is_selected = (s, r) == (sample, ray);
            if inspector.filter.shows(record) || is_selected {
                draw_ray(lines, record, size, is_selected);
            }
        }
    }
    if let Some(record) = inspector.ray() {
        draw_walk(lines, record, step, inspected.scene.scene());
    }
    if let Some((s, r, truth)) = &inspected.truth.first_wrong
        && (*s, *r) == (sample, ray)
        && let (Some((_, t)), Some(record)) = (truth.right, inspector.ray())
    {
        lines.disc(record.ray.at(t), 6.0, colors::RIGHT);
    }
}

fn draw_ray(lines: &Lines<'_>, record: &RayRecord, size: f64, is_selected: bool) {
    let color = colors::ray(record.role);
    let end = record
        .ray
        .at(record.end().unwrap_or(size / record.ray.d.length()));
    let width = if is_selected { 3.0 } else { 1.2 };
    lines.line(record.ray.o, end, Stroke::new(width, color), Hidden::Faint);
    if record.role == RayRole::Shadow && record.outcome == Outcome::Blocked {
        lines.disc(end, 3.0, colors::WRONG);
    }
    if let Outcome::Hit(hit) = record.outcome
        && is_selected
    {
        lines.disc(hit.p, 4.0, color);
        lines.arrow(hit.p, hit.n, 0.08 * size, colors::RIGHT, "n");
        if hit.n.distance(hit.ng) > 1e-6 {
            lines.arrow(hit.p, hit.ng, 0.08 * size, colors::HOVERED, "ng");
        }
    }
}

/// The boxes and primitives of the first `step` tests, the last one in bold.
fn draw_walk(lines: &Lines<'_>, record: &RayRecord, step: usize, scene: &kit::Scene) {
    for (i, test) in record.tests.iter().take(step).enumerate() {
        let is_last = i + 1 == step;
        match test {
            Test::Box { bounds, visit, .. } => {
                let color = match visit {
                    Visit::Entered { .. } => colors::RIGHT,
                    Visit::Missed => Color32::from_gray(150),
                    Visit::Behind { .. } | Visit::Pruned { .. } => colors::HOVERED,
                };
                let entered = matches!(visit, Visit::Entered { .. });
                if is_last || entered {
                    let width = if is_last { 2.5 } else { 1.0 };
                    lines.aabb(bounds, Stroke::new(width, color), Hidden::Faint);
                }
            }
            Test::Primitive { prim, .. } if is_last => {
                let stroke = Stroke::new(2.5, colors::HOVERED);
                match scene.primitive(*prim) {
                    kit::Primitive::Triangle(triangle) => {
                        let fill = colors::HOVERED.gamma_multiply(0.3);
                        lines.triangle(corners(triangle), fill, stroke);
                    }
                    kit::Primitive::Sphere(sphere) => {
                        lines.aabb(&sphere.bounds(), stroke, Hidden::Faint)
                    }
                }
            }
            Test::Primitive { .. } => {}
        }
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
    match session.mode() {
        Mode::Edit => selection(&lines, session),
        Mode::Bvh => tree_boxes(&lines, session),
        Mode::Render => {}
    }
    if let Some(inspected) = session.inspector.inspected() {
        let job = &inspected.job;
        if session.mode() == Mode::Render || camera.pos != job.camera.pos {
            let depth = 0.12 * inspected.scene.bounds.extent().length();
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
    if session.mode() == Mode::Render
        && let Some(render) = session.render()
        && let [first, ..] = session.camera_rays()
    {
        let scene = render.scene();
        let depth = 0.3 * scene.bounds.extent().length();
        let job = render.job();
        frustum(&lines, &job.camera, job.film, depth, colors::line(ui), None);
        let stroke = Stroke::new(1.2, colors::ray(RayRole::Camera));
        for ray in session.camera_rays() {
            lines.line(ray.o, ray.at(4.0 * depth), stroke, Hidden::Shown);
        }
        lines.disc(first.o, 4.0, stroke.color);
    }
    replay(&lines, &session.inspector);
}
