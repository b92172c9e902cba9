//! Replies, and the lines between what the cases print.

use wire::question::{read_reply, write_reply};
use wire::{case_of_marker, output_marker};

#[test]
fn replies_are_read_back() {
    let replies = [None, Some([-0.0, f64::INFINITY]), Some([1e-300, 7.0])];
    let mut bytes = Vec::new();
    for reply in replies {
        write_reply(&mut bytes, reply).expect("writing to memory succeeds");
    }
    let mut input = bytes.as_slice();
    for reply in replies {
        assert_eq!(read_reply(&mut input).expect("it is there"), reply);
    }
    assert!(read_reply(&mut input).is_err());
}

#[test]
fn a_marker_names_its_case() {
    let marker = output_marker(17);
    let lines: Vec<Option<u32>> = marker.lines().map(case_of_marker).collect();
    assert_eq!(lines, [None, Some(17)]);
    assert_eq!(case_of_marker("case 17"), None);
}
