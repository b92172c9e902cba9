//! Cases of rays and boxes.

use crate::tools::questions::probes::wire_ray;
use crate::tools::spec::Spec;
use kit::{Aabb, PixelSampler, Ray, Vec3};
use wire::kind;
use wire::work::{BoxWork, Probe};

/// The cases of `part2.task2`; the random boxes and rays come from `seed`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    let mut cases = vec![
        case(
            "all_octants",
            "Rays from all eight octants through a box. Pitfall: where d is negative, the ray \
             crosses the max plane first.",
            octants(),
        ),
        case(
            "miss_on_one_axis",
            "Rays inside two of the three slabs, but outside the third. Pitfall: all three axes \
             must be tested before anything is returned.",
            beside_on_one_axis(),
        ),
        case(
            "behind",
            "Boxes behind the ray's origin: the line crosses them at t < 0 only.",
            behind(),
        ),
        case(
            "origin_inside",
            "The ray starts inside the box: a hit, whose interval starts at min_t.",
            inside(),
        ),
        case(
            "along_an_axis_inside",
            "Rays parallel to an axis, inside the slabs of the other two: d is 0 there, and the \
             ray hits.",
            along_axes(true),
        ),
        case(
            "along_an_axis_beside",
            "Rays parallel to an axis, outside the box: on an axis where d is 0, the origin \
             decides. Where d is only small, the ray may still reach the box. Pitfall: treating a \
             small d as 0.",
            [along_axes(false), nearly_along_axes()].concat(),
        ),
        case(
            "clipped",
            "Ranges that end before the box, start behind it, cut it or have one point in common \
             with it: the interval is clipped to min_t..=max_t, and both ends count. Pitfall: with \
             `>=` for `>` between start and end, a ray that starts on the face through which it \
             leaves misses.",
            clipped(),
        ),
        case(
            "any_length_of_d",
            "Directions whose length is not 1: t is in units of the length of d.",
            scaled_directions(),
        ),
        case(
            "flat_box_crossed",
            "Boxes without depth, such as those of walls: a ray that crosses one enters and \
             leaves at the same t, which is a hit.",
            flat_crossed(),
        ),
        case(
            "near_misses",
            "Rays that pass the box at a millionth of its size, for sizes from 1e-6 to 1e6. \
             Pitfall: padding by an epsilon turns these misses into hits.",
            near_misses(),
        ),
        case(
            "fresh_random",
            "Random boxes and rays that depend on the seed.",
            random(seed),
        ),
        case(
            "origin_on_a_face",
            "The origin lies on a plane of the box and the ray runs along that plane. Pitfall: 0 \
             / 0 is NaN, and comparisons with NaN are false.",
            on_faces(),
        ),
        case(
            "edges_of_a_grid",
            "The boxes of a tree over a mesh with integer coordinates: rays along their edges, and \
             rays that slant in the plane of a face, through the box or beside it. The zeros of d \
             have both signs. Pitfall: 0 * inf is NaN at one plane or two, and what becomes of it \
             depends on which plane it is, and on the sign of the zero.",
            on_a_grid(),
        ),
        case(
            "flat_box_in_its_plane",
            "Rays inside the plane of a flat box: faces belong to the box, so the ray hits.",
            flat_in_plane(),
        ),
        case(
            "corners_and_edges",
            "Rays aimed at corners and edges: rounding may turn a miss into a hit, but never a \
             hit into a miss, which would be a hole in the picture.",
            corners_and_edges(seed),
        ),
        case(
            "range_behind_the_origin",
            "Ranges with a negative min_t: the part of the box behind the origin counts as far as \
             min_t. Pitfall: limiting the start of the interval to 0.",
            clipped_behind(),
        ),
        case(
            "point_box",
            "A box that is a single point: a ray exactly through it hits.",
            point_boxes(),
        ),
        case(
            "empty_box",
            "An empty box (min > max) and an empty range (min_t > max_t): both are a miss. \
             Pitfall: sorting the two planes of an axis turns an empty box into a large one, and \
             comparing with each end of the range alone does not detect that the range is empty.",
            empty_boxes(),
        ),
        case(
            "infinite_box",
            "Boxes that are infinite along some axes. Pitfall: inf - inf and 0 * inf are NaN.",
            infinite_boxes(),
        ),
        case(
            "not_a_number",
            "NaN in the box or the ray, and d = 0 outside the box: a miss.",
            not_numbers(),
        ),
        case(
            "denormal_direction",
            "A component of d so small that 1 / d overflows: the ray is nearly parallel, but not \
             parallel.",
            denormal(),
        ),
    ];
    cases.push(picture());
    cases
}

