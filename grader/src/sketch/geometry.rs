//! Draws a ray at the shapes that it is tested against.

use super::model::{Ink, Layout, Sketch, Stroke, TAxis, sides};
use super::view::{self, Frame, View};
use super::words::Anchor;
use judge::shown::ShownRay;
use kit::{Aabb, Ray, Scene, Sphere, Triangle, Vec3};

/// Normals that differ by less look the same.
const VISIBLE_ANGLE: f64 = 0.05;

/// The most shapes in a drawing.
const MOST_SHAPES: usize = 12;

/// Draws a ray and its shapes, seen from where the difference shows.
pub(super) fn ray(shown: &ShownRay) -> Option<Sketch> {
    let Scene {
        triangles, spheres, ..
    } = &shown.scene;
    let shapes = triangles.len() + spheres.len() + shown.boxes.len();
    if shapes == 0 || shapes > MOST_SHAPES {
        return None;
    }
    let (strokes, seen) = match (&triangles[..], &spheres[..], &shown.boxes[..]) {
        ([triangle], [], []) => of_triangle(shown, triangle)?,
        ([], [sphere], []) => of_sphere(shown, sphere)?,
        _ => of_shapes(shown)?,
    };
    let caption = match not_finite(shown) {
        Some(answer) => format!("{seen}; your {answer} is not finite"),
        None => seen,
    };
    Some(Sketch {
        axis: axis(shown),
        ..Sketch::new(strokes, &caption, Layout::Shape)
    })
}

/// The axis of `t`, where it shows what the shapes do not: a range that ends, or different `t`.
fn axis(shown: &ShownRay) -> Option<TAxis> {
    let range = [shown.ray.min_t, shown.ray.max_t];
    let is_open = range == [0.0, f64::INFINITY];
    let all_ahead = shown.expected.iter().chain(&shown.yours).all(|t| *t >= 0.0);
    let same = shown.expected.is_empty() || shown.yours.is_empty() || shown.expected == shown.yours;
    let is_needless = is_open && all_ahead && same;
    let finite = |ts: &[f64]| ts.iter().copied().filter(|t| t.is_finite()).collect();
    (!is_needless).then(|| TAxis {
        range,
        expected: finite(&shown.expected),
        yours: finite(&shown.yours),
    })
}

/// The normals at the hit, expected and yours, if they point elsewhere. At another point of the ray
/// the normal is another one.
fn differing_normals(shown: &ShownRay) -> Option<[Vec3; 2]> {
    let (right, found) = (shown.expected.first()?, shown.yours.first()?);
    if (right - found).abs() > 1e-6 * right.abs() {
        return None;
    }
    let [expected, yours] = shown.normals?;
    (expected.distance(yours) > VISIBLE_ANGLE && yours.is_finite()).then_some([expected, yours])
}

/// The part of the code's answer that cannot be drawn, since it is infinite or NaN.
fn not_finite(shown: &ShownRay) -> Option<&'static str> {
    let is_finite = |vectors: Option<[Vec3; 2]>| vectors.is_none_or(|[_, yours]| yours.is_finite());
    match shown.yours.iter().all(|t| t.is_finite()) {
        false => Some("t"),
        true if !is_finite(shown.points) => Some("point"),
        true if !is_finite(shown.normals) => Some("normal"),
        true => None,
    }
}

/// Where the code's answer says that the hit is, if that is not where the ray is at its `t`, and
/// not the right point either: of a right point it is `t` that is wrong.
fn stray_point(shown: &ShownRay) -> Option<Vec3> {
    let [expected, yours] = shown.points?;
    let along = shown.yours.first().map(|t| shown.ray.at(*t));
    let far = |p: Vec3| yours.distance(p) > VISIBLE_DISTANCE * expected.length().max(1.0);
    (yours.is_finite() && along.is_none_or(|p| far(p) && far(expected))).then_some(yours)
}

/// Points that differ by less, relative to their distance from the origin, are those of the ray.
const VISIBLE_DISTANCE: f64 = 1e-9;

/// Where the code says that the ray meets the shapes.
fn your_points(shown: &ShownRay) -> Vec<Vec3> {
    match stray_point(shown) {
        Some(p) => vec![p],
        // The ray at its t would be another point.
        None if shown.points.is_some_and(|[_, yours]| !yours.is_finite()) => Vec::new(),
        None => shown.yours.iter().map(|t| shown.ray.at(*t)).collect(),
    }
}

