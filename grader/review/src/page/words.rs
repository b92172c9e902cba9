//! The words of a picture on a page: reviewers and students read different ones.

/// The words of a page.
#[derive(Clone, Copy, Debug)]
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
    /// Where the golden has no fields, and the exact oracle's are shown.
    pub(crate) instead: &'static str,
    /// Where the golden has no fields, and there are no others.
    pub(crate) only_colour: &'static str,
    /// Of a pixel that differs and has no records on the page.
    pub(crate) no_records: &'static str,
}

/// For reviewers.
pub(crate) const REVIEW: Words = Words {
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

/// For students.
pub(crate) const LOOK: Words = Words {
    golden: "expected",
    actual: "yours",
    exact: "exact",
    refuted: "Yours is wrong",
    open: "Yours differs, and this part of it is not graded",
    confirmed: "Yours differs, and is right too.",
    instead: "Compare yours with the exact answer.",
    only_colour: "Of the expected answer, only the colour is known here.",
    no_records: "This page has the records of a sample of the pixels that differ, and this is none of them. The buttons below the picture go to those that have records.",
};
