//! Tests the page that `grader review` writes: its data, and in a browser a click on a pixel.

mod browser;
mod data;
mod webdriver;

use base::Workspace;
use judge::Tier;
use judge::cases::{self, Spec};
use judge::snapshot::{self, Fields, Snapshot, parse};
use look::case::Case;
use pages::picture;
use review::Review;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;
use wire::answer::{Hit, HitsAnswer, TriangleAnswer};
use wire::work::Ray;
use wire::{Answer, Work};

/// The pixels that [`Golden::changed_boxes`] changes: one beside the box, and two neighbours inside
/// it. Only the first has a row in the golden.
const FALSE_HIT: [u32; 2] = [0, 0];
const FALSE_MISS: [u32; 2] = [32, 24];
const LATER_EXIT: [u32; 2] = [33, 24];

/// A case whose golden is what the exact oracle answers, in a workspace of its own.
struct Golden {
    spec: Spec,
    answer: Answer,
    folder: TempDir,
}

static BOXES: LazyLock<Golden> = LazyLock::new(|| Golden::of("part2.task2", "picture"));
static FACES: LazyLock<Golden> = LazyLock::new(|| Golden::of("part1.task3", "front_face"));
static MESH: LazyLock<Golden> = LazyLock::new(|| Golden::of("part2.task3", "mesh_in_cornell_box"));

impl Golden {
    fn of(task: &str, name: &str) -> Golden {
        let found = cases::all(0).into_iter().find(|spec| spec.is(task, name));
        let spec = found.expect("the case exists");
        let calls: Vec<u32> = (0..judge::calls(&spec.work) as u32).collect();
        let records = spec.exact(&calls).expect("the oracle knows the case");
        let answer = answer(&spec.work, &records);

        let folder = tempfile::tempdir().expect("a folder");
        let write = |path: &Path, text: &str| {
            std::fs::create_dir_all(path.parent().expect("it has a folder")).expect("a folder");
            std::fs::write(path, text).expect("the file is written");
        };
        write(&folder.path().join("stages/course.toml"), "");
        let golden = Golden {
            answer,
            folder,
            spec,
        };
        let text = snapshot::write(&golden.spec.work, &golden.answer).expect("it has rows");
        write(&golden.workspace().snapshot(task, name), &text);
        if let Some(size) = golden.spec.picture {
            let picture = picture::compose(size, &golden.spec.work, &golden.answer)
                .expect("its answers have colours");
            let path = golden.workspace().golden_picture(task, name);
            picture::write_png(&path, &picture).expect("the file is written");
        }
        golden
    }

    fn workspace(&self) -> Workspace {
        Workspace::above(self.folder.path()).expect("it has a course.toml")
    }

    fn snapshot(&self) -> Snapshot {
        let path = self.workspace().snapshot(self.spec.task, self.spec.name);
        let text = std::fs::read_to_string(path).expect("the golden exists");
        parse(&text).expect("it is a snapshot")
    }

    fn review(&self, answer: &Answer) -> Review {
        let no_worker = Err("no worker is built for this test".into());
        let case = Case::of(
            &self.workspace(),
            &self.spec,
            Tier::Robust,
            answer,
            &no_worker,
        );
        Review {
            cases: vec![case.expect("the case can be compared")],
            ..Review::default()
        }
    }

    /// The number of the call for a pixel.
    fn call(&self, [x, y]: [u32; 2]) -> usize {
        let [w, _] = self.spec.picture.expect("the case has a picture");
        (y * w + x) as usize
    }

    /// The golden's answers about boxes, changed by `change`.
    fn boxes(&self, change: impl Fn(&mut [Option<[f64; 2]>])) -> Answer {
        let Answer::Boxes(mut answers) = self.answer.clone() else {
            panic!("{} is not about boxes", self.spec.name)
        };
        change(&mut answers);
        Answer::Boxes(answers)
    }

    /// The golden's answers about triangles, changed by `change`.
    fn triangles(&self, change: impl Fn(&mut [TriangleAnswer])) -> Answer {
        let Answer::Triangles(mut answers) = self.answer.clone() else {
            panic!("{} is not about triangles", self.spec.name)
        };
        change(&mut answers);
        Answer::Triangles(answers)
    }

    /// The golden's answers about hits, changed by `change`.
    fn hits(&self, change: impl Fn(&mut [Option<Hit>])) -> Answer {
        let Answer::SceneHits(mut answer) = self.answer.clone() else {
            panic!("{} is not about hits", self.spec.name)
        };
        change(&mut answer.hits);
        Answer::SceneHits(answer)
    }

    /// The golden's answers about boxes but for three pixels.
    fn changed_boxes(&self) -> Answer {
        self.boxes(|answers| {
            answers[self.call(FALSE_HIT)] = Some([1.0, 2.0]);
            answers[self.call(FALSE_MISS)] = None;
            let [enters, leaves] =
                answers[self.call(LATER_EXIT)].expect("this pixel is inside the box");
            answers[self.call(LATER_EXIT)] = Some([enters, leaves + 1.0]);
        })
    }
}

/// The answer that has these records.
fn answer(work: &Work, records: &[Fields]) -> Answer {
    let numbers = |fields: &Fields, name: &str| -> Option<Vec<f64>> {
        let field = fields.iter().find(|(field, _)| field == name);
        field.map(|(_, value)| value.numbers())
    };
    let vector = |fields: &Fields, name: &str| -> [f64; 3] {
        let numbers = numbers(fields, name).unwrap_or(vec![0.0; 3]);
        numbers.try_into().expect("three numbers")
    };
    let hit = |fields: &Fields| {
        Some(Hit {
            t: numbers(fields, "t")?[0],
            p: vector(fields, "p"),
            n: vector(fields, "n"),
            ng: vector(fields, "ng"),
            uv: numbers(fields, "uv").map_or([0.0; 2], |uv| [uv[0], uv[1]]),
            prim: numbers(fields, "prim").map_or(0, |prim| prim[0] as u32),
        })
    };
    match work {
        Work::Boxes(_) => {
            let inside = |fields| numbers(fields, "inside").map(|ends| [ends[0], ends[1]]);
            Answer::Boxes(records.iter().map(inside).collect())
        }
        Work::Triangles(work) => {
            let answers = work.probes.iter().zip(records).map(|(probe, fields)| {
                let hit = hit(fields);
                TriangleAnswer {
                    test: hit.map(|hit| [hit.t, hit.uv[0], hit.uv[1]]),
                    hit,
                    ray_after: Ray {
                        max_t: hit.map_or(probe.ray.max_t, |hit| hit.t),
                        ..probe.ray
                    },
                }
            });
            Answer::Triangles(answers.collect())
        }
        _ => {
            let hits: Vec<Option<Hit>> = records.iter().map(hit).collect();
            let max_t = hits
                .iter()
                .map(|hit| hit.map_or(f64::INFINITY, |hit| hit.t));
            Answer::SceneHits(HitsAnswer {
                max_t: max_t.collect(),
                hits,
                box_tests: 0,
                prim_tests: 0,
            })
        }
    }
}
