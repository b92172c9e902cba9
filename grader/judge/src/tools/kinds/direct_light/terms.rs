//! What each traced ray adds to an estimate, and the sum as a person multiplies it out.

use super::lamps::ShadingPlace;
use crate::tools::aspects::hits::show;
use crate::tools::call_text::is_coloured;
use kit::Vec3;

/// What one ray adds to an estimate: `f · L · cos θ / pdf / samples`.
pub(super) struct Term {
    d: Vec3,
    f: Vec3,
    /// The radiance that arrives.
    pub(super) light: Vec3,
    cosine: f64,
    /// The density of its direction.
    pdf: f64,
    /// The number of samples over which the mean is taken.
    samples: u32,
}

impl Term {
    /// The ray along `d` in world space.
    pub(super) fn of(place: &ShadingPlace, d: Vec3, light: Vec3, pdf: f64, samples: u32) -> Term {
        let wi = place.frame.to_local(d);
        Term {
            d,
            f: place.f(place.wo, wi),
            light,
            cosine: wi.z.abs(),
            pdf,
            samples: samples.max(1),
        }
    }

    pub(super) fn value(&self) -> Vec3 {
        self.f * self.light * (self.cosine / self.pdf / f64::from(self.samples))
    }

    fn text(&self) -> String {
        let [f, light] = [self.f, self.light].map(channels);
        let (cosine, pdf) = (self.cosine, self.pdf);
        let mean = match self.samples {
            1 => String::new(),
            samples => format!(" / {samples}"),
        };
        format!("{f} · {light} · {cosine} / {pdf}{mean}")
    }
}

/// One number if all channels are the same.
fn channels(colour: Vec3) -> String {
    match is_coloured(colour.into()) {
        true => show(colour),
        false => colour.x.to_string(),
    }
}

/// The most rays whose sum a person can follow.
const FEW: usize = 2;

/// The sum over the traced rays, as a sentence; empty without rays, and where there are many.
pub(super) fn text(terms: &[Term]) -> String {
    if terms.is_empty() || terms.len() > FEW {
        return String::new();
    }
    let sum: Vec<String> = terms.iter().map(Term::text).collect();
    let along: Vec<String> = terms.iter().map(|term| show(term.d)).collect();
    let mean = match terms[0].samples {
        1 => "",
        _ => " / samples",
    };
    let plural = if terms.len() == 1 { "ray" } else { "rays" };
    format!(
        "f · L · cos θ / pdf{mean} of the traced {plural}: {}, along {}. ",
        sum.join(" + "),
        along.join(" and ")
    )
}

#[cfg(test)]
mod tests {
    use super::super::worlds::floor;
    use super::*;

    #[test]
    fn the_text_of_a_term_is_its_value() {
        let place = ShadingPlace::of(&floor());
        let term = |samples| Term::of(&place, Vec3::Y, Vec3::splat(2.0), 0.5, samples);
        let f = place.f(place.wo, Vec3::Z);
        let written = format!("{} · 2 · 1 / 0.5 / 4", show(f));
        assert_eq!(term(4).text(), written);
        assert_eq!(term(4).value(), f);
        assert!(text(&[term(1)]).contains("traced ray: "));
        assert_eq!(text(&[term(1), term(1), term(1)]), "");
    }
}
