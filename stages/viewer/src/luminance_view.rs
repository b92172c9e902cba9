//! How the session shows luminances: false colours, the layer of a file, the histogram.

use crate::compare::Reference;
use crate::luminance::Histogram;
use std::sync::Arc;

/// How the luminance of the picture is shown.
#[derive(Default)]
pub(crate) struct LuminanceView {
    /// Whether it is shown in false colours.
    pub(crate) false_color: bool,
    /// The layer of a picture that is shown alone.
    pub(crate) layer: Option<usize>,
    /// The newest histogram, and what it was counted of.
    pub(crate) histogram: Option<(HistogramKey, Arc<Histogram>)>,
}

/// What a histogram was counted of.
pub(crate) struct HistogramKey {
    /// The render and its version.
    pub(crate) render: Option<(u64, u64)>,
    /// The file, if there is no render.
    pub(crate) file: Option<Arc<Reference>>,
    /// The exposure in stops.
    pub(crate) exposure: f64,
}

impl HistogramKey {
    /// Whether both histograms count the same.
    pub(crate) fn is_same(&self, other: &HistogramKey) -> bool {
        let files = (&self.file, &other.file);
        let is_same_file = match files {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        is_same_file && (self.render, self.exposure) == (other.render, other.exposure)
    }
}