fn case(name: &'static str, about: &'static str, probes: Vec<(Aabb, Ray)>) -> Spec {
    let boxes = probes
        .iter()
        .map(|(b, _)| [b.min.into(), b.max.into()])
        .collect();
    let probes = (0..).zip(&probes).map(|(shape, (_, ray))| Probe {
        shape,
        ray: wire_ray(ray),
    });
    let work = BoxWork {
        boxes,
        probes: probes.collect(),
    };
    Spec::new::<kind::Boxes>("part2.task2", name, about, work)
}

/// An asymmetric box, with no face at an integer.
const BOX: Aabb = Aabb {
    min: Vec3::new(-1.3, 0.7, -2.1),
    max: Vec3::new(1.9, 2.4, -0.4),
};

/// A box with integer coordinates.
const ROUND: Aabb = Aabb {
    min: Vec3::new(-1.0, -2.0, 1.0),
    max: Vec3::new(3.0, 2.0, 2.0),
};

/// The ray from `o` towards `target`, with a unit direction.
fn towards(o: Vec3, target: Vec3) -> Ray {
    Ray::new(o, (target - o).normalize())
}

/// The eight combinations of signs.
fn signs() -> impl Iterator<Item = Vec3> {
    (0..8).map(|i| {
        let sign = |bit: u32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        Vec3::new(sign(0), sign(1), sign(2))
    })
}

/// The point of a box with the given share of its extent on each axis.
fn point_of(b: &Aabb, share: Vec3) -> Vec3 {
    b.min + share * b.extent()
}

/// The three axes with both signs.
fn directions() -> impl Iterator<Item = (usize, f64)> {
    (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)])
}

fn octants() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for corner in signs() {
        for share in [
            Vec3::splat(0.5),
            Vec3::new(0.2, 0.7, 0.4),
            Vec3::new(0.9, 0.3, 0.8),
        ] {
            let o = BOX.centroid() + corner * Vec3::new(5.0, 4.0, 7.0);
            probes.push((BOX, towards(o, point_of(&BOX, share))));
            probes.push((
                BOX,
                towards(
                    o,
                    point_of(&BOX, share) + 4.0 * Vec3::new(corner.z, corner.x, corner.y),
                ),
            ));
        }
    }
    probes
}

fn beside_on_one_axis() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            for corner in signs() {
                // The ray is nearly perpendicular to `axis` and runs a little outside the slab.
                let mut o = BOX.centroid() + corner * Vec3::splat(6.0);
                let mut target = BOX.centroid() - corner * Vec3::new(0.2, 0.1, 0.3);
                let outside = BOX.centroid()[axis] + side * 0.5 * BOX.extent()[axis];
                o[axis] = outside + side * 1.5;
                target[axis] = outside + side * 1.2;
                probes.push((BOX, towards(o, target)));
            }
        }
    }
    probes
}

fn behind() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for corner in signs() {
        let o = BOX.centroid() + corner * Vec3::new(5.0, 4.0, 7.0);
        for share in [Vec3::splat(0.5), Vec3::new(0.2, 0.7, 0.4)] {
            let ray = towards(o, point_of(&BOX, share));
            probes.push((BOX, Ray { d: -ray.d, ..ray }));
        }
    }
    probes.extend(directions().map(|(axis, sign)| {
        let o = BOX.centroid() + 5.0 * sign * Vec3::AXES[axis];
        (BOX, Ray::new(o, sign * Vec3::AXES[axis]))
    }));
    probes
}

fn inside() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for corner in signs() {
        for share in [Vec3::splat(0.5), Vec3::new(0.1, 0.8, 0.6)] {
            let ray = Ray::new(
                point_of(&BOX, share),
                (corner * Vec3::new(1.0, 2.0, 0.5)).normalize(),
            );
            probes.push((BOX, ray));
            probes.push((
                BOX,
                Ray {
                    min_t: 0.05,
                    max_t: 0.1,
                    ..ray
                },
            ));
        }
    }
    probes
}

