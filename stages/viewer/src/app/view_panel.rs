//! The 3D view: the traced picture, lines over it, and the mouse.

use super::{colors, scene_lines};
use crate::command::Command;
use crate::project::Projection;
use crate::session::{Mode, Session};
use crate::topology::Element;
use egui::{
    Align2, Color32, ColorImage, FontId, PointerButton, Pos2, Rect, RichText, Role, ScrollArea,
    Sense, TextureHandle, TextureOptions, Ui, WidgetInfo,
};
use kit::Vec2;

/// The view and its texture.
#[derive(Default)]
pub(super) struct ViewPanel {
    /// The picture, which version it is, and the background behind it.
    texture: Option<((u64, Color32), TextureHandle)>,
    /// Whether the drag in progress moves the selected vertex.
    moves_vertex: bool,
}

/// The distance from a vertex at which a drag moves it, in points.
const GRAB_RADIUS: f32 = 14.0;
/// The steps of the wheel that are as much as pinching to twice the size.
const PINCH_STEPS: f64 = 5.0;
/// The points of scrolling that are one step of the wheel.
const SCROLL_PER_STEP: f32 = 40.0;

impl ViewPanel {
    /// Shows the view. Returns whether its picture will get better.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        session: &mut Session,
        commands: &mut Vec<Command>,
        fps: f64,
    ) -> bool {
        self.mouse(ui, rect, session);
        let pixels = rect.size() * ui.ctx().pixels_per_point();
        let size = (
            pixels.x.round().max(1.0) as u32,
            pixels.y.round().max(1.0) as u32,
        );
        let is_coming = session.update_view(size);
        self.paint_picture(ui, rect, session);
        scene_lines::of_session(ui, rect, session);
        self.paint_text(ui, rect, session, fps);
        if session.scene().is_none() && session.loading().is_none() {
            empty(ui, rect, session, commands);
        }
        is_coming
    }

    fn mouse(&mut self, ui: &mut Ui, rect: Rect, session: &mut Session) {
        let response = ui.interact(rect, ui.scope_id().with("view"), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "view of the scene"));
        let film = |at: Pos2| {
            Vec2::new(
                f64::from((at.x - rect.left()) / rect.width()),
                f64::from((rect.bottom() - at.y) / rect.height()),
            )
        };
        session.point_at_view(response.hover_pos().map(film));
        let by_height =
            |d: egui::Vec2| Vec2::new(f64::from(d.x), f64::from(-d.y)) / f64::from(rect.height());
        if response.drag_started_by(PointerButton::Primary) {
            let press = ui.input(|input| input.pointer.press_origin());
            self.moves_vertex = press.is_some_and(|at| grabs(session, rect, at));
        }
        if response.dragged_by(PointerButton::Primary) {
            let delta = response.drag_delta();
            if self.moves_vertex {
                let by = Vec2::new(
                    f64::from(delta.x / rect.width()),
                    f64::from(-delta.y / rect.height()),
                );
                session.apply(Command::MoveVertex(by));
            } else {
                session.apply(Command::Orbit(by_height(delta)));
            }
        }
        if response.drag_stopped_by(PointerButton::Primary) && self.moves_vertex {
            self.moves_vertex = false;
            session.apply(Command::EndMove);
        }
        if response.dragged_by(PointerButton::Secondary) {
            session.apply(Command::Pan(by_height(response.drag_delta())));
        }
        if response.hovered() {
            fingers(ui, session, rect.height());
        }
        if response.clicked() && session.mode() == Mode::Edit {
            session.apply(Command::Select);
        }
    }

    fn paint_picture(&mut self, ui: &Ui, rect: Rect, session: &Session) {
        let Some(picture) = session
            .scene()
            .and_then(|scene| session.view.picture(scene))
        else {
            ui.painter_at(rect)
                .rect_filled(rect, 0.0, colors::backdrop(ui));
            return;
        };
        // The background is part of the picture: painting it below would take as long again.
        let background = colors::backdrop(ui);
        let version = (session.view.version(), background);
        if self
            .texture
            .as_ref()
            .is_none_or(|(shown, _)| *shown != version)
        {
            let (w, h) = picture.size;
            let pixels = picture.pixels.iter();
            let image = ColorImage::new(
                [w as usize, h as usize],
                pixels
                    .map(|&[r, g, b, a]| match a {
                        0 => background,
                        _ => Color32::from_rgb(r, g, b),
                    })
                    .collect(),
            );
            match &mut self.texture {
                Some((shown, texture)) => {
                    texture.set(image, TextureOptions::LINEAR);
                    *shown = version;
                }
                None => {
                    let texture = ui.ctx().load_texture("view", image, TextureOptions::LINEAR);
                    self.texture = Some((version, texture));
                }
            }
        }
        if let Some((_, texture)) = &self.texture {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            ui.painter_at(rect)
                .image(texture.id(), rect, whole, Color32::WHITE);
        }
    }

    fn paint_text(&self, ui: &Ui, rect: Rect, session: &Session, fps: f64) {
        let Some(scene) = session.scene() else { return };
        let painter = ui.painter_at(rect);
        let font = FontId::proportional(13.0);
        let color = ui.visuals().strong_text_color();
        if let Some(failure) = session.view.failure(scene) {
            let at = rect.center_top() + egui::vec2(0.0, 34.0);
            let text = format!("{failure}: the scene is shown as lines");
            painter.text(
                at,
                Align2::CENTER_TOP,
                text,
                font.clone(),
                colors::palette(ui).attention,
            );
        }
        if !session.overlay() {
            return;
        }
        let name = match session.mode() {
            Mode::Edit => "Edit".to_owned(),
            Mode::Bvh => format!(
                "BVH: node {}, depth {}",
                session.walk().node(),
                session.walk().depth()
            ),
            Mode::Render => match session.render().and_then(|render| render.failure()) {
                Some(failure) => format!("{failure}: camera rays instead of a picture"),
                None => "Rays of the pixel".to_owned(),
            },
            Mode::Report => String::new(),
        };
        let inset = egui::vec2(8.0, 6.0);
        painter.text(
            rect.min + inset,
            Align2::LEFT_TOP,
            name,
            font.clone(),
            color,
        );
        if fps > 0.0 && session.mode() != Mode::Render {
            let at = rect.left_bottom() + egui::vec2(8.0, -6.0);
            let text = format!("{fps:.0} frames/s");
            painter.text(at, Align2::LEFT_BOTTOM, text, font, color);
        }
    }
}

