//! XML: comments, declarations, encodings, line ends, references. None of them changes the scene.

use crate::collada::small::{SMALL, edited};
use kit::Scene;

fn read(name: &str, text: &str) -> Scene {
    let loaded = scenes::parse(name, text).unwrap_or_else(|e| panic!("{e}"));
    assert!(loaded.warnings.is_empty(), "{}", loaded.warnings[0]);
    loaded.scene
}

fn expected() -> Scene {
    read("small.dae", SMALL)
}

#[test]
fn comments_and_processing_instructions_may_be_anywhere() {
    let everywhere = SMALL.replace('>', "><!-- > a \"comment\" --><?tool do=\"<it>\"?>");
    // Not in the XML declaration.
    let everywhere = everywhere.replacen("<!-- > a \"comment\" --><?tool do=\"<it>\"?>", "", 1);
    assert_eq!(read("small.dae", &everywhere), expected());
    let split = edited("Y_UP", "<!-- a -->Y_<!-- b -->UP");
    assert_eq!(read("small.dae", &split), expected());
    let numbers = edited("0 1 2 0 2 3", "0 1<!-- a --> 2 <?b?>0 2 3<!-- c -->");
    assert_eq!(read("small.dae", &numbers), expected());
}

#[test]
fn character_data_sections_are_text() {
    for (indices, line_end) in [
        ("<![CDATA[0 1 2 0 2 3]]>", "\n"),
        ("0 1 <![CDATA[2 0]]> 2 3", "\n"),
        ("0\n1\n2\n<![CDATA[0 2]]> 3", "\r\n"),
        ("0 1 2 0 <![CDATA[2]]><!-- a --> <![CDATA[3 ]]>", "\n"),
    ] {
        let text = edited("0 1 2 0 2 3", indices).replace('\n', line_end);
        assert_eq!(read("small.dae", &text), expected(), "{indices}");
    }
}

#[test]
fn document_types_without_entities_are_allowed() {
    let declaration = "<?xml version=\"1.0\"?>";
    for doctype in [
        "<!DOCTYPE COLLADA>",
        "<!DOCTYPE COLLADA SYSTEM \"http://www.collada.org/collada.dtd\">",
        "<!DOCTYPE COLLADA [<!-- don't > --><!ELEMENT COLLADA ANY>]>",
    ] {
        let text = edited(declaration, &format!("{declaration}{doctype}"));
        assert_eq!(read("small.dae", &text), expected(), "{doctype}");
    }
}

#[test]
fn tags_after_a_document_type_are_checked() {
    let many: String = (0..50_000).map(|i| format!("a{i}='' ")).collect();
    let text = format!("<!DOCTYPE a [<!-- don't --><!ELEMENT a ANY>]><a {many}/>");
    let error = scenes::parse("small.dae", &text).unwrap_err();
    assert_eq!(error.0.title(), "a tag has more than 1000 attributes");
}

#[test]
fn prefixes_line_ends_and_byte_order_marks_do_not_matter() {
    let prefixed = SMALL
        .replace("</", "</dae:")
        .replace('<', "<dae:")
        .replace("<dae:/", "</")
        .replace("<dae:?", "<?")
        .replace("xmlns=", "xmlns:dae=");
    for text in [
        prefixed,
        SMALL.replace('\n', "\r\n"),
        SMALL.replace('\n', "\r"),
        SMALL.replace('\n', " "),
        format!("\u{feff}{SMALL}"),
    ] {
        assert_eq!(read("small.dae", &text), expected());
    }
}

#[test]
fn files_in_other_encodings_give_the_same_scene() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("with spaces (1) é.dae");
    let named = SMALL
        .replace("Red", "Röd")
        .replace("?>", " encoding=\"X\"?>");
    let utf16 = |text: &str| -> Vec<u8> {
        let marked = format!("\u{feff}{text}");
        marked.encode_utf16().flat_map(u16::to_le_bytes).collect()
    };
    let latin_1 = |text: &str| -> Vec<u8> { text.chars().map(|c| c as u8).collect() };
    for bytes in [
        named.clone().into_bytes(),
        utf16(&named),
        latin_1(&named.replace("\"X\"", "\"ISO-8859-1\"")),
    ] {
        std::fs::write(&path, bytes).unwrap();
        let loaded = scenes::load(&path).unwrap_or_else(|e| panic!("{e}"));
        assert!(loaded.warnings.is_empty(), "{}", loaded.warnings[0]);
        assert_eq!(loaded.scene.materials[0].name, "Röd");
    }
    std::fs::write(&path, latin_1(&named)).unwrap();
    let loaded = scenes::load(&path).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.warnings[0].0.title(), "the file is not valid UTF-8");
    assert_eq!(loaded.warnings[0].0.line_and_column(), Some((20, 31)));
    assert_eq!(loaded.scene.triangles, expected().triangles);
}

#[test]
fn references_may_be_percent_encoded_or_name_their_own_file() {
    let odd = |text: &str| text.replace("id=\"square\"", "id=\"a b%é&amp;/(1)\"");
    let references = [
        ("#a b%é&amp;/(1)", "small.dae"),
        ("#a%20b%25%C3%A9%26/(1)", "small.dae"),
        (" #a%20b%25%C3%A9%26/(1) ", "small.dae"),
        ("./my%20scene.dae#a b%é&amp;/(1)", "folder/my scene.dae"),
        (
            "file:///x/my%20scene.dae#a b%é&amp;/(1)",
            "folder/my scene.dae",
        ),
    ];
    for (reference, file) in references {
        let text = odd(SMALL).replace("url=\"#square\"", &format!("url=\"{reference}\""));
        assert_eq!(read(file, &text), expected(), "{reference}");
    }
}

#[test]
fn xml_base_does_not_change_references_inside_the_file() {
    let text = edited(
        "<COLLADA ",
        "<COLLADA xml:base=\"http://example.org/a/b.dae\" ",
    );
    assert_eq!(read("small.dae", &text), expected());
}

#[test]
fn units_and_extensions_are_ignored() {
    let text = edited(
        "<up_axis>",
        "<unit name=\"inch\" meter=\"0.0254\"/><extra><technique profile=\"x\"><y:z xmlns:y=\"u\"/></technique></extra><up_axis>",
    );
    assert_eq!(read("small.dae", &text), expected());
}
