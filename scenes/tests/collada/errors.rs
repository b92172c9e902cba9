//! Invalid files. Each gives one error with the position, what was expected, and what to do.

use crate::collada::small::{self, SMALL, edited, load_edited, shows};
use scenes::SceneError;

/// The error of the small file with `from` replaced by `to`.
fn error(from: &str, to: &str) -> SceneError {
    match load_edited(from, to) {
        Ok(_) => panic!("`{to}` in place of `{from}` gives no error"),
        Err(error) => error,
    }
}

/// Checks the title, the line in the file, and that the error has an expectation and advice.
fn assert_error(error: &SceneError, title: &str, line: usize) {
    assert_eq!(error.0.title(), title, "\n{error}");
    assert_eq!(error.0.line_and_column().unwrap().0, line, "\n{error}");
    assert!(
        error
            .0
            .expected()
            .is_some_and(|expected| !expected.is_empty()),
        "\n{error}"
    );
    assert!(
        error.0.what_to_do().is_some_and(|help| !help.is_empty()),
        "\n{error}"
    );
    assert_eq!(error.0.file(), "small.dae");
}

#[test]
fn small_file_is_valid() {
    let loaded = scenes::parse("small.dae", SMALL).unwrap_or_else(|e| panic!("{e}"));
    assert!(loaded.warnings.is_empty(), "{}", loaded.warnings[0]);
    assert_eq!(
        (loaded.scene.triangles.len(), loaded.scene.spheres.len()),
        (2, 1)
    );
}

#[test]
fn report_shows_the_line_and_marks_the_position() {
    let report = error("0 1 2 0 2 3", "0 1 2 0 2 7").to_string();
    let expected = "\
error: index 7 is out of range: <source id=\"points\"> has 4 entries
  --> small.dae:36:24
   |
36 |           <p>0 1 2 0 2 7</p>
   |                        ^ expected 0 to 3
   |
   = help: the source or the index list is damaged: export the file again";
    assert_eq!(report, expected);
}

#[test]
fn styled_report_has_colours_and_plain_report_has_none() {
    let error = error("0 1 2 0 2 3", "0 1 2 0 2 7");
    assert!(error.styled().contains('\u{1b}'));
    assert!(!error.to_string().contains('\u{1b}'));
}

#[test]
fn very_long_lines_are_truncated_in_reports() {
    let many = "0 1 2 ".repeat(100_000);
    let text = small::edited("0 1 2 0 2 3", &format!("{many} 0 1 9 {many}"))
        .replace("count=\"2\"", "count=\"200001\"");
    let report = scenes::parse("small.dae", &text).unwrap_err().to_string();
    assert!(report.contains("small.dae:36:600019"), "{report}");
    assert!(report.len() < 1000, "{} bytes", report.len());
}

