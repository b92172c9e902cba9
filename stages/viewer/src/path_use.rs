//! What a path is for that the window asks for.

/// What a typed path is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathUse {
    /// To open the file.
    Open,
    /// To write the scene to it.
    SaveScene,
}