fn along_axes(through: bool) -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for (axis, sign) in directions() {
        for share in [Vec3::splat(0.5), Vec3::new(0.25, 0.75, 0.6)] {
            let mut o = point_of(&BOX, share);
            o[axis] -= 7.0 * sign;
            let ray = Ray::new(o, sign * Vec3::AXES[axis]);
            if through {
                probes.push((BOX, ray));
                // This ray is parallel to one pair of planes only.
                let tilted = ray.d + 0.05 * Vec3::AXES[(axis + 1) % 3];
                probes.push((BOX, Ray::new(o, tilted.normalize())));
                continue;
            }
            for (other, side) in directions().filter(|&(other, _)| other != axis) {
                let mut o = o;
                o[other] += 9.0 * side;
                probes.push((BOX, Ray::new(o, ray.d)));
                let tilted = ray.d + 0.05 * Vec3::AXES[3 - axis - other];
                probes.push((BOX, Ray::new(o, tilted.normalize())));
            }
        }
    }
    probes
}

/// Rays at an angle of 5e-5 to an axis, from far away. Those that start beside one of the
/// slabs of the other two axes hit the box; those that start within both slabs pass it.
fn nearly_along_axes() -> Vec<(Aabb, Ray)> {
    const DISTANCE: f64 = 1e5;
    const SLOPE: f64 = 5e-5;
    let mut probes = Vec::new();
    for (axis, sign) in directions() {
        for (other, side) in directions().filter(|&(other, _)| other != axis) {
            let mut d = sign * Vec3::AXES[axis];
            d[other] = SLOPE * side;
            let inside = point_of(&BOX, Vec3::new(0.4, 0.7, 0.55));
            let far = inside - DISTANCE * sign * Vec3::AXES[axis];
            probes.push((BOX, Ray::new(far, d)));
            let beside = far - DISTANCE * SLOPE * side * Vec3::AXES[other];
            probes.push((BOX, Ray::new(beside, d)));
        }
    }
    probes
}

/// A ray and the round box, with the range from `min_t` to `max_t`.
fn clipped_to(ray: Ray, min_t: f64, max_t: f64) -> (Aabb, Ray) {
    let ray = Ray {
        min_t,
        max_t,
        ..ray
    };
    (ROUND, ray)
}

/// Ranges with a negative `min_t`: on rays with the box behind their origin, and on rays that start
/// inside the box.
fn clipped_behind() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for corner in signs() {
        // The ray `behind` is in the box from t = -8.5 to t = -7.5, the ray `inside` from t = -0.5
        // to t = 0.5.
        let behind = Ray::new(ROUND.centroid() + 8.0 * corner, corner);
        let inside = Ray::new(ROUND.centroid(), corner);
        for (ray, min_t, max_t) in [
            (behind, -20.0, f64::INFINITY),
            (behind, -8.0, 20.0),
            (behind, -20.0, -8.0),
            (behind, -7.0, 20.0),
            (inside, -20.0, 20.0),
            (inside, -0.25, 0.25),
        ] {
            probes.push(clipped_to(ray, min_t, max_t));
        }
    }
    probes
}

fn clipped() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for corner in signs() {
        let o = ROUND.centroid() - 8.0 * corner;
        let ray = Ray::new(o, corner);
        // This ray is in the box from t = 7.5 to t = 8.5.
        for (min_t, max_t) in [
            (0.0, 7.0),
            (0.0, 8.0),
            (7.75, 8.25),
            (8.0, f64::INFINITY),
            (9.0, f64::INFINITY),
            (0.0, 20.0),
            (-20.0, 0.0),
            // The range and the box share one t: at the entry, inside, at the exit.
            (0.0, 7.5),
            (8.0, 8.0),
            (8.5, f64::INFINITY),
        ] {
            probes.push(clipped_to(ray, min_t, max_t));
        }
        // `leaving` starts on the face through which it leaves the box. `entering` starts and ends
        // on the face through which it enters. Each shares only t = 0 with the box, and widening by
        // a factor leaves 0 as it is.
        let half = 0.5 * ROUND.extent().min_element();
        let leaving = Ray::new(ROUND.centroid() + half * corner, corner);
        let entering = Ray::new(ROUND.centroid() - half * corner, corner);
        probes.push(clipped_to(leaving, 0.0, 20.0));
        probes.push(clipped_to(entering, 0.0, 0.0));
    }
    probes
}

