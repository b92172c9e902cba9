//! Simple traversals: trees of one node and of three, whose test results are given.

use crate::tools::questions::crosses::{Cross, CrossScene, along};
use crate::tools::questions::tree_plan::TreePlan;
use kit::{Ray, Vec3};
use wire::work::ScriptedWorld;

/// The simple questions about traversals for the closest hit or any hit, with rays along x.
pub(crate) fn questions(any_hit: bool) -> Vec<ScriptedWorld> {
    let scenes = scenes().into_iter();
    scenes.map(|scene| scene.script(&rays(), any_hit)).collect()
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
    ]
}

/// Rays along x and against it, with ranges that contain all, some or no hits.
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
    ]
}
