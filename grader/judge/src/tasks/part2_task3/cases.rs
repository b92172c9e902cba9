//! Cases of traversing the tree.

use crate::tools::findings::Aspect;
use crate::tools::questions::crosses::{Cross, CrossScene, along};
use crate::tools::questions::tree_plan::TreePlan;
use crate::tools::spec::Spec;
use kit::{PixelSampler, Ray, Vec3};
use wire::kind;
use wire::work::{NodeKind, ScriptedWorld};

/// The cases of `part2.task3` with scripted worlds; none of them needs another task.
pub(crate) fn cases() -> Vec<Spec> {
    let mut cases = hand_written();
    cases.extend(random());
    cases.extend(counted());
    cases.extend(deep());
    cases
}

/// Whether a case judges the number of box and primitive tests.
pub(crate) fn counts_work(case: &str) -> bool {
    ["nearer_first", "stops_at_first_hit"].contains(&case)
}

fn case(name: &'static str, about: &'static str, world: ScriptedWorld) -> Spec {
    Spec::new::<kind::Traverse>("part2.task3", name, about, world)
}

/// The box with the corners (x0, -1, -1) and (x1, 1, 1).
fn block(x0: f64, x1: f64) -> Cross {
    Cross::new(Vec3::new(x0, -1.0, -1.0), Vec3::new(x1, 1.0, 1.0))
}

/// The box of [`block`], with its plate perpendicular to the x axis at `x`.
fn block_with_plate(x0: f64, x1: f64, x: f64) -> Cross {
    block(x0, x1).with_plates(Vec3::new(x, 0.0, 0.0))
}

/// The box of a [`block_with_plate`] above the other blocks.
fn above(x0: f64, x1: f64, x: f64) -> Cross {
    let cross = Cross::new(Vec3::new(x0, 1.25, -1.0), Vec3::new(x1, 2.0, 1.0));
    cross.with_plates(Vec3::new(x, 1.75, 0.0))
}

/// The distance of hits that are close together but not equal, in single precision either.
const CLOSE: f64 = 1.0 / 131072.0;

/// Rays along x, in both directions, with |d| of 1, 2 and 0.5, at different heights.
fn through_blocks() -> Vec<Ray> {
    let mut rays = Vec::new();
    for y in [0.0, 0.5, -0.75, 1.5] {
        for (x, step) in [
            (-10.0, 1.0),
            (-10.0, 2.0),
            (30.0, -1.0),
            (30.0, -0.5),
            (30.0, 1.0),
        ] {
            rays.push(along(0, step, Vec3::new(x, y, 0.25)));
        }
    }
    rays
}

fn leaf(ids: &[u32]) -> TreePlan {
    TreePlan::Leaf(ids.to_vec())
}

/// The primitives `crosses` in leaves with others that no ray hits: some before the leaf's own, one
/// between any two, some behind. So leaves have up to eight primitives, and a ray misses most of
/// those that it is tested against, before the one that it hits or after it.
fn among_misses(mut crosses: Vec<Cross>, plan: TreePlan) -> CrossScene {
    const BEFORE: [usize; 4] = [1, 3, 0, 2];
    const BEHIND: [usize; 4] = [1, 0, 4, 2];
    let mut leaves = (0..4).cycle();
    let plan = plan.map_leaves(&mut |ids| {
        let number = leaves.next().unwrap_or(0);
        let mut missed = |like: u32| {
            crosses.push(crosses[like as usize].without_plates());
            crosses.len() as u32 - 1
        };
        let mut all = Vec::new();
        for (place, &id) in ids.iter().enumerate() {
            let before = if place == 0 { BEFORE[number] } else { 1 };
            all.extend((0..before).map(|_| missed(id)));
            all.push(id);
        }
        let last = ids.last().copied().unwrap_or(0);
        all.extend((0..BEHIND[number]).map(|_| missed(last)));
        all
    });
    CrossScene::new(crosses, &plan)
}

