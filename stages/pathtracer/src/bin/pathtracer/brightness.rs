//! Notes about a picture in which nothing can be seen: a scene file of another program may have
//! lamps of another unit, or its camera may look past everything.

use kit::Spectrum;
use pathtracer::{Rendered, Tone};

/// Below this byte a pixel looks black.
const DARK: u8 = 32;

/// If at least this share of the pixels that are not black is white, nothing can be told apart.
const WHITE_SHARE: f64 = 0.75;

/// A picture of fewer samples may be black by chance.
const MIN_SAMPLES: u64 = 1000;

/// The byte that a proposed exposure makes of a typical pixel.
const MIDDLE: u8 = 128;

/// A note if the bytes of `rendered` are nearly all black or white. `is_lit` is false for normals.
pub(crate) fn note(rendered: &Rendered, tone: Tone, is_lit: bool) -> Option<String> {
    if rendered.samples() < MIN_SAMPLES {
        return None;
    }
    let pixels = rendered.film.pixels().iter();
    let pixels = pixels.filter(|pixel| pixel.samples > 0);
    let mut seen: Vec<Spectrum> = pixels
        .map(|pixel| pixel.radiance)
        .filter(|radiance| radiance.luminance() > 0.0)
        .collect();
    if seen.is_empty() {
        return Some(black(is_lit).to_owned());
    }
    if !is_lit {
        return None;
    }
    seen.sort_unstable_by(|a, b| a.luminance().total_cmp(&b.luminance()));
    let brightest = seen[seen.len() - 1];
    let is_dark = tone.to_bytes(brightest).iter().all(|&byte| byte < DARK);
    let white = seen.iter().filter(|&&c| tone.to_bytes(c) == [255; 3]);
    let is_bright = white.count() as f64 >= WHITE_SHARE * seen.len() as f64;
    if !is_dark && !is_bright {
        return None;
    }
    let stops = exposure_for(seen[seen.len() / 2], tone)?;
    let what = if is_dark { "black" } else { "white" };
    Some(format!(
        "note: the picture is nearly {what}: try `--exposure {stops}`"
    ))
}

fn black(is_lit: bool) -> &'static str {
    if is_lit {
        "note: the picture is black: no ray reaches anything that is lit. `--shade normals` shows \
         what the camera sees"
    } else {
        "note: the picture is black: no ray of the camera hits anything. Try another camera (`-c`), \
         or look for one in the window (without `-f`)"
    }
}

/// The exposure in whole stops for which a pixel has about the byte [`MIDDLE`]; `None` if there is
/// none.
fn exposure_for(typical: Spectrum, tone: Tone) -> Option<f64> {
    let brightest_byte = |stops: f64| {
        let exposure = tone.exposure + stops;
        let bytes = Tone { exposure, ..tone }.to_bytes(typical);
        bytes.into_iter().max()
    };
    let stops = (-40..=40).map(f64::from);
    let mut enough = stops.skip_while(|&stops| brightest_byte(stops) < Some(MIDDLE));
    enough.next().map(|stops| tone.exposure + stops)
}
