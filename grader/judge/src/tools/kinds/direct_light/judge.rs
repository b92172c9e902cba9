//! Judges estimates of direct light, by the rays that they trace and the sum that they compute.
//!
//! An estimate is judged by its own rays, whatever random numbers it used: given the rays, the
//! right sum is exact. The distribution of the rays and the mean of the estimates are tested
//! separately.

use super::lamps::{
    SKY_PDF, ShadingPlace, VisiblePart, environment_map, first_lamp, sample_of_delta_light,
};
use super::shadow_targets::{Source, Target, target};
use super::terms::{self, Term};
use crate::plural;
use crate::tools::aspects::chance::{self, MIN_ESTIMATES};
use crate::tools::aspects::hits::show;
use crate::tools::aspects::numbers;
use crate::tools::call_text::{material, point};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::{Tally, Vec3};
use std::collections::HashSet;
use std::f64::consts::TAU;
use wire::direct::{DirectAnswer, DirectWork, RecordedRay, ShadedPoint, Strategy};
use wire::light::{Light, Material, Panel};

/// Relative error allowed in a sum: thousands of roundings, or a π with ten digits.
const SUM_BOUND: f64 = 1e-9;

/// How far an origin may be off, in world units: the worlds are ten units large, and the error
/// bound of points is 2e-12.
const ORIGIN_BOUND: f64 = 2e-13;

/// How far a direction may be from that of a delta light.
pub(super) const DIRECTION_BOUND: f64 = 1e-6;

/// How far the length of a direction may be from 1: some roundings. A component that is raised to
/// 0.001 makes it 0.0000005 longer.
const LENGTH_BOUND: f64 = 1e-12;

/// The largest gap between the end of a shadow ray and its light, relative to the distance.
const LONGEST_GAP: f64 = 1e-6;

/// The aspects in which an estimate is judged.
const OF_AN_ESTIMATE: [Aspect; 7] = [
    Aspect::Radiance,
    Aspect::Mean,
    Aspect::Rays,
    Aspect::Origin,
    Aspect::Direction,
    Aspect::Range,
    Aspect::Spread,
];

/// Judges every estimate of `work`.
pub(crate) fn direct(findings: &mut Findings, work: &DirectWork, answers: &[DirectAnswer]) {
    let function = match work.strategy {
        Strategy::ZeroBounce => "zero_bounce_radiance",
        Strategy::Hemisphere => "estimate_direct_lighting_hemisphere",
        Strategy::Lights => "estimate_direct_lighting_importance",
    };
    if !findings.is_written(function, &OF_AN_ESTIMATE) {
        return;
    }
    findings.count_for(function);
    for (call, (point, answer)) in work.points.iter().zip(answers).enumerate() {
        let one = Estimate {
            work,
            point,
            place: ShadingPlace::of(point),
            answer,
            call,
        };
        match work.strategy {
            Strategy::ZeroBounce => one.zero_bounce(findings),
            Strategy::Hemisphere => one.hemisphere(findings),
            Strategy::Lights => one.lights(findings),
        }
    }
    if work.strategy != Strategy::ZeroBounce && answers.len() >= MIN_ESTIMATES {
        statistics(findings, work, answers);
    }
}

/// Why the number of shadow rays is not judged.
const RAYS_BY_CHANCE: &str = "random numbers decide how many samples of a light can contribute, so fewer rays are right, too";

/// Records what random numbers leave open: the directions of estimates that are too few to test,
/// and the number of shadow rays.
pub(crate) fn untested(findings: &mut Findings, work: &DirectWork, answers: &[DirectAnswer]) {
    for (call, (point, answer)) in work.points.iter().zip(answers).enumerate() {
        let one = Estimate {
            work,
            point,
            place: ShadingPlace::of(point),
            answer,
            call,
        };
        let (least, most) = match work.strategy {
            Strategy::ZeroBounce | Strategy::Hemisphere => (0, 0),
            Strategy::Lights => one.right_rays(&one.sources()),
        };
        if least < most {
            findings.not_judged(Aspect::Rays, call, RAYS_BY_CHANCE);
        }
        let is_random = |source: &Source| !matches!(source, Source::Point(_));
        let may_be_random = match work.strategy {
            Strategy::ZeroBounce => false,
            Strategy::Hemisphere => true,
            Strategy::Lights => one.sources().iter().any(is_random),
        };
        let are_few = answers.len() < MIN_ESTIMATES;
        if may_be_random && are_few && !answer.rays.is_empty() {
            findings.not_judged(Aspect::Direction, call, chance::TOO_FEW);
        }
    }
}

