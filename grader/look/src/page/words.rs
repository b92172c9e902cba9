//! The words of a picture on a page: reviewers and students read different ones.

/// The words of a page.
#[derive(Clone, Copy, Debug)]
pub struct Words {
    /// The picture that students are graded against.
    pub golden: &'static str,
    /// The picture of the code.
    pub actual: &'static str,
    /// The answer of the exact oracle.
    pub exact: &'static str,
    /// Before the wrong fields of an answer.
    pub refuted: &'static str,
    /// Before the fields that are not judged.
    pub open: &'static str,
    /// Of an answer that differs and is right.
    pub confirmed: &'static str,
    /// Where the golden has no fields, and the exact oracle's are shown.
    pub instead: &'static str,
    /// Where the golden has no fields, and there are no others.
    pub only_colour: &'static str,
    /// Of a pixel that differs and has no records on the page.
    pub no_records: &'static str,
}

/// For students.
pub const LOOK: Words = Words {
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
