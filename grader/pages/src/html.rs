//! Building blocks of self-contained HTML pages.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pictures::image::Rgb;
use pictures::{Image, png};

/// The highest level of compression that does not take minutes.
const LEVEL: u8 = 9;

/// Escapes `text` for use in HTML text and attribute values.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Encodes `bytes` in base64 (RFC 4648, with padding), as used in data URIs and read by `atob`.
pub fn base64(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}

/// A data URI for the `src` of an `<img>`: the bytes of a picture file of the given subtype, such
/// as `png` or `svg+xml`.
pub fn image_uri(subtype: &str, bytes: &[u8]) -> String {
    format!("data:image/{subtype};base64,{}", base64(bytes))
}

/// Encodes the picture as a PNG in a data URI, for the `src` of an `<img>`.
pub fn png_data_uri(picture: &Image) -> String {
    image_uri("png", &png::encode(picture))
}

/// A patch of a colour, for legends.
pub fn chip([r, g, b]: Rgb) -> String {
    format!("<span class=\"chip\" style=\"background:rgb({r},{g},{b})\"></span>")
}

/// Compresses `bytes` (zlib, RFC 1950) and encodes the result in base64. A script reads it with
/// `DecompressionStream("deflate")`.
pub fn compressed(bytes: &[u8]) -> String {
    base64(&compress_to_vec_zlib(bytes, LEVEL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_text_is_compressed_as_zlib() {
        let text = compressed(&[b'a'; 9999]);
        assert!(text.starts_with("eN") && text.len() < 100, "{text}");
    }

    #[test]
    fn escaped_text_is_not_markup() {
        assert_eq!(escape("<a b='\"&\">"), "&lt;a b=&#39;&quot;&amp;&quot;&gt;");
    }
}
