//! Draws the rays of an estimate of direct light, in the hemisphere above the point, as SVG.

use grader::explain::hemisphere::{Hemisphere, shines};
use judge::shown::ShownPoint;
use std::fmt::Write;
use wire::direct::RecordedRay;

/// The radius of the hemisphere in the drawing.
const RADIUS: f64 = 92.0;

/// Half of the width and of the height of the drawing.
const HALF: [f64; 2] = [160.0, 100.0];

/// The distance from the middle at which rays below the horizon are drawn, in radii.
const OUTSIDE: f64 = 1.05;

/// The most rays that are drawn: those of a few samples.
const RAYS: usize = 256;

/// Draws the rays of an estimate.
pub(super) fn draw(shown: &ShownPoint) -> String {
    let ShownPoint { world, point, rays } = shown;
    let above = Hemisphere::above(point);
    let at = |[x, y]: [f64; 2]| [RADIUS * x, -RADIUS * y];
    let [w, h] = HALF;
    let mut svg = format!(
        "<svg class=\"ray lit\" viewBox=\"{} {} {} {}\" role=\"img\" aria-label=\"the hemisphere above the point\">\
         <circle class=\"edge\" r=\"{RADIUS}\"/>",
        -w,
        -h,
        2.0 * w,
        2.0 * h
    );
    let mut dot = |class: &str, place: [f64; 2], r: f64| {
        let [x, y] = at(place);
        let _ = write!(
            svg,
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>"
        );
    };
    for emits in [false, true] {
        let class = if emits { "light" } else { "surface" };
        for panel in &world.panels {
            if shines(&above, panel) == emits {
                for place in above.panel(panel) {
                    dot(class, place, 2.6);
                }
            }
        }
    }
    for place in above.lights(world) {
        dot("light", place, 5.0);
    }
    let mut below = 0;
    for traced in rays.iter().take(RAYS) {
        match above.place(traced.ray.d) {
            Some(place) => dot(class_of(traced), place, 2.4),
            None => {
                below += 1;
                // Beside the circle, where the ray leaves the hemisphere.
                if let Some([x, y]) = above.below(traced.ray.d) {
                    dot("below", [OUTSIDE * x, OUTSIDE * y], 2.4);
                }
            }
        }
    }
    if let Some(place) = above.place(point.wo) {
        dot("origin", place, 4.0);
    }
    svg.push_str("</svg>");
    let _ = write!(
        svg,
        "<p class=\"key\">The hemisphere above the point; the normal is in the middle. {} of yours, {below} of them below the horizon (rings): \
         <span class=\"good\">● light arrives or the way is free</span> · <span class=\"bad\">● dark or blocked</span> · large: to the viewer</p>",
        judge::plural(rays.len(), "ray", "rays")
    );
    svg
}

/// A ray that sees light, or a shadow ray that reaches it.
fn class_of(traced: &RecordedRay) -> &'static str {
    let sees_light = traced.seen.iter().any(|channel| *channel > 0.0);
    match sees_light || !traced.hit {
        true => "free",
        false => "dark",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::direct::ShadedPoint;
    use wire::light::{LitWorld, Material, Panel};
    use wire::work::Ray;

    #[test]
    fn the_rays_of_an_estimate_are_drawn_where_they_go() {
        let light = Panel {
            axis: 2,
            at: 1.0,
            min: [-0.2; 2],
            max: [0.2; 2],
            faces: -1.0,
            material: Material::Emission([1.0; 3]),
        };
        let world = LitWorld {
            panels: vec![light],
            ..LitWorld::default()
        };
        let point = ShadedPoint {
            p: [0.0; 3],
            n: [0.0, 0.0, 1.0],
            ng: [0.0, 0.0, 1.0],
            error: 0.0,
            material: Material::Diffuse([0.5; 3]),
            wo: [0.0, 0.6, 0.8],
        };
        let ray = |d: [f64; 3], seen: f64, hit: bool| RecordedRay {
            ray: Ray {
                o: [0.0; 3],
                d,
                min_t: 0.0,
                max_t: f64::INFINITY,
            },
            seen: [seen; 3],
            hit,
        };
        let rays = vec![
            ray([0.0, 0.0, 1.0], 1.0, true),
            ray([0.8, 0.0, 0.6], 0.0, true),
            ray([0.6, 0.0, -0.8], 0.0, false),
        ];
        let svg = draw(&ShownPoint { world, point, rays });
        assert!(
            svg.contains("<circle class=\"free\" cx=\"0.0\" cy=\"-0.0\""),
            "{svg}"
        );
        assert!(svg.contains("<circle class=\"dark\" cx=\"73.6\""), "{svg}");
        assert!(svg.contains("3 rays of yours, 1 of them below the horizon (rings)"));
        assert!(svg.contains("<circle class=\"below\" cx=\"96.6\""), "{svg}");
        assert!(svg.contains("class=\"light\"") && svg.contains("class=\"origin\""));
    }
}