/// Marks the hits, or where the ray passes if there are none.
fn marks(strokes: &mut Vec<Stroke>, shown: &ShownRay, view: &View, frame: &Frame) {
    let expected = shown.expected.iter().map(|t| shown.ray.at(*t)).collect();
    for (ink, points) in [(Ink::Expected, expected), (Ink::Yours, your_points(shown))] {
        let places = points.into_iter().map(|p| view.place(p));
        strokes.extend(
            places
                .filter(|at| frame.contains(*at))
                .map(|at| Stroke::Mark(ink, at)),
        );
    }
}

/// Draws both normals at the right hit.
fn normals(strokes: &mut Vec<Stroke>, shown: &ShownRay, view: &View, length: f64) {
    let (Some([expected, yours]), Some(t)) = (differing_normals(shown), shown.expected.first())
    else {
        return;
    };
    let p = shown.ray.at(*t);
    for (ink, n, name) in [
        (Ink::Expected, expected, "expected normal"),
        (Ink::Yours, yours, "your normal"),
    ] {
        let ends = [p, p + length * n.normalize_or_zero()].map(|end| view.place(end));
        strokes.push(Stroke::Arrow(ink, ends));
        strokes.push(Stroke::word_at_tip(ends, name));
    }
}

/// A triangle in its own plane, with the point where the ray crosses it; or from its side, where
/// normals differ or the ray is parallel to it.
fn of_triangle(shown: &ShownRay, triangle: &Triangle) -> Option<(Vec<Stroke>, String)> {
    let Triangle { p0, p1, p2, .. } = *triangle;
    let right = (p1 - p0).try_normalize()?;
    let n = (p1 - p0).cross(p2 - p0).try_normalize()?;
    let d = shown.ray.d.try_normalize()?;
    // A point beside the plane is seen from the side alone.
    let is_beside = stray_point(shown).is_some_and(|p| {
        let off = p - p0;
        off.dot(n).abs() > 0.1 * off.length()
    });
    if differing_normals(shown).is_some() || is_beside || n.dot(d).abs() < 1e-9 {
        return triangle_from_its_side(shown, triangle, n);
    }
    let view = View {
        origin: p0,
        right,
        up: n.cross(right),
    };
    let t = n.dot(p0 - shown.ray.o) / n.dot(shown.ray.d);
    let crossing = view.place(shown.ray.at(t));
    let corners = [p0, p1, p2].map(|p| view.place(p));
    let mut others = vec![crossing];
    others.extend(your_points(shown).into_iter().map(|p| view.place(p)));
    let frame = Frame::around(&corners, &others)?;
    let mut strokes = edges_of(corners);
    for (i, corner) in corners.into_iter().enumerate() {
        strokes.push(Stroke::Word(Anchor::Start, corner, format!("p{i}")));
    }
    match shown.expected.is_empty() && shown.yours.is_empty() {
        true => strokes.push(Stroke::Mark(Ink::Shape, crossing)),
        false => marks(&mut strokes, shown, &view, &frame),
    }
    let side = if n.dot(d) < 0.0 { "front" } else { "back" };
    Some((
        strokes,
        format!("the triangle's plane, ray from the {side}"),
    ))
}

fn triangle_from_its_side(
    shown: &ShownRay,
    triangle: &Triangle,
    n: Vec3,
) -> Option<(Vec<Stroke>, String)> {
    let Triangle { p0, p1, p2, .. } = *triangle;
    let in_plane = |v: Vec3| {
        let v = v - v.dot(n) * n;
        (v.length() > 1e-6).then(|| v.normalize())
    };
    let difference = differing_normals(shown).and_then(|[a, b]| in_plane(b - a));
    let right = difference
        .or_else(|| in_plane(shown.ray.d))
        .or_else(|| in_plane(p1 - p0))?;
    let view = View {
        origin: p0,
        right,
        up: n,
    };
    let corners = [p0, p1, p2].map(|p| view.place(p));
    let size = corners.iter().map(|p| p[0]).fold(0.0, f64::max)
        - corners.iter().map(|p| p[0]).fold(0.0, f64::min);
    let tall = corners.map(|[x, _]| [x, 0.3 * size]);
    let low = corners.map(|[x, _]| [x, -0.3 * size]);
    let mut others = vec![view.place(shown.ray.o)];
    others.extend(stray_point(shown).map(|p| view.place(p)));
    let frame = Frame::around(&[corners, tall, low].concat(), &others)?;
    let mut strokes = edges_of(corners);
    marks(&mut strokes, shown, &view, &frame);
    normals(&mut strokes, shown, &view, 0.3 * size);
    view::ray(&mut strokes, &view, &frame, shown);
    Some((strokes, "the triangle from its side, front up".into()))
}

