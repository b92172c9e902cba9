//! Notes about a picture in which nothing can be seen: a scene file of another program may have
//! lamps of another unit, or its camera may look past everything.

use kit::Spectrum;
use pathtracer::{Darkness, Rendered, Tone};

/// Below this byte a pixel looks black.
const DARK: u8 = 32;

/// If at least this share of the pixels that are not black is white, nothing can be told apart.
const WHITE_SHARE: f64 = 0.75;

/// A picture of fewer samples may be black by chance.
const MIN_SAMPLES: u64 = 1000;

/// The byte that a proposed exposure makes of a typical pixel.
const MIDDLE: u8 = 128;

/// A note if the bytes of `rendered` are nearly all black or white. `why_black` finds the reason;
/// `None` for normals.
pub(crate) fn note(
    rendered: &Rendered,
    tone: Tone,
    why_black: Option<impl FnOnce() -> Darkness>,
) -> Option<String> {
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
        let why = why_black.map_or(Darkness::NothingSeen, |why| why());
        return Some(format!("note: the picture is black: {}", reason(why)));
    }
    why_black.as_ref()?;
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

/// Why, and what to do.
fn reason(why: Darkness) -> &'static str {
    match why {
        Darkness::NothingSeen => {
            "no ray of the camera hits anything. Try another camera (`-c`), or look for one in the \
             window (without `-f`)"
        }
        Darkness::NoLight => "the scene has no light",
        Darkness::DepthZero => "`-m 0` shows lamps only, and the camera sees none. Try `-m 1`",
        Darkness::OnlyDeltaLights => {
            "`-H` finds no point, spot or directional lights, and there are no others: omit `-H`"
        }
        Darkness::BlackSurfaces => {
            "what the camera sees reflects no light: black materials, or the backs of lamps. `--shade \
             normals` shows it"
        }
        Darkness::BehindLights => {
            "what the camera sees is behind the lamps, or outside of their cones. `--shade normals` \
             shows it"
        }
        Darkness::FacingAway => {
            "all that the camera sees faces away from the lights. `--shade normals` shows it"
        }
        Darkness::Shadowed => {
            "something is between the lights and what the camera sees. `--shade normals` shows it"
        }
        Darkness::Other => "no light found its way. `--shade normals` shows what the camera sees",
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
