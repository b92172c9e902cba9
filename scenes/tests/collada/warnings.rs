//! Files with problems that the reader can repair or ignore. Each gives a warning.

use crate::collada::small::{SMALL, edited, load_edited};
use kit::{Material, Scene, Spectrum};

/// Text to replace, its replacement, the title of the warning, and its label.
const WARNINGS: &[(&str, &str, &str, &str)] = &[
    (
        "id=\"ball\">",
        "id=\"square\"/><geometry id=\"ball\">",
        "several <geometry> have the id `square`",
        "using the first one",
    ),
    (
        "<matrix>1 0 0 0  0 1 0 0",
        "<matrix>0 0 0 0  0 0 0 0",
        "this shape has no area after its transform",
        "no ray hits it",
    ),
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
        "<technique sid=\"common\">\n      <phong><diffuse><color>0.8 0.1 0.1 1</color>",
        "<newparam sid=\"t\"><sampler2D><source>s</source><wrap_s>MIRROR</wrap_s></sampler2D></newparam>\
         <technique sid=\"common\"><phong><diffuse><texture texture=\"t\" texcoord=\"UV\"/>",
        "<wrap_s> is `MIRROR`",
        "only WRAP is supported",
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
        "</diffuse>",
        "</diffuse><transparent opaque=\"RGB_ZERO\"><texture texture=\"leaf\" texcoord=\"UV\"/></transparent>",
        "the transparency of the common profile is ignored",
        "this surface is opaque",
    ),
    (
        "</diffuse>",
        "</diffuse><transparent><color>0 0 0 0.3</color></transparent><transparency><float>1</float></transparency>",
        "the transparency of the common profile is ignored",
        "this surface is opaque",
    ),
    (
        "</diffuse>",
        "</diffuse><transparent opaque=\"RGB_ZERO\"><color>0.5 1 1 1</color></transparent>",
        "the transparency of the common profile is ignored",
        "this surface is opaque",
    ),
    (
        "</diffuse>",
        "</diffuse><transparency><float>0.4</float></transparency>",
        "the transparency of the common profile is ignored",
        "this surface is opaque",
    ),
    (
        "</diffuse>",
        "</diffuse><transparent opaque=\"A_ONE\"><color>1 1 1 0</color></transparent><transparency><float>1</float></transparency>",
        "a surface without opacity is shown opaque",
        "this surface is opaque",
    ),
    (
        "</diffuse>",
        "</diffuse><transparent opaque=\"RGB_ZERO\"><color>1 1 1 1</color></transparent>",
        "a surface without opacity is shown opaque",
        "this surface is opaque",
    ),
    (
        "offset=\"0\"/>",
        "offset=\"0\"/><input semantic=\"COLOR\" source=\"#points\" offset=\"0\"/>",
        "the colours of vertices are ignored",
        "the material alone gives a surface its colour",
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
        "<instance_force_field url=\"#x\"/>",
        "<instance_force_field> is ignored",
        "only nodes, shapes, lights and cameras are supported here",
    ),
    (
        "<translate>0 0 5</translate>",
        "<scale>1 1 0</scale>",
        "this camera has no direction after its transform",
        "expected an invertible transform; without another camera, the scene is framed",
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
        "expected <perspective>; without another camera, the scene is framed",
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
    (
        "<instance_effect url=\"#red-effect\"/>",
        "",
        "<material id=\"red\"> has no <instance_effect>",
        "expected a <instance_effect> inside",
    ),
    (
        "url=\"#red-effect\"",
        "url=\"#green\"",
        "there is no <effect> with the id `green`",
        "refers to a <effect> that is not in the file",
    ),
    (
        "</profile_COMMON>",
        "</profile_COMMON><extra><technique profile=\"CGL\"><microfacet/></technique></extra>",
        "<microfacet> is not a material",
        "expected emission, mirror, glossy, glass or refraction",
    ),
    (
        "url=\"#lamp\"",
        "url=\"other.dae#lamp\"",
        "`other.dae#lamp` is in another file",
        "expected `#` and the id of a <light> in this file",
    ),
    (
        "count=\"12\"",
        "count=\"4000000000\"",
        "<float_array id=\"points-array\"> has count=\"4000000000\", but contains 12 numbers",
        "using 12",
    ),
    (
        "count=\"12\"",
        "count=\"-1\"",
        "<float_array id=\"points-array\"> has count=\"-1\", but contains 12 numbers",
        "using 12",
    ),
    (
        "count=\"4\"",
        "count=\"5\"",
        "<accessor> reads 5 entries, but <float_array id=\"points-array\"> contains 4",
        "using 4",
    ),
    (
        "count=\"2\"",
        "count=\"3\"",
        "<triangles> has count=\"3\", but contains 2 triangles",
        "using 2",
    ),
    (
        "1 1 0",
        "1 1,5 0",
        "`1,5` has a decimal comma",
        "expected a decimal point; read as 1.5",
    ),
    (
        "id=\"square-vertices\"",
        "id=\"x\"",
        "there is no <vertices> with the id `square-vertices`",
        "using <vertices id=\"x\">",
    ),
    (
        "<xfov>50</xfov>",
        "<yfov>40</yfov><xfov>180</xfov>",
        "xfov is 180",
        "expected degrees from 0.001 to 179.999",
    ),
    (
        "<aspect_ratio>1.5",
        "<aspect_ratio>0",
        "aspect_ratio is 0",
        "expected a number from 0.001 to 1000",
    ),
    (
        "<znear>0.1",
        "<znear>-1",
        "znear is -1",
        "expected a number >= 0, below 1e30",
    ),
    (
        "<znear>0.1",
        "<znear>1e40",
        "znear is 10000000000000000000000000000000000000000",
        "expected a number >= 0, below 1e30",
    ),
    (
        "<zfar>100",
        "<zfar>0.1",
        "zfar is 0.1",
        "expected more than znear, 0.1",
    ),
    (
        "<zfar>100",
        "<zfar>far",
        "`far` in <zfar> is not a number",
        "expected a finite number",
    ),
    (
        "<translate>3 0 0</translate>",
        "<lookat>0 0 0  0 5 0  0 1 0</lookat>",
        "<lookat> has no valid up direction",
        "expected eye, point of interest, up",
    ),
    (
        "<point><color>1 2 3</color></point>",
        "<spot><color>1 2 3</color><falloff_angle>360</falloff_angle></spot>",
        "the opening angle is 360 degrees",
        "expected more than 0 and at most 180",
    ),
    ("Y_UP", "", "<up_axis> is empty", "using Y_UP"),
    (
        "<extra><technique profile=\"CGL\"><sphere><radius>0.5</radius></sphere></technique></extra>",
        "<convex_mesh convex_hull_of=\"#square\"/>",
        "<convex_mesh> is not supported",
        "expected <mesh>, or <sphere> in the profile CGL; it is ignored",
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
fn opaque_surfaces_of_all_exporters_give_no_warning() {
    for transparent in [
        "<transparent opaque=\"A_ONE\"><color>1 1 1 1</color></transparent><transparency><float>1</float></transparency>",
        "<transparent><color>0.5 0.5 0.5 1</color></transparent><transparency><float>1</float></transparency>",
        "<transparent opaque=\"RGB_ZERO\"><color>0 0 0 1</color></transparent><transparency><float>1</float></transparency>",
        "<transparent opaque=\"RGB_ZERO\"><color>1 1 1 0.5</color></transparent><transparency><float>0</float></transparency>",
        "<transparent><param ref=\"a\"/></transparent>",
        "<transparency><float>1</float></transparency>",
    ] {
        let loaded = load_edited("</diffuse>", &format!("</diffuse>{transparent}"));
        let warnings = loaded.unwrap_or_else(|e| panic!("{e}")).warnings;
        assert!(warnings.is_empty(), "{transparent}: {}", warnings[0]);
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
    assert_eq!(
        loaded.warnings[0].0.title(),
        "polygons with fewer than 3 corners: 2"
    );
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
            .any(|w| w.0.title() == "polygons that intersect themselves or have no area: 1"),
        "{:?}",
        loaded.warnings
    );
}
