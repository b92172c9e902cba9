//! Files with problems that the reader can repair or ignore. Each gives a warning.

use crate::collada::small::{SMALL, edited, load_edited, shows};
use kit::{Material, Scene, Spectrum};

/// Text to replace, and its replacement.
const WARNINGS: &[[&str; 2]] = &[
    [r#"id="ball">"#, r#"id="square"/><geometry id="ball">"#],
    ["<matrix>1 0 0 0  0 1 0 0", "<matrix>0 0 0 0  0 0 0 0"],
    ["0 0 0 1</matrix>", "0 0 0</matrix>"],
    ["0 0 0 1</matrix>", "</matrix>"],
    [r#" count="12""#, ""],
    [r#" count="2""#, ""],
    [r##"target="#red""##, r##"target="#rde""##],
    [r#"symbol="paint""#, r#"symbol="print""#],
    [
        "<color>0.8 0.1 0.1 1</color>",
        r#"<texture texture="t" texcoord="UV"/>"#,
    ],
    [
        "<technique sid=\"common\">\n      <phong><diffuse><color>0.8 0.1 0.1 1</color>",
        "<newparam sid=\"t\"><sampler2D><source>s</source><wrap_s>MIRROR</wrap_s></sampler2D></newparam>\
         <technique sid=\"common\"><phong><diffuse><texture texture=\"t\" texcoord=\"UV\"/>",
    ],
    ["<color>0.8 0.1 0.1 1</color>", ""],
    ["0.8 0.1 0.1 1", "1.8 0.1 0.1 1"],
    [
        "<diffuse>",
        "<emission><color>1 1 1 1</color></emission><diffuse>",
    ],
    [
        "<phong>",
        r#"<phong><emission><texture texture="t" texcoord="UV"/></emission><specular><color>1 1 1 1</color></specular>"#,
    ],
    [
        "<phong><diffuse><color>0.8 0.1 0.1 1</color></diffuse></phong>",
        "<constant><emission><color>1 1 1 1</color></emission></constant>",
    ],
    [
        "</diffuse>",
        r#"</diffuse><transparent opaque="RGB_ZERO"><texture texture="leaf" texcoord="UV"/></transparent>"#,
    ],
    [
        "</diffuse>",
        "</diffuse><transparent><color>0 0 0 0.3</color></transparent><transparency><float>1</float></transparency>",
    ],
    [
        "</diffuse>",
        r#"</diffuse><transparent opaque="RGB_ZERO"><color>0.5 1 1 1</color></transparent>"#,
    ],
    [
        "</diffuse>",
        "</diffuse><transparency><float>0.4</float></transparency>",
    ],
    [
        "</diffuse>",
        r#"</diffuse><transparent opaque="A_ONE"><color>1 1 1 0</color></transparent><transparency><float>1</float></transparency>"#,
    ],
    [
        "</diffuse>",
        r#"</diffuse><transparent opaque="RGB_ZERO"><color>1 1 1 1</color></transparent>"#,
    ],
    [
        r#"offset="0"/>"#,
        r##"offset="0"/><input semantic="COLOR" source="#points" offset="0"/>"##,
    ],
    ["<sphere><radius>0.5</radius></sphere>", "<cone/>"],
    ["<point><color>1 2 3</color></point>", ""],
    ["<point><color>1 2 3</color></point>", "<laser/>"],
    [
        r##"<translate>0 5 0</translate><instance_light url="#lamp"/>"##,
        r##"<instance_force_field url="#x"/>"##,
    ],
    ["<translate>0 0 5</translate>", "<scale>1 1 0</scale>"],
    [
        "<translate>0 0 5</translate>",
        r##"<instance_camera url="#cam"/>"##,
    ],
    ["perspective>", "orthographic>"],
    [
        r##"<scene><instance_visual_scene url="#scene"/></scene>"##,
        "",
    ],
    ["0 1 2 0 2 3", "0 1 2 0 2 2"],
    ["</mesh>", r#"<lines count="0"/></mesh>"#],
    [r##"<instance_effect url="#red-effect"/>"##, ""],
    [r##"url="#red-effect""##, r##"url="#green""##],
    [
        "</profile_COMMON>",
        r#"</profile_COMMON><extra><technique profile="CGL"><microfacet/></technique></extra>"#,
    ],
    [r##"url="#lamp""##, r#"url="other.dae#lamp""#],
    [r#"count="12""#, r#"count="4000000000""#],
    [r#"count="12""#, r#"count="-1""#],
    [r#"count="4""#, r#"count="5""#],
    [r#"count="2""#, r#"count="3""#],
    ["1 1 0", "1 1,5 0"],
    [r#"id="square-vertices""#, r#"id="x""#],
    ["<xfov>50</xfov>", "<yfov>40</yfov><xfov>180</xfov>"],
    ["<aspect_ratio>1.5", "<aspect_ratio>0"],
    ["<znear>0.1", "<znear>-1"],
    ["<znear>0.1", "<znear>1e40"],
    ["<zfar>100", "<zfar>0.1"],
    ["<zfar>100", "<zfar>far"],
    [
        "<translate>3 0 0</translate>",
        "<lookat>0 0 0  0 5 0  0 1 0</lookat>",
    ],
    [
        "<point><color>1 2 3</color></point>",
        "<spot><color>1 2 3</color><falloff_angle>360</falloff_angle></spot>",
    ],
    ["Y_UP", ""],
    [
        r#"<extra><technique profile="CGL"><sphere><radius>0.5</radius></sphere></technique></extra>"#,
        r##"<convex_mesh convex_hull_of="#square"/>"##,
    ],
];

#[test]
fn problems_give_a_warning_with_title_and_label() {
    let each = WARNINGS.iter().flat_map(|[from, to]| {
        let loaded = load_edited(from, to).unwrap_or_else(|e| panic!("{e}"));
        assert!(!loaded.scene.is_empty());
        let warnings = loaded.warnings.into_iter();
        warnings.map(|warning| (*from, *to, warning.0))
    });
    shows(
        "warnings",
        "each says what is wrong and what is used instead; few edits have a second one",
        each,
    );
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

/// Which material such a part has is up to the application.
#[test]
fn parts_that_name_none_of_several_materials_have_the_first_with_a_warning() {
    let bound = "<instance_material symbol=\"paint\" target=\"#red\"/>";
    let two = format!("{bound}<instance_material symbol=\"other\" target=\"#nothing\"/>");
    let named = SMALL.replacen(bound, &two, 1);
    let [unnamed, unnamed_of_one] =
        [&named, SMALL].map(|text| text.replace("<triangles material=\"paint\"", "<triangles"));
    let title = "a part of the shape names none of its materials";
    for (text, titles) in [(named, &[][..]), (unnamed_of_one, &[]), (unnamed, &[title])] {
        let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
        let found = loaded.warnings.iter().map(|warning| warning.0.title());
        assert_eq!(found.collect::<Vec<_>>(), titles);
        assert_eq!(loaded.scene.materials[0].name, "Red");
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
