//! Simple traversals: trees of at most seven nodes, and a deep one, whose test results are given.

use crate::tools::questions::crosses::{Cross, CrossScene, along};
use crate::tools::questions::tree_plan::TreePlan;
use kit::{Ray, Vec3};
use wire::work::ScriptedWorld;

/// The simple questions about traversals for the closest hit or any hit, with rays along x. Each
/// has one ray: the tests of all rays of a question are counted together.
pub(crate) fn questions(any_hit: bool) -> Vec<ScriptedWorld> {
    let one = |scene: &CrossScene, ray: Ray| scene.script(&[ray], any_hit);
    let of_scene = |scene: CrossScene| rays().into_iter().map(move |ray| one(&scene, ray));
    scenes().into_iter().flat_map(of_scene).collect()
}

/// The primitive in the box from `x0` to `x1`, which a ray along x hits at `x`.
fn block(x0: f64, x1: f64, x: f64) -> Cross {
    let cross = Cross::new(Vec3::new(x0, -1.0, -1.0), Vec3::new(x1, 1.0, 1.0));
    cross.with_plates(Vec3::new(x, 0.0, 0.0))
}

fn leaf(ids: &[u32]) -> TreePlan {
    TreePlan::Leaf(ids.to_vec())
}

fn scenes() -> Vec<CrossScene> {
    let two = || TreePlan::split(leaf(&[0]), leaf(&[1]));
    let (near, far) = (block(1.0, 3.0, 2.0), block(5.0, 7.0, 6.0));
    vec![
        CrossScene::empty(),
        CrossScene::new(vec![near], &leaf(&[0])),
        CrossScene::new(vec![near, far], &leaf(&[0, 1])),
        CrossScene::new(vec![far, near], &leaf(&[0, 1])),
        // A leaf in which a ray misses one primitive and hits the other.
        CrossScene::new(vec![near.without_plates(), far], &leaf(&[0, 1])),
        CrossScene::new(vec![near, far.without_plates()], &leaf(&[0, 1])),
        CrossScene::new(vec![near, far], &two()),
        CrossScene::new(vec![far, near], &two()),
        // The box that a ray enters first has the farther hit.
        CrossScene::new(vec![block(1.0, 9.0, 8.0), block(3.0, 5.0, 4.0)], &two()),
        CrossScene::new(vec![block(3.0, 5.0, 4.0), block(1.0, 9.0, 8.0)], &two()),
        // A box that a ray meets without a hit inside.
        CrossScene::new(vec![near.without_plates(), far], &two()),
        CrossScene::new(
            vec![near, far, block(9.0, 11.0, 10.0)],
            &TreePlan::split(leaf(&[0]), TreePlan::split(leaf(&[1]), leaf(&[2]))),
        ),
        // The places in the list are not the numbers of the primitives.
        CrossScene::new(vec![near, far], &TreePlan::split(leaf(&[1]), leaf(&[0]))),
        // Flat boxes.
        CrossScene::new(vec![block(2.0, 2.0, 2.0)], &leaf(&[0])),
        CrossScene::new(vec![block(2.0, 2.0, 2.0), block(6.0, 6.0, 6.0)], &two()),
        // Deep enough that which child is visited first changes the number of tests.
        CrossScene::new(
            [1.0, 5.0, 9.0, 13.0]
                .map(|x| block(x, x + 2.0, x + 1.0))
                .into(),
            &TreePlan::halves(&[0, 1, 2, 3], 1),
        ),
        deep(),
    ]
}

/// A tree of which each left child has one primitive less than its parent.
fn deep() -> CrossScene {
    let row = (0..DEEP).map(|i| 4.0 * f64::from(i) + 1.0);
    let blocks = row.map(|x| block(x, x + 2.0, x + 1.0));
    let plan = (1..DEEP).fold(leaf(&[0]), |below, i| TreePlan::split(below, leaf(&[i])));
    CrossScene::new(blocks.collect(), &plan)
}

/// The primitives in the deep tree: more than the stacks have room for that are too small.
const DEEP: u32 = 40;

/// Rays along x and against it, with ranges that contain all, some or no hits; the last ones end at
/// a hit.
fn rays() -> Vec<Ray> {
    let from = |x: f64, step: f64| along(0, step, Vec3::new(x, 0.0, 0.0));
    let ahead = from(0.0, 1.0);
    vec![
        ahead,
        from(12.0, -1.0),
        from(0.0, 2.0),
        along(0, 1.0, Vec3::new(0.0, 3.0, 0.0)),
        from(0.0, -1.0),
        Ray {
            max_t: 1.5,
            ..ahead
        },
        Ray {
            max_t: 4.5,
            ..ahead
        },
        Ray {
            min_t: 4.5,
            ..ahead
        },
        Ray {
            min_t: 20.0,
            ..ahead
        },
        from(4.5, 1.0),
        Ray {
            max_t: 2.0,
            ..ahead
        },
        Ray {
            min_t: 6.0,
            ..ahead
        },
        Ray {
            min_t: 6.0,
            max_t: 6.0,
            ..ahead
        },
    ]
}
