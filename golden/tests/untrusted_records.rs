//! What the grader reads was written by a process in which the student's code ran: here records of
//! every kind of work are damaged in every way. No damaged record may end the grader or score.

use crate::shared::{AfterTheGoldens, SPECS, record};
use grader::workers::records;
use grader::workers::runner::Ending;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::Finding;
use std::collections::BTreeMap;
use std::io::Cursor;
use wire::answer::{HitsAnswer, VisitsAnswer};
use wire::file::{FrameReader, Key, MAX_FRAME_BYTES, body_of, with_header};
use wire::picture::PictureAnswer;
use wire::work::{Ray, SceneSource, Shapes, TestTiming, TimingWork, VisitsWork};
use wire::{Answer, Case, Outcome, Record, RecordFrame, Work};

/// Random numbers (Marsaglia's xorshift64), the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// Below `end`, which is not 0.
    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }
}

/// A case, whose answers are judged if it is one of the grader's, and what the reference answers.
#[derive(Clone)]
struct Answered {
    case: Case,
    spec: Option<&'static Spec>,
    answer: Answer,
}

/// Every case; in a handout without those whose tasks are carved.
fn answered() -> Vec<Answered> {
    let of_tasks = SPECS
        .iter()
        .map(|spec| (spec.case(), Some(spec), record(spec).clone()));
    let measured = measurements().into_iter().map(|case| {
        let record = worker::run(0, &case);
        (case, None, record)
    });
    let all = of_tasks.chain(measured);
    all.filter_map(|(case, spec, record)| match record.outcome {
        Outcome::Answered(answer) => Some(Answered { case, spec, answer }),
        Outcome::NotAttempted { .. } => None,
        outcome => panic!("{} {}: {outcome:?}", case.task, case.name),
    })
    .collect()
}

/// A case of each kind of work that is not judged.
fn measurements() -> Vec<Case> {
    let scene = SPECS.iter().find_map(|spec| match &spec.work {
        Work::SceneHits(work) => Some(work),
        _ => None,
    });
    let scene = scene.expect("a case is about a whole scene");
    let rays: Vec<Ray> = scene.rays[..20].to_vec();
    let timing = Work::Timing(TimingWork {
        scene: SceneSource::Generated("smooth".into(), 100),
        max_leaf_size: 4,
        rays: rays.clone(),
        brute_force_rays: 2,
        rounds: 3,
    });
    let test = Work::TimeTest(TestTiming {
        shapes: Shapes::Boxes(vec![[[0.0; 3], [1.0; 3]]; 20]),
        rays: rays.clone(),
        per_ray: 1,
        orders: vec![(0..20).collect(); 3],
    });
    let visits = Work::Visits(VisitsWork {
        scene: scene.scene.clone(),
        tree: scene.tree.clone(),
        rays,
    });
    let mut picture = judge::pictures::of("part3.task1").expect("the task has a picture");
    picture.work.size = [8, 6];
    let case = |work: Work| Case {
        task: "part2.task3".into(),
        name: "measurement".into(),
        limit_ms: 5000,
        work,
        order: Vec::new(),
    };
    [timing, test, visits, Work::Picture(picture.work)]
        .map(case)
        .to_vec()
}

