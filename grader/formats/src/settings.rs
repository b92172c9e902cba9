//! What a file contains besides the outcome: what the instructor chose.

use crate::classroom50::Assignment;
use base::GraderError;

/// What a file contains besides the outcome.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Whether extra credit is added to the total score. Otherwise it is only shown.
    pub add_extra: bool,
    /// When students see the results in Gradescope.
    pub visibility: Visibility,
    /// What Classroom 50 calls the submission, or why it is not known.
    pub assignment: Result<Assignment, GraderError>,
}

/// When students see results in Gradescope.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// At once.
    #[default]
    Visible,
    /// After the due date.
    AfterDueDate,
    /// After grades are published.
    AfterPublished,
    /// Never.
    Hidden,
}

impl Visibility {
    /// All values.
    pub const ALL: [Visibility; 4] = [
        Visibility::Visible,
        Visibility::AfterDueDate,
        Visibility::AfterPublished,
        Visibility::Hidden,
    ];

    /// Its name in Gradescope and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Visibility::Visible => "visible",
            Visibility::AfterDueDate => "after_due_date",
            Visibility::AfterPublished => "after_published",
            Visibility::Hidden => "hidden",
        }
    }

    /// The value with this name.
    pub fn named(name: &str) -> Option<Visibility> {
        let mut all = Visibility::ALL.into_iter();
        all.find(|visibility| visibility.name() == name)
    }
}
