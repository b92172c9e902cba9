//! A case of the report in 3D: shapes, the ray, the stage's hit and the exact one.

use super::colors;
use super::scene_lines::{Hidden, Lines, frustum};
use crate::orbit::Orbit;
use crate::report::CaseView;
use crate::session::Session;
use crate::topology::corners;
use egui::{Align2, Color32, FontId, PointerButton, Rect, Sense, Stroke, Ui};
use kit::{FilmSize, Scene, Vec2};
use scenes::placement::{for_film, frame};

/// Shows the opened case. The mouse moves its camera.
pub(super) fn show(ui: &mut Ui, rect: Rect, session: &mut Session) {
    let Some(report) = session.report_mut() else {
        return;
    };
    let Some((_, Some(view))) = &report.opened else {
        let font = FontId::proportional(15.0);
        let text = "This case is not about a single ray: its sentences are at the side.";
        let color = ui.visuals().text_color();
        ui.painter_at(rect)
            .text(rect.center(), Align2::CENTER_CENTER, text, font, color);
        return;
    };
    let response = ui.interact(rect, ui.scope_id().with("case"), Sense::click_and_drag());
    let film = FilmSize {
        w: rect.width().max(1.0) as u32,
        h: rect.height().max(1.0) as u32,
    };
    let orbit = report.orbit.get_or_insert_with(|| framed(view, film));
    let delta = response.drag_delta() / rect.height();
    let by = Vec2::new(f64::from(delta.x), f64::from(-delta.y));
    if response.dragged_by(PointerButton::Primary) {
        orbit.rotate(std::f64::consts::PI * by.x, std::f64::consts::PI * by.y);
    }
    if response.dragged_by(PointerButton::Secondary) {
        orbit.pan(by.x, by.y);
    }
    if response.hovered() {
        let scroll = ui.input(|input| input.smooth_scroll_delta().y);
        orbit.zoom(f64::from(scroll / 40.0));
    }
    let camera = for_film(&orbit.camera(), film);
    let lines = Lines::new(ui, rect, &camera, None);
    draw(&lines, view, ui);
    let legend = [
        (colors::ray(pathtracer::RayRole::Camera), "the ray"),
        (colors::WRONG, "your hit"),
        (colors::RIGHT, "the exact hit"),
    ];
    for (i, (color, text)) in legend.into_iter().enumerate() {
        let at = rect.min + egui::vec2(16.0, 18.0 + 18.0 * i as f32);
        let font = FontId::proportional(13.0);
        ui.painter_at(rect).circle_filled(at, 4.0, color);
        let at = at + egui::vec2(10.0, 0.0);
        ui.painter_at(rect)
            .text(at, Align2::LEFT_CENTER, text, font, color);
    }
}

/// A view of everything that the case shows, from a corner.
fn framed(view: &CaseView, film: FilmSize) -> Orbit {
    let bounds = view.bounds();
    // The two corners of the bounds as points of a scene.
    let scene = Scene {
        spheres: [bounds.min, bounds.max]
            .map(|center| kit::Sphere {
                center,
                radius: 0.0,
            })
            .to_vec(),
        ..Scene::default()
    };
    let home = frame(&scene, kit::Vec3::new(0.5, 0.35, 1.0), film);
    Orbit::new(home)
}

fn draw(lines: &Lines<'_>, view: &CaseView, ui: &Ui) {
    let edge = Stroke::new(1.5, ui.visuals().text_color());
    let fill = Color32::from_rgb(120, 140, 200).gamma_multiply(0.3);
    for triangle in &view.scene.triangles {
        lines.triangle(corners(triangle), fill, edge);
    }
    for sphere in &view.scene.spheres {
        lines.ball(sphere.center, sphere.radius, edge);
    }
    for b in &view.boxes {
        lines.aabb(b, edge, Hidden::Shown);
    }
    let size = view.bounds().extent().length().max(1e-300);
    if let Some(camera) = &view.camera {
        let film = FilmSize { w: 10, h: 10 };
        frustum(lines, camera, film, 1.0, colors::line(ui), None);
    }
    let ray = &view.ray;
    let farthest = view.student.iter().chain(&view.right).copied();
    let reach = farthest.fold(1.5 * size / ray.d.length(), f64::max);
    let end = ray.max_t.min(reach);
    let color = colors::ray(pathtracer::RayRole::Camera);
    let start = ray.min_t.max(-reach);
    lines.line(
        ray.at(start),
        ray.at(end),
        Stroke::new(2.5, color),
        Hidden::Shown,
    );
    lines.disc(ray.o, 4.0, color);
    for (hits, radius, color) in [
        (&view.right, 7.0, colors::RIGHT),
        (&view.student, 4.5, colors::WRONG),
    ] {
        for &t in hits {
            lines.disc(ray.at(t), radius, color);
        }
    }
}