/// How many entries an answer has, counted without the grader's help: where there are several
/// lists, of each.
fn entries(answer: &Answer) -> Vec<usize> {
    match answer {
        Answer::Pixels(answers) => {
            let of = |a: &wire::answer::PixelAnswer| a.traced.len() == a.traced_radiance.len();
            vec![answers.len(), usize::from(answers.iter().all(of))]
        }
        Answer::CameraRays(answers) => vec![answers.len()],
        Answer::Triangles(answers) => vec![answers.len()],
        Answer::Spheres(answers) => vec![answers.len()],
        Answer::BruteForce(answer) | Answer::SceneHits(answer) => {
            vec![answer.hits.len(), answer.max_t.len()]
        }
        Answer::Boxes(answers) => vec![answers.len()],
        // Any number of nodes may be a tree: that is judged.
        Answer::Build(_) => vec![],
        Answer::BuildGrowth(answer) => {
            let each = answer.rounds.iter().map(Vec::len);
            std::iter::once(answer.nodes.len()).chain(each).collect()
        }
        Answer::Traverse(answers) => vec![answers.len()],
        Answer::Timing(answer) => [&answer.build_s, &answer.tree_s, &answer.brute_s]
            .map(|s| s.len())
            .to_vec(),
        Answer::TimeTest(seconds) => vec![seconds.len()],
        Answer::Visits(answer) => vec![answer.rays.len()],
        Answer::Lambert(answers) => vec![answers.len()],
        Answer::Direct(answers) => vec![answers.len()],
        Answer::Specular(answers) => vec![answers.len()],
        Answer::Paths(answers) => vec![answers.len()],
        Answer::Roulette(answers) => vec![answers.len()],
        Answer::Stop(answers) | Answer::SureStop(answers) => vec![answers.len()],
        Answer::AdaptivePixels(answers) => vec![answers.len()],
        Answer::Picture(answer) => answer.panels.iter().map(Vec::len).collect(),
    }
}

/// What is done to a list of answers.
#[derive(Clone, Copy, Debug)]
enum Change {
    DropLast,
    DropFirst,
    DuplicateLast,
    Empty,
}

impl Change {
    /// The list after the change.
    fn of<T: Clone>(self, list: &[T]) -> Vec<T> {
        match (self, list) {
            (Change::DropLast, [rest @ .., _]) | (Change::DropFirst, [_, rest @ ..]) => {
                rest.to_vec()
            }
            (Change::DuplicateLast, [.., last]) => [list, std::slice::from_ref(last)].concat(),
            (Change::Empty, _) | (_, []) => Vec::new(),
        }
    }

    /// The hits with either of their lists changed.
    fn of_hits(self, hits: &HitsAnswer) -> [HitsAnswer; 2] {
        let (mut fewer_hits, mut fewer_ends) = (hits.clone(), hits.clone());
        fewer_hits.hits = self.of(&hits.hits);
        fewer_ends.max_t = self.of(&hits.max_t);
        [fewer_hits, fewer_ends]
    }

    /// The answers with one of its lists changed.
    fn of_answer(self, answer: &Answer) -> Vec<Answer> {
        macro_rules! with_lists {
            ($($kind:ident)*) => {
                match answer {
                    $(Answer::$kind(list) => vec![Answer::$kind(self.of(list))],)*
                    Answer::BruteForce(hits) => self.of_hits(hits).map(Answer::BruteForce).to_vec(),
                    Answer::SceneHits(hits) => self.of_hits(hits).map(Answer::SceneHits).to_vec(),
                    Answer::Build(build) => {
                        let (mut nodes, mut order) = (build.clone(), build.clone());
                        nodes.tree.nodes = self.of(&build.tree.nodes);
                        order.tree.order = self.of(&build.tree.order);
                        match self {
                            // Once more at the end, a node is one that nothing leads to.
                            Change::DuplicateLast => vec![Answer::Build(order)],
                            _ => vec![Answer::Build(nodes), Answer::Build(order)],
                        }
                    }
                    Answer::BuildGrowth(growth) => {
                        let mut growth = growth.clone();
                        growth.rounds[0] = self.of(&growth.rounds[0]);
                        vec![Answer::BuildGrowth(growth)]
                    }
                    Answer::Timing(times) => {
                        let mut times = times.clone();
                        times.tree_s = self.of(&times.tree_s);
                        vec![Answer::Timing(times)]
                    }
                    Answer::Picture(picture) => {
                        let mut pixels = picture.clone();
                        pixels.panels[0] = self.of(&picture.panels[0]);
                        let panels = self.of(&picture.panels);
                        vec![
                            Answer::Picture(pixels),
                            Answer::Picture(PictureAnswer { panels }),
                        ]
                    }
                    Answer::Visits(visits) => {
                        let rays = self.of(&visits.rays);
                        vec![Answer::Visits(VisitsAnswer { rays })]
                    }
                }
            };
        }
        let mut changed = with_lists!(Pixels CameraRays Triangles Spheres Boxes Traverse TimeTest
            Lambert Direct Specular Paths Roulette Stop SureStop AdaptivePixels);
        if let Answer::Pixels(answers) = answer {
            let mut answers = answers.clone();
            answers[0].traced_radiance = self.of(&answers[0].traced_radiance);
            changed.push(Answer::Pixels(answers));
        }
        changed
    }
}