fn edges_of(corners: [[f64; 2]; 3]) -> Vec<Stroke> {
    let edges = sides(corners).map(|ends| Stroke::Line(Ink::Shape, ends));
    edges.to_vec()
}

/// A sphere in the plane of the ray and the centre.
fn of_sphere(shown: &ShownRay, sphere: &Sphere) -> Option<(Vec<Stroke>, String)> {
    let right = shown.ray.d.try_normalize()?;
    let offset = shown.ray.o - sphere.center;
    let across = offset - offset.dot(right) * right;
    let up = match across.length() > 1e-9 * sphere.radius {
        true => across.try_normalize()?,
        false => right.any_orthonormal_vector(),
    };
    let view = View {
        origin: sphere.center,
        right,
        up,
    };
    let strokes = of_scene(shown, &view)?;
    Some((strokes, "the plane of ray and centre".into()))
}

/// Shapes in the plane of two axes: the first is the ray's main one, the other shows that the ray
/// misses, if it does.
fn of_shapes(shown: &ShownRay) -> Option<(Vec<Stroke>, String)> {
    let d = shown.ray.d.abs();
    let main = if d.x >= d.y && d.x >= d.z {
        0
    } else if d.y >= d.z {
        1
    } else {
        2
    };
    let others = [(main + 1) % 3, (main + 2) % 3];
    let misses_in = |axis: usize| {
        let mut boxes = shown.boxes.iter();
        boxes.any(|b| is_beside(b, &shown.ray, [main, axis]))
    };
    let other = match shown.expected.is_empty() && !misses_in(others[0]) && misses_in(others[1]) {
        true => others[1],
        false => others[0],
    };
    // The axes in their usual order.
    let axes = [main.min(other), main.max(other)];
    let unit = |axis: usize| Vec3::AXES[axis];
    let view = View {
        origin: Vec3::ZERO,
        right: unit(axes[0]),
        up: unit(axes[1]),
    };
    let strokes = of_scene(shown, &view)?;
    let names = ["x", "y", "z"];
    let caption = format!("{} to the right, {} up", names[axes[0]], names[axes[1]]);
    Some((strokes, caption))
}

/// Whether the line along the ray passes beside the box in the plane of two axes.
fn is_beside(b: &Aabb, ray: &Ray, axes: [usize; 2]) -> bool {
    let in_plane = |v: Vec3| axes.map(|axis| v[axis]);
    let corners = [b.min, b.max].map(in_plane);
    let inside = view::inside(corners, in_plane(ray.o), in_plane(ray.d));
    inside.is_none_or(|[from, to]| from > to)
}

/// All shapes with the ray, in a view.
fn of_scene(shown: &ShownRay, view: &View) -> Option<Vec<Stroke>> {
    let mut shapes = Vec::new();
    for triangle in &shown.scene.triangles {
        let corners = [triangle.p0, triangle.p1, triangle.p2].map(|p| view.place(p));
        shapes.extend(sides(corners));
    }
    for sphere in &shown.scene.spheres {
        let [x, y] = view.place(sphere.center);
        let around = |step: u32| {
            let angle = f64::from(step) / 48.0 * std::f64::consts::TAU;
            [
                x + sphere.radius * angle.cos(),
                y + sphere.radius * angle.sin(),
            ]
        };
        shapes.extend((0..48).map(|step| [around(step), around(step + 1)]));
    }
    for b in &shown.boxes {
        let [[x0, y0], [x1, y1]] = [b.min, b.max].map(|p| view.place(p));
        shapes.extend(sides([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]));
    }
    let expected = shown.expected.iter().map(|t| shown.ray.at(*t));
    let others: Vec<[f64; 2]> = expected
        .chain(your_points(shown))
        .chain([shown.ray.o])
        .map(|p| view.place(p))
        .collect();
    let frame = Frame::around(&shapes.concat(), &others)?;
    let lines = shapes.into_iter();
    let mut strokes: Vec<Stroke> = lines.map(|ends| Stroke::Line(Ink::Shape, ends)).collect();
    marks(&mut strokes, shown, view, &frame);
    let size = shown.scene.spheres.iter().map(|sphere| sphere.radius);
    normals(&mut strokes, shown, view, size.fold(1.0, f64::min));
    view::ray(&mut strokes, view, &frame, shown);
    Some(strokes)
}
