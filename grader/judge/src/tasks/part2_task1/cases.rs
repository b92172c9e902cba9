//! Cases of building the tree.

use super::growth::FAST;
use crate::tools::spec::Spec;
use kit::{Aabb, PixelSampler, Vec3};
use wire::kind;
use wire::work::{BuildGrowthWork, BuildWork};

/// The cases of `part2.task1`.
pub(crate) fn cases() -> Vec<Spec> {
    vec![
        case(
            "no_primitives",
            "An empty scene: a tree over no primitives has no nodes, not even an empty leaf.",
            Vec::new(),
            4,
        ),
        case(
            "one_primitive",
            "One primitive and max_leaf_size 1: one leaf. Pitfall: with `<` for `<=` in the \
             leaf's condition the recursion does not end.",
            vec![cube(Vec3::new(1.0, 2.0, 3.0), 0.5)],
            1,
        ),
        case(
            "two_primitives",
            "Two primitives and max_leaf_size 1: one split, two leaves.",
            vec![cube(Vec3::ZERO, 0.5), cube(Vec3::X * 3.0, 0.5)],
            1,
        ),
        case(
            "exactly_max_leaf_size",
            "max_leaf_size primitives in one place: \"at most\" includes max_leaf_size, so they \
             may share a leaf. No split point separates them.",
            vec![cube(Vec3::ONE, 0.5); 2],
            2,
        ),
        case(
            "equal_centroids",
            "Nested boxes with one centroid: no split point separates them, but the recursion \
             must end and no leaf may be too large.",
            (1..=50)
                .map(|i| cube(Vec3::new(4.0, -2.0, 1.0), f64::from(i)))
                .collect(),
            4,
        ),
        case(
            "duplicates_among_others",
            "Forty copies of one box among other boxes. Pitfall: once the others are split off, \
             one side of every split is empty.",
            duplicates_among_others(),
            4,
        ),
        case(
            "one_side_empty",
            "A huge box next to small ones. Pitfall: a split at the middle of the node's box \
             leaves one side empty.",
            one_side_empty(),
            2,
        ),
        case(
            "centroids_on_the_split",
            "A grid whose centroids lie on the split planes: each primitive goes to one side. \
             Pitfall: with `<` for one side and `>` for the other, these primitives are lost.",
            grid(),
            4,
        ),
        case(
            "long_boxes",
            "Boxes that are long compared with their distance. Pitfall: splitting by a corner \
             instead of the centroid separates one box at a time, and boxes around centroids are \
             too small.",
            long_boxes(),
            4,
        ),
        case(
            "far_from_the_origin",
            "A cloud of boxes far from the origin: each node's box is the smallest one around its \
             primitives. Pitfall: a union that starts with (0, 0, 0) instead of the empty box \
             extends to the origin.",
            cloud(500, Vec3::new(3e3, -5e3, 4e3)),
            4,
        ),
        strip_case("strip_along_x", 0),
        strip_case("strip_along_y", 1),
        strip_case("strip_along_z", 2),
        case(
            "large_mesh",
            "The boxes of a terrain of 100,000 triangles.",
            terrain(),
            4,
        ),
        case(
            "leaf_size_0",
            "max_leaf_size 0 counts as 1. Pitfall: a recursion that does not end.",
            cloud(20, Vec3::ZERO),
            0,
        ),
        case(
            "halving_distances",
            "Each box at half the distance of the one before. Pitfall: midpoint splits separate \
             one box at a time, a thousand levels deep.",
            (0..1000).map(halving).collect(),
            1,
        ),
        case(
            "thin_boxes",
            "Boxes with no extent along one axis and nearly none along another. Pitfall: a \
             division by the extent gives no valid bin.",
            thin_boxes(),
            2,
        ),
        case(
            "near_the_largest_float",
            "Coordinates near f64::MAX. Pitfall: max - min and min + max overflow.",
            near_max(),
            2,
        ),
        case(
            "nan_and_empty_boxes",
            "NaN boxes and empty boxes among valid ones: each primitive is in the order once, and \
             the other boxes stay valid.",
            broken_boxes(),
            2,
        ),
        case(
            "infinite_boxes",
            "Boxes that are infinite along an axis: their centroid is NaN or infinite.",
            infinite_boxes(),
            2,
        ),
        growth(),
    ]
}

