//! Pictures inside the page.

use crate::error::GraderError;
use crate::html::base64;
use image::RgbImage;
use std::io::Cursor;

/// The picture as the address of an `<img>`: a PNG in base 64.
pub(crate) fn png(picture: &RgbImage) -> Result<String, GraderError> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(|e| GraderError::new(format!("cannot encode a picture: {e}")))?;
    Ok(format!("data:image/png;base64,{}", base64(bytes.get_ref())))
}
