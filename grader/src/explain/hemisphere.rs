//! The hemisphere above a point of a surface, seen from above: lights, other surfaces, the viewer,
//! rays.
//!
//! A unit direction `w` is drawn at `(w.x, w.y)` of the local space in which the normal is +z. So
//! the normal is in the middle, the horizon is the unit circle, and the area of a light in the disc
//! is proportional to what a diffuse surface receives from it (Nusselt's analogue).

use super::drawing::Drawing;
use crate::sketch::plot::Plot;
use judge::shown::ShownPoint;
use kit::{Frame, Vec3};
use wire::direct::{LambertProbe, ShadedPoint};
use wire::light::{Light, LitWorld, Material, Panel};
use wire::work::Xyz;

/// The points of a panel that are drawn, along each side.
const GRID: u32 = 24;

/// The side of the surface that the viewer is on.
#[derive(Clone, Copy, Debug)]
pub struct Hemisphere {
    p: Vec3,
    frame: Frame,
}

impl Hemisphere {
    /// The hemisphere above `point`, on the side of the viewer.
    pub fn above(point: &ShadedPoint) -> Hemisphere {
        let (n, wo) = (Vec3::from(point.n), Vec3::from(point.wo));
        Hemisphere {
            p: point.p.into(),
            frame: Frame::around(if n.dot(wo) < 0.0 { -n } else { n }),
        }
    }

    /// Where a world direction is drawn; `None` below the horizon.
    pub fn place(&self, direction: Xyz) -> Option<[f64; 2]> {
        let w = self.frame.to_local(Vec3::from(direction).try_normalize()?);
        (w.z > 0.0).then_some([w.x, w.y])
    }

    /// The point of the horizon below which a world direction points; `None` above the horizon and
    /// straight down.
    pub fn below(&self, direction: Xyz) -> Option<[f64; 2]> {
        let w = self.frame.to_local(direction.into());
        let across = w.x.hypot(w.y);
        (w.z <= 0.0 && across > 0.0).then(|| [w.x / across, w.y / across])
    }

    fn towards(&self, target: Xyz) -> Option<[f64; 2]> {
        self.place((Vec3::from(target) - self.p).into())
    }

    /// Where the points of a panel are drawn.
    pub fn panel(&self, panel: &Panel) -> Vec<[f64; 2]> {
        let share = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
        let along =
            |axis: usize, i: u32| panel.min[axis] + share(i) * (panel.max[axis] - panel.min[axis]);
        let points = (0..GRID).flat_map(|i| (0..GRID).map(move |j| [i, j]));
        points
            .filter_map(|[i, j]| self.towards(panel.point([along(0, i), along(1, j)])))
            .collect()
    }

    /// Whether the front of a panel is seen from the point.
    pub fn sees_front(&self, panel: &Panel) -> bool {
        let middle = [0, 1].map(|axis| 0.5 * (panel.min[axis] + panel.max[axis]));
        let from = self.p - Vec3::from(panel.point(middle));
        from.dot(panel.front().into()) > 0.0
    }

    /// Where the lights of the world that are points or directions are drawn.
    pub fn lights(&self, world: &LitWorld) -> Vec<[f64; 2]> {
        let lights = world.lights.iter();
        lights
            .filter_map(|light| match light {
                Light::Point { position, .. } | Light::Spot { position, .. } => {
                    self.towards(*position)
                }
                Light::Directional { direction, .. } => self.place(direction.map(|x| -x)),
                Light::Sky(_) => None,
            })
            .collect()
    }
}

/// Whether a panel is a light that shines towards the point.
pub fn shines(hemisphere: &Hemisphere, panel: &Panel) -> bool {
    matches!(panel.material, Material::Emission(_)) && hemisphere.sees_front(panel)
}

/// An empty disc.
fn disc() -> Plot {
    let mut plot = Plot::new([-1.9, -1.05], [1.9, 1.05]);
    plot.unit_circle();
    plot
}

