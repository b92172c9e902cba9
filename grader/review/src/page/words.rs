//! What the page calls the two sides that it compares.

use look::page::words::Words;

/// For reviewers.
pub(super) const REVIEW: Words = Words {
    golden: "golden",
    actual: "actual",
    exact: "exact",
    refuted: "The exact oracle refutes the actual answer",
    open: "The exact oracle does not judge all of the actual answer. Not judged",
    confirmed: "The exact oracle confirms the actual answer.",
    instead: "The golden stores rows for a sample of the pixels, and none for this one: compare with the exact answer.",
    only_colour: "The golden stores rows for a sample of the pixels, and none for this one: only its colour is known.",
    no_records: "This page has the records of a sample of the pixels that differ, evenly spread, and this is none of them. The buttons below the picture go to those that have records.",
};
