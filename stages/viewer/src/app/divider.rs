//! The line between the picture and the 3D view, which the mouse drags.

use super::colors;
use egui::{CursorIcon, Rect, Role, Sense, Ui, Vec2, WidgetInfo};

/// The width of the line, in points.
const WIDTH: f32 = 6.0;

/// Where the line is, as a share of the longer edge.
pub(super) struct Divider {
    share: f32,
}

impl Default for Divider {
    fn default() -> Divider {
        Divider { share: 0.5 }
    }
}

impl Divider {
    /// Draws the line across the longer edge of `rect`. Returns the two parts.
    pub(super) fn show(&mut self, ui: &Ui, rect: Rect) -> [Rect; 2] {
        let is_wide = rect.width() >= rect.height();
        let (at, size) = match is_wide {
            true => (
                rect.left() + self.share * rect.width(),
                Vec2::new(WIDTH, rect.height()),
            ),
            false => (
                rect.top() + self.share * rect.height(),
                Vec2::new(rect.width(), WIDTH),
            ),
        };
        let mut line = Rect::from_center_size(rect.center(), size);
        match is_wide {
            true => line = line.translate(Vec2::new(at - line.center().x, 0.0)),
            false => line = line.translate(Vec2::new(0.0, at - line.center().y)),
        }
        let response = ui.interact(line, ui.scope_id().with("divider"), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "divider"));
        let (delta, icon) = match is_wide {
            true => (
                response.drag_delta().x / rect.width(),
                CursorIcon::ResizeHorizontal,
            ),
            false => (
                response.drag_delta().y / rect.height(),
                CursorIcon::ResizeVertical,
            ),
        };
        self.share = (self.share + delta).clamp(0.1, 0.9);
        let is_used = response.hovered() || response.dragged();
        response.on_hover_cursor(icon);
        let palette = colors::palette(ui);
        let color = if is_used {
            palette.selected
        } else {
            palette.line
        };
        let thin = match is_wide {
            true => line.shrink2(Vec2::new(WIDTH / 3.0, 0.0)),
            false => line.shrink2(Vec2::new(0.0, WIDTH / 3.0)),
        };
        ui.painter().rect_filled(thin, 0.0, color);
        let (mut first, mut second) = (rect, rect);
        match is_wide {
            true => (first.max.x, second.min.x) = (line.left(), line.right()),
            false => (first.max.y, second.min.y) = (line.top(), line.bottom()),
        }
        [first, second]
    }
}
