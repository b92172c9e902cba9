//! The check of pictures: their form is checked, nothing in them is judged.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, same_length};
use crate::tools::findings::Findings;
use wire::kind;
use wire::picture::{PictureAnswer, PictureWork};

impl Check for kind::Picture {
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

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &PictureWork, _: &PictureAnswer) {}
}
