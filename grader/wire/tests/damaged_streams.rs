//! Fuzzing: whatever bytes arrive, the readers of the channel return values or an error. They never
//! panic, hang or ask for more memory than a frame may have.

use damage::{Random, damage, seeds};
use wire::file::{FrameReader, FrameWriter, Key, read_cases, write_cases};
use wire::question::{Question, read_reply, write_reply};
use wire::work::{BoxWork, Probe, Ray};
use wire::{Answer, Case, Excess, Outcome, Record, RecordFrame, Work};

/// The number of damaged streams.
const STREAMS: u64 = 20_000;

/// A stream of every kind of frame, and its key.
fn frames() -> (Vec<u8>, Key) {
    let key = Key::random();
    let record = |outcome| {
        RecordFrame::Done(Record {
            case: 0,
            untouched: vec!["part1.task3".into()],
            holes: Vec::new(),
            outcome,
        })
    };
    let question = Question::Prim(7);
    let all = [
        RecordFrame::Started { case: 0 },
        RecordFrame::Calling { case: 0, call: 1 },
        RecordFrame::Asking {
            case: 0,
            call: 1,
            question,
        },
        record(Outcome::Answered(Answer::Boxes(vec![
            None,
            Some([0.5, 7.0]),
        ]))),
        record(Outcome::Unable {
            reason: "none".into(),
        }),
        RecordFrame::Spent { case: 1, ms: 500 },
        RecordFrame::TimedOut { case: 1, call: 2 },
        RecordFrame::PrintedTooMuch { case: 1, call: 2 },
        RecordFrame::TookTooMuch {
            case: 1,
            call: 2,
            what: Excess::Threads,
        },
    ];
    let (mut input, output) = std::io::pipe().expect("there is a pipe");
    let mut writer = FrameWriter::new(Box::new(output), key);
    for frame in &all {
        writer.write(frame).expect("the pipe has room");
    }
    drop(writer);
    let mut bytes = Vec::new();
    std::io::Read::read_to_end(&mut input, &mut bytes).expect("the pipe ends");
    assert_eq!(read(&bytes, key).len(), all.len());
    (bytes, key)
}

fn read(bytes: &[u8], key: Key) -> Vec<Result<RecordFrame, String>> {
    FrameReader::new(Box::new(std::io::Cursor::new(bytes.to_vec())), key).collect()
}

#[test]
fn damaged_frames_end_in_an_error() {
    let (bytes, key) = frames();
    let whole = read(&bytes, key);
    for seed in seeds(STREAMS) {
        let mut damaged = bytes.clone();
        damage(&mut damaged, &mut Random::new(seed));
        let frames = read(&damaged, key);
        // What stands before the damage is read as it was; an error ends the stream.
        let errors = frames.iter().filter(|frame| frame.is_err()).count();
        let is_last = frames.last().is_none_or(|last| last.is_err());
        assert!(errors == 0 || errors == 1 && is_last, "seed {seed}");
        assert!(frames.len() <= whole.len() + 1, "seed {seed}");
    }
}

#[test]
fn damaged_cases_and_replies_are_errors_or_values() {
    let ray = Ray {
        o: [0.0; 3],
        d: [1.0, 0.0, 0.0],
        min_t: 0.0,
        max_t: 1.0,
    };
    let case = Case {
        task: "part2.task2".into(),
        name: "a".into(),
        limit_ms: 77,
        work: Work::Boxes(BoxWork {
            boxes: vec![[[0.0; 3], [1.0; 3]]],
            probes: vec![Probe { shape: 0, ray }; 3],
        }),
        order: Vec::new(),
    };
    let mut cases = Vec::new();
    write_cases(&mut cases, Key::random(), &[case]).expect("writing to memory succeeds");
    let mut replies = Vec::new();
    write_reply(&mut replies, Some([0.5, 0.7])).expect("writing to memory succeeds");
    for seed in seeds(STREAMS) {
        let mut random = Random::new(seed);
        let mut damaged = [cases.clone(), replies.clone()];
        damaged
            .iter_mut()
            .for_each(|bytes| damage(bytes, &mut random));
        let [cases, replies] = damaged;
        if let Ok((_, cases)) = read_cases(&mut cases.as_slice()) {
            assert!(cases.len() <= 200, "seed {seed}");
        }
        assert_eq!(
            read_reply(&mut replies.as_slice()).is_ok(),
            replies.len() >= 17,
            "seed {seed}"
        );
    }
}
