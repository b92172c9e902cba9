//! A and B: the picture of the render or a kept one, against another.

use super::Session;
use crate::compare::{Difference, Reference};
use crate::picture_pair::{Differences, PairDisplay, PicturePair};
use std::path::Path;
use std::sync::Arc;

/// The comparison of two pictures.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// A: the index of a kept picture; `None` for the render.
    pub first: Option<usize>,
    /// B: the index of a kept picture.
    pub second: usize,
    /// How both are shown.
    pub display: PairDisplay,
    /// Whether single pixels count, or only differences beyond the noise.
    pub each_pixel: bool,
    compared: Option<(ComparedKey, Compared)>,
}

/// What a comparison was computed of.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ComparedKey {
    first: Option<usize>,
    second: usize,
    /// The render and its version, if it is A.
    render: Option<(u64, u64)>,
    differences: Differences,
}

/// Two pictures and their errors.
#[derive(Clone, Debug)]
pub struct Compared {
    /// A number of its own for each comparison.
    pub number: u64,
    /// The errors of A; `None` if the sizes differ.
    pub errors: Option<Difference>,
    /// Both pictures and the causes; `None` if the sizes differ.
    pub pair: Option<Arc<PicturePair>>,
}

impl Session {
    /// The pictures that were kept or read, in order.
    pub fn kept(&self) -> &[Arc<Reference>] {
        &self.kept
    }

    /// The comparison of two pictures.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// How the compared pictures are shown.
    pub fn comparison_mut(&mut self) -> Option<&mut Comparison> {
        self.comparison.as_mut()
    }

    pub(super) fn keep_for_comparison(&mut self) {
        let Some(render) = &self.render else {
            return self.say("There is no picture to keep: R renders one");
        };
        let flags = match &self.settings {
            Some(settings) => settings.flags(),
            None => String::new(),
        };
        let reference = Reference::of_film(&flags, &render.shown().film);
        self.compare_with(reference);
        self.say("Kept: later pictures are compared with this one");
    }

    /// Reads a picture, and compares with it.
    pub(super) fn compare_with_file(&mut self, path: &Path) {
        match Reference::load(path) {
            Ok(reference) => {
                self.say(format!("Compared with {}", path.display()));
                self.compare_with(reference);
                self.mode = super::Mode::Render;
            }
            Err(why) => self.say(why),
        }
    }

    fn compare_with(&mut self, reference: Reference) {
        self.kept.push(Arc::new(reference));
        self.show_layer(None);
        let newest = self.kept.len() - 1;
        match &mut self.comparison {
            Some(comparison) => comparison.second = newest,
            None => {
                self.comparison = Some(Comparison {
                    // Without a render, the picture before is A.
                    first: match self.render {
                        Some(_) => None,
                        None => newest.checked_sub(1),
                    },
                    second: newest,
                    display: PairDisplay::default(),
                    each_pixel: false,
                    compared: None,
                });
            }
        }
        let without_first = self.render.is_none();
        if let Some(comparison) = &mut self.comparison
            && comparison.first.is_none()
            && without_first
        {
            comparison.first = newest.checked_sub(1);
        }
    }

    /// A becomes B, and B becomes A. The render is kept for that.
    pub(super) fn swap_compared(&mut self) {
        let Some(first) = self.first_picture() else {
            return;
        };
        let Some(comparison) = &mut self.comparison else {
            return;
        };
        let at = comparison.first.unwrap_or_else(|| {
            self.kept.push(first);
            self.kept.len() - 1
        });
        (comparison.first, comparison.second) = (Some(comparison.second), at);
    }

    /// The next of the kept pictures becomes B.
    pub(super) fn next_compared(&mut self) {
        let count = self.kept.len();
        if let Some(comparison) = &mut self.comparison {
            comparison.second = (comparison.second + 1) % count;
        }
    }

    /// Picture A; `None` without a comparison or a render.
    pub fn first_picture(&self) -> Option<Arc<Reference>> {
        let comparison = self.comparison.as_ref()?;
        match comparison.first {
            Some(first) => self.kept.get(first).cloned(),
            None => {
                let film = &self.render.as_ref()?.shown().film;
                Some(Arc::new(Reference::of_film("the render", film)))
            }
        }
    }

    /// Picture B; `None` without a comparison.
    pub fn second_picture(&self) -> Option<&Arc<Reference>> {
        self.kept.get(self.comparison.as_ref()?.second)
    }

    /// What differences of both pictures mean: in pictures of light single pixels are noise.
    fn differences(&self) -> Option<Differences> {
        let comparison = self.comparison.as_ref()?;
        let shows_normals = comparison.first.is_none()
            && self
                .render
                .as_ref()
                .is_some_and(|render| !render.scene().prepared.picture.is_lit());
        Some(match (shows_normals, comparison.each_pixel) {
            (true, _) => Differences::Normals,
            (false, true) => Differences::Values,
            (false, false) => Differences::Noise,
        })
    }

    /// The comparison of both pictures as they are now; `None` without two pictures.
    pub fn compared(&mut self) -> Option<&Compared> {
        let differences = self.differences()?;
        let comparison = self.comparison.as_ref()?;
        let render = self.render.as_ref().filter(|_| comparison.first.is_none());
        let key = ComparedKey {
            first: comparison.first,
            second: comparison.second,
            render: render.map(|render| (render.number(), render.shown().version)),
            differences,
        };
        if !matches!(&comparison.compared, Some((of, _)) if *of == key) {
            let (first, second) = (self.first_picture()?, self.second_picture()?);
            let errors = Difference::of(&first, second);
            let pair = PicturePair::of(first.image(), second.image(), differences);
            self.comparisons += 1;
            let compared = Compared {
                number: self.comparisons,
                errors,
                pair: pair.map(Arc::new),
            };
            self.comparison.as_mut()?.compared = Some((key, compared));
        }
        let (_, compared) = self.comparison.as_ref()?.compared.as_ref()?;
        Some(compared)
    }
}