fn hand_written() -> Vec<Spec> {
    let one_leaf = among_misses(
        vec![block(0.0, 1.0), block(3.0, 4.0), block(6.0, 7.0)],
        leaf(&[0, 1, 2]),
    );
    let in_a_row = vec![
        block(0.0, 1.0),
        Cross::new(Vec3::new(4.0, 0.25, -1.0), Vec3::new(5.0, 2.0, 1.0)),
        block(8.0, 9.0),
    ];
    let siblings = among_misses(
        in_a_row.clone(),
        TreePlan::split(TreePlan::split(leaf(&[0]), leaf(&[1])), leaf(&[2])),
    );
    let before_a_wall = among_misses(
        [in_a_row, vec![block(WALL, WALL)]].concat(),
        TreePlan::split(
            TreePlan::split(TreePlan::split(leaf(&[0]), leaf(&[1])), leaf(&[2])),
            leaf(&[3]),
        ),
    );
    let box_in_box = among_misses(
        vec![
            block_with_plate(0.0, 20.0, 19.0),
            block_with_plate(8.0, 12.0, 9.0),
            block(21.0, 22.0),
        ],
        TreePlan::split(TreePlan::split(leaf(&[0]), leaf(&[2])), leaf(&[1])),
    );
    let reversed = among_misses(
        vec![
            block_with_plate(0.0, 4.0, 3.0),
            block_with_plate(0.0, 4.0, 1.0),
            block(6.0, 7.0),
        ],
        TreePlan::split(leaf(&[0, 1]), leaf(&[2])),
    );
    let flat = among_misses(
        vec![block(1.0, 1.0), block(5.0, 5.0), block(9.0, 9.0)],
        TreePlan::split(leaf(&[0]), TreePlan::split(leaf(&[1]), leaf(&[2]))),
    );
    let twins = among_misses(
        vec![
            block(0.0, 2.0),
            block(0.0, 2.0),
            block(-1.0, 3.0),
            block(7.0, 9.0),
            above(-8.0, -4.0, -6.0 + 2.0 * CLOSE),
            above(-7.0, -4.0, -6.0 + CLOSE),
            above(-7.0, -4.0, -6.0),
            above(12.0, 16.0, 14.0 - 2.0 * CLOSE),
            above(12.0, 15.0, 14.0 - CLOSE),
            above(12.0, 15.0, 14.0),
        ],
        TreePlan::split(
            TreePlan::split(leaf(&[3, 0]), TreePlan::split(leaf(&[2]), leaf(&[1]))),
            TreePlan::split(
                TreePlan::split(leaf(&[4]), leaf(&[5, 6])),
                TreePlan::split(leaf(&[8, 9]), leaf(&[7])),
            ),
        ),
    );
    vec![
        case(
            "empty_tree",
            "A tree without nodes: every ray misses.",
            CrossScene::empty().closest(&through_blocks()),
        ),
        case(
            "one_leaf",
            "The root is a leaf of seven primitives, three of which can be hit, and its box is tested \
             like that of every other node. Pitfall: a test of the children's boxes alone leaves out the root's.",
            one_leaf.closest(&through_blocks()),
        ),
        case(
            "both_children",
            "Hits in the left child, in the right child and in both. Pitfall: visiting one child \
             only, combining both with `||`, or leaving a leaf at the first primitive that is missed, \
             loses hits.",
            siblings.closest(&through_blocks()),
        ),
        case(
            "box_in_box",
            "The box that the ray enters first contains the farther hit. Pitfall: the first hit \
             found is not the closest, and a box beyond it does not end the search.",
            box_in_box.closest(&through_blocks()),
        ),
        case(
            "leaf_in_any_order",
            "A leaf whose farther primitive comes first, and others that the ray misses: all primitives \
             of a leaf are tested.",
            reversed.closest(&through_blocks()),
        ),
        case(
            "flat_boxes",
            "Boxes without depth, such as those of walls: their interval is a single t, with min \
             == max.",
            flat.closest(&through_blocks()),
        ),
        case(
            "ties",
            "Primitives in the same place, in one leaf and in two: any of them is right, at their \
             t. Others are close together: the nearer one is right. Pitfall: comparing hits with \
             an epsilon returns the farther one.",
            twins.closest(&through_blocks()),
        ),
        case(
            "clipped_rays",
            "Ranges that start or end before, between and behind the hits: hits out of range do \
             not count, and a miss does not change max_t.",
            siblings.closest(&clipped()),
        ),
        case(
            "clipped_rays_any_hit",
            "The same rays, traced for any hit, and ranges that start or end exactly at a hit: both \
             ends count.",
            before_a_wall.any(&[clipped(), up_to_a_hit()].concat()),
        ),
        case(
            "range_ends",
            "Ranges that start or end exactly at a hit in a flat box: both ends count, for boxes \
             too.",
            flat.closest(&range_ends()),
        ),
        case(
            "rounded_boxes",
            "Boxes whose interval starts a few units in the last place behind the hit inside, \
             because of rounding; also for rays that start next to the boxes, where the rounding \
             is that of the coordinates. Pitfall: culling them against max_t without slack, or \
             with a slack in proportion to t alone, loses the closest hit.",
            rounded_boxes(),
        ),
    ]
}

