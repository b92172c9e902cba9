//! The opened case of a report: its parts, in 3D or as pictures, and the mouse over them.

use super::lines::Lines;
use super::pair_view::{self, PairTextures, dragged_wipe};
use super::picture_panel::{fitted, hint};
use super::{case_lines, colors};
use crate::command::Command;
use crate::orbit::Orbit;
use crate::report::{CasePart, CaseView, OpenCase};
use crate::session::Session;
use egui::{Align2, Color32, FontId, PointerButton, Rect, Response, Sense, Ui};
use kit::{FilmSize, Scene, Vec2};
use scenes::placement::{for_film, frame};

/// The names of the two pictures of a case.
pub(super) const NAMES: [&str; 2] = ["yours", "golden"];

/// The height of the row of buttons above the case.
const TABS: f32 = 30.0;

/// The textures of the opened case.
#[derive(Default)]
pub(super) struct CasePanel {
    pictures: PairTextures,
    /// The case and part that the textures are of, and a number for it.
    shown: (Option<(usize, CasePart)>, u64),
}

impl CasePanel {
    /// Shows the opened case.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        session: &mut Session,
        commands: &mut Vec<Command>,
    ) {
        let Some(opened) = session.opened_case_mut() else {
            return hint(ui, rect, "No case lost points");
        };
        let Some(part) = opened.part() else {
            return hint(ui, rect, &nothing_to_see(opened));
        };
        let (above, rect) = rect.split_top_bottom_at_y(rect.top() + TABS);
        tabs(ui, above, opened, part, commands);
        let response = ui.interact(rect, ui.scope_id().with("case"), Sense::click_and_drag());
        match part {
            CasePart::View => view(ui, rect, &response, opened),
            _ => self.pictures(ui, rect, &response, opened, part),
        }
    }

    fn pictures(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        opened: &mut OpenCase,
        part: CasePart,
    ) {
        let key = Some((opened.index, part));
        if self.shown.0 != key {
            self.shown = (key, self.shown.1 + 1);
        }
        let pair = match opened.pictures().pair(part) {
            Some(Ok(pair)) => pair,
            Some(Err(why)) => return hint(ui, rect, why),
            None => return,
        };
        let area = fitted(rect.shrink(6.0), pair.size());
        let textures = self.pictures.of(ui, self.shown.1, pair);
        pair_view::paint(ui, area, opened.display, textures, NAMES);
        if let Some(at) = response.interact_pointer_pos()
            && response.dragged()
        {
            opened.display.wipe = dragged_wipe(area, at);
        }
    }
}

/// Why there is nothing to see.
fn nothing_to_see(opened: &OpenCase) -> String {
    let silent = opened.content().and_then(|content| content.silent.clone());
    match (opened.failure(), silent) {
        (Some(failure), _) => failure.to_string(),
        (None, Some(silent)) => silent,
        (None, None) if opened.is_running() => "Running the case with your code".to_owned(),
        (None, None) => "This case measures numbers: its sentences are at the side".to_owned(),
    }
}

/// The buttons of the parts.
fn tabs(ui: &mut Ui, rect: Rect, opened: &OpenCase, part: CasePart, commands: &mut Vec<Command>) {
    let inner = egui::UiBuilder::new().max_rect(rect.shrink2(egui::vec2(8.0, 3.0)));
    ui.new_child(inner).horizontal_centered(|ui| {
        for one in opened.parts() {
            if ui.selectable_label(one == part, one.name()).clicked() {
                commands.push(Command::ShowPart(one));
            }
        }
        match opened.is_running() {
            true => ui.weak("rendering pictures"),
            false => ui.weak("Y: next"),
        };
    });
}

/// The case in 3D. The mouse moves its camera.
fn view(ui: &mut Ui, rect: Rect, response: &Response, opened: &mut OpenCase) {
    let film = FilmSize {
        w: rect.width().max(1.0) as u32,
        h: rect.height().max(1.0) as u32,
    };
    if opened.orbit.is_none() {
        opened.orbit = opened.view().map(|view| framed(view, film));
    }
    let Some(orbit) = opened.orbit.as_mut() else {
        return;
    };
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
    let Some(view) = opened.view() else { return };
    case_lines::draw(&lines, ui, opened, view);
    let painter = ui.painter_at(rect);
    for (i, (color, text)) in case_lines::legend(view).into_iter().enumerate() {
        let at = rect.min + egui::vec2(16.0, 18.0 + 18.0 * i as f32);
        let font = FontId::proportional(13.0);
        painter.circle_filled(at, 4.0, color);
        let at = at + egui::vec2(10.0, 0.0);
        let color = ui.visuals().text_color();
        painter.text(at, Align2::LEFT_CENTER, text, font, color);
    }
    if let Some((color, text)) = verdict(view, opened) {
        let at = rect.left_bottom() + egui::vec2(10.0, -8.0);
        let font = FontId::proportional(14.0);
        let galley = painter.layout(text, font, color, rect.width() - 20.0);
        let area = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        let shade = colors::backdrop(ui).gamma_multiply(0.85);
        painter.rect_filled(area.expand(4.0), 3.0, shade);
        painter.galley(area.min, galley, color);
    }
}

/// The sentence below the case: the first event where it parts from the truth.
fn verdict(view: &CaseView, opened: &OpenCase) -> Option<(Color32, String)> {
    Some(match view {
        CaseView::Visits(case) => match &case.parting {
            Some(parting) => (colors::WRONG, parting.sentence.clone()),
            None => (colors::RIGHT, "This ray's result is right.".to_owned()),
        },
        CaseView::Tree(case) => {
            let node = opened.walk.node();
            let faults: Vec<&str> = case.fault_of(node).collect();
            match (faults.as_slice(), &case.fault) {
                ([], Some(fault)) => (colors::WRONG, fault.clone()),
                ([], None) if case.is_loose(node) => (
                    colors::HOVERED,
                    format!("node {node}: its box is larger than what it contains"),
                ),
                ([], None) => return None,
                (faults, _) => (colors::WRONG, format!("node {node}: {}", faults.join("; "))),
            }
        }
        _ => return None,
    })
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
    Orbit::new(frame(&scene, kit::Vec3::new(0.5, 0.35, 1.0), film))
}
