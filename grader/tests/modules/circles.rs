//! Circles of imports: the strongly connected components of the graph of files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// The files that import each other, directly or through others: each circle sorted.
pub(crate) fn of(imports: &BTreeMap<PathBuf, BTreeSet<PathBuf>>) -> Vec<Vec<PathBuf>> {
    let reached: BTreeMap<&PathBuf, BTreeSet<&PathBuf>> = imports
        .keys()
        .map(|file| (file, reached_from(file, imports)))
        .collect();
    let reaches = |a: &PathBuf, b: &PathBuf| reached.get(a).is_some_and(|all| all.contains(b));
    let mut circles = BTreeSet::new();
    for file in imports.keys().filter(|file| reaches(file, file)) {
        let others = reached[file].iter().filter(|other| reaches(other, file));
        circles.insert(others.map(|other| (*other).clone()).collect::<Vec<_>>());
    }
    circles.into_iter().collect()
}

/// All files that `file` imports, directly or through others.
fn reached_from<'a>(
    file: &'a PathBuf,
    imports: &'a BTreeMap<PathBuf, BTreeSet<PathBuf>>,
) -> BTreeSet<&'a PathBuf> {
    let mut reached = BTreeSet::new();
    let mut next = vec![file];
    while let Some(file) = next.pop() {
        let found = imports.get(file).into_iter().flatten();
        next.extend(found.filter(|file| reached.insert(*file)));
    }
    reached
}