/// A frame without its header.
fn body(frame: &RecordFrame) -> Vec<u8> {
    body_of(frame).expect("memory takes it")
}

fn started(case: u32) -> Vec<u8> {
    body(&RecordFrame::Started { case })
}

fn done(case: u32, answer: Answer) -> Vec<u8> {
    body(&RecordFrame::Done(Record {
        case,
        untouched: Vec::new(),
        holes: Vec::new(),
        outcome: Outcome::Answered(answer),
    }))
}

/// Frames with these bodies, as somebody sends them who knows the key.
fn send(bodies: &[Vec<u8>], key: Key) -> Vec<u8> {
    let frames = (0..)
        .zip(bodies)
        .map(|(number, body)| with_header(body, key, number))
        .map(|frame| frame.expect("it is not too long"));
    frames.flatten().collect()
}

fn read(bytes: Vec<u8>, key: Key, cases: &[Case]) -> Vec<Ending> {
    let frames = FrameReader::new(Box::new(Cursor::new(bytes)), key);
    records::read(frames, cases, 0).endings
}

/// What is read of frames with these bodies.
fn read_bodies(bodies: &[Vec<u8>], cases: &[Case]) -> Vec<Ending> {
    let key = Key::random();
    read(send(bodies, key), key, cases)
}

/// The answer inside an ending.
fn answer_of(ending: &Ending) -> Option<&Answer> {
    match ending.outcome() {
        Some(Outcome::Answered(answer)) => Some(answer),
        _ => None,
    }
}

/// Whether the answer earns all points of its case. All else that is done with an answer is done,
/// too: nothing of it may panic.
fn scores_in_full(spec: &Spec, answer: &Answer) -> bool {
    let _ = judge::picture::colours(&spec.work, answer);
    let _ = judge::snapshot::full(&spec.work, answer);
    let findings = judge::judge(spec, Tier::Core, answer);
    for worst in findings.iter().filter_map(|finding| finding.worst.as_ref()) {
        let _ = judge::repro::test(spec, Tier::Core, worst.call as usize);
    }
    !findings.is_empty() && findings.iter().all(Finding::passed)
}

#[test]
fn an_answer_that_lacks_or_repeats_entries_never_scores_in_full() {
    let _begin = AfterTheGoldens;
    let changes = [
        Change::DropLast,
        Change::DropFirst,
        Change::DuplicateLast,
        Change::Empty,
    ];
    for Answered { case, spec, answer } in answered() {
        let name = format!("{} {}", case.task, case.name);
        let written = done(0, answer.clone());
        assert!(
            written.len() < MAX_FRAME_BYTES as usize / 4,
            "{name} has a record of {} bytes",
            written.len()
        );
        let only = std::slice::from_ref(&case);
        let right = read_bodies(&[started(0), written.clone()], only);
        assert!(answer_of(&right[0]).is_some(), "{name}: {right:?}");
        for change in changes {
            for changed in change.of_answer(&answer) {
                let frame = done(0, changed);
                // Nothing to drop.
                if frame == written {
                    continue;
                }
                let endings = read_bodies(&[started(0), frame], only);
                let [ending] = endings.as_slice() else {
                    panic!("{name} {change:?}: {endings:?}")
                };
                let scores = answer_of(ending)
                    .zip(spec)
                    .is_some_and(|(answer, spec)| scores_in_full(spec, answer));
                assert!(!scores, "{name} scores after {change:?}");
                let is_tree = matches!(answer, Answer::Build(_));
                assert!(is_tree || answer_of(ending).is_none(), "{name} {change:?}");
            }
        }
    }
}

