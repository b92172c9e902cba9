//! What a case is about, in 3D.

use super::file::FailedCase;
use super::light_case::LightCase;
use super::ray_case::RayCase;
use super::tree_case::TreeCase;
use super::visit_case::VisitCase;
use kit::Aabb;
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
            (Work::Traverse(world), _) => {
                CaseView::Visits(VisitCase::in_script(world, world.rays.get(call)?))
            }
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
            _ => return None,
        })
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
                let boxes = case.tree.nodes.iter().map(|node| node.bounds);
                let boxes = boxes.filter(is_drawn);
                let all = boxes.fold(case.scene.bounds(), Aabb::union);
                all.grown_by(case.record.ray.o)
            }
            CaseView::Light(case) => case.bounds(),
        }
    }
}

/// Whether a box can be drawn.
pub fn is_drawn(b: &Aabb) -> bool {
    !b.is_empty() && b.min.is_finite() && b.max.is_finite()
}
