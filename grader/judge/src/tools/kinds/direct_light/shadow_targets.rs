//! Which light a shadow ray goes to.

use super::judge::DIRECTION_BOUND;
use kit::{Environment, LightSample, Vec3};
use wire::direct::RecordedRay;
use wire::light::Panel;

/// A shadow ray belongs to a light if its range ends this close to it, relative to the distance.
const TARGET_BOUND: f64 = 1e-2;

/// A light whose light can arrive at the point.
pub(super) enum Source {
    /// A light without extent, with its sample.
    Point(LightSample),
    /// A panel and its radiance.
    Lamp(Panel, Vec3),
    /// A sky and its radiance.
    Sky(Vec3),
    /// An environment map.
    Map(Environment),
}

impl Source {
    /// Whether it is part of a lamp of several panels, of which a world has at most one.
    pub(super) fn is_part(&self) -> bool {
        matches!(self, Source::Lamp(panel, _) if panel.is_part())
    }
}

/// What a shadow ray goes to. `source` is the place of the light among those given, `far` its
/// distance.
pub(super) enum Target {
    /// A light at which, or close to which, its range ends.
    Light { source: usize, far: f64 },
    /// A light along it, but its range ends elsewhere.
    WrongEnd { source: usize, far: f64 },
    /// No light.
    None,
}

/// The light to which a shadow ray from `p` goes: of the lights along the ray, the one closest to
/// the end of its range; of several that are equally far from it, the nearest.
pub(super) fn target(sources: &[Source], p: Vec3, recorded: &RecordedRay) -> Target {
    let (d, max_t) = (Vec3::from(recorded.ray.d), recorded.ray.max_t);
    let along = |source: &Source| match source {
        Source::Point(light) => {
            ((d - light.wi).length() < DIRECTION_BOUND).then_some(light.distance)
        }
        Source::Lamp(panel, _) => Some(panel.meets(p.into(), recorded.ray.d)?.0),
        Source::Sky(_) => (d.y >= 0.0).then_some(f64::INFINITY),
        Source::Map(picture) => (picture.pdf(d) > 0.0).then_some(f64::INFINITY),
    };
    let off = |far: f64| {
        if far == max_t {
            0.0
        } else if far.is_finite() {
            ((far - max_t) / far).abs()
        } else {
            f64::INFINITY
        }
    };
    let ways = sources
        .iter()
        .enumerate()
        .filter_map(|(i, source)| Some((i, along(source)?)));
    let nearest = ways.filter(|(_, far)| *far > 0.0).min_by(|a, b| {
        let by_end = off(a.1).total_cmp(&off(b.1));
        by_end.then(a.1.total_cmp(&b.1))
    });
    match nearest {
        Some((source, far)) if off(far) <= TARGET_BOUND => Target::Light { source, far },
        Some((source, far)) => Target::WrongEnd { source, far },
        None => Target::None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::judge::direct;
    use super::super::lamps::{ShadingPlace, sample_of_delta_light};
    use super::super::worlds::{floor, of_panels};
    use crate::tools::findings::{Aspect, Finding, Findings};
    use kit::Vec3;
    use wire::direct::{DirectAnswer, DirectWork, RecordedRay, Strategy};
    use wire::light::{Light, LitWorld};
    use wire::work::Ray;

    /// The findings about the right sum over one shadow ray to a point light, which ends at `end`
    /// times the distance of the light.
    fn findings(end: f64) -> Vec<Finding> {
        let light = Light::Point {
            position: [0.5, 2.0, -1.0],
            intensity: [6.0, 3.0, 1.0],
        };
        let place = ShadingPlace::of(&floor());
        let sample = sample_of_delta_light(&light, place.p)
            .flatten()
            .expect("it shines on the floor");
        let arriving = place.scattered(sample.wi) * Vec3::from(sample.radiance.to_array());
        let ray = RecordedRay {
            ray: Ray {
                o: place.start(sample.wi).into(),
                d: sample.wi.into(),
                min_t: 0.0,
                max_t: sample.distance * end,
            },
            seen: [0.0; 3],
            hit: false,
        };
        let work = DirectWork {
            world: LitWorld {
                lights: vec![light],
                ..of_panels(Vec::new())
            },
            strategy: Strategy::Lights,
            points: vec![floor()],
            samples: 1,
            seed: 0,
        };
        let answer = DirectAnswer {
            radiance: arriving.into(),
            rays: vec![ray],
        };
        let mut findings = Findings::default().with_messages();
        direct(&mut findings, &work, &[answer]);
        findings.into_vec()
    }

    fn wrong(findings: &[Finding]) -> Vec<Aspect> {
        let wrong = findings.iter().filter(|finding| finding.wrong > 0);
        wrong.map(|finding| finding.aspect).collect()
    }

    #[test]
    fn a_shadow_ray_with_a_wrong_end_is_called_that() {
        assert_eq!(wrong(&findings(1.0 - 1e-9)), []);
        for end in [f64::INFINITY, 1.5, 0.5] {
            let findings = findings(end);
            assert_eq!(wrong(&findings), [Aspect::Range, Aspect::Radiance], "{end}");
            for finding in findings.iter().filter(|finding| finding.wrong > 0) {
                let worst = finding.worst.as_ref().expect("it has a message");
                let message = worst.message.to_string();
                assert!(message.contains("just before"), "{message}");
            }
        }
    }
}
