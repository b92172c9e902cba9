//! Draws light and scattering from the side: a surface, its normal, and directions as arrows.

use super::model::{Ink, Layout, Sketch, Stroke, sides};
use super::words::Anchor;
use judge::shown::{ShownBounce, ShownPath, ShownPoint};
use kit::Vec3;
use wire::direct::LambertProbe;
use wire::light::{Light, Material};
use wire::work::Xyz;

/// Half of the length of the surface that is drawn; directions are 1 long.
const HALF: f64 = 1.4;

/// The most rays and lights that are drawn.
const MOST: usize = 8;

/// What is seen of a surface.
const FROM_ITS_SIDE: &str = "the surface from its side, the normal up";

/// A surface with its normal up.
fn surface() -> Vec<Stroke> {
    vec![Stroke::Line(Ink::Shape, [[-HALF, 0.0], [HALF, 0.0]])]
}

/// The local direction, horizontal in the plane of the drawing, across which `directions` differ
/// most.
fn across(directions: &[Xyz]) -> [f64; 2] {
    let longest = directions
        .iter()
        .map(|w| [w[0], w[1]])
        .max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
    match longest {
        Some([x, y]) if x.hypot(y) > 1e-9 => [x / x.hypot(y), y / x.hypot(y)],
        _ => [1.0, 0.0],
    }
}

/// An arrow from the surface along a local direction, with its name.
fn arrow(strokes: &mut Vec<Stroke>, [x, y]: [f64; 2], ink: Ink, w: Xyz, name: &str) {
    let ends = [[0.0; 2], [x * w[0] + y * w[1], w[2]]];
    strokes.push(Stroke::Arrow(ink, ends));
    strokes.push(Stroke::word_at_tip(ends, name));
}

/// Two directions at a diffuse surface.
pub(super) fn pair(probe: &LambertProbe) -> Sketch {
    let along = across(&[probe.wo, probe.wi]);
    let mut strokes = surface();
    arrow(&mut strokes, along, Ink::Ray, probe.wo, "wo");
    arrow(&mut strokes, along, Ink::Light, probe.wi, "wi");
    Sketch::new(strokes, FROM_ITS_SIDE, Layout::Shape)
}

/// The direction that a mirror or glass sends on.
pub(super) fn bounce(shown: &ShownBounce) -> Sketch {
    let is_finite = |wi: &Xyz| wi.iter().all(|x| x.is_finite());
    let yours = shown.yours.filter(is_finite);
    let answers = [shown.expected, yours].into_iter().flatten();
    let all: Vec<Xyz> = [shown.wo].into_iter().chain(answers).collect();
    let along = across(&all);
    let mut strokes = surface();
    arrow(&mut strokes, along, Ink::Ray, shown.wo, "wo");
    if let Some(wi) = shown.expected {
        arrow(&mut strokes, along, Ink::Expected, wi, "expected");
    }
    if let Some(wi) = yours.filter(|wi| Some(*wi) != shown.expected) {
        let wi = wi.map(|x| x.clamp(-2.0, 2.0));
        arrow(&mut strokes, along, Ink::Yours, wi, "yours");
    }
    let caption = match shown.yours == yours {
        true => FROM_ITS_SIDE.to_owned(),
        false => format!("{FROM_ITS_SIDE}; your direction is not finite"),
    };
    Sketch::new(strokes, &caption, Layout::Shape)
}

