//! The cameras of the views, and the picture of the 3D view.

use super::{Mode, Session};
use crate::orbit::Orbit;
use crate::view_picture::{ViewRequest, ViewStyle};
use kit::FilmSize;
use scenes::placement::for_film;
use std::sync::Arc;

impl Session {
    /// Moves the camera of the visible view.
    pub(super) fn with_camera(&mut self, change: impl FnOnce(&mut Orbit)) {
        // In render mode the render camera stays; the view of the replay moves.
        let camera = match self.mode {
            Mode::Edit | Mode::Bvh => self.orbit.as_mut(),
            Mode::Render => self.spy.as_mut(),
            Mode::Report => self
                .opened_case_mut()
                .and_then(|opened| opened.orbit.as_mut()),
        };
        if let Some(camera) = camera {
            change(camera);
        }
    }

    /// The camera of the 3D view that is visible.
    pub fn view_orbit(&self) -> Option<&Orbit> {
        match self.mode {
            Mode::Render => self.spy.as_ref(),
            Mode::Report => self.opened_case()?.orbit.as_ref(),
            Mode::Edit | Mode::Bvh => self.orbit.as_ref(),
        }
    }

    /// What the visible 3D view is to show, with `size` pixels; `None` without a scene.
    pub fn view_request(&self, size: (u32, u32)) -> Option<ViewRequest> {
        let film = FilmSize {
            w: size.0.max(1),
            h: size.1.max(1),
        };
        Some(ViewRequest {
            camera: for_film(&self.view_orbit()?.camera(), film),
            size: (film.w, film.h),
            style: match self.mode {
                Mode::Bvh if self.scene.as_ref()?.bvh().is_some() => {
                    ViewStyle::Node(self.walk.node())
                }
                _ => ViewStyle::Materials,
            },
            edges: self.edges,
            cut: self.cut,
        })
    }

    /// Brings the picture of the 3D view up to date. Returns whether more is to come.
    pub fn update_view(&mut self, size: (u32, u32)) -> bool {
        let (Some(scene), Some(request)) = (self.scene.clone(), self.view_request(size)) else {
            return false;
        };
        let wake = Arc::clone(&self.wake);
        self.view.update(&scene, request, self.patience, &wake)
    }
}

/// The angle that a drag over the height of the view rotates by, in radians.
pub(super) const ROTATION_PER_VIEW: f64 = std::f64::consts::PI;

/// A view of what `orbit` sees, from its side: its camera and its rays are visible.
pub(super) fn beside(orbit: Orbit) -> Orbit {
    let mut spy = Orbit::new(orbit.view());
    spy.rotate(-0.7, -0.25);
    spy.zoom(-4.0);
    Orbit::new(spy.view())
}
