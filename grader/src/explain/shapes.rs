//! Draws rays at triangles, spheres and boxes.

use super::drawing::Drawing;
use crate::sketch::plot::Plot;
use judge::expected::HitOrMiss;
use judge::plural;
use judge::shown::ShownRay;
use kit::{Aabb, Sphere, Triangle, Vec3};

/// Draws rays that are each tested against one triangle, one sphere or one box; `None` for others.
pub(super) fn rays(rays: &[&ShownRay]) -> Option<Drawing> {
    fn each<'a, T>(
        rays: &[&'a ShownRay],
        shapes: impl Fn(&'a ShownRay) -> &'a [T],
    ) -> Option<Vec<(&'a ShownRay, &'a T)>> {
        let pairs = rays.iter().map(|ray| {
            let ShownRay { scene, boxes, .. } = ray;
            let all = scene.triangles.len() + scene.spheres.len() + boxes.len();
            match shapes(ray) {
                [shape] if all == 1 => Some((*ray, shape)),
                _ => None,
            }
        });
        pairs.collect()
    }
    let of_triangles = each(rays, |ray| &ray.scene.triangles);
    of_triangles
        .map(|pairs| triangles(&pairs))
        .or_else(|| Some(spheres(&each(rays, |ray| &ray.scene.spheres)?)))
        .or_else(|| Some(boxes(&each(rays, |ray| &ray.boxes)?)))
}

/// The mark of a ray.
fn mark(shown: &ShownRay) -> char {
    match shown.decision {
        HitOrMiss::Hit => 'o',
        HitOrMiss::Miss => 'x',
        HitOrMiss::Either => '?',
    }
}

/// "8 rays: 5 must hit, 3 must miss".
fn counts<T>(all: &[(&ShownRay, T)]) -> String {
    let decisions = [
        (HitOrMiss::Hit, "must hit"),
        (HitOrMiss::Miss, "must miss"),
        (HitOrMiss::Either, "may do either"),
    ];
    let parts = decisions.into_iter().filter_map(|(decision, what)| {
        let count = all
            .iter()
            .filter(|(ray, _)| ray.decision == decision)
            .count();
        (count > 0).then(|| format!("{count} {what}"))
    });
    let rays = plural(all.len(), "ray", "rays");
    format!("{rays}: {}", parts.collect::<Vec<_>>().join(", "))
}

/// Adds the legend of marks, and how many rays are not in the drawing.
fn finish(plot: &Plot, what: &str, outside: usize) -> Drawing {
    let signs = "o hit, x miss, ? either, * several different ones";
    let drawing = Drawing::new(plot, &[what, signs]);
    drawing.without(outside, ["ray is", "rays are"], "outside the drawing")
}

/// All triangles as one: each ray is where the line along it meets its triangle's plane, by its
/// barycentric weights.
fn triangles(all: &[(&ShownRay, &Triangle)]) -> Drawing {
    let mut plot = Plot::new([-0.6, -0.45], [1.6, 1.3]);
    // p0 at the bottom left, p1 at the bottom right, p2 at the top.
    let place = |b1: f64, b2: f64| [b1 + 0.5 * b2, b2];
    plot.outline(&[place(0.0, 0.0), place(1.0, 0.0), place(0.0, 1.0)]);
    let (mut front, mut back, mut never, mut outside) = (0, 0, 0, 0);
    for (shown, triangle) in all {
        let ray = &shown.ray;
        let (e1, e2) = (triangle.p1 - triangle.p0, triangle.p2 - triangle.p0);
        let normal = e1.cross(e2);
        let along = normal.dot(ray.d);
        let t = normal.dot(triangle.p0 - ray.o) / along;
        let at = ray.o + t * ray.d - triangle.p0;
        let area = normal.length_squared();
        let b1 = at.cross(e2).dot(normal) / area;
        let b2 = e1.cross(at).dot(normal) / area;
        if !(t.is_finite() && b1.is_finite() && b2.is_finite()) {
            never += 1;
            continue;
        }
        front += usize::from(along < 0.0);
        back += usize::from(along > 0.0);
        outside += usize::from(!plot.mark(place(b1, b2), mark(shown)));
    }
    let mut words = format!(
        "; {}. {front} come from the front, {back} from behind",
        counts(all)
    );
    if never > 0 {
        let rays = plural(never, "ray never crosses", "rays never cross");
        words.push_str(&format!(". {rays} the plane at one point"));
    }
    let what = "where rays cross the plane; p0 left, p1 right, p2 top";
    Drawing {
        words,
        ..finish(&plot, what, outside)
    }
}

/// All spheres as one: each ray goes to the right, as far above the centre as it passes it, from
/// the mark of its origin on.
fn spheres(all: &[(&ShownRay, &Sphere)]) -> Drawing {
    const REACH: f64 = 3.6;
    let mut plot = Plot::new([-REACH, -1.1], [REACH, 1.7]);
    plot.unit_circle();
    let (mut inside, mut nearest, mut farthest, mut outside) = (0, f64::INFINITY, 0.0_f64, 0);
    for (shown, sphere) in all {
        let ray = &shown.ray;
        let to_center = sphere.center - ray.o;
        let d = ray.d.normalize_or_zero();
        let along = to_center.dot(d) / sphere.radius;
        let aside = (to_center - to_center.dot(d) * d).length() / sphere.radius;
        inside += usize::from(to_center.length() < sphere.radius);
        if aside.is_finite() {
            nearest = nearest.min(aside);
            farthest = farthest.max(aside);
        }
        let x = (-along).clamp(-REACH, REACH);
        outside += usize::from(!plot.mark([x, aside], mark(shown)));
    }
    let words = format!(
        "; {}. {inside} start inside. They pass the centre at {nearest:.3} to {farthest:.3} radii",
        counts(all)
    );
    let what = "origins of rays that go right; farther ones are at the edge";
    Drawing {
        words,
        ..finish(&plot, what, outside)
    }
}

/// The most rays that are drawn at a box.
const RAYS_AT_A_BOX: usize = 6;

/// The first box that has a size along two axes, seen along the third one, and some of its rays.
fn boxes(all: &[(&ShownRay, &Aabb)]) -> Drawing {
    let drawable = all.iter().find_map(|(_, b)| Some((*b, sides(b)?)));
    let Some((&Aabb { min, max }, [u, v])) = drawable else {
        return Drawing {
            words: ". No box has an area to draw".to_owned(),
            lines: Vec::new(),
        };
    };
    let flat = |p: Vec3| [p[u], p[v]];
    let margin = 0.8 * (max - min);
    let mut plot = Plot::new(flat(min - margin), flat(max + margin));
    plot.outline(&[
        [min[u], min[v]],
        [max[u], min[v]],
        [max[u], max[v]],
        [min[u], max[v]],
    ]);
    let same = all.iter().filter(|(_, b)| (b.min, b.max) == (min, max));
    let mut outside = 0;
    for (shown, _) in same.take(RAYS_AT_A_BOX) {
        let ray = &shown.ray;
        let reach = 2.0 * ((max - min).length() + (0.5 * (min + max) - ray.o).length());
        let end = ray.o + reach * ray.d.normalize_or_zero();
        // From the origin to far behind the box, as far as the drawing shows it.
        plot.line(flat(ray.o), flat(end));
        // At the origin, or where the ray enters the drawing.
        let mut steps = (0..400)
            .map(|step| ray.o.lerp(end, f64::from(step) / 400.0))
            .map(flat);
        outside += usize::from(!steps.any(|point| plot.mark(point, mark(shown))));
    }
    let axes = ["x", "y", "z"];
    let what = format!(
        "a box with some of its rays, {} right, {} up",
        axes[u], axes[v]
    );
    finish(&plot, &what, outside)
}

/// The first two axes along which a box has a finite size.
fn sides(&Aabb { min, max }: &Aabb) -> Option<[usize; 2]> {
    let mut axes = (0..3).filter(|axis| {
        let size = max[*axis] - min[*axis];
        size > 0.0 && size.is_finite()
    });
    Some([axes.next()?, axes.next()?])
}
