//! Many warnings: those of one kind are counted together.

use crate::collada::small::{edited, load_edited};

#[test]
fn warnings_of_one_kind_are_counted_together() {
    let many: String = (0..5000).map(|i| format!("<unknown{i}/>\n")).collect();
    let loaded = load_edited("<translate>0 5 0</translate>", &many).unwrap();
    let [warning] = &loaded.warnings[..] else {
        panic!("{} warnings", loaded.warnings.len())
    };
    assert_eq!(warning.0.title(), "<unknown0> is ignored");
    let elsewhere = "4999 more like this, at lines 59, 60, 61, ...";
    assert_eq!(warning.0.elsewhere(), Some(elsewhere));
    assert!(
        warning
            .to_string()
            .ends_with(&format!("= note: {elsewhere}")),
        "{warning}"
    );
}

#[test]
fn the_same_warning_at_the_same_place_counts_once() {
    // Both instances of the node use the light, whose type is unknown.
    let text = edited("<point><color>1 2 3</color></point>", "<laser/>").replace(
        "<node id=\"cam-node\">",
        "<node id=\"again\"><instance_light url=\"#lamp\"/><instance_node url=\"#lamp-node\"/></node>\
         <node id=\"cam-node\">",
    );
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.warnings.len(), 1);
    assert_eq!(loaded.warnings[0].0.elsewhere(), None);
}

#[test]
fn excess_kinds_of_warnings_are_only_counted() {
    let name = |i: u8| {
        format!(
            "<unknown-{}{}/>",
            char::from(b'a' + i / 26),
            char::from(b'a' + i % 26)
        )
    };
    let many: String = (0..60).map(name).collect();
    let loaded = load_edited("<translate>0 5 0</translate>", &many).unwrap();
    assert_eq!(loaded.warnings.len(), 51);
    assert_eq!(
        loaded.warnings[50].0.title(),
        "10 more warnings are not shown"
    );
}
