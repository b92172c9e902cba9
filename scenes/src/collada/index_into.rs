//! The values of an input at the corners of a primitive element.

use super::index_lists::IndexLists;
use super::vertices::Vectors;
use kit::Vec3;
use std::rc::Rc;

/// The offset of an input in a group of indices, and the list that its index refers to.
pub(super) struct IndexInto<'a, T = Vec3> {
    pub(super) offset: usize,
    pub(super) vectors: Rc<Vectors<'a, T>>,
}

impl<'a, T: Copy> IndexInto<'a, T> {
    pub(super) fn new(offset: usize, vectors: &Rc<Vectors<'a, T>>) -> IndexInto<'a, T> {
        let vectors = Rc::clone(vectors);
        IndexInto { offset, vectors }
    }

    /// The values at three corners. `None` if an index is out of range: it is added to `missing`.
    pub(super) fn values(
        &self,
        lists: &IndexLists<'a>,
        groups: [usize; 3],
        missing: &mut Found,
    ) -> Option<[T; 3]> {
        let indices = groups.map(|group| lists.index(group, self.offset));
        match indices.map(|index| self.vectors.values.get(index)) {
            [Some(a), Some(b), Some(c)] => Some([*a, *b, *c]),
            values => {
                let first = values.iter().position(|value| value.is_none());
                missing.add(1, groups[first.unwrap_or(0)]);
                None
            }
        }
    }
}

/// A number of problems, and the group of the first one.
#[derive(Default)]
pub(super) struct Found {
    pub(super) count: usize,
    pub(super) first: Option<usize>,
}

impl Found {
    pub(super) fn add(&mut self, more: usize, group: usize) {
        self.count += more;
        if more > 0 {
            self.first.get_or_insert(group);
        }
    }
}
