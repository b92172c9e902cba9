//! False colours, the histogram, and the layer of a file that is shown.

use super::Session;
use crate::compare::Reference;
use crate::luminance::Histogram;
use crate::luminance_view::HistogramKey;
use crate::picture_layer::Layer;
use kit::Spectrum;
use std::sync::Arc;

impl Session {
    /// Whether the picture is shown in false colours.
    pub fn false_color(&self) -> bool {
        self.luminance.false_color
    }

    pub(super) fn toggle_false_color(&mut self) {
        if self.comparison.is_some() && self.first_picture().is_some() {
            return self.say("A and B are shown: end the comparison to see false colours");
        }
        self.luminance.false_color = !self.luminance.false_color;
    }

    /// The picture file that is shown alone: without a render, and without another one to compare
    /// with.
    pub fn single_picture(&self) -> Option<&Arc<Reference>> {
        let is_alone = self.render.is_none() && self.first_picture().is_none();
        self.kept.last().filter(|_| is_alone)
    }

    /// The layer of the single picture that is shown, and its place; `None` for the picture itself.
    pub fn layer(&self) -> Option<(usize, &Layer)> {
        let place = self.luminance.layer?;
        Some((place, self.single_picture()?.layers.get(place)?))
    }

    /// Shows a layer of the single picture, or the picture itself.
    pub(super) fn show_layer(&mut self, place: Option<usize>) {
        self.luminance.layer = place;
    }

    /// The luminances of the picture that is shown; `None` without one.
    pub fn histogram(&mut self) -> Option<Arc<Histogram>> {
        let render = self.render.as_ref();
        let key = HistogramKey {
            render: render.map(|render| (render.number(), render.shown().version)),
            file: self.single_picture().cloned(),
            exposure: self.tone.exposure,
        };
        if let Some((of, histogram)) = &self.luminance.histogram
            && of.is_same(&key)
        {
            return Some(Arc::clone(histogram));
        }
        let histogram = match (render, &key.file) {
            (Some(render), _) => {
                let film = &render.shown().film;
                let rendered = film.pixels().iter().filter(|pixel| pixel.samples > 0);
                Histogram::of(rendered.map(|pixel| pixel.radiance), key.exposure)
            }
            (None, Some(file)) => {
                let linear = file.linear.as_ref()?.iter();
                Histogram::of(linear.map(|&c| Spectrum::from(c)), key.exposure)
            }
            (None, None) => return None,
        };
        let histogram = Arc::new(histogram);
        self.luminance.histogram = Some((key, Arc::clone(&histogram)));
        Some(histogram)
    }
}
