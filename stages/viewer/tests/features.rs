//! Which features the stages of this project lack.

use viewer::features::MissingFeatures;

/// In a complete project nothing is missing. Handouts do not have this test.
#[test]
fn the_reference_has_all_features() {
    assert_eq!(MissingFeatures::find(), MissingFeatures::default());
}
