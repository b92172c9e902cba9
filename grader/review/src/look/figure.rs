//! Draws one ray and the shape that it is tested against, as SVG.

use judge::shown::ShownRay;
use kit::{Aabb, Ray, Sphere, Triangle, Vec3};
use std::fmt::Write;

/// Normals that differ by less look the same.
const VISIBLE_ANGLE: f64 = 0.05;

/// Half of the width and of the height of the drawing. Its centre is the centre of the shape.
const HALF: [f64; 2] = [160.0, 100.0];

/// What the marks mean.
const KEY: &str = "<p class=\"key\"><span class=\"good\">○ expected</span> · <span class=\"bad\">× yours</span> · lines from the hit: normals · \
     dashed: outside of the ray's range</p>";

/// The shape of a drawing.
enum Shape {
    Triangle(Triangle),
    Sphere(Sphere),
    Box(Aabb),
}

/// A ray with one shape.
struct Figure<'a> {
    shape: Shape,
    shown: &'a ShownRay,
}

/// Draws a ray; `None` if it is not tested against one shape, or has numbers that cannot be drawn.
pub(super) fn draw(shown: &ShownRay) -> Option<String> {
    let figure = Figure {
        shape: the_shape(shown)?,
        shown,
    };
    let view = View::of(&figure)?;
    Some(figure.draw(&view))
}

/// The only shape; `None` if there are several, or none.
fn the_shape(shown: &ShownRay) -> Option<Shape> {
    let ShownRay { scene, boxes, .. } = shown;
    match (&scene.triangles[..], &scene.spheres[..], &boxes[..]) {
        ([triangle], [], []) => Some(Shape::Triangle(*triangle)),
        ([], [sphere], []) => Some(Shape::Sphere(*sphere)),
        ([], [], [b]) => Some(Shape::Box(*b)),
        _ => None,
    }
}

impl Figure<'_> {
    /// The normals at the hits, expected and yours, if they point elsewhere.
    fn differing_normals(&self) -> Option<[Vec3; 2]> {
        let [expected, yours] = self.shown.normals?;
        (expected.distance(yours) > VISIBLE_ANGLE && yours.is_finite()).then_some([expected, yours])
    }

    fn draw(&self, view: &View) -> String {
        let [w, h] = HALF;
        let mut svg = format!(
            "<svg class=\"ray\" viewBox=\"{} {} {} {}\" role=\"img\" aria-label=\"the ray and its shape\">",
            -w,
            -h,
            2.0 * w,
            2.0 * h
        );
        self.draw_shape(view, &mut svg);
        let reach = view.reach / self.shown.ray.d.length();
        let middle = view.nearest_t(&self.shown.ray);
        let (start, end) = (middle - reach, middle + reach);
        let inside = [
            start.max(self.shown.ray.min_t),
            end.min(self.shown.ray.max_t),
        ];
        line(
            &mut svg,
            "outside",
            view.at(&self.shown.ray, start),
            view.at(&self.shown.ray, end),
        );
        if inside[0] < inside[1] {
            let [from, to] = inside.map(|t| view.at(&self.shown.ray, t));
            line(&mut svg, "inside", from, to);
        }
        arrow(
            &mut svg,
            view.at(&self.shown.ray, end),
            view.at(&self.shown.ray, end - 0.1 * reach),
        );
        if (start..=end).contains(&0.0) {
            dot(&mut svg, "origin", view.at(&self.shown.ray, 0.0), 4.0);
        }
        if let (Some(normals), Some(t)) = (self.differing_normals(), self.shown.expected.first()) {
            let p = self.shown.ray.at(*t);
            for (class, n) in ["expected", "yours"].into_iter().zip(normals) {
                let tip = p + n.normalize_or_zero() * (0.5 * view.reach);
                line(&mut svg, class, view.project(p), view.project(tip));
            }
        }
        let within = |t: &&f64| (start..=end).contains(*t);
        for t in self.shown.expected.iter().filter(within) {
            dot(&mut svg, "expected", view.at(&self.shown.ray, *t), 6.0);
        }
        for t in self.shown.yours.iter().filter(within) {
            cross(&mut svg, view.at(&self.shown.ray, *t));
        }
        svg + "</svg>" + KEY
    }

    fn draw_shape(&self, view: &View, svg: &mut String) {
        match &self.shape {
            Shape::Triangle(t) => {
                let corners = [t.p0, t.p1, t.p2]
                    .map(|p| view.project(p))
                    .map(|[x, y]| format!("{x:.1},{y:.1}"))
                    .join(" ");
                let _ = write!(svg, "<polygon class=\"shape\" points=\"{corners}\"/>");
            }
            Shape::Sphere(sphere) => {
                let [x, y] = view.project(sphere.center);
                let r = sphere.radius * view.scale;
                let _ = write!(
                    svg,
                    "<circle class=\"shape\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\"/>"
                );
            }
            Shape::Box(b) => {
                let corner = |i: u32| {
                    let pick = |axis: usize| if i >> axis & 1 == 1 { b.max } else { b.min }[axis];
                    Vec3::new(pick(0), pick(1), pick(2))
                };
                for i in 0..8 {
                    for bit in [1, 2, 4].into_iter().filter(|bit| i & bit == 0) {
                        let ends = [corner(i), corner(i | bit)].map(|p| view.project(p));
                        line(svg, "edge", ends[0], ends[1]);
                    }
                }
            }
        }
    }
}

