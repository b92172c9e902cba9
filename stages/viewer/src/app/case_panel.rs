//! The opened case of a report: its parts, in 3D or as pictures, and the mouse over them.

use super::case_lines::Sample;
use super::colors::Palette;
use super::lines::{self, Lines};
use super::pair_view::{self, PairTextures, dragged_wipe};
use super::picture_panel::hint;
use super::zoom::fitted;
use super::{case_lines, colors};
use crate::command::Command;
use crate::digits;
use crate::orbit::Orbit;
use crate::report::{CasePart, CaseView, OpenCase};
use crate::session::Session;
use egui::{Align2, Color32, FontId, PointerButton, Rect, Response, Role, Sense, Ui, WidgetInfo};
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
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "case of the report"));
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
    legend(ui, &painter, rect, view);
    if let Some((verdict, text)) = verdict(view, opened) {
        let color = verdict.color(colors::palette(ui));
        let at = rect.left_bottom() + egui::vec2(10.0, -8.0);
        let font = FontId::proportional(14.0);
        let galley = painter.layout(text, font, color, rect.width() - 20.0);
        let area = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        shade(ui, &painter, area.expand(4.0));
        painter.galley(area.min, galley, color);
    }
}

/// Makes what is drawn so far dim, so that text over it has contrast.
fn shade(ui: &Ui, painter: &egui::Painter, area: Rect) {
    painter.rect_filled(area, 3.0, colors::backdrop(ui).gamma_multiply(0.85));
}

fn legend(ui: &Ui, painter: &egui::Painter, rect: Rect, view: &CaseView) {
    let text_color = ui.visuals().text_color();
    let lines = case_lines::legend(view, colors::palette(ui));
    for (i, (sample, color, text)) in lines.into_iter().enumerate() {
        let at = rect.min + egui::vec2(22.0, 18.0 + 18.0 * i as f32);
        let font = FontId::proportional(13.0);
        let galley = painter.layout_no_wrap(text.to_owned(), font, text_color);
        let name = Align2::LEFT_CENTER.anchor_size(at + egui::vec2(20.0, 0.0), galley.size());
        let sign = Rect::from_center_size(at, egui::vec2(26.0, 18.0));
        shade(ui, painter, sign.union(name).expand2(egui::vec2(4.0, 0.0)));
        match sample {
            Sample::Dot => {
                painter.circle_filled(at, 4.0, color);
            }
            Sample::Ring => lines::ring(painter, at, color),
            Sample::Cross => lines::cross(painter, at, color),
            Sample::Line(pattern) => {
                lines::sample(painter, at, egui::Stroke::new(2.5, color), pattern);
            }
        }
        painter.galley(name.min, galley, text_color);
    }
}

/// What the sentence below a case says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Right,
    Attention,
    Wrong,
}

impl Verdict {
    fn color(self, palette: &Palette) -> Color32 {
        match self {
            Verdict::Right => palette.right,
            Verdict::Attention => palette.attention,
            Verdict::Wrong => palette.wrong,
        }
    }
}

/// The sentence below the case: the first event where it parts from the truth, or else what the
/// case loses points for. It is right only if the whole case is.
fn verdict(view: &CaseView, opened: &OpenCase) -> Option<(Verdict, String)> {
    let wrong_now = opened.content()?.wrong_now.as_deref();
    let of_case = match wrong_now? {
        [] => (Verdict::Right, "Your code passes this case now.".to_owned()),
        [first, ..] => (Verdict::Wrong, digits::shortened(first)),
    };
    Some(match view {
        CaseView::Visits(case) => match (&case.parting, case.wrong_order()) {
            (Some(parting), _) => (Verdict::Wrong, digits::shortened(&parting.sentence)),
            (None, Some(order)) => {
                // A few more tests than with the best order are allowed.
                let verdict = match of_case.0 {
                    Verdict::Right => Verdict::Attention,
                    verdict => verdict,
                };
                (verdict, digits::shortened(&order.sentence()))
            }
            (None, None) => of_case,
        },
        CaseView::Tree(case) => {
            let node = opened.walk.node();
            let faults: Vec<&str> = case.fault_of(node).collect();
            match (faults.as_slice(), &case.fault) {
                ([], Some(fault)) => (Verdict::Wrong, fault.clone()),
                ([], None) if case.is_loose(node) => (
                    Verdict::Attention,
                    format!("node {node}: its box is larger than what it contains"),
                ),
                ([], None) => of_case,
                (faults, _) => (
                    Verdict::Wrong,
                    format!("node {node}: {}", faults.join("; ")),
                ),
            }
        }
        CaseView::Ray(_)
        | CaseView::Light(_)
        | CaseView::Pixel(_)
        | CaseView::Scatter(_)
        | CaseView::Plot(_) => of_case,
    })
}

/// A view of what differs in the case, or of everything that it shows.
fn framed(view: &CaseView, film: FilmSize) -> Orbit {
    let bounds = view.focus();
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
    Orbit::new(frame(&scene, view.seen_from(), film))
}
