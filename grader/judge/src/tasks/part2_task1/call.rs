//! One call shown.

use crate::tools::shown::{MOST_SPANS, ShownCall, ShownSpans, Span, tree_rows};
use wire::work::{BuildWork, Tree};

/// The boxes and the levels of the tree that was built, along the axis in which the boxes lie
/// apart. `None` for more boxes than a drawing can show.
pub(super) fn shown(work: &BuildWork, tree: &Tree) -> Option<ShownCall> {
    if work.bounds.is_empty() || work.bounds.len() > MOST_SPANS {
        return None;
    }
    let spread = |axis: usize| {
        let starts = work.bounds.iter().map(|[min, _]| min[axis]);
        let (low, high) = starts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high - low
    };
    let axes = (0..3).max_by(|a, b| spread(*a).total_cmp(&spread(*b)).then(b.cmp(a)));
    let axis = axes.unwrap_or(0);
    let boxes = work.bounds.iter().enumerate().map(|(id, [min, max])| Span {
        ends: [min[axis], max[axis]],
        label: id.to_string(),
    });
    let mut rows = vec![boxes.collect()];
    rows.extend(tree_rows(tree, |node| {
        let [min, max] = tree.nodes.get(node)?.bounds;
        Some([min[axis], max[axis]])
    })?);
    Some(ShownCall::Spans(ShownSpans {
        along: ["x", "y", "z"][axis],
        about: "the boxes; below, your tree, level by level",
        rows,
        expected: None,
        yours: None,
    }))
}