/// Text to replace, and its replacement.
const INVALID: &[[&str; 2]] = &[
    // Missing parts.
    [
        r##"<vertices id="square-vertices"><input semantic="POSITION" source="#points"/></vertices>"##,
        "",
    ],
    [r#"semantic="POSITION""#, r#"semantic="COLOR""#],
    [
        r##"<input semantic="VERTEX" source="#square-vertices" offset="0"/>"##,
        "",
    ],
    [r#" semantic="VERTEX""#, ""],
    [r#" offset="0""#, ""],
    [r##" url="#lamp""##, ""],
    ["<radius>0.5</radius>", ""],
    ["<color>1 2 3</color>", ""],
    // References to missing elements, or to elements with another tag.
    [r##"url="#square""##, r##"url="#sqare""##],
    [r##"url="#square""##, r##"url="#points""##],
    [r##"url="#square""##, r#"url="square""#],
    [r##"url="#square""##, r#"url="other.dae#square""#],
    [r##"url="#square""##, r#"url="""#],
    [r#"id="points-array""#, r#"id="points-list""#],
    [r#"id="points""#, r#"id="dots""#],
    [r##"url="#scene""##, r##"url="#stage""##],
    // Counts.
    [r#"stride="3""#, r#"stride="2""#],
    [r#"stride="3""#, r#"stride="0""#],
    [r#"stride="3""#, r#"stride="4000000000000000000""#],
    [
        r#"stride="3""#,
        r#"stride="3" offset="18446744073709551615""#,
    ],
    [r#"<param name="Y"/>"#, ""],
    ["0 1 2 0 2 3", "0 1 2 0 2"],
    [r#"offset="0""#, r#"offset="3""#],
    [r#"offset="0""#, r#"offset="4000000000""#],
    ["0.8 0.1 0.1 1", "0.8 0.1"],
    ["3 0 0", "3 0"],
    ["<radius>0.5", "<radius>0.5 0.5"],
    ["<radius>0.5", "<radius>"],
    ["  0 0 1 0  0 0 0 1<", "<"],
    ["0 0 0 1</matrix>", "0 0 1 1</matrix>"],
    // Indices and numbers.
    ["0 1 2 0 2 3", "0 1 2 0 2 4"],
    ["0 1 2 0 2 3", "0 1 2 0 2 -3"],
    ["0 1 2 0 2 3", "0 1 2 0 2 4294967296"],
    ["0 1 2 0 2 3", "0 1 2 0 2 1.5"],
    ["1 1 0", "1, 1, 0"],
    ["1 1 0", "1 1,5,0"],
    ["3 0 0", "3 nan 0"],
    ["3 0 0", "3 -1.#INF 0"],
    ["1 1 0", "1 <b/> 0"],
    ["<radius>0.5", "<radius>-0.5"],
    ["1 2 3", "1 -2 3"],
    ["<translate>3 0 0</translate>", "<rotate>0 0 0 90</rotate>"],
    [
        "<translate>3 0 0</translate>",
        "<lookat>1 1 1 1 1 1 0 1 0</lookat>",
    ],
    [
        "<translate>3 0 0</translate>",
        "<skew>90 1 0 0 0 1 0</skew>",
    ],
    ["<translate>3 0 0</translate>", "<scale>1 2 3</scale>"],
    [
        "<translate>3 0 0</translate>",
        "<scale>1e308 1e308 1e308</scale><scale>10 10 10</scale>",
    ],
    ["Y_UP", "UP"],
    // The scene.
    [
        "<translate>0 5 0</translate>",
        r##"<instance_node url="#lamp-node"/>"##,
    ],
];

#[test]
fn invalid_files_give_an_error_with_title_and_line() {
    let each = INVALID.iter().map(|[from, to]| {
        let error = error(from, to);
        assert!(error.0.what_to_do().is_some(), "{error}");
        (*from, *to, *error.0)
    });
    shows(
        "errors",
        "each marks what is wrong, and says what is expected there and what to do",
        each,
    );
}

#[test]
fn malformed_xml_is_an_error_with_its_position() {
    let end = "\n</COLLADA>\n";
    let lines = SMALL.trim_end().lines().count();
    assert_error(
        &error(end, "\n\n"),
        "the file is not well-formed XML: it ends before all elements are closed",
        lines - 1,
    );
    let entity = "<!DOCTYPE COLLADA [\n<!ENTITY a \"b\">\n]>\n<COLLADA ";
    assert_error(
        &error("<COLLADA ", entity),
        "the file is not well-formed XML: it declares entities",
        3,
    );
    assert_error(
        &error("</mesh>", "</mash>"),
        "the file is not well-formed XML: expected 'mesh' tag, not 'mash' at 38:7",
        38,
    );
    for text in [
        "",
        " ",
        "<",
        "\u{feff}",
        "solid cube",
        "<?xml version=\"1.0\"?>",
        "\0\0\0",
        "<a/><b/>",
    ] {
        let error = scenes::parse("small.dae", text).unwrap_err();
        assert!(error.0.title().contains("not"), "{error}");
    }
}

/// A download that was cut off: wherever it ends, the error marks the end and says so.
#[test]
fn a_text_that_is_cut_off_is_an_error_at_its_end() {
    let text = format!(
        "{}<!-- <the> end --></COLLADA>",
        SMALL.trim_end().trim_end_matches("</COLLADA>")
    );
    for end in 1..text.len() {
        let cut = &text[..end];
        let error = scenes::parse("small.dae", cut).unwrap_err();
        assert!(
            error.0.title().contains("it ends"),
            "after `{cut}`: {error}"
        );
        assert!(
            error
                .0
                .what_to_do()
                .unwrap()
                .contains("end of the file is missing"),
            "{error}"
        );
        let line = cut.trim_end().lines().count();
        assert_eq!(
            error.0.line_and_column().unwrap().0,
            line,
            "after `{cut}`: {error}"
        );
    }
}

#[test]
fn a_text_that_is_not_xml_is_an_error_with_advice() {
    for (text, title) in [
        ("", "the file is empty: it is not a COLLADA scene"),
        (
            "\n ",
            "the file has only white space: it is not a COLLADA scene",
        ),
        (
            "solid cube",
            "the file is not XML: it does not begin with `<`",
        ),
    ] {
        let error = scenes::parse("small.dae", text).unwrap_err();
        assert_eq!(error.0.title(), title);
        assert!(error.0.what_to_do().is_some(), "{error}");
    }
}

#[test]
fn thousands_of_attributes_or_namespaces_are_an_error() {
    let many = |attribute: &str| -> String {
        (0..50_000)
            .map(|i| attribute.replace('N', &i.to_string()))
            .collect()
    };
    let attributes =
        scenes::parse("small.dae", &format!("<COLLADA\n {}/>", many("aN='>' "))).unwrap_err();
    assert_error(&attributes, "a tag has more than 1000 attributes", 1);
    let nested = format!(
        "<COLLADA>\n{}{}</COLLADA>",
        many("<a xmlns:pN='uN'>"),
        "</a>".repeat(50_000)
    );
    let namespaces = scenes::parse("small.dae", &nested).unwrap_err();
    assert_error(&namespaces, "the file declares more than 100 namespaces", 2);
}

#[test]
fn equals_signs_in_comments_and_values_are_not_counted() {
    let banner = "=".repeat(5000);
    let text = format!(
        "<!-- <a {banner} > -->{}",
        SMALL.replace("<?xml version=\"1.0\"?>\n", "")
    )
    .replace("name=\"Red\"", &format!("name=\"{banner}\""));
    assert!(scenes::parse("small.dae", &text).is_ok());
}

#[test]
fn entities_are_an_error() {
    let bomb = "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><COLLADA>&b;</COLLADA>";
    let error = scenes::parse("small.dae", bomb).unwrap_err();
    assert!(
        error.0.what_to_do().unwrap().contains("<!ENTITY"),
        "{error}"
    );
}

#[test]
fn other_xml_is_an_error() {
    let error = scenes::parse("small.dae", "<svg/>").unwrap_err();
    assert_error(&error, "the file is not COLLADA but <svg>", 1);
}

#[test]
fn empty_scenes_are_an_error() {
    let error = scenes::parse("small.dae", "<COLLADA/>").unwrap_err();
    assert_error(&error, "no <scene> selects a visual scene", 1);
    let empty = error_of_scene("<visual_scene id=\"scene\"/>");
    assert_error(&empty, "the scene is empty", 2);
    let light_only = error_of_scene("<visual_scene id=\"scene\"><node id=\"a\"/></visual_scene>");
    assert_error(&light_only, "the scene is empty", 2);
    assert_eq!(light_only.0.elsewhere(), None);
    // What was left out is named.
    let lines =
        edited("<triangles material", "<lines material").replace("</triangles>", "</lines>");
    let lines = lines.replace("CGL", "other");
    let error = scenes::parse("small.dae", &lines).unwrap_err();
    let note = error.0.elsewhere().unwrap_or_default();
    assert!(note.contains("lines"), "{error}");
}

/// The error of a file that contains only a visual scene.
fn error_of_scene(visual_scene: &str) -> SceneError {
    let text = format!(
        "<COLLADA><library_visual_scenes>\n{visual_scene}\n</library_visual_scenes>\
         <scene><instance_visual_scene url=\"#scene\"/></scene></COLLADA>"
    );
    scenes::parse("small.dae", &text).unwrap_err()
}

#[test]
fn deep_nesting_is_an_error() {
    let deep = 200_000;
    let nested = "<node>".repeat(deep) + &"</node>".repeat(deep);
    let error = error_of_scene(&format!(
        "<visual_scene id=\"scene\">{nested}</visual_scene>"
    ));
    assert_error(&error, "nodes are nested more than 256 levels deep", 2);
}

#[test]
fn long_chains_of_instances_are_an_error() {
    let chain: String = (0..50_000)
        .map(|i| {
            format!(
                "<node id=\"n{i}\"><instance_node url=\"#n{}\"/></node>",
                i + 1
            )
        })
        .collect();
    let error = error_of_scene(&format!(
        "<visual_scene id=\"scene\">{chain}<node id=\"n50000\"/></visual_scene>"
    ));
    assert_error(&error, "nodes are nested more than 256 levels deep", 2);
}

#[test]
fn exponentially_many_instances_are_an_error() {
    // Sixty nodes, each with two instances of the next one: 2^60 instances.
    let nodes: String = (0..60)
        .map(|i| format!("<node id=\"n{i}\"><instance_node url=\"#n{0}\"/><instance_node url=\"#n{0}\"/></node>", i + 1))
        .collect();
    let error = error_of_scene(&format!(
        "<visual_scene id=\"scene\"><node id=\"root\"><instance_node url=\"#n0\"/></node>{nodes}<node id=\"n60\"/></visual_scene>"
    ));
    assert_error(
        &error,
        "the scene has more than 1048576 instances of nodes, shapes and lights",
        2,
    );
}

#[test]
fn too_many_triangles_over_all_instances_are_an_error() {
    let triangles = "0 1 2 ".repeat(20_000);
    let instances = "<instance_geometry url=\"#square\"/>".repeat(1000);
    let text = small::edited("0 1 2 0 2 3", &triangles)
        .replace("count=\"2\"", "count=\"20000\"")
        .replace(
            "<node id=\"lamp-node\">",
            &format!("<node id=\"lamp-node\">{instances}"),
        );
    let error = scenes::parse("small.dae", &text).unwrap_err();
    assert_error(
        &error,
        "the scene has more than 16777216 triangles and spheres",
        58,
    );
}

#[test]
fn cycles_over_several_nodes_are_detected() {
    let error = error_of_scene(
        "<visual_scene id=\"scene\"><node id=\"a\"><instance_node url=\"#b\"/></node>\
         <node id=\"b\"><node id=\"c\"><instance_node url=\"#a\"/></node></node></visual_scene>",
    );
    assert_error(&error, "<node id=\"a\"> contains itself", 2);
}

#[test]
fn unreadable_files_are_an_error() {
    let missing = scenes::load("no/such/file.dae").unwrap_err();
    assert!(
        missing.0.title().starts_with("the file cannot be read"),
        "{missing}"
    );
    assert_eq!(missing.0.file(), "no/such/file.dae");
    let folder = tempfile::tempdir().unwrap();
    let error = scenes::load(folder.path()).unwrap_err();
    assert!(
        error.0.title().starts_with("the file cannot be read"),
        "{error}"
    );
    let path = folder.path().join("scene.dae");
    std::fs::write(&path, b"PK\x03\x04").unwrap();
    let error = scenes::load(&path).unwrap_err();
    assert_eq!(
        error.0.title(),
        "the file is a ZIP archive, such as .zae or .kmz"
    );
    std::fs::write(&path, b"").unwrap();
    assert!(scenes::load(&path).is_err());
}

#[test]
fn polygons_too_complex_to_triangulate_are_an_error() {
    // A comb with 20,000 teeth. Its reflex corners make ear clipping slow.
    let teeth = 20_000;
    let points: String = (0..teeth)
        .map(|i| format!("{i} 1 0 {i}.5 {} 0 ", if i % 2 == 0 { -3 } else { 0 }))
        .collect();
    let corners = 2 * teeth;
    let order: String = (0..corners).map(|i| format!("{i} ")).collect();
    let text = SMALL
        .replace(
            "count=\"12\">0 0 0  1 0 0  1 1 0  0 1 0",
            &format!("count=\"{}\">{points}", 3 * corners),
        )
        .replace("count=\"4\"", &format!("count=\"{corners}\""))
        .replace(
            "<triangles material=\"paint\" count=\"2\">",
            "<polygons material=\"paint\" count=\"1\">",
        )
        .replace("</triangles>", "</polygons>")
        .replace("0 1 2 0 2 3", &order);
    let error = scenes::parse("small.dae", &text).unwrap_err();
    assert_error(
        &error,
        "the polygons of <polygons> are too complex to triangulate",
        34,
    );
}