/// The wheel, and fingers on a touch pad or a screen: scrolling and pinching move the camera nearer
/// or farther, two fingers that move sideways orbit, on a screen in all directions.
fn fingers(ui: &Ui, session: &mut Session, height: f32) {
    let (scroll, touch, pinch) = ui.input(|input| {
        (
            input.smooth_scroll_delta(),
            input.multi_touch(),
            input.zoom_delta(),
        )
    });
    let moved = match touch {
        Some(touch) => touch.translation_delta,
        None => egui::vec2(scroll.x, 0.0),
    };
    if moved != egui::Vec2::ZERO {
        let by = Vec2::new(f64::from(moved.x), f64::from(-moved.y)) / f64::from(height);
        session.apply(Command::Orbit(by));
    }
    let pinched = PINCH_STEPS * f64::from(pinch).log2();
    let steps = f64::from(scroll.y / SCROLL_PER_STEP) + pinched;
    if steps != 0.0 && touch.is_none() || pinched != 0.0 {
        session.apply(Command::Zoom(if touch.is_none() { steps } else { pinched }));
    }
}

/// Whether a press at `at` grabs the selected vertex.
fn grabs(session: &Session, rect: Rect, at: Pos2) -> bool {
    let (Some(position), Some(Element::Vertex(_)), Mode::Edit) = (
        session.selected_vertex_position(),
        session.selection(),
        session.mode(),
    ) else {
        return false;
    };
    let size = (rect.width() as u32, rect.height() as u32);
    let Some(request) = session.view_request(size) else {
        return false;
    };
    Projection::new(&request.camera)
        .point(position)
        .is_some_and(|film| {
            let shown = Pos2::new(
                rect.left() + rect.width() * film.x as f32,
                rect.bottom() - rect.height() * film.y as f32,
            );
            shown.distance(at) <= GRAB_RADIUS
        })
}

/// What to do without a scene.
fn empty(ui: &mut Ui, rect: Rect, session: &Session, commands: &mut Vec<Command>) {
    let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(rect.shrink(24.0)));
    inner.vertical_centered(|ui| {
        ui.add_space(0.1 * rect.height());
        ui.heading("Drop a .dae file here");
        ui.label("or start with one: viewer SCENE.dae");
        for path in session.recent() {
            if ui.link(path.display().to_string()).clicked() {
                commands.push(Command::Open(path.clone()));
            }
        }
        if session.course_scenes().is_empty() {
            return;
        }
        ui.add_space(16.0);
        ui.label(RichText::new("The scenes of the course").strong());
        ScrollArea::vertical().id_salt("scenes").show(ui, |ui| {
            for path in session.course_scenes() {
                let name = path.file_stem().unwrap_or_default().to_string_lossy();
                if ui.link(name).clicked() {
                    commands.push(Command::Open(path.clone()));
                }
            }
        });
    });
}