fn clipped() -> Vec<Ray> {
    let ranges = [
        (0.0, 5.0),
        (0.0, 9.5),
        (11.0, 13.0),
        (11.0, 100.0),
        (15.0, 17.0),
        (20.0, 100.0),
        (-20.0, 0.0),
    ];
    let each = through_blocks()
        .into_iter()
        .flat_map(|ray| ranges.map(|range| (ray, range)));
    each.map(|(ray, (min_t, max_t))| Ray {
        min_t,
        max_t,
        ..ray
    })
    .collect()
}

/// The x of the flat box in the world of `clipped_rays_any_hit`.
const WALL: f64 = 12.0;

/// Ranges with a single hit, on the wall or on the plate inside a block: the hit is in the middle
/// of the range, at its end, or at its start.
fn up_to_a_hit() -> Vec<Ray> {
    let mut rays = Vec::new();
    for (x, step) in [(-10.0, 1.0), (-10.0, 2.0), (30.0, -1.0), (30.0, -0.5)] {
        for hit in [WALL, 0.5] {
            let t = (hit - x) / step;
            for (min_t, max_t) in [(t - 0.75, t + 0.75), (t - 0.75, t), (t, t + 0.75)] {
                rays.push(Ray {
                    min_t,
                    max_t,
                    ..along(0, step, Vec3::new(x, 0.5, 0.25))
                });
            }
        }
    }
    rays
}

fn range_ends() -> Vec<Ray> {
    let mut rays = Vec::new();
    for ray in [along(0, 1.0, Vec3::ZERO), along(0, -2.0, Vec3::X * 10.0)] {
        for x in [1.0, 5.0, 9.0] {
            let t = (x - ray.o.x) / ray.d.x;
            rays.push(Ray { max_t: t, ..ray });
            rays.push(Ray { min_t: t, ..ray });
            rays.push(Ray {
                min_t: t,
                max_t: t,
                ..ray
            });
            rays.push(Ray {
                min_t: t.next_up(),
                ..ray
            });
            rays.push(Ray {
                max_t: t.next_down(),
                ..ray
            });
        }
    }
    rays
}

/// Pairs of primitives 2 ulp (units in the last place) apart; the box interval of the nearer
/// primitive starts 6 ulp behind it. An ulp is that of `t` or, for rays that start next to the
/// boxes, of the boxes' coordinates: code that subtracts coordinates rounds as much.
fn rounded_boxes() -> ScriptedWorld {
    const NEARER: [u32; 2] = [0, 3];
    /// How far from the boxes the nearest rays start.
    const NEXT_TO_THE_BOXES: f64 = 1.0 / 1024.0 / 1024.0;
    let later = |t: f64, ulps: i32| match t {
        ..=NEXT_TO_THE_BOXES => t + f64::from(ulps) * 4.0 * f64::EPSILON,
        _ if ulps < 0 => (ulps..0).fold(t, |t, _| t.next_down()),
        _ => (0..ulps).fold(t, |t, _| t.next_up()),
    };
    let wall = |y: f64, half: f64| {
        Cross::new(
            Vec3::new(1.0, y - half, -1.0),
            Vec3::new(1.0, y + half, 1.0),
        )
    };
    let world = CrossScene::new(
        vec![
            wall(0.0, 1.0),
            wall(0.0, 0.75),
            wall(4.0, 0.75),
            wall(4.0, 1.0),
        ],
        &TreePlan::split(
            TreePlan::split(leaf(&[1]), leaf(&[0])),
            TreePlan::split(leaf(&[3]), leaf(&[2])),
        ),
    );
    let from = |x: f64, step: f64| [0.0, 4.0].map(|y| along(0, step, Vec3::new(x, y, 0.0)));
    let starts = [
        (-0.1, 1.0),
        (-2.7, 1.0),
        (1.3, -1.0),
        (77.7, -1.0),
        (1.0 - NEXT_TO_THE_BOXES, 1.0),
        (1.0 + NEXT_TO_THE_BOXES, -1.0),
    ];
    let rays: Vec<Ray> = starts
        .into_iter()
        .flat_map(|(x, step)| from(x, step))
        .collect();
    let mut script = world.script(&rays, false);
    for scripted in &mut script.rays {
        for id in NEARER {
            let t = &mut scripted.prims[id as usize];
            *t = t.map(|t| later(t, -2));
        }
        for (at, node) in script.tree.nodes.iter().enumerate().rev() {
            let span = match node.kind {
                NodeKind::Leaf { first, .. }
                    if NEARER.contains(&script.tree.order[first as usize]) =>
                {
                    scripted.spans[at].map(|[enters, _]| [later(enters, 4); 2])
                }
                NodeKind::Leaf { .. } => scripted.spans[at],
                NodeKind::Interior { left, right } => {
                    let children = [left, right].map(|child| scripted.spans[child as usize]);
                    children
                        .into_iter()
                        .flatten()
                        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
                }
            };
            scripted.spans[at] = span;
        }
    }
    script
}

