//! Files with problems that the reader can repair or ignore. Each gives a warning.

use crate::small::{SMALL, edited, load_edited};
use kit::{Material, Scene, Spectrum};

/// Text to replace, its replacement, the title of the warning, and its label.
const WARNINGS: &[(&str, &str, &str, &str)] = &[
    (
        "0 0 0 1</matrix>",
        "0 0 0</matrix>",
        "<matrix> has 15 numbers",
        "missing numbers are filled in from the last row 0 0 0 1",
    ),
    (
        "0 0 0 1</matrix>",
        "</matrix>",
        "<matrix> has 12 numbers",
        "missing numbers are filled in from the last row 0 0 0 1",
    ),
    (
        " count=\"12\"",
        "",
        "<float_array id=\"points-array\"> has no attribute `count`",
        "using 12",
    ),
    (
        " count=\"2\"",
        "",
        "<triangles> has no attribute `count`",
        "using 2",
    ),
    (
        "target=\"#red\"",
        "target=\"#rde\"",
        "there is no <material> with the id `rde`",
        "the surface uses grey, 0.5 0.5 0.5",
    ),
    (
        "symbol=\"paint\"",
        "symbol=\"print\"",
        "no material is bound to `paint`",
        "expected an <instance_material> with this symbol; using this one instead",
    ),
    (
        "<color>0.8 0.1 0.1 1</color>",
        "<texture texture=\"t\" texcoord=\"UV\"/>",
        "the texture `t` has no image file",
        "expected a sampler, or an <image> with <init_from>",
    ),
    (
        "<color>0.8 0.1 0.1 1</color>",
        "",
        "<effect id=\"red-effect\"> has no diffuse colour",
        "expected <color> in <diffuse> of phong, lambert or blinn",
    ),
    (
        "0.8 0.1 0.1 1",
        "1.8 0.1 0.1 1",
        "<color> has a channel above 1",
        "expected at most 1; larger channels are clamped to 1",
    ),
    (
        "<diffuse>",
        "<emission><color>1 1 1 1</color></emission><diffuse>",
        "the emission of the common profile is ignored",
        "this surface emits no light",
    ),
    (
        "<sphere><radius>0.5</radius></sphere>",
        "<cone/>",
        "<cone> is not a shape",
        "expected <sphere>; it is ignored",
    ),
    (
        "<point><color>1 2 3</color></point>",
        "",
        "<light id=\"lamp\"> has no light type",
        "expected area, point, spot, directional or ambient; it is ignored",
    ),
    (
        "<point><color>1 2 3</color></point>",
        "<laser/>",
        "<laser> is not a light type",
        "expected area, point, spot, directional or ambient; it is ignored",
    ),
    (
        "<translate>0 5 0</translate><instance_light url=\"#lamp\"/>",
        "<instance_controller url=\"#x\"/>",
        "<instance_controller> is ignored",
        "only nodes, geometries, lights and cameras are supported here",
    ),
    (
        "<translate>0 0 5</translate>",
        "<scale>1 1 0</scale>",
        "this camera has no direction after its transform",
        "expected an invertible transform; the default view is used",
    ),
    (
        "<translate>0 0 5</translate>",
        "<instance_camera url=\"#cam\"/>",
        "the scene has more than one camera",
        "the first one is used, this one is ignored",
    ),
    (
        "perspective>",
        "orthographic>",
        "<camera id=\"cam\"> has <orthographic>",
        "expected <perspective>; the camera is ignored, and the default view is used",
    ),
    (
        "<scene><instance_visual_scene url=\"#scene\"/></scene>",
        "",
        "no <scene> selects a visual scene",
        "using the only visual scene",
    ),
    (
        "0 1 2 0 2 3",
        "0 1 2 0 2 2",
        "triangles without area: 1",
        "they are invisible and are ignored",
    ),
    (
        "</mesh>",
        "<lines count=\"0\"/></mesh>",
        "<lines> is ignored",
        "only triangles, polylist, polygons, tristrips and trifans are supported",
    ),
];

#[test]
fn problems_give_a_warning_with_title_and_label() {
    for (from, to, title, label) in WARNINGS {
        let loaded = load_edited(from, to).unwrap_or_else(|e| panic!("{e}"));
        let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        let warning = loaded.warnings.iter().find(|w| w.0.title() == *title);
        let warning = warning.unwrap_or_else(|| panic!("no warning `{title}` among {warnings:#?}"));
        assert_eq!(warning.0.expected(), Some(*label), "\n{warning}");
        assert!(warning.0.line_and_column().is_some());
        assert!(warning.to_string().starts_with("warning: "));
        assert!(!loaded.scene.is_empty());
    }
}

#[test]
fn short_matrix_gives_the_same_scene() {
    let short = load_edited("0 0 0 1</matrix>", "0 0 0</matrix>").unwrap();
    assert_eq!(
        short.scene,
        scenes::parse("small.dae", SMALL).unwrap().scene
    );
}

fn materials(scene: &Scene) -> Vec<Material> {
    scene.materials.iter().map(|named| named.material).collect()
}

#[test]
fn missing_materials_are_grey() {
    let grey = Material::Diffuse {
        reflectance: Spectrum::grey(0.5),
    };
    for (from, to) in [
        ("target=\"#red\"", "target=\"#nothing\""),
        ("<instance_material symbol=\"paint\" target=\"#red\"/>", ""),
    ] {
        assert_eq!(materials(&load_edited(from, to).unwrap().scene), [grey]);
    }
}

#[test]
fn polygons_with_too_few_corners_are_ignored() {
    let text = edited(
        "<triangles material=\"paint\" count=\"2\">",
        "<polylist material=\"paint\" count=\"3\"><vcount>4 2 0</vcount>",
    )
    .replace("</triangles>", "</polylist>")
    .replace("0 1 2 0 2 3", "0 1 2 3 0 1");
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.scene.triangles.len(), 2);
    assert_eq!(loaded.warnings[0].0.title(), "a polygon has 2 corners");
}

#[test]
fn self_intersecting_polygons_are_kept_with_a_warning() {
    let text = edited(
        "<triangles material=\"paint\" count=\"2\">",
        "<polygons material=\"paint\" count=\"1\">",
    )
    .replace("</triangles>", "</polygons>")
    .replace("0 1 2 0 2 3", "0 2 1 3");
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert!(
        loaded
            .warnings
            .iter()
            .any(|w| w.0.title() == "a polygon intersects itself or has no area"),
        "{:?}",
        loaded.warnings
    );
}

#[test]
fn excess_warnings_are_only_counted() {
    let many: String = (0..5000).map(|i| format!("<unknown{i}/>\n")).collect();
    let loaded = load_edited("<translate>0 5 0</translate>", &many).unwrap();
    assert_eq!(loaded.warnings.len(), 51);
    assert_eq!(
        loaded.warnings[50].0.title(),
        "4950 more warnings are not shown"
    );
}