fn scaled_directions() -> Vec<(Aabb, Ray)> {
    let each = octants().into_iter().step_by(5);
    each.flat_map(|(b, ray)| {
        [1e-3, 0.3, 17.0, 1e4].map(|scale| {
            (
                b,
                Ray {
                    d: scale * ray.d,
                    ..ray
                },
            )
        })
    })
    .collect()
}

/// The lower face of `b` along `axis`, as a box without depth.
fn flattened(b: Aabb, axis: usize) -> Aabb {
    let mut flat = b;
    flat.max[axis] = flat.min[axis];
    flat
}

fn flat_crossed() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for (axis, sign) in directions() {
        let flat = flattened(BOX, axis);
        for share in [Vec3::splat(0.5), Vec3::new(0.2, 0.3, 0.9)] {
            let target = point_of(&flat, share);
            let straight = Ray::new(
                target - 3.7 * sign * Vec3::AXES[axis],
                sign * Vec3::AXES[axis],
            );
            probes.push((flat, straight));
            let from = target - sign * Vec3::new(1.1, 1.3, 1.7);
            probes.push((flat, towards(from, target)));
            probes.push((
                flat,
                towards(from, target + 5.0 * Vec3::AXES[(axis + 1) % 3]),
            ));
        }
    }
    probes
}

/// Rays perpendicular to one axis that miss a face of the box by a millionth of the box's size.
fn near_misses() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for scale in [1e-6, 1.0, 1e6] {
        let b = Aabb {
            min: scale * BOX.min,
            max: scale * BOX.max,
        };
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                let mut share = Vec3::splat(0.4);
                share[axis] = side + 1e-6 * (2.0 * side - 1.0);
                let target = point_of(&b, share);
                let along = scale * (Vec3::AXES[(axis + 1) % 3] + 0.3 * Vec3::AXES[(axis + 2) % 3]);
                probes.push((b, towards(target - 4.0 * along, target)));
                probes.push((b, towards(target + 4.0 * along, target)));
            }
        }
    }
    probes
}

fn random_point(sampler: &mut PixelSampler) -> Vec3 {
    let xy = sampler.next_2d();
    2.0 * xy.extend(sampler.next_1d()) - 1.0
}

fn random(seed: u64) -> Vec<(Aabb, Ray)> {
    let mut sampler = PixelSampler::new(0, 2, seed);
    let one = |_| {
        let b = Aabb::of([random_point(&mut sampler), random_point(&mut sampler)]);
        let o = 3.0 * random_point(&mut sampler);
        let target = 1.2 * random_point(&mut sampler);
        (b, towards(o, target))
    };
    (0..2000).map(one).collect()
}

/// Rays along the plane of a face, with origins before, on, behind and beside the face; the zeros
/// of `d` have both signs.
fn on_faces() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for (axis, sign) in directions() {
        for other in (0..3).filter(|&other| other != axis) {
            for (plane, zero) in [(0.0, 0.0), (0.0, -0.0), (1.0, 0.0), (1.0, -0.0)] {
                let mut share = Vec3::splat(0.5);
                share[other] = plane;
                let on_plane = point_of(&ROUND, share);
                let mut d = Vec3::splat(zero);
                d[axis] = sign;
                probes.push((ROUND, Ray::new(on_plane - 5.0 * sign * Vec3::AXES[axis], d)));
                probes.push((ROUND, Ray::new(on_plane, d)));
                probes.push((ROUND, Ray::new(on_plane + 5.0 * sign * Vec3::AXES[axis], d)));
                let third = Vec3::AXES[3 - axis - other];
                probes.push((ROUND, Ray::new(on_plane + 9.0 * third, d)));
            }
        }
    }
    probes
}