/// A parallel projection, in which the ray goes to the right.
struct View {
    centre: Vec3,
    right: Vec3,
    up: Vec3,
    /// Units of the drawing per unit of length.
    scale: f64,
    /// How far the ray is drawn to both sides of its point nearest to the centre.
    reach: f64,
}

impl View {
    /// The view of a scene; `None` if it is not finite or has no size.
    fn of(figure: &Figure<'_>) -> Option<View> {
        let (centre, radius, normal) = match &figure.shape {
            Shape::Triangle(t) => {
                let centre = (t.p0 + t.p1 + t.p2) / 3.0;
                let far = [t.p0, t.p1, t.p2].map(|p| p.distance(centre));
                let normal = (t.p1 - t.p0).cross(t.p2 - t.p0);
                (centre, far.into_iter().fold(0.0, f64::max), normal)
            }
            Shape::Sphere(s) => (s.center, s.radius.abs(), Vec3::new(0.3, 1.0, 0.2)),
            Shape::Box(b) => (
                b.centroid(),
                0.5 * b.extent().length(),
                Vec3::new(0.5, 0.8, 0.6),
            ),
        };
        let d = figure.shown.ray.d.try_normalize()?;
        // Across the ray, so that as much as possible of the shape and all of the ray are seen;
        // turned a little towards the ray, so that a shape across it is not seen from its edge.
        let across = normal - normal.dot(d) * d;
        let across = if across.length() > 1e-3 * normal.length() {
            across.try_normalize()?
        } else {
            d.any_orthonormal_vector()
        };
        let towards_viewer = (across - 0.45 * d).try_normalize()?;
        let right = (d - d.dot(towards_viewer) * towards_viewer).try_normalize()?;
        let offset = figure.shown.ray.o - centre;
        let miss = (offset - offset.dot(d) * d).length();
        let size = radius.max(miss);
        let view = View {
            centre,
            right,
            up: towards_viewer.cross(right),
            scale: 0.8 * HALF[1] / size,
            reach: 1.9 * size,
        };
        let is_drawable = centre.is_finite() && size > 0.0 && size.is_finite();
        (is_drawable && view.scale.is_finite() && view.nearest_t(&figure.shown.ray).is_finite())
            .then_some(view)
    }

    /// The `t` of the ray's point that is nearest to the centre.
    fn nearest_t(&self, ray: &Ray) -> f64 {
        (self.centre - ray.o).dot(ray.d) / ray.d.length_squared()
    }

    fn project(&self, p: Vec3) -> [f64; 2] {
        let offset = (p - self.centre) * self.scale;
        [offset.dot(self.right), -offset.dot(self.up)]
    }

    fn at(&self, ray: &Ray, t: f64) -> [f64; 2] {
        self.project(ray.at(t))
    }
}

fn line(svg: &mut String, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    let _ = write!(
        svg,
        "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
    );
}

fn dot(svg: &mut String, class: &str, [x, y]: [f64; 2], r: f64) {
    let _ = write!(
        svg,
        "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"/>"
    );
}

fn cross(svg: &mut String, [x, y]: [f64; 2]) {
    for side in [-5.0, 5.0] {
        line(svg, "yours", [x - 5.0, y - side], [x + 5.0, y + side]);
    }
}

/// The head of an arrow that ends at `tip` and comes from `tail`.
fn arrow(svg: &mut String, tip: [f64; 2], tail: [f64; 2]) {
    let [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]];
    let length = dx.hypot(dy).max(1e-9);
    let [dx, dy] = [9.0 * dx / length, 9.0 * dy / length];
    for side in [-0.45, 0.45] {
        let barb = [tip[0] - dx - side * dy, tip[1] - dy + side * dx];
        line(svg, "head", barb, tip);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(d: [f64; 3], interval: Option<[f64; 2]>) -> Option<String> {
        draw(&ShownRay {
            boxes: vec![Aabb {
                min: Vec3::ZERO,
                max: Vec3::ONE,
            }],
            expected: vec![3.0, 4.0],
            yours: interval.into_iter().flatten().collect(),
            ..ShownRay::new(Ray::new(Vec3::new(-3.0, 0.5, 0.5), d.into()))
        })
    }

    #[test]
    fn a_figure_shows_the_expected_ends_and_those_of_the_answer() {
        let count = |svg: &str, class: &str| svg.matches(&format!("class=\"{class}\"")).count();
        let right = boxes([1.0, 0.0, 0.0], Some([3.0, 4.0])).expect("it can be drawn");
        assert_eq!(count(&right, "edge"), 12);
        assert_eq!(count(&right, "expected"), 2);
        assert_eq!(count(&right, "yours"), 4, "two crosses of two lines");
        let missed = boxes([1.0, 0.0, 0.0], None).expect("it can be drawn");
        assert_eq!(
            [count(&missed, "expected"), count(&missed, "yours")],
            [2, 0]
        );
        assert!(!missed.contains("NaN"), "{missed}");
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        assert_eq!(boxes([0.0; 3], None), None);
        assert_eq!(boxes([f64::NAN, 0.0, 0.0], None), None);
    }
}
