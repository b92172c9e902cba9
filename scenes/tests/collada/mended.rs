//! Files that are not quite right but can be read: each gives a warning that says what was done.

use crate::small::{SMALL, edited, load_edited};
use kit::{Material, Scene, Spectrum};

/// What is changed, to what, the head line of the warning and what was done about it.
const MENDED: &[(&str, &str, &str, &str)] = &[
    (
        "0 0 0 1</matrix>",
        "0 0 0</matrix>",
        "<matrix> has 15 numbers",
        "taken as if the rest of the last row, 0 0 0 1, were there",
    ),
    (
        "0 0 0 1</matrix>",
        "</matrix>",
        "<matrix> has 12 numbers",
        "taken as if the rest of the last row, 0 0 0 1, were there",
    ),
    (
        " count=\"12\"",
        "",
        "<float_array id=\"points-array\"> has no attribute `count`",
        "taken as 12",
    ),
    (
        " count=\"2\"",
        "",
        "<triangles> has no attribute `count`",
        "taken as 2",
    ),
    (
        "target=\"#red\"",
        "target=\"#rde\"",
        "there is no <material> with the id `rde`",
        "the surface is taken as grey, 0.5 0.5 0.5",
    ),
    (
        "symbol=\"paint\"",
        "symbol=\"print\"",
        "no material is bound to `paint`",
        "expected an <instance_material> with this symbol; this one is taken",
    ),
    (
        "<color>0.8 0.1 0.1 1</color>",
        "<texture texture=\"t\" texcoord=\"UV\"/>",
        "the texture `t` leads to no image file",
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
        "<color> gives back more light than it gets",
        "expected at most 1; channels above it are taken as 1",
    ),
    (
        "<diffuse>",
        "<emission><color>1 1 1 1</color></emission><diffuse>",
        "the emission of the common profile is passed over",
        "gives no light",
    ),
    (
        "<sphere><radius>0.5</radius></sphere>",
        "<cone/>",
        "<cone> is not a shape",
        "expected <sphere>; it is passed over",
    ),
    (
        "<point><color>1 2 3</color></point>",
        "",
        "<light id=\"lamp\"> does not say what kind of light it is",
        "expected area, point, spot, directional or ambient; it is passed over",
    ),
    (
        "<point><color>1 2 3</color></point>",
        "<laser/>",
        "<laser> is not a kind of light",
        "expected area, point, spot, directional or ambient; it is passed over",
    ),
    (
        "<translate>0 5 0</translate><instance_light url=\"#lamp\"/>",
        "<instance_controller url=\"#x\"/>",
        "<instance_controller> is passed over",
        "only nodes, geometries, lights and cameras are placed",
    ),
    (
        "<translate>0 0 5</translate>",
        "<scale>1 1 0</scale>",
        "the transform leaves this camera no direction",
        "expected a transform that does not flatten it; the scene is framed",
    ),
    (
        "<translate>0 0 5</translate>",
        "<instance_camera url=\"#cam\"/>",
        "the scene has more than one camera",
        "the first one is used, this one is passed over",
    ),
    (
        "perspective>",
        "orthographic>",
        "<camera id=\"cam\"> has <orthographic>",
        "expected <perspective>; the camera is passed over and the scene framed",
    ),
    (
        "<scene><instance_visual_scene url=\"#scene\"/></scene>",
        "",
        "no <scene> says what to show",
        "the only visual scene is taken",
    ),
    (
        "0 1 2 0 2 3",
        "0 1 2 0 2 2",
        "triangles without area: 1",
        "they cannot be seen and are left out",
    ),
    (
        "</mesh>",
        "<lines count=\"0\"/></mesh>",
        "<lines> is passed over",
        "only triangles, polylist, polygons, tristrips and trifans have a surface",
    ),
];

#[test]
fn what_can_be_mended_is_a_warning_that_says_so() {
    for (from, to, title, done) in MENDED {
        let loaded = load_edited(from, to).unwrap_or_else(|e| panic!("{e}"));
        let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        let warning = loaded.warnings.iter().find(|w| w.0.title() == *title);
        let warning = warning.unwrap_or_else(|| panic!("no warning `{title}` among {warnings:#?}"));
        assert_eq!(warning.0.expected(), Some(*done), "\n{warning}");
        assert!(warning.0.line_and_column().is_some());
        assert!(warning.to_string().starts_with("warning: "));
        assert!(!loaded.scene.is_empty());
    }
}

#[test]
fn a_short_matrix_means_the_same() {
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
fn small_polygons_are_passed_over() {
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
fn polygons_that_cross_themselves_are_drawn_with_a_warning() {
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
            .any(|w| w.0.title() == "a polygon crosses itself or has no area"),
        "{:?}",
        loaded.warnings
    );
}

#[test]
fn thousands_of_warnings_are_counted_not_kept() {
    let many: String = (0..5000).map(|i| format!("<unknown{i}/>\n")).collect();
    let loaded = load_edited("<translate>0 5 0</translate>", &many).unwrap();
    assert_eq!(loaded.warnings.len(), 51);
    assert_eq!(
        loaded.warnings[50].0.title(),
        "4950 more warnings are not shown"
    );
}
