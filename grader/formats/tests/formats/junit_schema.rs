//! The schema of JUnit files that Jenkins publishes with its xUnit plugin, as far as this project's
//! files use it: `junit-10.xsd` in
//! <https://github.com/jenkinsci/xunit-plugin/tree/master/src/main/resources/org/jenkinsci/plugins/xunit/types/model/xsd>.

use roxmltree::{Document, Node};

/// What an element may contain: its name, required and other attributes, elements, and whether text.
struct Element {
    name: &'static str,
    required: &'static [&'static str],
    optional: &'static [&'static str],
    children: &'static [&'static str],
    has_text: bool,
}

const SCHEMA: [Element; 9] = [
    Element {
        name: "testsuites",
        required: &[],
        optional: &["name", "time", "tests", "failures", "errors"],
        children: &["testsuite"],
        has_text: false,
    },
    Element {
        name: "testsuite",
        required: &["name", "tests", "failures", "errors"],
        optional: &[
            "group",
            "time",
            "skipped",
            "timestamp",
            "hostname",
            "id",
            "package",
            "file",
            "log",
            "url",
        ],
        children: &[
            "testsuite",
            "properties",
            "testcase",
            "system-out",
            "system-err",
        ],
        has_text: false,
    },
    Element {
        name: "testcase",
        required: &["name"],
        optional: &["time", "classname", "group"],
        children: &["skipped", "error", "failure", "system-out", "system-err"],
        has_text: false,
    },
    Element {
        name: "properties",
        required: &[],
        optional: &[],
        children: &["property"],
        has_text: false,
    },
    Element {
        name: "property",
        required: &["name", "value"],
        optional: &[],
        children: &[],
        has_text: false,
    },
    message("failure"),
    message("error"),
    message("skipped"),
    Element {
        name: "system-out",
        required: &[],
        optional: &[],
        children: &[],
        has_text: true,
    },
];

const fn message(name: &'static str) -> Element {
    Element {
        name,
        required: &[],
        optional: &["type", "message"],
        children: &[],
        has_text: true,
    }
}

/// What in `text` the schema does not allow.
pub(crate) fn violations(text: &str) -> Vec<String> {
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(e) => return vec![e.to_string()],
    };
    let mut found = Vec::new();
    if !document.root_element().has_tag_name("testsuites") {
        found.push("the root is not testsuites".into());
    }
    let elements = document.descendants().filter(Node::is_element);
    elements.for_each(|node| check(node, &mut found));
    found
}

fn check(node: Node, found: &mut Vec<String>) {
    let name = node.tag_name().name();
    let Some(element) = SCHEMA.iter().find(|element| element.name == name) else {
        return found.push(format!("there is no element {name}"));
    };
    for required in element.required {
        if node.attribute(*required).is_none() {
            found.push(format!("{name} has no {required}"));
        }
    }
    for attribute in node.attributes() {
        let attribute = attribute.name();
        if !element.required.contains(&attribute) && !element.optional.contains(&attribute) {
            found.push(format!("{name} has {attribute}"));
        }
    }
    for child in node.children() {
        let tag = child.tag_name().name();
        if child.is_element() && !element.children.contains(&tag) {
            found.push(format!("{name} contains {tag}"));
        }
        let text = child.text().filter(|_| child.is_text()).unwrap_or_default();
        if !element.has_text && !text.trim().is_empty() {
            found.push(format!("{name} contains the text {text:?}"));
        }
    }
}

#[test]
fn the_schema_refuses_what_it_does_not_know() {
    let found =
        violations("<testsuites skipped='1'><testsuite name='a'><x/></testsuite></testsuites>");
    assert_eq!(
        found,
        [
            "testsuites has skipped",
            "testsuite has no tests",
            "testsuite has no failures",
            "testsuite has no errors",
            "testsuite contains x",
            "there is no element x"
        ]
    );
}