/// A point among lights, from the side on which the first light is.
pub(super) fn lit_point(shown: &ShownPoint) -> Option<Sketch> {
    let ShownPoint { world, point, rays } = shown;
    let (p, n) = (Vec3::from(point.p), Vec3::from(point.n).try_normalize()?);
    let emits = |material: &Material| matches!(material, Material::Emission(_));
    let panels = world.panels.iter().map(|panel| {
        let corners = [
            [panel.min[0], panel.min[1]],
            [panel.max[0], panel.min[1]],
            [panel.max[0], panel.max[1]],
            [panel.min[0], panel.max[1]],
        ];
        let corners = corners.map(|at| Vec3::from(panel.point(at)) - p);
        (corners, emits(&panel.material))
    });
    let panels: Vec<([Vec3; 4], bool)> = panels.take(MOST).collect();
    let lamps = world.lights.iter().filter_map(|light| match light {
        Light::Point { position, .. } | Light::Spot { position, .. } => {
            Some((Vec3::from(*position) - p, false))
        }
        Light::Directional { direction, .. } => {
            Some((-Vec3::from(*direction).normalize_or_zero(), true))
        }
        Light::Sky(_) => None,
    });
    let lamps: Vec<(Vec3, bool)> = lamps.take(MOST).collect();
    // The farthest light fits, the nearest is still beside the point.
    let reach = panels
        .iter()
        .flat_map(|(corners, _)| corners)
        .chain(lamps.iter().filter(|lamp| !lamp.1).map(|lamp| &lamp.0))
        .map(|v| v.length())
        .fold(1.0, f64::max);
    if !reach.is_finite() {
        return None;
    }
    let seen = lamps.iter().map(|lamp| lamp.0).chain([point.wo.into()]);
    let side = seen.map(|v| v - v.dot(n) * n).find(|v| v.length() > 1e-6);
    let right = side
        .unwrap_or_else(|| n.any_orthonormal_vector())
        .try_normalize()?;
    let place = |v: Vec3| [v.dot(right), v.dot(n)];
    let half = 0.6 * reach;
    let mut strokes = vec![Stroke::Line(Ink::Shape, [[-half, 0.0], [half, 0.0]])];
    for (lamp, is_direction) in &lamps {
        let at = place(if *is_direction {
            0.8 * reach * *lamp
        } else {
            *lamp
        });
        strokes.push(Stroke::Mark(Ink::Light, at));
    }
    for (corners, shines) in &panels {
        let ink = if *shines { Ink::Light } else { Ink::Shape };
        strokes.extend(sides(corners.map(place)).map(|ends| Stroke::Line(ink, ends)));
    }
    let viewer = place(0.4 * reach * Vec3::from(point.wo));
    strokes.push(Stroke::Arrow(Ink::Ray, [[0.0; 2], viewer]));
    strokes.push(Stroke::Word(Anchor::Start, viewer, "wo".into()));
    let directions = rays
        .iter()
        .map(|traced| Vec3::from(traced.ray.d).try_normalize());
    let drawn: Vec<Vec3> = directions.flatten().take(MOST).collect();
    for d in &drawn {
        let tip = place(0.6 * reach * *d);
        strokes.push(Stroke::Arrow(Ink::Yours, [[0.0; 2], tip]));
    }
    let traced = match (rays.len(), drawn.len()) {
        (0, _) => "your code traced no ray",
        (_, 0) => "your rays have no direction that is finite and not 0",
        _ => "x arrows: your rays",
    };
    let caption = format!("{FROM_ITS_SIDE}; {traced}");
    Some(Sketch::new(strokes, &caption, Layout::Shape))
}

/// A path that goes up and down between its surfaces; `None` if its first ray meets nothing.
pub(super) fn path(shown: &ShownPath) -> Option<Sketch> {
    let corner = |i: usize| [i as f64, f64::from(u32::from(i.is_multiple_of(2)))];
    let surfaces = shown.surfaces.len();
    if surfaces == 0 {
        return None;
    }
    let mut strokes = vec![Stroke::Mark(Ink::Ray, corner(0))];
    for i in 0..=surfaces {
        let ink = match shown.yours {
            Some(traced) if i < traced => Ink::Ray,
            _ => Ink::Outside,
        };
        strokes.push(Stroke::Arrow(ink, [corner(i), corner(i + 1)]));
    }
    for (i, name) in shown.surfaces.iter().enumerate() {
        let [x, y] = corner(i + 1);
        strokes.push(Stroke::Line(Ink::Shape, [[x - 0.3, y], [x + 0.3, y]]));
        let beside = if y > 0.5 { 1.25 } else { -0.25 };
        strokes.push(Stroke::Word(
            Anchor::Middle,
            [x, beside],
            (*name).to_owned(),
        ));
    }
    let traced = shown.yours.map_or_else(String::new, |traced| {
        format!(
            "; your code traced {}",
            judge::plural(traced, "ray", "rays")
        )
    });
    let caption = format!("the given surfaces in turn{traced}");
    Some(Sketch::new(strokes, &caption, Layout::Shape))
}