/// Three cases of each kind of work: the two with the shortest answers, and the one with the
/// longest of those that are soon judged.
fn three_of_each_kind() -> Vec<Vec<Answered>> {
    const SOON_JUDGED: usize = 150_000;
    let mut by_kind: BTreeMap<&str, Vec<(usize, Answered)>> = BTreeMap::new();
    for answered in answered() {
        let size = done(0, answered.answer.clone()).len();
        let kind = by_kind.entry(answered.case.work.kind()).or_default();
        kind.push((size, answered));
    }
    let three = by_kind.into_values().map(|mut of_kind| {
        of_kind.sort_by_key(|(size, _)| *size);
        of_kind.truncate(
            of_kind
                .partition_point(|(size, _)| *size < SOON_JUDGED)
                .max(3),
        );
        let longest = of_kind.split_off(of_kind.len() - 1);
        of_kind.truncate(2);
        let three = of_kind.into_iter().chain(longest);
        three.map(|(_, answered)| answered).collect()
    });
    three.collect()
}

/// Frames with these bodies in some other state than a sound worker leaves them in: mostly as
/// somebody spoils them who knows the key.
fn spoil(bodies: &[Vec<u8>], key: Key, random: &mut Random) -> Vec<u8> {
    let mut bodies = bodies.to_vec();
    let (some, other) = (random.below(bodies.len()), random.below(bodies.len()));
    match random.below(5) {
        0 => bodies.swap(some, other),
        1 => bodies.insert(some, bodies[other].clone()),
        2 => drop(bodies.remove(some)),
        _ => {}
    }
    if random.below(4) == 0 {
        let mut bytes = send(&bodies, key);
        spoil_bytes(&mut bytes, random);
        return bytes;
    }
    let some = random.below(bodies.len());
    spoil_bytes(&mut bodies[some], random);
    send(&bodies, key)
}

fn spoil_bytes(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    match random.below(4) {
        0 => bytes.truncate(at),
        // A long number in the place of a short one, such as a length.
        1 => bytes[at..].iter_mut().take(4).for_each(|byte| *byte = 0xFF),
        _ => {
            for _ in 0..=random.below(3) {
                let at = random.below(bytes.len());
                bytes[at] ^= 1 << random.below(8);
            }
        }
    }
}

#[test]
fn spoilt_records_end_nothing_and_do_not_score() {
    let _begin = AfterTheGoldens;
    /// Spoilt files of each kind of work.
    const FILES: usize = 100;
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let (mut accepted, mut rejected) = (0, 0);
    for of_kind in three_of_each_kind() {
        let cases: Vec<Case> = of_kind.iter().map(|a| a.case.clone()).collect();
        // The records in order, and each case with the answer to another.
        let in_order: [Vec<Vec<u8>>; 2] = [0, 1].map(|off| {
            let answers = of_kind.iter().cycle().skip(off).map(|a| a.answer.clone());
            let records = (0..).zip(answers).take(of_kind.len());
            records
                .flat_map(|(case, answer)| [started(case), done(case, answer)])
                .collect()
        });
        for _ in 0..FILES {
            let frames = &in_order[usize::from(random.below(4) == 0)];
            let key = Key::random();
            let endings = read(spoil(frames, key, &mut random), key, &cases);
            assert!(endings.len() <= cases.len());
            for (ending, right) in endings.iter().zip(&of_kind) {
                let Some(answer) = answer_of(ending) else {
                    rejected += 1;
                    continue;
                };
                accepted += 1;
                assert_eq!(answer.kind(), right.answer.kind());
                assert_eq!(
                    entries(answer),
                    entries(&right.answer),
                    "{}",
                    right.case.name
                );
                // Frames that were left alone need not be judged again.
                let is_right = done(0, answer.clone()) == done(0, right.answer.clone());
                if let (Some(spec), false) = (right.spec, is_right) {
                    scores_in_full(spec, answer);
                }
            }
        }
    }
    assert!(
        accepted.min(rejected) > 1000 || accepted + rejected == 0,
        "{accepted} {rejected}"
    );
}
