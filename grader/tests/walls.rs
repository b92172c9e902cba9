//! The walls of the house: which crate may know which.

use cargo_metadata::{DependencyKind, MetadataCommand};
use std::collections::{BTreeMap, BTreeSet};

/// What each crate of ours may depend on (tests and benches apart). A crate that is not here fails the test: give
/// it a place first.
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("kit", &[]),
    ("raygen", &["kit"]),
    ("intersect", &["kit"]),
    ("bbox", &["kit"]),
    ("bvh", &["kit"]),
    ("direct", &["kit"]),
    ("global", &["kit"]),
    ("adaptive", &["kit"]),
    ("simd_bvh", &["kit"]),
    ("simd_paths", &["kit"]),
    ("scenes", &["kit"]),
    (
        "pathtracer",
        &[
            "kit",
            "scenes",
            "raygen",
            "intersect",
            "bbox",
            "bvh",
            "direct",
            "global",
            "adaptive",
            "simd_bvh",
            "simd_paths",
        ],
    ),
    ("wire", &[]),
    (
        "worker",
        &[
            "kit",
            "scenes",
            "wire",
            "raygen",
            "intersect",
            "bbox",
            "bvh",
            "direct",
            "global",
            "adaptive",
        ],
    ),
    ("kernels", &["kit"]),
    ("grader", &["kit", "scenes", "wire", "kernels"]),
    ("golden", &[]),
];

#[test]
fn no_crate_knows_more_than_it_may() {
    let metadata = MetadataCommand::new()
        .no_deps()
        .exec()
        .expect("cargo metadata runs");
    let ours: BTreeSet<&str> = metadata
        .packages
        .iter()
        .map(|package| package.name.as_str())
        .collect();
    let may_know: BTreeMap<&str, BTreeSet<&str>> = MAY_KNOW
        .iter()
        .map(|(name, known)| (*name, known.iter().copied().collect()))
        .collect();
    for package in &metadata.packages {
        let name = package.name.as_str();
        let allowed = may_know
            .get(name)
            .unwrap_or_else(|| panic!("`{name}` has no place in MAY_KNOW"));
        let normal = package
            .dependencies
            .iter()
            .filter(|dependency| dependency.kind == DependencyKind::Normal);
        for dependency in normal.filter(|dependency| ours.contains(dependency.name.as_str())) {
            assert!(
                allowed.contains(dependency.name.as_str()),
                "`{name}` may not know `{}`: a stage imports only `kit`, and `grader` never links what it grades",
                dependency.name
            );
        }
    }
}
