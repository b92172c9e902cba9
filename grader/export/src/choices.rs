//! What the instructor chose.

/// What to grade, and what students see of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choices {
    /// The part, such as `part1`.
    pub what: String,
    /// The title of the part.
    pub title: String,
    /// The number of the part.
    pub part: u32,
    /// The hint level, from 1 to 4.
    pub hint: String,
    /// When students see the results in Gradescope.
    pub visibility: String,
    /// Whether extra credit is added to the total score.
    pub add_extra: bool,
    /// The seed of the random inputs, if it is the same for everyone.
    pub seed: Option<u64>,
    /// Whether to grade where code cannot be contained.
    pub unsandboxed: bool,
    /// Whether the image of PrairieLearn contains no solutions.
    pub public: bool,
    /// The repository of the handout on GitHub, `OWNER/NAME`.
    pub course: Option<String>,
    /// The branch or tag of that repository.
    pub reference: String,
}

impl Choices {
    /// The options of `grader` that they mean.
    pub fn options(&self) -> String {
        let mut options = format!("--hint {}", self.hint);
        if let Some(seed) = self.seed {
            options.push_str(&format!(" --seed {seed}"));
        }
        if self.add_extra {
            options.push_str(" --add-extra");
        }
        options
    }
}