/// Boxes with integer coordinates, one of them flat. For each: rays along all edges from before the
/// box, from on the edge and from behind; then rays in the planes of faces that slant towards the
/// box, or pass it. All combinations of the zeros' signs.
fn on_a_grid() -> Vec<(Aabb, Ray)> {
    const ZEROS: [f64; 2] = [0.0, -0.0];
    let mut probes = Vec::new();
    for b in [ROUND, flattened(ROUND, 2)] {
        for (axis, sign) in directions() {
            let [other, third] = [1, 2].map(|turn| (axis + turn) % 3);
            let along = sign * Vec3::AXES[axis];
            for plane in [0.0, 1.0] {
                let mut share = Vec3::splat(plane);
                share[axis] = 0.5;
                for [zero, last_zero] in [0, 1, 2, 3].map(|i| [ZEROS[i / 2], ZEROS[i % 2]]) {
                    let mut d = along;
                    (d[other], d[third]) = (zero, last_zero);
                    for edge in [plane, 1.0 - plane] {
                        share[third] = edge;
                        let on_edge = point_of(&b, share);
                        probes.extend(
                            [-8.0, 0.0, 8.0].map(|t| (b, Ray::new(on_edge + t * along, d))),
                        );
                    }
                }
                for zero in ZEROS {
                    share[third] = 0.5;
                    let on_face = point_of(&b, share);
                    let mut d = along;
                    (d[other], d[third]) = (zero, 0.25);
                    probes.extend([0.0, 8.0].map(|beside| {
                        (
                            b,
                            Ray::new(on_face - 8.0 * d + beside * Vec3::AXES[third], d),
                        )
                    }));
                }
            }
        }
    }
    probes
}

fn flat_in_plane() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for axis in 0..3 {
        let flat = flattened(ROUND, axis);
        let center = flat.centroid();
        for (along, sign) in directions().filter(|&(along, _)| along != axis) {
            for zero in [0.0, -0.0] {
                let mut d = Vec3::splat(zero);
                d[along] = sign;
                probes.push((flat, Ray::new(center - 6.0 * sign * Vec3::AXES[along], d)));
                d[3 - axis - along] = 0.125;
                probes.push((flat, Ray::new(center - 4.0 * d, d)));
            }
        }
    }
    probes
}

/// Rays aimed at every corner and at the midpoint of every edge: first along integer directions,
/// where nothing rounds, then from random origins.
fn corners_and_edges(seed: u64) -> Vec<(Aabb, Ray)> {
    let mut sampler = PixelSampler::new(1, 2, seed);
    let mut probes = Vec::new();
    for corner in signs() {
        let share = 0.5 * corner + 0.5;
        let edges = (0..3).map(|axis| {
            let mut share = share;
            share[axis] = 0.5;
            share
        });
        for share in edges.chain([share]) {
            let target = point_of(&ROUND, share);
            for d in [
                Vec3::new(1.0, 1.0, -1.0),
                Vec3::new(2.0, -1.0, 1.0),
                Vec3::new(-1.0, 3.0, 2.0),
            ] {
                probes.push((ROUND, Ray::new(target - 4.0 * d, d)));
            }
            for b in [BOX, ROUND] {
                for _ in 0..20 {
                    let o = b.centroid() + 9.0 * random_point(&mut sampler);
                    probes.push((b, towards(o, point_of(&b, share))));
                }
            }
        }
    }
    probes
}

fn point_boxes() -> Vec<(Aabb, Ray)> {
    let at = |p: Vec3| Aabb { min: p, max: p };
    let p = Vec3::new(2.0, -3.0, 5.0);
    let mut probes = Vec::new();
    for corner in signs() {
        let d = corner * Vec3::new(1.0, 2.0, 0.5);
        probes.push((at(p), Ray::new(p - 4.0 * d, d)));
        probes.push((at(p), Ray::new(p - 4.0 * d + 0.25 * Vec3::X, d)));
    }
    for (axis, sign) in directions() {
        probes.push((
            at(p),
            Ray::new(p - 3.0 * sign * Vec3::AXES[axis], sign * Vec3::AXES[axis]),
        ));
    }
    probes
}

