//! The box tests of rays: those that the code made, beside those that its hit needs.

use kit::{Aabb, Ray};
use wire::work::{NodeKind, Tree};

/// A box test in a walk: by the code, by the needed walk, or by both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The index of the box.
    pub number: u32,
    /// Whether the ray hits it, if the needed walk tests it.
    pub needed: Option<bool>,
    /// Whether the code says that the ray hits it, if the code tests it.
    pub actual: Option<bool>,
}

/// The box tests that a hit at `t` needs: a traversal that visits the nearer child first, enters no
/// box beyond `t`, and tests boxes without rounding. Of a miss, `t` is the end of the ray's range.
/// In the order of the tests: the index of the node, and whether the ray hits its box.
pub fn needed(tree: &Tree, ray: &Ray, t: f64) -> Vec<(u32, bool)> {
    let enters = |at: u32| {
        let [min, max] = tree.nodes.get(at as usize)?.bounds.map(Into::into);
        let verdict = oracle::bbox(&Aabb { min, max }, ray);
        let ends = verdict.ends.filter(|_| verdict.hits())?;
        Some(ends.0.to_f64().max(ray.min_t))
    };
    let mut walk = Vec::new();
    let mut next = Vec::new();
    let mut test = |at: u32, next: &mut Vec<(u32, f64)>| {
        let entered = enters(at);
        walk.push((at, entered.is_some()));
        next.extend(entered.filter(|enters| *enters <= t).map(|t| (at, t)));
    };
    if !tree.nodes.is_empty() {
        test(0, &mut next);
    }
    // Of a malformed tree, the walk ends after as many tests as a tree has nodes.
    let mut left = tree.nodes.len();
    while let Some((at, _)) = next.pop() {
        if let NodeKind::Interior { left: a, right: b } = tree.nodes[at as usize].kind {
            if left < 2 {
                break;
            }
            left -= 2;
            let mut children = Vec::new();
            test(a, &mut children);
            test(b, &mut children);
            // The nearer child is popped first.
            children.sort_by(|a, b| b.1.total_cmp(&a.1));
            next.extend(children);
        }
    }
    walk
}

/// The steps of both walks: those of the code in its order, the others after the needed test before
/// them.
pub fn beside(needed: &[(u32, bool)], actual: &[(u32, bool)]) -> Vec<Step> {
    let mut steps: Vec<Step> = actual
        .iter()
        .map(|&(number, hit)| Step {
            number,
            needed: None,
            actual: Some(hit),
        })
        .collect();
    let mut place = 0;
    for &(number, hit) in needed {
        let found = steps.iter().position(|step| step.number == number);
        match found {
            Some(at) => {
                steps[at].needed = Some(hit);
                place = at + 1;
            }
            None => {
                let step = Step {
                    number,
                    needed: Some(hit),
                    actual: None,
                };
                steps.insert(place.min(steps.len()), step);
                place += 1;
            }
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Vec3;
    use wire::work::Node;

    /// A root over two leaves, from x = 0 to 1 and from 2 to 3.
    fn tree() -> Tree {
        let node = |min: f64, max: f64, kind| Node {
            bounds: [[min, 0.0, 0.0], [max, 1.0, 1.0]],
            kind,
        };
        let leaf = |first| NodeKind::Leaf { first, count: 1 };
        Tree {
            nodes: vec![
                node(0.0, 3.0, NodeKind::Interior { left: 1, right: 2 }),
                node(2.0, 3.0, leaf(0)),
                node(0.0, 1.0, leaf(1)),
            ],
            order: vec![0, 1],
        }
    }

    #[test]
    fn boxes_beyond_the_hit_and_beside_the_ray_are_tested_and_not_entered() {
        let ray = Ray::new(Vec3::new(-1.0, 0.5, 0.5), Vec3::X);
        assert_eq!(
            needed(&tree(), &ray, 1.5),
            [(0, true), (1, true), (2, true)]
        );
        let beside = Ray::new(Vec3::new(-1.0, 5.0, 0.5), Vec3::X);
        assert_eq!(needed(&tree(), &beside, f64::INFINITY), [(0, false)]);
        let empty = Tree {
            nodes: Vec::new(),
            order: Vec::new(),
        };
        assert_eq!(needed(&empty, &ray, 1.0), []);
    }

    #[test]
    fn a_cycle_ends() {
        let mut tree = tree();
        tree.nodes[1].kind = NodeKind::Interior { left: 0, right: 0 };
        let ray = Ray::new(Vec3::new(-1.0, 0.5, 0.5), Vec3::X);
        assert!(needed(&tree, &ray, 9.0).len() <= 4);
    }

    #[test]
    fn both_walks_are_in_one_list() {
        let steps = beside(
            &[(0, true), (3, false), (1, true)],
            &[(0, true), (2, true), (1, false)],
        );
        let flat: Vec<_> = steps
            .iter()
            .map(|s| (s.number, s.needed, s.actual))
            .collect();
        assert_eq!(
            flat,
            [
                (0, Some(true), Some(true)),
                (3, Some(false), None),
                (2, None, Some(true)),
                (1, Some(true), Some(false)),
            ]
        );
    }
}
