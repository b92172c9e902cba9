//! The plane that cuts the scene open.

use super::Session;
use crate::cut::Cut;

impl Session {
    /// The cut of the 3D view.
    pub fn cut(&self) -> Option<Cut> {
        self.cut
    }

    /// The range of coordinates in which the plane can be; `None` without a scene or a cut.
    pub fn cut_range(&self) -> Option<[f64; 2]> {
        let (cut, bounds) = (self.cut?, self.scene.as_ref()?.bounds);
        Some([bounds.min[cut.axis], bounds.max[cut.axis]])
    }

    /// Cuts across the next axis, or no longer.
    pub(super) fn next_cut(&mut self) {
        let next = self.cut.map_or(0, |cut| cut.axis + 1);
        let Some(scene) = &self.scene else {
            return self.say("There is no scene to cut: open one first");
        };
        let Some(orbit) = self.view_orbit() else {
            return self.say("A picture is not cut: click a pixel to see the scene beside it");
        };
        let camera = orbit.camera().pos;
        let is_axis = next < Cut::AXES.len();
        self.cut = is_axis.then(|| Cut::through_middle(next, &scene.bounds, camera));
        match self.cut {
            Some(cut) => self.say(format!(
                "Cut across {}: Shift 5 shows the other side",
                Cut::AXES[cut.axis]
            )),
            None => self.say("The scene is whole again"),
        }
    }

    /// Shows the other side of the cut.
    pub(super) fn flip_cut(&mut self) {
        match &mut self.cut {
            Some(cut) => cut.keeps_smaller = !cut.keeps_smaller,
            None => self.say("There is no cut: 5 cuts the scene"),
        }
    }

    /// Moves the plane.
    pub(super) fn move_cut(&mut self, at: f64) {
        if let Some(cut) = &mut self.cut {
            cut.at = at;
        }
    }
}