/// The world above a point.
pub(super) fn lit_point(ShownPoint { world, point, .. }: &ShownPoint) -> Drawing {
    let hemisphere = Hemisphere::above(point);
    let mut plot = disc();
    // A cell has one mark: lights are drawn after what may cover them.
    for emits in [false, true] {
        for panel in &world.panels {
            if shines(&hemisphere, panel) == emits {
                for place in hemisphere.panel(panel) {
                    plot.set(place, if emits { 'L' } else { '#' });
                }
            }
        }
    }
    for place in hemisphere.lights(world) {
        plot.set(place, 'L');
    }
    if let Some(place) = hemisphere.place(point.wo) {
        plot.set(place, 'v');
    }
    Drawing::new(
        &plot,
        &[
            "above the first point, seen along its normal, which is in the middle",
            "L light, # other surface, v viewer; circle: horizon",
        ],
    )
}

/// Pairs of directions in local space.
pub(super) fn directions<'a>(pairs: impl Iterator<Item = &'a LambertProbe>) -> Drawing {
    let mut plot = disc();
    let mut below = 0;
    for probe in pairs {
        for (w, mark) in [(probe.wi, 'i'), (probe.wo, 'v')] {
            match w[2] > 0.0 {
                true => {
                    plot.mark([w[0], w[1]], mark);
                }
                false => below += 1,
            }
        }
    }
    let signs = "v to the viewer, i to the light, * both; circle: horizon";
    let drawing = Drawing::new(&plot, &["local space, seen along the normal", signs]);
    drawing.without(
        below,
        ["direction is", "directions are"],
        "below the horizon",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(wo: Xyz) -> ShadedPoint {
        ShadedPoint {
            p: [0.0; 3],
            n: [0.0, 0.0, 1.0],
            ng: [0.0, 0.0, 1.0],
            error: 0.0,
            material: Material::Diffuse([0.5; 3]),
            wo,
        }
    }

    #[test]
    fn the_normal_is_in_the_middle_and_the_horizon_is_the_circle() {
        let above = Hemisphere::above(&point([0.0, 0.6, 0.8]));
        assert_eq!(above.place([0.0, 0.0, 2.0]), Some([0.0, 0.0]));
        assert_eq!(above.place([0.0, 0.0, -1.0]), None);
        assert_eq!(above.below([0.0, -2.0, -1.0]), Some([0.0, -1.0]));
        assert_eq!(above.below([0.0, 0.0, -1.0]), None);
        let near = above.place([1.0, 0.0, 1e-9]).expect("it is above");
        assert!((near[0].hypot(near[1]) - 1.0).abs() < 1e-6);
        // The viewer is below: so is the hemisphere.
        let below = Hemisphere::above(&point([0.0, 0.6, -0.8]));
        assert_eq!(below.place([0.0, 0.0, -1.0]), Some([0.0, 0.0]));
    }

    #[test]
    fn a_light_above_the_point_is_drawn_and_one_that_faces_away_does_not_shine() {
        let panel = |faces| Panel {
            axis: 2,
            at: 1.0,
            min: [-0.5; 2],
            max: [0.5; 2],
            faces,
            material: Material::Emission([1.0; 3]),
        };
        let above = Hemisphere::above(&point([0.0, 0.0, 1.0]));
        assert!(shines(&above, &panel(-1.0)) && !shines(&above, &panel(1.0)));
        assert_eq!(above.panel(&panel(-1.0)).len(), (GRID * GRID) as usize);
        let world = LitWorld {
            panels: vec![panel(-1.0)],
            ..LitWorld::default()
        };
        let Drawing { lines, .. } = lit_point(&ShownPoint {
            world,
            point: point([0.0, 0.9, 0.1]),
            rays: Vec::new(),
        });
        let drawing = lines.join("\n");
        assert!(
            drawing.matches('L').count() > 20 && drawing.contains('v'),
            "{drawing}"
        );
    }
}
