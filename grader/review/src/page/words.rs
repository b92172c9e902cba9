//! The words of a picture on a page: reviewers and students read different ones.

use serde::Serialize;

/// The words of a page. The field names are those of the page's script.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Words {
    /// The picture that students are graded against.
    pub(crate) golden: &'static str,
    /// The picture of the code.
    pub(crate) actual: &'static str,
    /// The answer of the exact oracle.
    pub(crate) exact: &'static str,
    /// Before the wrong fields of an answer.
    pub(crate) refuted: &'static str,
    /// Before the fields that are not judged.
    pub(crate) open: &'static str,
    /// Of an answer that differs and is right.
    pub(crate) confirmed: &'static str,
    /// Where the golden has fewer fields than the answer.
    pub(crate) short: &'static str,
    /// Where the golden has no fields, and the exact oracle's are shown.
    pub(crate) instead: &'static str,
    /// Where the golden has no fields, and there are no others.
    pub(crate) only_colour: &'static str,
}

/// For reviewers.
pub(crate) const REVIEW: Words = Words {
    golden: "golden",
    actual: "actual",
    exact: "exact",
    refuted: "The exact oracle refutes the actual answer",
    open: "The exact oracle does not judge all of the actual answer. Not judged",
    confirmed: "The exact oracle confirms the actual answer.",
    short: "– is not stored: the golden has the main fields of this pixel.",
    instead: "The golden stores rows for a sample of the pixels, and none for this one: compare with the exact oracle's record.",
    only_colour: "The golden stores rows for a sample of the pixels, and none for this one: only its colour is known.",
};

/// For students.
pub(crate) const LOOK: Words = Words {
    golden: "expected",
    actual: "yours",
    exact: "exact",
    refuted: "Yours is wrong",
    open: "Yours differs, and this part of it is not graded",
    confirmed: "Yours differs, and is right too.",
    short: "– is not stored for this pixel.",
    instead: "Compare yours with the exact answer.",
    only_colour: "Of the expected answer, only the colour is known here.",
};
