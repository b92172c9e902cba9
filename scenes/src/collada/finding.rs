//! What the reader has to report about a place in the document.

use super::document::Document;
use crate::diagnostic::{Diagnostic, SceneError};
use std::ops::Range;

/// An error or a warning, before its line is computed: that takes time, and of warnings of one kind
/// only the first is shown.
pub(super) struct Finding<'r, 'a> {
    doc: &'r Document<'a>,
    mark: Range<usize>,
    title: String,
    label: String,
    help: Option<String>,
}

impl<'r, 'a> Finding<'r, 'a> {
    /// A finding at the bytes `mark`, with a label that describes what was expected.
    pub(super) fn new(
        doc: &'r Document<'a>,
        mark: Range<usize>,
        title: impl Into<String>,
        label: impl Into<String>,
    ) -> Finding<'r, 'a> {
        Finding {
            doc,
            mark,
            title: title.into(),
            label: label.into(),
            help: None,
        }
    }

    /// Replaces the label.
    pub(super) fn relabel(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Sets the advice on what to do, or for a warning, what was done.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds this to the warnings of the document.
    pub(super) fn warn(self) {
        let doc = self.doc;
        doc.add_warning(&self.title, self.mark.start, || self.located());
    }

    fn located(&self) -> Diagnostic {
        let diagnostic = Diagnostic::about_file(self.doc.file(), &self.title).at(
            self.doc.source(),
            self.mark.clone(),
            &self.label,
        );
        match &self.help {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        }
    }
}

impl From<Finding<'_, '_>> for SceneError {
    fn from(finding: Finding<'_, '_>) -> SceneError {
        finding.located().into()
    }
}