/// Tests the statistics of many estimates; all points of `work` are the same.
fn statistics(findings: &mut Findings, work: &DirectWork, answers: &[DirectAnswer]) {
    let place = ShadingPlace::of(&work.points[0]);
    if work.strategy == Strategy::Hemisphere {
        let rays = answers.iter().flat_map(|answer| &answer.rays);
        let directions: Vec<Option<Vec3>> = rays
            .map(|recorded| Some(place.frame.to_local(recorded.ray.d.into())))
            .collect();
        let side = place.wo.z.signum();
        let density = |w: Vec3| if w.z * side > 0.0 { 1.0 / TAU } else { 0.0 };
        chance::spread(
            findings,
            &directions,
            density,
            "uniformly over the hemisphere",
        );
        super::degrees::judge(findings, work, &directions);
        super::near_the_plane::judge(findings, &directions);
    }
    let green: Tally = answers.iter().map(|answer| answer.radiance[1]).collect();
    chance::mean(findings, "estimates", &green, place.lit_by(&work.world).y);
}

struct Estimate<'a> {
    work: &'a DirectWork,
    point: &'a ShadedPoint,
    place: ShadingPlace,
    answer: &'a DirectAnswer,
    call: usize,
}

impl Estimate<'_> {
    fn about(&self) -> String {
        let geometric = match self.point.ng == self.point.n {
            true => String::new(),
            false => format!(", the geometric normal {}", point(self.point.ng)),
        };
        format!(
            "Point {} with the normal {}{geometric}, {}, seen along wo = {}, {}",
            point(self.point.p),
            point(self.point.n),
            material(&self.point.material),
            point(self.point.wo),
            plural(self.work.samples, "sample", "samples")
        )
    }

    /// Judges the sum, which consists of `terms`. If a wrong sum is what one of `mistakes` gives
    /// for the same rays, the class of the sum is the name of that mistake.
    fn radiance(
        &self,
        findings: &mut Findings,
        right: Vec3,
        terms: &[Term],
        mistakes: &[(&'static str, Vec3)],
    ) {
        findings.expect(Aspect::Radiance);
        let answered = self.answer.radiance;
        let (aspect, call) = (Aspect::Radiance, self.call);
        let is = |sum: Vec3| numbers::same_colour(answered, sum.into(), SUM_BOUND);
        let named = mistakes.iter().find(|(_, sum)| !is(right) && is(*sum));
        if let Some((name, _)) = named {
            let class = Some(Class::Named(name));
            let off = (Vec3::from(answered) - right).length();
            findings.judge_class(aspect, call, class, off, || {
                let right = right.to_array();
                Message::new(format!("your result: {answered:?}; expected: {right:?}"))
                    .compares(answered, right)
                    .asked(format!("{}{}", terms::text(terms), self.about()))
            });
            return;
        }
        numbers::colour(
            findings,
            aspect,
            call,
            answered,
            right.into(),
            SUM_BOUND,
            || format!("{}{}", terms::text(terms), self.about()),
        );
    }

    fn zero_bounce(&self, findings: &mut Findings) {
        let emitted = self.point.material.emitted();
        let in_front = self.place.ng.dot(self.point.wo.into()) > 0.0;
        let right = emitted.filter(|_| in_front).map_or(Vec3::ZERO, Vec3::from);
        self.radiance(findings, right, &[], &[]);
    }

    fn hemisphere(&self, findings: &mut Findings) {
        let samples = self.work.samples;
        let (wanted, most) = match self.point.material {
            Material::Mirror(_) | Material::Glass(_) => (0, 0),
            // A lamp scatters nothing: rays from it are of no use, but no contract forbids them.
            Material::Emission(_) | Material::PartOfLamp(_) => (0, samples),
            Material::Diffuse(_) => (samples, samples),
        };
        self.count(findings, wanted, most);
        let mut sum = Vec3::ZERO;
        let mut terms = Vec::new();
        let mut mistakes = super::mistakes::HemisphereMistakes::default();
        let wrong_side = self.wrong_side();
        for recorded in &self.answer.rays {
            let d = Vec3::from(recorded.ray.d);
            self.start(findings, recorded);
            findings.expect(Aspect::Range);
            let whole = recorded.ray.min_t == 0.0 && recorded.ray.max_t == f64::INFINITY;
            findings.judge(Aspect::Range, self.call, whole, 1.0, || {
                let [from, to] = [recorded.ray.min_t, recorded.ray.max_t];
                Message::new(format!(
                    "your result: a ray with the range [{from:?}, {to:?}]; expected: [0, inf]"
                ))
                .compares([from, to], [0.0, f64::INFINITY])
                .asked(self.about())
            });
            findings.expect(Aspect::Direction);
            let side = self.place.frame.to_local(d).z * self.place.wo.z;
            let length = d.length();
            let class = if (length - 1.0).abs() > LENGTH_BOUND || length.is_nan() {
                Some(Class::WrongLength)
            } else {
                (side < 0.0).then_some(wrong_side)
            };
            findings.judge_class(Aspect::Direction, self.call, class, 1.0, || {
                let length = match class {
                    Some(Class::WrongLength) => format!(" of length {length}"),
                    _ => String::new(),
                };
                Message::new(format!(
                    "your result: a ray along d = {}{length}; expected: a unit vector on the side of wo",
                    show(d)
                ))
                .compares((class == Some(Class::WrongLength)).then_some(d.length()), [1.0])
                .asked(self.about())
            });
            let seen = Vec3::from(recorded.seen);
            sum += self.place.scattered(d) * seen;
            terms.push(Term::of(&self.place, d, seen, 1.0 / TAU, samples));
            let lamp = first_lamp(&self.work.world, recorded);
            mistakes.add(&self.place, recorded, lamp);
        }
        self.distinct(findings);
        if self.lacks_rays(findings, wanted) {
            return;
        }
        let share = TAU / f64::from(samples.max(1));
        self.radiance(findings, sum * share, &terms, &mistakes.sums(share));
    }

    /// Judges an estimate without rays as wrong if rays are necessary, at least `wanted` of them: a
    /// sum over no rays says nothing about the light. Returns whether it is wrong.
    fn lacks_rays(&self, findings: &mut Findings, wanted: u32) -> bool {
        let lacks = wanted > 0 && self.answer.rays.is_empty();
        if lacks {
            findings.expect(Aspect::Radiance);
            let class = Some(Class::Named("without rays"));
            findings.judge_class(Aspect::Radiance, self.call, class, 1.0, || {
                Message::new(format!(
                    "your result: {:?} without tracing a ray; expected: the sum over at least {wanted}",
                    self.answer.radiance
                ))
                .asked(self.about())
            });
        }
        lacks
    }

    /// The class of rays that go to the wrong side of the surface.
    fn wrong_side(&self) -> Class {
        let to_viewer = self.place.wo.z;
        let all = |z: &dyn Fn(Vec3) -> f64| {
            let mut rays = self.answer.rays.iter();
            rays.all(|recorded| z(recorded.ray.d.into()) * to_viewer > 0.0)
        };
        if all(&|d| -self.place.frame.to_local(d).z) {
            Class::Named("all on the other side")
        } else if all(&|d| d.z) {
            Class::Named("as if they were local")
        } else {
            Class::OtherSide
        }
    }

    fn lights(&self, findings: &mut Findings) {
        let sources = self.sources();
        let (least, most) = self.right_rays(&sources);
        self.count(findings, least, most);
        let (mut sum, mut with_distance_twice) = (Vec3::ZERO, Vec3::ZERO);
        let mut terms = Vec::new();
        let mut with_wrong_ends = Vec3::ZERO;
        let mut with_geometric_cosine = Vec3::ZERO;
        let mut first_wrong_end = None;
        for recorded in &self.answer.rays {
            let target = target(&sources, self.place.p, recorded);
            self.start(findings, recorded);
            self.shadow_ray(findings, recorded, &target);
            let (source, far) = match target {
                Target::Light { source, far } | Target::WrongEnd { source, far } => (source, far),
                Target::None => continue,
            };
            let mut term = self.term(&sources[source], far, recorded.ray.d.into());
            if recorded.hit {
                term.light = Vec3::ZERO;
            }
            let light = term.value();
            with_wrong_ends += light;
            if let Target::WrongEnd { .. } = target {
                first_wrong_end.get_or_insert((recorded, far));
                continue;
            }
            sum += light;
            terms.push(term);
            with_geometric_cosine += light * self.place.geometric_to_shading(recorded.ray.d.into());
            with_distance_twice += match far.is_finite() {
                true => light / (far * far),
                false => light,
            };
        }
        self.distinct(findings);
        if self.lacks_rays(findings, least) {
            return;
        }
        let is = |sum: Vec3| numbers::same_colour(self.answer.radiance, sum.into(), SUM_BOUND);
        if let Some((recorded, far)) = first_wrong_end
            && !is(sum)
            && is(with_wrong_ends)
        {
            return self.ends_are_wrong(findings, recorded, far);
        }
        let mistakes = [
            ("distance twice", with_distance_twice),
            ("the cosine to the geometric normal", with_geometric_cosine),
        ];
        self.radiance(findings, sum, &terms, &mistakes);
    }

    /// Judges a sum as wrong although it is right for what its rays returned: some shadow rays do
    /// not end at their light. `recorded` is the first of them, `far` the distance of its light.
    fn ends_are_wrong(&self, findings: &mut Findings, recorded: &RecordedRay, far: f64) {
        findings.expect(Aspect::Radiance);
        let class = Some(Class::Named("wrong ends"));
        findings.judge_class(Aspect::Radiance, self.call, class, 1.0, || {
            Message::new(format!(
                "your result: a shadow ray with max_t = {:?}; expected: it ends just before its light, at t = {far:?}. The sum {:?} is right for these rays",
                recorded.ray.max_t, self.answer.radiance
            ))
            .compares_beside(recorded.ray.max_t, far)
            .asked(self.about())
        });
    }

    /// The lights whose light can arrive at the point.
    fn sources(&self) -> Vec<Source> {
        let world = &self.work.world;
        let lights = world.lights.iter().filter_map(|light| {
            match (sample_of_delta_light(light, self.place.p), light) {
                (Some(sample), _) => sample.map(Source::Point),
                (None, Light::Sky(radiance)) => Some(Source::Sky((*radiance).into())),
                (None, _) => None,
            }
        });
        let panels = world.panels.iter().filter_map(|panel| {
            let radiance = panel.material.emitted()?;
            let is_seen = self.place.visible_part(panel) != VisiblePart::None;
            is_seen.then(|| Source::Lamp(*panel, radiance.into()))
        });
        let around = environment_map(world).map(Source::Map);
        lights.chain(around).chain(panels).collect()
    }

    /// The smallest and the largest number of shadow rays that all lights together may get.
    fn right_rays(&self, sources: &[Source]) -> (u32, u32) {
        if let Material::Mirror(_) | Material::Glass(_) = self.point.material {
            return (0, 0);
        }
        let add = |(least, most), source: &Source| {
            let (few, many) = self.rays_to(source);
            (least + few, most + many)
        };
        let (parts, whole): (Vec<&Source>, _) = sources.iter().partition(|source| source.is_part());
        let of_parts = if parts.is_empty() {
            0
        } else {
            self.work.samples
        };
        whole.into_iter().fold((0, of_parts), add)
    }

    /// The area from which the samples of a lamp are taken.
    fn sampled_area(&self, panel: &Panel) -> f64 {
        if !panel.is_part() {
            return panel.area();
        }
        let panels = self.work.world.panels.iter();
        panels
            .filter(|other| other.is_part())
            .map(Panel::area)
            .sum()
    }

    /// The smallest and the largest number of shadow rays that one light may get.
    fn rays_to(&self, source: &Source) -> (u32, u32) {
        let samples = self.work.samples;
        match source {
            Source::Point(light) => {
                let one = u32::from(self.place.scattered(light.wi) != Vec3::ZERO);
                (one, one)
            }
            Source::Lamp(panel, _) if self.place.visible_part(panel) == VisiblePart::All => {
                (samples, samples)
            }
            Source::Lamp(..) | Source::Sky(_) | Source::Map(_) => (0, samples),
        }
    }

    /// What an unblocked ray along `d` to a light at the distance `far` adds to the sum.
    fn term(&self, source: &Source, far: f64, d: Vec3) -> Term {
        let samples = self.work.samples;
        let (light, pdf, samples) = match source {
            Source::Point(light) => (Vec3::from(light.radiance.to_array()), 1.0, 1),
            Source::Sky(radiance) => (*radiance, SKY_PDF, samples),
            Source::Map(picture) => {
                let radiance = Vec3::from(picture.radiance(d).to_array());
                (radiance, picture.pdf(d), samples)
            }
            Source::Lamp(panel, radiance) => {
                let facing = (-d.dot(panel.front().into())).max(0.0);
                let pdf = far * far / (facing * self.sampled_area(panel));
                (*radiance, pdf, samples)
            }
        };
        Term::of(&self.place, d, light, pdf, samples)
    }

    /// Judges a shadow ray: it goes to a light that can contribute, and ends just before the light.
    fn shadow_ray(&self, findings: &mut Findings, recorded: &RecordedRay, target: &Target) {
        findings.expect(Aspect::Direction);
        findings.expect(Aspect::Range);
        let goes_to_light = !matches!(target, Target::None);
        findings.judge(Aspect::Direction, self.call, goes_to_light, 1.0, || {
            Message::new(format!(
                "your result: a shadow ray with d = {:?}; expected: it goes to a light that contributes here",
                recorded.ray.d
            ))
            .asked(self.about())
        });
        let is_useless = self.place.scattered(recorded.ray.d.into()) == Vec3::ZERO;
        findings.judge(Aspect::Rays, self.call, !is_useless, 1.0, || {
            Message::new(format!(
                "your result: a shadow ray along d = {:?}; expected: none",
                recorded.ray.d
            ))
            .because(", since no light from there is scattered to wo".into())
            .asked(self.about())
        });
        let (Target::Light { far, .. } | Target::WrongEnd { far, .. }) = *target else {
            return;
        };
        let gap = (far - recorded.ray.max_t) / far;
        let ends_right =
            far == f64::INFINITY && recorded.ray.max_t == far || gap > 0.0 && gap <= LONGEST_GAP;
        let right = recorded.ray.min_t == 0.0 && ends_right;
        findings.judge(Aspect::Range, self.call, right, 1.0, || {
            let [from, to] = [recorded.ray.min_t, recorded.ray.max_t];
            Message::new(format!(
                "your result: a shadow ray with the range [{from:?}, {to:?}]; expected: from 0 to just before the light at t = {far:?}"
            ))
            .compares([from, to], [0.0, far])
            .asked(self.about())
        });
    }

    fn count(&self, findings: &mut Findings, least: u32, most: u32) {
        findings.expect(Aspect::Rays);
        let traced = self.answer.rays.len();
        let right = (least as usize..=most as usize).contains(&traced);
        let (wanted, size) = (f64::from(least), traced as f64 - f64::from(most));
        let class_of = match self.work.strategy {
            Strategy::Hemisphere => Class::of_signed_number,
            Strategy::ZeroBounce | Strategy::Lights => Class::of_number,
        };
        let class = (!right).then(|| class_of(traced as f64, wanted));
        findings.judge_class(Aspect::Rays, self.call, class, size.abs(), || {
            let right = if least == most {
                format!("{least}")
            } else {
                format!("{least} to {most}")
            };
            let traced = plural(traced, "ray", "rays");
            Message::new(format!("your result: {traced}; expected: {right}")).asked(self.about())
        });
    }

    /// Judges the origin of a ray: the point, offset by its error bound.
    fn start(&self, findings: &mut Findings, recorded: &RecordedRay) {
        findings.expect(Aspect::Origin);
        let right = self.place.start(recorded.ray.d.into());
        let o = Vec3::from(recorded.ray.o);
        let (off, from_surface) = ((o - right).length(), (o - self.place.p).length());
        let is_off = off.is_nan() || off > ORIGIN_BOUND;
        let class = is_off.then(|| Class::of_offset(off, from_surface));
        findings.judge_class(Aspect::Origin, self.call, class, off, || {
            Message::new(format!(
                "your result: a ray with the origin {}; expected: {}, from Surface::leave",
                show(recorded.ray.o.into()),
                show(right)
            ))
            .compares(recorded.ray.o, right.to_array())
            .asked(self.about())
        });
    }

    /// Judges that no two samples use the same random numbers: no two rays have one direction.
    fn distinct(&self, findings: &mut Findings) {
        let is_directional = |light: &Light| matches!(light, Light::Directional { .. });
        let may_repeat = self
            .work
            .world
            .lights
            .iter()
            .filter(|l| is_directional(l))
            .count()
            > 1;
        if self.answer.rays.len() < 2 || may_repeat {
            return;
        }
        findings.expect(Aspect::Spread);
        let bits = |recorded: &RecordedRay| recorded.ray.d.map(f64::to_bits);
        let different: HashSet<_> = self.answer.rays.iter().map(bits).collect();
        let (all, different) = (self.answer.rays.len(), different.len());
        let right = all == different;
        findings.judge(Aspect::Spread, self.call, right, 1e3, || {
            Message::new(format!(
                "the {all} rays have only {}: each sample needs its own random numbers",
                plural(different, "direction", "directions")
            ))
            .asked(self.about())
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use wire::Work;

    /// Code that traces so many rays along one direction, whatever it is asked.
    fn messages(rays: usize) -> Vec<String> {
        let specs = cases::of("part3.task2", 0);
        let works = specs.iter().filter_map(|spec| match &spec.work {
            Work::Direct(work) => Some(work),
            _ => None,
        });
        let of = |work: &DirectWork| {
            let answer = |point: &ShadedPoint| {
                let ray = wire::work::Ray {
                    o: point.p,
                    d: point.n,
                    min_t: 0.0,
                    max_t: f64::INFINITY,
                };
                let (seen, hit) = ([0.0; 3], false);
                DirectAnswer {
                    radiance: seen,
                    rays: vec![RecordedRay { ray, seen, hit }; rays],
                }
            };
            let answers: Vec<DirectAnswer> = work.points.iter().map(answer).collect();
            let mut findings = Findings::default();
            direct(&mut findings, work, &answers);
            findings.into_vec()
        };
        let worst = works.flat_map(of).filter_map(|finding| finding.worst);
        worst.map(|worst| worst.message.to_string()).collect()
    }

    #[test]
    fn one_ray_is_told_in_the_singular() {
        let [one, two] = [1, 2].map(|rays| messages(rays).join("\n"));
        assert!(one.contains("your result: 1 ray; expected: "), "{one}");
        assert!(two.contains("the 2 rays have only 1 direction: "), "{two}");
        // A direction of the right length is wrong elsewhere: its length is not compared.
        assert!(
            !one.contains("Diffuse(") && !one.contains("Point ["),
            "{one}"
        );
        for text in [&one, &two] {
            let plurals = ["1 rays", "1 directions", "1 samples"];
            let wrong = plurals
                .iter()
                .find(|word| text.contains(&format!(" {word}")));
            assert_eq!(wrong, None, "{text}");
        }
    }
}
