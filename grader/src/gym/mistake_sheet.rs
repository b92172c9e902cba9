//! The pictures of typical mistakes in a chapter: one file for each task, with the right picture at
//! the left, then those of mistakes.

use base::Workspace;
use pictures::Image;
use std::path::PathBuf;

/// Width and height of each picture in a sheet: half of those of a panel.
pub const TILE: [u32; 2] = [160, 120];

/// Pixels between two pictures.
pub const GAP: u32 = 4;

/// The file of the task `key`.
pub fn file(workspace: &Workspace, key: &str) -> PathBuf {
    let name = key.replace('.', "-");
    let folder = workspace.root().join("stages/book/src/mistakes");
    folder.join(format!("{name}.png"))
}

/// The left edge of the picture at the place `number`.
pub fn left(number: u32) -> u32 {
    left_among(TILE[0], number)
}

/// The left edge of the picture at the place `number` among pictures of this width.
pub fn left_among(width: u32, number: u32) -> u32 {
    number * (width + GAP)
}

/// The picture at the place `number` in a sheet; the right one is at 0. `None` if the sheet has
/// another height, or no such picture.
pub fn picture(sheet: &Image, number: u32) -> Option<Image> {
    let [width, height] = sheet.size();
    let is_there = height == TILE[1] && width >= left(number) + TILE[0];
    is_there.then(|| Image::from_fn(TILE, |x, y| sheet.get(left(number) + x, y)))
}
