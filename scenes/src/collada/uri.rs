//! URIs: references to elements, and paths of image files.

use super::document::Element;
use std::borrow::Cow;

/// The namespace of `xml:base`.
const XML: &str = "http://www.w3.org/XML/1998/namespace";

/// The text with `%20` and the like decoded. Unchanged if the bytes are not UTF-8.
pub(crate) fn percent_decoded(text: &str) -> Cow<'_, str> {
    if !text.contains('%') {
        return Cow::Borrowed(text);
    }
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, tail @ ..] = rest {
        let escaped = (*first == b'%')
            .then(|| tail.get(..2))
            .flatten()
            .and_then(|digits| u8::from_str_radix(str::from_utf8(digits).ok()?, 16).ok());
        bytes.push(escaped.unwrap_or(*first));
        rest = if escaped.is_some() { &tail[2..] } else { tail };
    }
    String::from_utf8(bytes).map_or(Cow::Borrowed(text), Cow::Owned)
}

/// The last segment of a path, such as the name of a file. A `\` separates segments too.
pub(super) fn last_segment(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The path of the file that `uri`, the text of `element`, refers to. A relative one is relative to
/// the `xml:base` of the element and its ancestors, if they have any, else to the scene file.
pub(super) fn path(element: Element<'_>, uri: &str) -> String {
    let bases = element
        .ancestors()
        .filter_map(|ancestor| ancestor.attribute((XML, "base")));
    let mut path = slashes(uri);
    for base in bases {
        if is_absolute(&path) {
            break;
        }
        let base = slashes(base.trim());
        let folder = base.rfind('/').map_or("", |slash| &base[..=slash]);
        path = format!("{folder}{path}");
    }
    without_scheme(&percent_decoded(&path)).to_owned()
}

/// Exporters on Windows write paths with `\`.
fn slashes(uri: &str) -> String {
    uri.replace('\\', "/")
}

/// Whether a URI starts at the root, with a scheme or with a drive.
fn is_absolute(uri: &str) -> bool {
    let scheme = uri.split(['/', '%']).next().unwrap_or_default();
    uri.starts_with('/') || scheme.contains(':')
}

/// Removes `file:` and the host: `file:///a` is `/a`, `file:///C:/a` is `C:/a`.
pub(crate) fn without_scheme(uri: &str) -> &str {
    let path = match uri.split_once(':') {
        Some((scheme, path)) if scheme.eq_ignore_ascii_case("file") => path,
        _ => return uri,
    };
    let path = path.strip_prefix("//localhost").unwrap_or(path);
    let path = path.strip_prefix("//").unwrap_or(path);
    match path.as_bytes() {
        [b'/', drive, b':', ..] if drive.is_ascii_alphabetic() => &path[1..],
        _ => path,
    }
}

#[cfg(test)]
mod tests {
    use super::{path, percent_decoded};

    /// The path of the only `<init_from>` of a document.
    fn path_in(xml: &str) -> String {
        let document = roxmltree::Document::parse(xml).expect("well-formed");
        let mut elements = document.descendants();
        let element = elements
            .find(|element| element.has_tag_name("init_from"))
            .expect("an init_from");
        path(element, element.text().expect("a URI"))
    }

    #[test]
    fn uris_become_paths() {
        for (uri, expected) in [
            ("tiles.png", "tiles.png"),
            ("./a/my%20tiles.png", "./a/my tiles.png"),
            ("file:///home/me/my%20tiles.png", "/home/me/my tiles.png"),
            ("file:///C:/a/b.png", "C:/a/b.png"),
            ("file://localhost/a.png", "/a.png"),
            ("file:a.png", "a.png"),
            ("FILE:///a.png", "/a.png"),
            (r"C:\a\b.png", "C:/a/b.png"),
            (r"..\a\b.png", "../a/b.png"),
            ("100%.png", "100%.png"),
        ] {
            assert_eq!(path_in(&format!("<init_from>{uri}</init_from>")), expected);
        }
        assert_eq!(percent_decoded("a%2"), "a%2");
        assert_eq!(percent_decoded("%ff.png"), "%ff.png");
    }

    #[test]
    fn relative_paths_start_at_the_xml_base() {
        let within = |outer: &str, inner: &str, uri: &str| {
            path_in(&format!(
                "<a xml:base='{outer}'><b xml:base='{inner}'><init_from>{uri}</init_from></b></a>"
            ))
        };
        assert_eq!(within("x/y.dae", "z/", "a.png"), "x/z/a.png");
        assert_eq!(within("x/", "file:///z/", "a%20b.png"), "/z/a b.png");
        assert_eq!(within("x/", "z/", "/a.png"), "/a.png");
        assert_eq!(within("x.dae", "y.dae", "a.png"), "a.png");
    }
}
