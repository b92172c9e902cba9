//! Examples of mirrored and refracted directions.
//!
//! They are judged by Snell's law in the form of vectors: at a boundary only the part along the
//! normal changes. So a handout judges examples without the formula that computes a direction.

use super::by_hand::BY_HAND;
use kit::Vec3;
use wire::Work;
use wire::global::SpecularCall;

/// The function of an example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpecularFunction {
    /// `reflect`.
    Reflect,
    /// `refract`, with the index of the inside over that of the outside.
    Refract(f64),
}

/// A direction in local space, and the direction that a student expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularExample {
    /// The function.
    pub function: SpecularFunction,
    /// To the viewer.
    pub wo: Vec3,
    /// The direction, if there is one.
    pub expected: Option<Vec3>,
}

/// The situations of mirrored and refracted directions.
pub(super) const SITUATIONS: &[&str] = &[
    "mirrored along the normal",
    "mirrored aslant",
    "mirrored from below",
    "refracted along the normal",
    "refracted aslant, from outside",
    "refracted aslant, from inside",
    "total internal reflection",
    "an index below 1",
    "x and y that differ",
];

pub(super) fn verdict(example: &SpecularExample) -> Option<String> {
    let SpecularExample {
        function,
        wo,
        expected,
    } = *example;
    let is_unit = |w: Vec3| (w.length() - 1.0).abs() <= BY_HAND;
    if !is_unit(wo) || wo.z == 0.0 {
        return Some("its wo is not of length 1, or is in the plane of the surface".into());
    }
    // The indices of the side of wo and of the side of the expected direction.
    let (mine, other) = match function {
        SpecularFunction::Reflect => (1.0, 1.0),
        SpecularFunction::Refract(ior) if !(ior > 0.0 && ior.is_finite()) => {
            return Some("its ior is not a positive number".into());
        }
        SpecularFunction::Refract(ior) if wo.z > 0.0 => (1.0, ior),
        SpecularFunction::Refract(ior) => (ior, 1.0),
    };
    let tangential = wo.truncate().length() * mine / other;
    let is_total = tangential >= 1.0 && function != SpecularFunction::Reflect;
    let Some(wi) = expected else {
        return (!is_total).then(|| {
            format!(
                "it says no direction; there is one, at {tangential:.3} from the normal's axis: no total \
                 internal reflection"
            )
        });
    };
    if is_total {
        return Some(format!(
            "it says a direction; by Snell's law the sine would be {tangential:.3}: total internal reflection"
        ));
    }
    if !is_unit(wi) {
        return Some(format!(
            "its direction has the length {:.4}, not 1",
            wi.length()
        ));
    }
    let stays = wi.z * wo.z > 0.0;
    if stays != (function == SpecularFunction::Reflect) {
        return Some(match stays {
            true => "its direction stays on the side of wo".into(),
            false => "its direction leaves the side of wo".to_owned(),
        });
    }
    let kept = mine * wo.truncate() + other * wi.truncate();
    (kept.length() > 3.0 * BY_HAND * mine.max(other)).then(|| {
        format!(
            "its tangential part is {}, wrong by {:.3}: n · (x, y) is the same on both sides, and turned about",
            wi.truncate(),
            kept.length() / other
        )
    })
}

impl SpecularExample {
    pub(super) fn situations(&self) -> Vec<&'static str> {
        let Vec3 { x, y, z } = self.wo;
        let is_straight = x == 0.0 && y == 0.0;
        let ior = match self.function {
            SpecularFunction::Reflect => None,
            SpecularFunction::Refract(ior) => Some(ior),
        };
        let refracts = ior.is_some() && self.expected.is_some();
        let touched = [
            ior.is_none() && is_straight,
            ior.is_none() && !is_straight,
            ior.is_none() && z < 0.0,
            refracts && is_straight,
            refracts && !is_straight && z > 0.0,
            refracts && !is_straight && z < 0.0,
            ior.is_some() && self.expected.is_none(),
            ior.is_some_and(|ior| ior < 1.0),
            x.abs() != y.abs() && x * y != 0.0,
        ];
        let each = SITUATIONS.iter().zip(touched);
        each.filter(|(_, is)| *is).map(|(name, _)| *name).collect()
    }

    pub(super) fn work(&self) -> Work {
        let wo = self.wo.into();
        Work::Specular(vec![match self.function {
            SpecularFunction::Reflect => SpecularCall::Reflect { wo },
            SpecularFunction::Refract(ior) => SpecularCall::Refract { wo, ior },
        }])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(
        function: SpecularFunction,
        wo: [f64; 3],
        expected: Option<[f64; 3]>,
    ) -> SpecularExample {
        SpecularExample {
            function,
            wo: wo.into(),
            expected: expected.map(Into::into),
        }
    }

    #[test]
    fn mirrored_directions_keep_their_height() {
        let reflect =
            |expected| example(SpecularFunction::Reflect, [0.6, 0.0, 0.8], Some(expected));
        assert_eq!(verdict(&reflect([-0.6, 0.0, 0.8])), None);
        let through = verdict(&reflect([-0.6, 0.0, -0.8])).expect("it is wrong");
        assert_eq!(through, "its direction leaves the side of wo");
        assert!(verdict(&reflect([f64::NAN, 0.0, 0.8])).is_some());
        let back = verdict(&reflect([0.6, 0.0, 0.8])).expect("it is wrong");
        assert!(back.contains("wrong by 1.200"), "{back}");
    }

    #[test]
    fn refracted_directions_follow_snells_law() {
        let refract = |ior, wo, expected| example(SpecularFunction::Refract(ior), wo, expected);
        let down = [-0.3, 0.0, -0.954];
        assert_eq!(verdict(&refract(2.0, [0.6, 0.0, 0.8], Some(down))), None);
        let inverse = verdict(&refract(0.5, [0.6, 0.0, 0.8], Some(down))).expect("it is wrong");
        assert!(inverse.contains("the sine would be 1.200"), "{inverse}");
        assert_eq!(verdict(&refract(2.0, [0.6, 0.0, -0.8], None)), None);
        assert!(verdict(&refract(1.5, [0.0, 0.0, 1.0], None)).is_some());
        let straight = refract(2.0, [0.6, 0.0, 0.8], Some([-0.6, 0.0, -0.8]));
        assert!(verdict(&straight).is_some_and(|why| why.contains("wrong by 0.300")));
    }

    #[test]
    fn each_situation_is_touched_by_some_example() {
        let up = [0.0, 0.0, 1.0];
        let examples = [
            example(SpecularFunction::Reflect, up, Some(up)),
            example(SpecularFunction::Reflect, [0.6, 0.0, -0.8], None),
            example(SpecularFunction::Refract(2.0), up, Some([0.0, 0.0, -1.0])),
            example(SpecularFunction::Refract(0.5), [0.2, 0.1, 0.97], Some(up)),
            example(SpecularFunction::Refract(2.0), [0.2, 0.0, -0.98], Some(up)),
            example(SpecularFunction::Refract(2.0), [0.6, 0.0, -0.8], None),
        ];
        let touched: Vec<&str> = examples
            .iter()
            .flat_map(SpecularExample::situations)
            .collect();
        for situation in SITUATIONS {
            assert!(
                touched.contains(situation),
                "no {situation:?} in {touched:?}"
            );
        }
    }
}
