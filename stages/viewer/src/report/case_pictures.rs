//! The pictures of a case: the golden one, that of the stages now, and the causes of differences.

use crate::picture_pair::{CauseCount, PicturePair};
use judge::Tier;
use judge::cases::Spec;
use judge::pictures::NAME;
use judge::snapshot;
use judge::whole::judge_whole;
use pictures::cause::{self, Cause};
use pictures::difference::{Mark, compare};
use pictures::image::Rgb;
use pictures::{Image, png, tone};
use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};
use wire::Answer;

/// The folder of the goldens: of the project that the report is in, else of the current folder or of
/// this program.
pub fn golden_folder(report: &Path) -> Option<PathBuf> {
    let starts = [
        std::path::absolute(report).ok(),
        env::current_dir().ok(),
        env::current_exe().ok(),
    ];
    let is_project = |folder: &&Path| folder.join("stages/course.toml").is_file();
    let mut starts = starts.iter().flatten();
    let root = starts.find_map(|start| start.ancestors().find(is_project))?;
    Some(root.join("golden"))
}

/// The picture that the answers of the case `spec` are the pixels of, compared with its golden one;
/// `None` for other cases. The error is a sentence.
pub fn of_case(
    goldens: &Path,
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
) -> Option<Result<PicturePair, String>> {
    let actual = tone::of_answer(spec.picture?, &spec.work, answer)?;
    let path = goldens.join(spec.task).join(format!("{}.png", spec.name));
    let golden = match read(&path, actual.size()) {
        Ok(golden) => golden,
        Err(why) => return Some(Err(why)),
    };
    let causes = causes(spec, tier, answer, &golden, &actual)?;
    let counts = cause::counts(&causes).into_iter();
    let legend = counts.map(|(cause, pixels)| CauseCount {
        label: cause.label(),
        color: cause.colour(),
        pixels,
    });
    Some(Ok(PicturePair {
        about: vec!["a pixel for each call".to_owned()],
        difference: cause::difference(&actual, &causes),
        first: actual,
        second: golden,
        legend: legend.collect(),
    }))
}

/// Why each pixel differs, in the order of the calls: by what the exact oracle finds wrong, by hit and
/// miss, and by the colours. The goldens' rows are not needed, so it works with packed goldens, too.
fn causes(
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
    golden: &Image,
    actual: &Image,
) -> Option<Vec<Cause>> {
    let full = snapshot::full(&spec.work, answer)?;
    let whole = judge_whole(spec, tier, answer);
    let wrong: &BTreeMap<u32, Vec<_>> = whole.wrong_calls();
    let misses_are_black = tone::misses_are_black(&spec.work);
    let [w, h] = actual.size();
    let cause = |line: &snapshot::Line| {
        let (x, y) = (line.call % w, h - 1 - line.call / w);
        let colors: [Rgb; 2] = [golden.get(x, y), actual.get(x, y)];
        let golden_hits = misses_are_black.then_some(colors[0] != [0; 3]);
        let wrong = wrong.get(&line.call).map_or(&[][..], Vec::as_slice);
        Cause::without_row(golden_hits, line, wrong, colors[0] == colors[1])
    };
    Some(full.lines.iter().map(cause).collect())
}

/// The picture of `task`, rendered with the stages of this program, and compared with its golden one.
/// The error is a sentence.
pub fn of_task(goldens: &Path, task: &str) -> Result<PicturePair, String> {
    let picture = judge::pictures::of(task).ok_or_else(|| format!("{task} has no picture"))?;
    let path = goldens.join(task).join(format!("{NAME}.png"));
    let golden = read(&path, picture.size())?;
    let spec = picture.spec();
    let actual = match super::stage_answer::answer_of(&spec)?.answer {
        Answer::Picture(answer) => tone::compose(&picture, &answer),
        other => return Err(format!("the worker returned {}", other.kind())),
    };
    let compared = compare(&picture, &golden, &actual);
    let mut legend: BTreeMap<Mark, usize> = BTreeMap::new();
    for (mark, pixels) in compared.counts.iter().flatten() {
        *legend.entry(*mark).or_default() += pixels;
    }
    let panels = picture.panels.iter();
    Ok(PicturePair {
        about: panels.map(|panel| panel.about.to_owned()).collect(),
        first: actual,
        second: golden,
        difference: compared.difference,
        legend: CauseCount::of_marks(legend),
    })
}

/// Reads a golden picture of this size.
fn read(path: &Path, size: [u32; 2]) -> Result<Image, String> {
    let golden = png::read(path).map_err(|why| format!("cannot read {}: {why}", path.display()))?;
    let [w, h] = golden.size();
    if [w, h] == size {
        return Ok(golden);
    }
    Err(format!(
        "{} has {w} x {h} pixels, expected {} x {}: copy it again from the handout",
        path.display(),
        size[0],
        size[1]
    ))
}
