//! Runs Part 4: mirrors and glass, scripted paths, and roulette.

use crate::stages::Global;
use crate::{convert, light};
use harness::{attempt, each_call};
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, PrimId, Scattering, Spectrum, Surface,
    Triangle, Vec2, Vec3,
};
use std::cell::{Cell, RefCell};
use wire::global::{PathAnswer, RouletteWork, ScriptedPath, SpecularAnswer, SpecularCall, Step};
use wire::work::Xyz;

pub(crate) fn specular(stage: &Global, calls: &[SpecularCall]) -> Vec<SpecularAnswer> {
    each_call(calls, |_, call| specular_call(stage, call))
}

fn specular_call(stage: &Global, call: &SpecularCall) -> SpecularAnswer {
    let direction = |d: Option<Vec3>| SpecularAnswer::Direction(d.map(Into::into));
    let sample =
        |s: Option<BsdfSample>| SpecularAnswer::Sample(s.as_ref().map(convert::wire_sample));
    match *call {
        SpecularCall::Fresnel { cos_i, eta } => {
            let share = attempt("fresnel_dielectric", || {
                (stage.fresnel_dielectric)(cos_i, eta)
            });
            SpecularAnswer::Share(share.unwrap_or_default())
        }
        SpecularCall::Reflect { wo } => {
            direction(attempt("reflect", || (stage.reflect)(wo.into())))
        }
        SpecularCall::Refract { wo, ior } => {
            direction(attempt("refract", || (stage.refract)(wo.into(), ior)).flatten())
        }
        SpecularCall::Mirror { reflectance, wo } => {
            let drawn = attempt("mirror_sample", || {
                (stage.mirror_sample)(reflectance.into(), wo.into())
            });
            sample(drawn.flatten())
        }
        SpecularCall::Refraction {
            transmittance,
            ior,
            wo,
        } => {
            let drawn = attempt("refraction_sample", || {
                (stage.refraction_sample)(transmittance.into(), ior, wo.into())
            });
            sample(drawn.flatten())
        }
        SpecularCall::Glass {
            reflectance,
            transmittance,
            ior,
            wo,
            choice,
        } => {
            let drawn = attempt("glass_sample", || {
                (stage.glass_sample)(
                    reflectance.into(),
                    transmittance.into(),
                    ior,
                    wo.into(),
                    choice,
                )
            });
            sample(drawn.flatten())
        }
    }
}

pub(crate) fn paths(stage: &Global, paths: &[ScriptedPath]) -> Vec<PathAnswer> {
    each_call(paths, |i, path| run_path(stage, i as u32, path))
}

/// The scene of a path's surfaces: one triangle each, which is never intersected.
fn lit_scene(path: &ScriptedPath) -> LitScene {
    let objects: Vec<_> = path
        .steps
        .iter()
        .map(|step| (vec![facing(step)], light::material(&step.material)))
        .collect();
    let environment = path.surroundings().as_ref().map(light::environment);
    LitScene::new(light::scene(&objects), environment)
}

/// A triangle around the step's point, with its normal.
fn facing(step: &Step) -> Triangle {
    let frame = kit::Frame::around(step.n.into());
    let p = Vec3::from(step.p);
    let corner = |x: f64, y: f64| p + x * frame.s + y * frame.t;
    let points = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)];
    Triangle::smooth(points, [frame.n; 3])
}

fn run_path(stage: &Global, call: u32, path: &ScriptedPath) -> PathAnswer {
    let lit = lit_scene(path);
    let recorded = RefCell::new(PathAnswer::default());
    let script = PathScript {
        path,
        recorded: &recorded,
        at: Cell::new(0),
    };
    let mut sampler = PixelSampler::new(call, 0, path.seed);
    sampler.get_sample();
    let radiance = (stage.estimate_radiance)(
        &lit,
        &convert::ray(&path.ray),
        path.max_depth,
        &mut sampler,
        &script,
        &mut |ray| script.trace(ray),
        &mut |surface: &Surface, wo, _: &mut PixelSampler| {
            let calls_before = recorded.borrow().direct.len();
            harness::limit_calls("direct", calls_before, || script.asked_for());
            let prim = surface.prim.0;
            recorded.borrow_mut().direct.push((prim, wo.into()));
            script.step(prim as usize).direct.into()
        },
        &mut |throughput, bounces, u| {
            let calls = &mut recorded.borrow_mut().roulette_calls;
            harness::limit_calls("roulette", calls.len(), || script.asked_for());
            calls.push((throughput.to_array(), bounces, u));
            Some(throughput * script.step(script.at.get()).roulette?)
        },
    );
    let mut answer = recorded.take();
    answer.radiance = radiance.to_array();
    answer
}

/// The scripted surfaces of a path. Each traced ray moves to the next one.
struct PathScript<'a> {
    path: &'a ScriptedPath,
    recorded: &'a RefCell<PathAnswer>,
    /// The surface that was hit last.
    at: Cell<usize>,
}

impl PathScript<'_> {
    fn step(&self, i: usize) -> &Step {
        &self.path.steps[i.min(self.path.steps.len() - 1)]
    }

    /// What the student's code was asked for.
    fn asked_for(&self) -> String {
        format!("a path with max_depth {}", self.path.max_depth)
    }

    fn trace(&self, ray: &kit::Ray) -> Option<Hit> {
        let rays = &mut self.recorded.borrow_mut().rays;
        harness::limit_calls("trace", rays.len(), || self.asked_for());
        // Ray `i` hits surface `i`.
        let i = rays.len();
        rays.push(convert::wire_ray(ray));
        let step = self.path.steps.get(i)?;
        self.at.set(i);
        Some(Hit {
            t: 1.0,
            p: step.p.into(),
            n: step.n.into(),
            ng: step.n.into(),
            uv: Vec2::splat(0.25),
            prim: PrimId(i as u32),
        })
    }
}

impl Scattering for PathScript<'_> {
    fn f(&self, _: &Material, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, _: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        let i = self.at.get();
        let numbers: Xyz = [u.x, u.y, choice];
        let samples = &mut self.recorded.borrow_mut().samples;
        harness::limit_calls("sample", samples.len(), || self.asked_for());
        samples.push((i as u32, wo.into(), numbers));
        let sample = self.step(i).sample?;
        Some(BsdfSample {
            wi: sample.wi.into(),
            f: sample.f.into(),
            pdf: sample.pdf,
            delta: sample.delta,
        })
    }
}

pub(crate) fn roulette(stage: &Global, work: &RouletteWork) -> Vec<Option<Xyz>> {
    let calls = work
        .paths
        .iter()
        .flat_map(|path| work.numbers.iter().map(move |u| (path, u)));
    each_call(
        &calls.collect::<Vec<_>>(),
        |_, &(&(throughput, bounces), &u)| {
            (stage.play_roulette)(throughput.into(), bounces, u).map(Spectrum::to_array)
        },
    )
}
