//! Frames and cases are read back; a frame that the worker did not write ends the reading.

use std::io::{self, Cursor, Read};
use std::sync::LazyLock;
use wire::file::{FrameReader, Key, body_of, read_cases, with_header, write_cases};
use wire::{Outcome, Record, RecordFrame};

static KEY: LazyLock<Key> = LazyLock::new(Key::random);

fn frames(bytes: &[u8]) -> Vec<Result<RecordFrame, String>> {
    FrameReader::new(Box::new(Cursor::new(bytes.to_vec())), *KEY).collect()
}

/// Frame number `number`, about the case of this number.
fn started(number: u32) -> Vec<u8> {
    numbered(number, *KEY, number.into())
}

/// A frame about `case` with this key and number.
fn numbered(case: u32, key: Key, number: u64) -> Vec<u8> {
    let body = body_of(&RecordFrame::Started { case });
    let frame = body.and_then(|body| with_header(&body, key, number));
    frame.expect("writing to memory succeeds")
}

fn written() -> Vec<u8> {
    [started(0), started(1)].concat()
}

#[test]
fn written_frames_are_read_back() {
    let started = |case| Ok(RecordFrame::Started { case });
    assert_eq!(frames(&written()), [started(0), started(1)]);
}

#[test]
fn cases_are_read_back_with_their_key() {
    let key = Key::random();
    let mut bytes = Vec::new();
    write_cases(&mut bytes, key, &[]).expect("writing to memory succeeds");
    let (read, cases) = read_cases(&mut bytes.as_slice()).expect("they are valid");
    assert!(read == key && cases.is_empty());
    assert!(Key::random() != key);
}

#[test]
fn an_incomplete_frame_is_skipped() {
    let bytes = written();
    for left in bytes.len() / 2..bytes.len() {
        assert_eq!(
            frames(&bytes[..left]),
            [Ok(RecordFrame::Started { case: 0 })]
        );
    }
}

#[test]
fn reading_ends_at_an_invalid_frame() {
    let with_body = |length: u32, body: &[u8]| {
        let mut bytes = with_header(body, *KEY, 2).expect("writing to memory succeeds");
        bytes[..4].copy_from_slice(&length.to_le_bytes());
        bytes
    };
    for invalid in [
        with_body(2, &[77, 0]),
        // A byte too many.
        with_body(3, &[0, 1, 0]),
        with_body(u32::MAX, &[0]),
    ] {
        let bytes = [written(), invalid, started(3)].concat();
        let frames = frames(&bytes);
        assert_eq!(frames.len(), 3, "{frames:?}");
        assert!(frames[2].is_err(), "{frames:?}");
    }
}

/// Frames with the same body, without an end.
struct EndlessFrames {
    body: Vec<u8>,
    frame: Cursor<Vec<u8>>,
    written: u64,
}

impl Read for EndlessFrames {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.frame.position() == self.frame.get_ref().len() as u64 {
            self.frame = Cursor::new(with_header(&self.body, *KEY, self.written)?);
            self.written += 1;
        }
        self.frame.read(into)
    }
}

#[test]
fn all_records_together_have_a_limit() {
    let record = Record {
        case: 0,
        untouched: Vec::new(),
        holes: Vec::new(),
        outcome: Outcome::Unable {
            reason: "x".repeat(16 << 20),
        },
    };
    let body = body_of(&RecordFrame::Done(record)).expect("writing to memory succeeds");
    let endless = EndlessFrames {
        body,
        frame: Cursor::default(),
        written: 0,
    };
    let read: Vec<Option<String>> = FrameReader::new(Box::new(endless), *KEY)
        .map(Result::err)
        .collect();
    let (end, frames) = read.split_last().expect("there are frames");
    // Each has some bytes more than 16 MB, all may have 512 MB.
    assert_eq!(frames, [const { None }; 31]);
    let why = end.as_ref().expect("the last one is too much");
    assert!(
        why.starts_with("the records of all cases have more than"),
        "{why}"
    );
}

#[test]
fn a_frame_without_the_key_or_its_number_is_forged() {
    let of = |key, number| numbered(2, key, number);
    let [valid, guessed, replayed] = [of(*KEY, 2), of(Key::random(), 2), of(*KEY, 1)];
    let is_read = |frame: Vec<u8>| frames(&[written(), frame].concat())[2].is_ok();
    assert!(is_read(valid));
    assert!(!is_read(guessed));
    assert!(!is_read(replayed));
}