fn case(name: &'static str, about: &'static str, boxes: Vec<Aabb>, max_leaf_size: u32) -> Spec {
    let bounds = boxes.iter().map(|b| [b.min.into(), b.max.into()]).collect();
    let work = BuildWork {
        bounds,
        max_leaf_size,
    };
    Spec::new::<kind::Build>("part2.task1", name, about, work)
}

/// The sizes are far enough apart to tell O(n log² n) from O(n²); the largest takes the reference a
/// tenth of a second, and the control half a second.
fn growth() -> Spec {
    let work = BuildGrowthWork {
        sizes: vec![3_125, 12_500, 50_000, 200_000],
        max_leaf_size: 4,
        rounds: 3,
        fast: FAST,
        enough: 8.0,
    };
    Spec::new::<kind::BuildGrowth>(
        "part2.task1",
        "growth_of_the_build_time",
        "Trees over up to 200,000 primitives: the time to build one grows as O(n log n), compared with \
         sorting as many boxes. Not judged, and free, on a machine that is too busy. Pitfall: a \
         search or a shift of a whole list for each primitive takes O(n²).",
        work,
    )
}

fn cube(center: Vec3, half: f64) -> Aabb {
    Aabb {
        min: center - half,
        max: center + half,
    }
}

/// Uniform in the unit cube.
fn random_point(sampler: &mut PixelSampler) -> Vec3 {
    let xy = sampler.next_2d();
    xy.extend(sampler.next_1d())
}

fn duplicates_among_others() -> Vec<Aabb> {
    let copies = std::iter::repeat_n(cube(Vec3::new(5.0, 5.0, 5.0), 0.25), 40);
    copies.chain(cloud(60, Vec3::ZERO)).collect()
}

fn one_side_empty() -> Vec<Aabb> {
    let small = (0..30).map(|i| cube(Vec3::new(f64::from(i), 0.0, 0.0), 0.25));
    let huge = Aabb {
        min: Vec3::new(-1.0, -1.0, -1.0),
        max: Vec3::new(1000.0, 1.0, 1.0),
    };
    small.chain([huge]).collect()
}

/// Unit cubes on the points of a grid, 9 a side: the midpoint of each node is a centroid, at
/// several levels.
fn grid() -> Vec<Aabb> {
    let side = || (-4..=4).map(f64::from);
    let points = side().flat_map(|x| side().flat_map(move |y| side().map(move |z| (x, y, z))));
    points
        .map(|(x, y, z)| cube(Vec3::new(x, y, z), 0.5))
        .collect()
}

/// Box `i` extends from just beyond `i / 2` to `3i / 2` along x; a second set is its mirror image.
/// Of the boxes up to `k`, only the last ones have their nearer corner beyond the middle, `k / 2`.
fn long_boxes() -> Vec<Aabb> {
    let along_x = (0..300).map(|i| {
        let i = f64::from(i);
        Aabb {
            min: Vec3::new(0.502 * i, 0.0, 0.0),
            max: Vec3::new(1.498 * i, 1.0, 1.0),
        }
    });
    let back = along_x.clone().map(|b| Aabb {
        min: Vec3::new(-b.max.x, 2.0, 0.0),
        max: Vec3::new(-b.min.x, 3.0, 1.0),
    });
    along_x.chain(back).collect()
}

/// `n` boxes of about a tenth of a unit in a cube of 10 units around `center`.
fn cloud(n: u32, center: Vec3) -> Vec<Aabb> {
    let mut sampler = PixelSampler::new(n, 0, 1);
    let mut one = || {
        let at = center + 10.0 * random_point(&mut sampler) - 5.0;
        cube(at, 0.05 + 0.1 * sampler.next_1d())
    };
    (0..n).map(|_| one()).collect()
}

