//! The check of pictures: their form is checked, nothing in them is judged.

use crate::Tier;
use crate::cases::Spec;
use crate::check::{Check, Content, same_length};
use crate::tally::Tally;
use wire::picture::{PictureAnswer, PictureWork};

/// The picture of a task.
pub(crate) struct Picture;

impl Check for Picture {
    type Question = PictureWork;
    type Answer = PictureAnswer;

    const LIMIT_MS: u64 = 10_000;

    fn calls(work: &PictureWork) -> usize {
        work.size[0] as usize * work.size[1] as usize
    }

    fn fits(work: &PictureWork, answer: &PictureAnswer) -> Result<(), String> {
        if answer.panels.len() != work.panels as usize {
            return Err(format!(
                "expected {} panels, found {}",
                work.panels,
                answer.panels.len()
            ));
        }
        let mut panels = answer.panels.iter();
        panels.try_for_each(|panel| same_length("pixels", panel.len(), Self::calls(work)))
    }

    fn judge(_: &mut Tally, _: &Spec, _: Tier, _: &PictureWork, _: &PictureAnswer) {}

    fn lines(_: &PictureWork, _: &PictureAnswer) -> Option<Content> {
        None
    }
}
