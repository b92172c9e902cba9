//! The number of box and primitive tests that traversals of a tree make.

use std::ops::AddAssign;
use wire::work::{NodeKind, Tree};

/// A traversal may make this many times the tests of one that visits children in a fixed order,
/// averaged over left to right and right to left. Half of the rays go one way and half the other.
/// Visiting the farther child first, or every node, makes twice as many tests.
pub(crate) const WORK_FACTOR: f64 = 1.5;

/// As [`WORK_FACTOR`], if any hit ends the traversal. It may visit the boxes in any order: taking
/// the nearest of all open boxes makes 1.6 times the tests, and not stopping at a hit makes twelve.
pub(crate) const ANY_HIT_WORK_FACTOR: f64 = 3.0;

/// Why a number of tests above the fewest is not judged.
pub(crate) const MORE_TESTS: &str =
    "there are more tests than the fewest possible, which is allowed within limits";

/// Why a number of tests below the fewest is not judged.
pub(crate) const TOO_FEW_TESTS: &str =
    "there are fewer tests than a traversal makes that is right whatever the tree";

/// Numbers of box and primitive tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tests {
    pub(crate) boxes: u64,
    pub(crate) prims: u64,
}

impl AddAssign for Tests {
    fn add_assign(&mut self, other: Tests) {
        self.boxes += other.boxes;
        self.prims += other.prims;
    }
}

/// The tests of all rays of a case.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NeededTests {
    /// The fewest.
    pub(crate) fewest: Tests,
    /// Those of traversals in a fixed order: the sum over left to right and right to left.
    pub(crate) twice_plain: Tests,
}

/// A ray through a tree, and what its line meets.
pub(crate) struct TracedRay<'a> {
    pub(crate) tree: &'a Tree,
    /// Whether any hit ends the traversal.
    pub(crate) any_hit: bool,
    /// `min_t` and `max_t`.
    pub(crate) range: [f64; 2],
    /// The interval in which the line is inside the box of a node.
    pub(crate) span: &'a dyn Fn(usize) -> Option<[f64; 2]>,
    /// The `t` at which the line hits a primitive.
    pub(crate) hit: &'a dyn Fn(u32) -> Option<f64>,
}

impl TracedRay<'_> {
    /// The tests of a traversal that visits children in a fixed order, left before right or right
    /// before left if `mirrored`, and culls boxes beyond the closest hit so far.
    pub(crate) fn fixed_order(&self, mirrored: bool) -> Tests {
        let mut max_t = self.range[1];
        self.walk(mirrored, |prims| {
            let hits = prims.iter().filter_map(|&id| (self.hit)(id));
            let nearest = hits
                .filter(|&t| self.range[0] <= t)
                .fold(f64::INFINITY, f64::min);
            let ends = nearest <= max_t && self.any_hit;
            max_t = max_t.min(nearest);
            if ends { None } else { Some(max_t) }
        })
    }

    /// The tests that every right traversal makes, whatever its order: of the children of every box
    /// that the ray enters before its `closest` hit, and of the primitives in such leaves. For any
    /// hit, only those that lead to one primitive.
    pub(crate) fn fewest(&self, closest: Option<f64>) -> Tests {
        match closest {
            Some(_) if self.any_hit => Tests { boxes: 1, prims: 1 },
            Some(closest) => self.until(closest.next_down()),
            None => self.until(self.range[1]),
        }
    }

    /// The tests of a traversal that enters all boxes in the ray's range, and shortens no ray.
    pub(crate) fn all_met(&self) -> Tests {
        self.until(self.range[1])
    }

    /// The tests of a traversal that enters all boxes up to `max_t`.
    fn until(&self, max_t: f64) -> Tests {
        let within = TracedRay {
            range: [self.range[0], max_t],
            ..*self
        };
        within.walk(false, |_| Some(max_t))
    }

    /// Counts the tests of a traversal in depth-first order. `visit` gets the primitives of a leaf
    /// and returns the new `max_t`, or `None` to end.
    fn walk(&self, mirrored: bool, mut visit: impl FnMut(&[u32]) -> Option<f64>) -> Tests {
        let [min_t, mut max_t] = self.range;
        let mut tests = Tests::default();
        let mut next = Vec::from_iter((!self.tree.nodes.is_empty()).then_some(0));
        tests.boxes += next.len() as u64;
        while let Some(at) = next.pop() {
            let is_entered =
                (self.span)(at).is_some_and(|[enters, leaves]| enters <= max_t && leaves >= min_t);
            if !is_entered {
                continue;
            }
            match self.tree.nodes[at].kind {
                NodeKind::Interior { left, right } => {
                    tests.boxes += 2;
                    let children = [right as usize, left as usize];
                    next.extend(children);
                    if mirrored {
                        let top = next.len();
                        next.swap(top - 1, top - 2);
                    }
                }
                NodeKind::Leaf { first, count } => {
                    tests.prims += u64::from(count);
                    let run = first as usize..first as usize + count as usize;
                    match visit(&self.tree.order[run]) {
                        Some(nearest) => max_t = nearest,
                        None => return tests,
                    }
                }
            }
        }
        tests
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::Node;

    /// A root over two leaves of two primitives. The ray is inside the left leaf from 1 to 3 and in
    /// the right one from 2 to 4; it hits primitive 0 at 2.5 and 3 at 3.5.
    fn tests(any_hit: bool, max_t: f64, of: impl Fn(&TracedRay<'_>) -> Tests) -> [u64; 2] {
        let node = |kind| Node {
            bounds: [[0.0; 3]; 2],
            kind,
        };
        let leaf = |first| node(NodeKind::Leaf { first, count: 2 });
        let tree = Tree {
            nodes: vec![
                node(NodeKind::Interior { left: 1, right: 2 }),
                leaf(0),
                leaf(2),
            ],
            order: vec![0, 1, 2, 3],
        };
        let span = |node: usize| Some([[1.0, 4.0], [1.0, 3.0], [2.0, 4.0]][node]);
        let hit = |id: u32| [Some(2.5), None, None, Some(3.5)][id as usize];
        let ray = TracedRay {
            tree: &tree,
            any_hit,
            range: [0.0, max_t],
            span: &span,
            hit: &hit,
        };
        let Tests { boxes, prims } = of(&ray);
        [boxes, prims]
    }

    #[test]
    fn the_order_decides_how_many_primitives_are_tested() {
        let left_first = |ray: &TracedRay<'_>| ray.fixed_order(false);
        let right_first = |ray: &TracedRay<'_>| ray.fixed_order(true);
        assert_eq!(tests(false, 9.0, left_first), [3, 4]);
        assert_eq!(tests(false, 9.0, right_first), [3, 4]);
        assert_eq!(tests(true, 9.0, left_first), [3, 2]);
        assert_eq!(tests(false, 1.5, left_first), [3, 2]);
        assert_eq!(tests(false, 0.5, left_first), [1, 0]);
    }

    #[test]
    fn the_fewest_tests_are_those_before_the_closest_hit() {
        assert_eq!(tests(false, 9.0, |ray| ray.fewest(Some(2.5))), [3, 4]);
        assert_eq!(tests(false, 9.0, |ray| ray.fewest(Some(2.0))), [3, 2]);
        assert_eq!(tests(false, 0.5, |ray| ray.fewest(None)), [1, 0]);
        assert_eq!(tests(true, 9.0, |ray| ray.fewest(Some(2.5))), [1, 1]);
    }
}