fn strip_case(name: &'static str, axis: usize) -> Spec {
    case(
        name,
        "A strip of boxes, in random order. One half spreads a little along the one, the other \
         half along the other of the two short axes. Pitfall: only splits along the longest of all \
         three axes separate them.",
        strip(axis),
        4,
    )
}

/// 256 boxes one behind the other along an axis, in permuted order. They lie in two planes: the
/// first half has small random offsets along the next axis, the second half along the one after it.
/// So each order of the two shorter extents occurs, and a search for the longest axis that does not
/// compare all pairs finds the wrong one in a half.
fn strip(axis: usize) -> Vec<Aabb> {
    let mut sampler = PixelSampler::new(axis as u32, 0, 2);
    // 91 and 256 have no common divisor, so every position comes once.
    (0..256_u32)
        .map(|i| {
            let along = 91 * i % 256;
            let across = if along < 128 { axis + 1 } else { axis + 2 } % 3;
            let mut center = Vec3::ZERO;
            center[axis] = f64::from(along);
            center[across] = sampler.next_1d();
            cube(center, 0.25)
        })
        .collect()
}

/// The boxes of the triangles of a hilly height field with 224 cells a side.
fn terrain() -> Vec<Aabb> {
    const SIDE: u32 = 224;
    let vertex = |i: u32, j: u32| {
        let (x, z) = (f64::from(i), f64::from(j));
        let hills = 12.0 * kit::math::sin(0.05 * x) * kit::math::cos(0.07 * z)
            + kit::math::sin(0.9 * x + 0.4 * z);
        Vec3::new(x, hills, z)
    };
    let cells = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let corners = [
                vertex(i, j),
                vertex(i + 1, j),
                vertex(i, j + 1),
                vertex(i + 1, j + 1),
            ];
            [
                Aabb::of([corners[0], corners[1], corners[2]]),
                Aabb::of([corners[3], corners[1], corners[2]]),
            ]
        })
        .collect()
}

fn halving(k: i32) -> Aabb {
    let at = 2.0_f64.powi(-k);
    Aabb {
        min: Vec3::new(at, 0.0, 0.0),
        max: Vec3::new(at * 1.0625, at, at),
    }
}

fn thin_boxes() -> Vec<Aabb> {
    let mut boxes: Vec<Aabb> = (0..100)
        .map(|i| {
            let x = 1e-300 * f64::from(i);
            Aabb {
                min: Vec3::new(x, 7.0, f64::from(i % 10)),
                max: Vec3::new(x, 7.0, f64::from(i % 10 + 1)),
            }
        })
        .collect();
    boxes.push(Aabb {
        min: Vec3::new(1.0, 7.0, 0.0),
        max: Vec3::new(1.0_f64.next_up(), 7.0, 1e-12),
    });
    boxes
}

fn near_max() -> Vec<Aabb> {
    (-10..=10)
        .map(|i| {
            let x = f64::MAX * 0.0999 * f64::from(i);
            Aabb {
                min: Vec3::new(x - f64::MAX * 5e-4, 0.0, -1.0),
                max: Vec3::new(x + f64::MAX * 5e-4, f64::from(i + 10), 1.0),
            }
        })
        .collect()
}

fn broken_boxes() -> Vec<Aabb> {
    let nan = Aabb {
        min: Vec3::new(0.0, f64::NAN, 0.0),
        max: Vec3::ONE,
    };
    let all_nan = Aabb {
        min: Vec3::NAN,
        max: Vec3::NAN,
    };
    let mut boxes = cloud(30, Vec3::ZERO);
    for (at, broken) in [(0, nan), (7, Aabb::EMPTY), (11, all_nan), (33, Aabb::EMPTY)] {
        boxes.insert(at, broken);
    }
    boxes
}

fn infinite_boxes() -> Vec<Aabb> {
    let mut boxes = cloud(30, Vec3::ZERO);
    boxes.push(Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    });
    boxes.push(Aabb {
        min: Vec3::new(f64::NEG_INFINITY, 0.0, 0.0),
        max: Vec3::ONE,
    });
    boxes.push(Aabb {
        min: Vec3::ZERO,
        max: Vec3::new(1.0, 1.0, f64::INFINITY),
    });
    boxes
}