fn random() -> Vec<Spec> {
    let (world, rays) = random_world(60, 600);
    vec![
        case(
            "random_trees",
            "Overlapping boxes in leaves of one to eight, in a tree that joins random pairs, so that \
             siblings overlap everywhere: the closest of all hits.",
            world.closest(&rays),
        ),
        case(
            "random_trees_any_hit",
            "The same rays: there is any hit exactly where there is a closest hit.",
            world.any(&rays),
        ),
    ]
}

/// Boxes with integer coordinates, some flat, in leaves of one to eight that are close together. A
/// tree joins random pairs from the leaves up.
/// The rays run along all axes through the centres of unit cells, where no ray touches a box edge.
fn random_world(boxes: u32, rays: u32) -> (CrossScene, Vec<Ray>) {
    let mut sampler = PixelSampler::new(boxes, rays, 3);
    let mut whole = |n: f64| (n * sampler.next_1d()).floor();
    let (mut crosses, mut plans) = (Vec::new(), Vec::new());
    for size in (1..=8).cycle() {
        let first = crosses.len() as u32;
        if first == boxes {
            break;
        }
        let corner = Vec3::new(whole(8.0), whole(8.0), whole(8.0));
        let ids = first..boxes.min(first + size);
        for i in ids.clone() {
            let min = corner + Vec3::new(whole(3.0), whole(3.0), whole(3.0));
            let mut size = Vec3::new(1.0 + whole(7.0), 1.0 + whole(7.0), 1.0 + whole(7.0));
            if i % 4 == 0 {
                size[(i / 4 % 3) as usize] = 0.0;
            }
            let inside = Vec3::new(whole(5.0), whole(5.0), whole(5.0)) / 4.0;
            crosses.push(Cross::new(min, min + size).with_plates(min + size * inside));
        }
        plans.push(leaf(&Vec::from_iter(ids.rev())));
    }
    while plans.len() > 1 {
        let left = plans.swap_remove(whole(plans.len() as f64) as usize);
        let right = plans.swap_remove(whole(plans.len() as f64) as usize);
        plans.push(TreePlan::split(left, right));
    }
    let rays = (0..rays).map(|i| {
        let o = Vec3::new(whole(18.0), whole(18.0), whole(18.0)) + 0.5;
        let step = if whole(2.0) == 0.0 { 1.0 } else { -1.0 };
        let min_t = whole(8.0);
        let max_t = if i % 3 == 0 {
            f64::INFINITY
        } else {
            min_t + whole(12.0)
        };
        Ray {
            min_t,
            max_t,
            ..along((i % 3) as usize, step, o)
        }
    });
    let rays = rays.collect();
    (CrossScene::new(crosses, &plans.remove(0)), rays)
}

fn counted() -> Vec<Spec> {
    vec![
        case(
            "nearer_first",
            "Layers behind layers: after a hit, boxes beyond max_t are culled. Visiting the left \
             child first is accepted, the nearer child first makes fewer tests. Pitfall: visiting \
             the farther child first, or every node, makes too many tests.",
            layers(),
        )
        .mainly(&[Aspect::T, Aspect::Work]),
        case(
            "stops_at_first_hit",
            "Many overlapping boxes, most of them hit: a shadow ray stops at the first hit.",
            overlapping_boxes(),
        )
        .mainly(&[Aspect::Work]),
    ]
}

