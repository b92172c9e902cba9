//! The check of pictures: their form is checked, nothing in them is judged.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, same_length};
use crate::tools::findings::Findings;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use wire::kind;
use wire::picture::{PictureAnswer, PictureWork};

impl Check for kind::Picture {
    const LIMIT_MS: u64 = 10_000;

    fn calls(work: &PictureWork) -> usize {
        work.size[0] as usize * work.size[1] as usize
    }

    fn only_call(_: &PictureWork, _: usize) -> Option<PictureWork> {
        None
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

    fn lines(_: &PictureWork, _: &PictureAnswer) -> Option<Content> {
        None
    }

    fn input(_: &PictureWork, _: usize) -> Option<String> {
        None
    }

    fn exact(_: &PictureWork, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        _: &PictureWork,
        _: Tier,
        _: bool,
        _: usize,
        _: Option<&PictureAnswer>,
    ) -> Option<ShownCall> {
        None
    }
}