fn empty_boxes() -> Vec<(Aabb, Ray)> {
    let mut inverted_on_x = ROUND;
    (inverted_on_x.min.x, inverted_on_x.max.x) = (ROUND.max.x, ROUND.min.x);
    let mut rays: Vec<Ray> = signs()
        .map(|d| Ray::new(ROUND.centroid() - 5.0 * d, d))
        .collect();
    rays.extend(directions().map(|(axis, sign)| {
        Ray::new(
            ROUND.centroid() - 5.0 * sign * Vec3::AXES[axis],
            sign * Vec3::AXES[axis],
        )
    }));
    let boxes = [Aabb::EMPTY, inverted_on_x];
    let of_boxes = boxes
        .into_iter()
        .flat_map(|b| rays.iter().map(move |ray| (b, *ray)));
    // Both ends of these ranges lie inside the box, but `min_t` is greater than `max_t`.
    let of_ranges = signs().map(|d| Ray {
        min_t: 8.0,
        max_t: 7.9,
        ..Ray::new(ROUND.centroid() - 8.0 * d, d)
    });
    of_boxes.chain(of_ranges.map(|ray| (ROUND, ray))).collect()
}

fn infinite_boxes() -> Vec<(Aabb, Ray)> {
    let all = Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    };
    let half = Aabb {
        min: Vec3::ZERO,
        max: Vec3::INFINITY,
    };
    let mut slab = all;
    (slab.min.y, slab.max.y) = (1.0, 2.0);
    let mut probes = Vec::new();
    for b in [all, half, slab] {
        for d in signs() {
            probes.push((b, Ray::new(Vec3::new(0.5, 1.5, 0.75), d)));
            probes.push((
                b,
                Ray {
                    max_t: 100.0,
                    ..Ray::new(Vec3::new(0.5, -1.5, 0.75), d)
                },
            ));
        }
        for (axis, sign) in directions() {
            probes.push((
                b,
                Ray::new(Vec3::new(0.5, 1.5, 0.75), sign * Vec3::AXES[axis]),
            ));
            probes.push((
                b,
                Ray::new(Vec3::new(-0.5, -1.5, -0.75), sign * Vec3::AXES[axis]),
            ));
        }
    }
    probes
}

fn not_numbers() -> Vec<(Aabb, Ray)> {
    let ray = Ray::new(
        ROUND.centroid() - Vec3::new(5.0, 4.0, 3.0),
        Vec3::new(5.0, 4.0, 3.0),
    );
    let mut probes = Vec::new();
    for axis in 0..3 {
        let (mut low, mut high) = (ROUND, ROUND);
        low.min[axis] = f64::NAN;
        high.max[axis] = f64::NAN;
        let (mut nan_origin, mut nan_direction) = (ray, ray);
        nan_origin.o[axis] = f64::NAN;
        nan_direction.d[axis] = f64::NAN;
        probes.extend([
            (low, ray),
            (high, ray),
            (ROUND, nan_origin),
            (ROUND, nan_direction),
        ]);
    }
    probes.push((ROUND, Ray::new(ray.o, Vec3::ZERO)));
    probes
}

fn denormal() -> Vec<(Aabb, Ray)> {
    let mut probes = Vec::new();
    for (axis, sign) in directions() {
        for tiny in [f64::from_bits(1), 1e-310, -1e-310] {
            let mut d = sign * Vec3::AXES[axis];
            d[(axis + 1) % 3] = tiny;
            let through = ROUND.centroid() - 6.0 * sign * Vec3::AXES[axis];
            probes.push((ROUND, Ray::new(through, d)));
            probes.push((
                ROUND,
                Ray::new(through + 7.0 * Vec3::AXES[(axis + 1) % 3], d),
            ));
        }
    }
    probes
}

/// A box seen by a camera: the nearer a ray enters the box, the brighter its pixel.
fn picture() -> Spec {
    const SIZE: [u32; 2] = [64, 48];
    let eye = Vec3::new(3.1, 4.3, 5.2);
    let forward = (BOX.centroid() - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let probes = pixels.map(|(x, y)| {
        let share = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n) - 0.5;
        let d = forward + 0.9 * share(x, SIZE[0]) * right + 0.675 * share(y, SIZE[1]) * up;
        (BOX, Ray::new(eye, d.normalize()))
    });
    Spec {
        picture: Some(SIZE),
        ..case(
            "picture",
            "A box seen by a camera: the nearer the ray enters it, the brighter the pixel.",
            probes.collect(),
        )
    }
}