/// A stack of layers along each axis, and rays through each stack from both ends.
fn layers() -> ScriptedWorld {
    const LAYERS: u32 = 256;
    let mut crosses = Vec::new();
    let mut rays = Vec::new();
    let mut stacks = Vec::new();
    for axis in 0..3 {
        let corner = 2000.0 * Vec3::AXES[(axis + 1) % 3];
        let first = crosses.len() as u32;
        for i in 0..LAYERS {
            let min = corner + f64::from(2 * i) * Vec3::AXES[axis];
            let mut size = Vec3::splat(16.0);
            size[axis] = 1.0;
            crosses.push(Cross::new(min, min + size));
        }
        let ids: Vec<u32> = (first..first + LAYERS).collect();
        stacks.push(TreePlan::halves(&ids, 1));
        for i in 0..16 {
            let mut start =
                corner + 0.5 + f64::from(i % 4) * Vec3::AXES[(axis + 2) % 3] + f64::from(i / 4);
            start[axis] = -8.0;
            rays.push(along(axis, 1.0, start));
            start[axis] = f64::from(2 * LAYERS + 8);
            rays.push(along(axis, -1.0, start));
        }
    }
    let plan = stacks
        .into_iter()
        .reduce(TreePlan::split)
        .unwrap_or_else(|| leaf(&[]));
    CrossScene::new(crosses, &plan).closest(&rays)
}

/// Boxes that all contain the stretch from x = 0 to x = 100, with plates at random positions.
fn overlapping_boxes() -> ScriptedWorld {
    let mut sampler = PixelSampler::new(0, 0, 4);
    let crosses: Vec<Cross> = (0..256)
        .map(|i| {
            let reach = 0.25 * f64::from(i % 8);
            let x = (1.0 + 98.0 * sampler.next_1d()).floor();
            block_with_plate(-reach, 100.0 + reach, x)
        })
        .collect();
    let ids: Vec<u32> = (0..256).collect();
    let rays: Vec<Ray> = (0..32)
        .map(|i| {
            let y = f64::from(i % 8) / 8.0 - 0.5;
            if i < 16 {
                along(0, 1.0, Vec3::new(-50.0, y, 0.0))
            } else {
                along(0, -1.0, Vec3::new(150.0, y, 0.0))
            }
        })
        .collect();
    CrossScene::new(crosses, &TreePlan::halves(&ids, 1)).any(&rays)
}

fn deep() -> Vec<Spec> {
    vec![
        case(
            "deep_tree",
            "A tree of 48 levels with the only hit in the last leaf. Pitfall: a stack of 32 nodes \
             is too small.",
            chains(48),
        ),
        case(
            "very_deep_tree",
            "The same with 500 levels. Pitfall: a stack of fixed size overflows.",
            chains(500),
        ),
    ]
}

/// Four chains, one above the other. At each level of a chain, one child is a leaf and the other is
/// the rest of the chain, which is on the left or on the right, nearer or farther than the leaf.
/// The leaf with the only hit has a primitive before it that is missed.
/// Whichever child a traversal visits first, in one of the chains its stack holds a leaf of each
/// level when it reaches the two innermost leaves, one of which has the only hit.
fn chains(levels: u32) -> ScriptedWorld {
    let mut crosses = Vec::new();
    let mut chains = Vec::new();
    let mut rays = Vec::new();
    for (rest_on_left, outwards) in [(false, 1.0), (false, -1.0), (true, 1.0), (true, -1.0)] {
        let y = 4.0 * chains.len() as f64;
        let mut plan = None;
        for level in 0..levels {
            let id = crosses.len() as u32;
            let x = outwards * f64::from(2 * level);
            let cross = Cross::new(
                Vec3::new(x, y - 1.0, -1.0),
                Vec3::new(x + 1.0, y + 1.0, 1.0),
            );
            crosses.push(cross.without_plates());
            let own = match level {
                1 => {
                    crosses.push(cross);
                    leaf(&[id, id + 1])
                }
                _ => leaf(&[id]),
            };
            plan = Some(match (plan, rest_on_left) {
                (None, _) => own,
                (Some(rest), true) => TreePlan::split(rest, own),
                (Some(rest), false) => TreePlan::split(own, rest),
            });
        }
        chains.extend(plan);
        let far = f64::from(2 * levels + 10);
        rays.push(along(0, 1.0, Vec3::new(-far, y, 0.0)));
        rays.push(along(0, -1.0, Vec3::new(far, y, 0.0)));
    }
    let plan = chains
        .into_iter()
        .reduce(TreePlan::split)
        .unwrap_or_else(|| leaf(&[]));
    CrossScene::new(crosses, &plan).closest(&rays)
}
