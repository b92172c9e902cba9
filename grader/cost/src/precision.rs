//! The precision of a kernel or of a library.

use serde::{Deserialize, Serialize};

/// The precision of a kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// Single precision: 24 bits. The oracle uses the rounded inputs, so that only the kernel's own
    /// roundings count.
    F32,
    /// Double precision: 53 bits.
    #[default]
    F64,
    /// Shapes and rays are stored in single precision and computed with in double precision. Judged
    /// like `f32`.
    #[serde(rename = "f32 in f64")]
    F32InF64,
}

impl Precision {
    /// The name, as in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
            Precision::F32InF64 => "f32 in f64",
        }
    }
}
