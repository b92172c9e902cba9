//! What a case is about, in 3D.

use super::file::FailedCase;
use super::light_case::LightCase;
use super::pixel_case::PixelCase;
use super::plot_case::PlotCase;
use super::ray_case::RayCase;
use super::scatter_case::ScatterCase;
use super::tree_case::TreeCase;
use super::visit_case::VisitCase;
use crate::project::is_drawn;
use kit::{Aabb, Vec3};
use wire::work::ScriptedWorld;
use wire::{Answer, Work};

/// The view of a case, at the call with the worst answer.
#[derive(Clone, Debug)]
pub enum CaseView {
    /// A ray and what it is tested against.
    Ray(RayCase),
    /// A tree that was built.
    Tree(TreeCase),
    /// A ray through a given tree.
    Visits(VisitCase),
    /// An estimate of light, or a path.
    Light(LightCase),
    /// The samples of a pixel.
    Pixel(PixelCase),
    /// Directions at a surface, and its lobe.
    Scatter(ScatterCase),
    /// Numbers as a plot.
    Plot(PlotCase),
}

impl CaseView {
    /// The view of a case; `None` if there is nothing to see in 3D. `answer` is that of the stages, if
    /// they have one.
    pub fn of(case: &FailedCase, answer: Option<&Answer>) -> Option<CaseView> {
        let spec = case.spec.as_ref()?;
        let worst = case.worst_call();
        if let Some(ray) =
            worst.and_then(|(call, message)| RayCase::of(spec, case.tier, call as usize, message))
        {
            return Some(CaseView::Ray(ray));
        }
        // A case without a worst call, such as one that crashed, is shown at its first one.
        let call = worst.map_or(0, |(call, _)| call as usize);
        Some(match (&spec.work, answer) {
            (Work::Build(work), Some(Answer::Build(answer))) => {
                CaseView::Tree(TreeCase::of(work, answer))
            }
            (Work::Traverse(world), _) => CaseView::Visits(scripted(world, call)?),
            (Work::SceneHits(work), _) => CaseView::Visits(VisitCase::in_scene(
                &work.scene,
                &work.tree,
                work.rays.get(call)?,
                work.any_hit,
            )),
            (Work::Visits(work), _) => CaseView::Visits(VisitCase::in_scene(
                &work.scene,
                &work.tree,
                work.rays.get(call)?,
                false,
            )),
            (Work::Direct(work), Some(Answer::Direct(answers))) => CaseView::Light(
                LightCase::of_point(work, work.points.get(call)?, answers.get(call)?),
            ),
            (Work::Paths(paths), Some(Answer::Paths(answers))) => {
                CaseView::Light(LightCase::of_path(paths.get(call)?, answers.get(call)?))
            }
            (Work::Pixels(work), Some(Answer::Pixels(answers))) => {
                CaseView::Pixel(PixelCase::of_pixel(work, call, answers.get(call)?)?)
            }
            (Work::AdaptivePixels(work), Some(Answer::AdaptivePixels(answers))) => {
                CaseView::Pixel(PixelCase::of_adaptive(work.get(call)?, answers.get(call)?))
            }
            (Work::Lambert(work), Some(Answer::Lambert(answers))) => {
                CaseView::Scatter(ScatterCase::of_diffuse(work, answers, call)?)
            }
            (Work::Specular(calls), Some(answer @ Answer::Specular(answers))) => {
                match PlotCase::of_fresnel(calls, answers, call) {
                    Some(plot) => CaseView::Plot(plot),
                    None => {
                        let case = ScatterCase::of_specular(spec, case.tier, answer, call)?;
                        CaseView::Scatter(case)
                    }
                }
            }
            (Work::Roulette(work), Some(Answer::Roulette(answers))) => {
                CaseView::Plot(PlotCase::of_roulette(work, answers, call)?)
            }
            (
                Work::Stop(work) | Work::SureStop(work),
                Some(Answer::Stop(answers) | Answer::SureStop(answers)),
            ) => CaseView::Plot(PlotCase::of_stop(work.get(call)?, answers.get(call)?)?),
            _ => return None,
        })
    }

    /// From where it is seen best: a plot and a square from the front, all else from a corner.
    pub fn seen_from(&self) -> Vec3 {
        match self {
            CaseView::Plot(_) => Vec3::Z,
            CaseView::Pixel(case) if case.checks.is_empty() => Vec3::Z,
            _ => Vec3::new(0.5, 0.35, 1.0),
        }
    }

    /// A box around what differs from the truth, or else around what is drawn.
    pub fn focus(&self) -> Aabb {
        let all = self.bounds();
        match self {
            CaseView::Ray(case) => case.focus(),
            CaseView::Tree(case) => {
                let wrong = case.wrong.first();
                let node = wrong.and_then(|wrong| case.tree.nodes.get(wrong.node as usize));
                let needed = wrong.and_then(|wrong| case.exact.get(wrong.node as usize));
                let boxes = node
                    .map(|node| node.bounds)
                    .into_iter()
                    .chain(needed.copied());
                let place = boxes.filter(is_drawn).fold(Aabb::EMPTY, Aabb::union);
                if place.is_empty() { all } else { place }
            }
            CaseView::Visits(case) => {
                let hit = case.right.map(|(_, t)| case.record.ray.at(t));
                let place = case.place_of_difference().filter(is_drawn);
                match (place, hit) {
                    (Some(place), Some(hit)) => place.grown_by(hit),
                    (Some(place), None) => place,
                    (None, _) => all,
                }
            }
            CaseView::Light(_) | CaseView::Pixel(_) | CaseView::Scatter(_) | CaseView::Plot(_) => {
                all
            }
        }
    }

    /// A box around what is drawn.
    pub fn bounds(&self) -> Aabb {
        match self {
            CaseView::Ray(case) => case.shown.bounds(),
            CaseView::Tree(case) => {
                let boxes = case.primitives.iter().filter(|b| is_drawn(b));
                boxes.fold(Aabb::EMPTY, |all, b| all.union(*b))
            }
            CaseView::Visits(case) => {
                let boxes = case
                    .tree
                    .nodes
                    .iter()
                    .map(|node| node.bounds)
                    .filter(is_drawn);
                let all = boxes.fold(case.scene.bounds(), Aabb::union);
                all.grown_by(case.record.ray.o)
            }
            CaseView::Light(case) => case.bounds(),
            CaseView::Pixel(case) => case.bounds(),
            CaseView::Scatter(case) => case.bounds(),
            CaseView::Plot(case) => case.bounds(),
        }
    }
}

/// The ray with this number of a scripted world. Where the sentence is about all rays of the case,
/// such as the number of their tests, that one may be right: then it is the first one that is not.
fn scripted(world: &ScriptedWorld, call: usize) -> Option<VisitCase> {
    let named = VisitCase::in_script(world, world.rays.get(call)?);
    if named.first_difference().is_some() || named.parting.is_some() {
        return Some(named);
    }
    let mut others = world.rays.iter().take(MAX_RAYS);
    let differing = others.find_map(|ray| {
        let case = VisitCase::in_script(world, ray);
        case.first_difference().is_some().then_some(case)
    });
    Some(differing.unwrap_or(named))
}

/// The most rays of a case that are traced to find one that is wrong.
const MAX_RAYS: usize = 300;
