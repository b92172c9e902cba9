//! Meshes, transforms and controllers with parts that are repaired or left out.

use crate::collada::small::{SMALL, edited, load_edited};
use kit::{Scene, Vec3};
use scenes::Loaded;

fn titles(loaded: &Loaded) -> Vec<&str> {
    loaded.warnings.iter().map(|w| w.0.title()).collect()
}

fn read(text: &str) -> Scene {
    let loaded = scenes::parse("small.dae", text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(titles(&loaded), [""; 0]);
    loaded.scene
}

#[test]
fn polygons_with_a_position_that_is_not_finite_are_left_out() {
    for number in [
        "nan",
        "-NaN",
        "INF",
        "-1.#IND",
        "1.#QNAN0",
        "-nan(ind)",
        "1e999",
    ] {
        let loaded = load_edited("0 1 0<", &format!("0 {number} 0<")).unwrap();
        let title = format!("`{number}` in <float_array id=\"points-array\"> is not finite");
        assert_eq!(titles(&loaded), [title]);
        assert_eq!(loaded.scene.triangles.len(), 1);
    }
}

/// The small file with a source of normals; `indices` are pairs of a position and a normal.
fn with_normals(normals: &str, indices: &str) -> String {
    let source = format!(
        "<source id=\"normals\"><float_array id=\"n\" count=\"6\">{normals}</float_array><technique_common>\
         <accessor source=\"#n\" count=\"2\" stride=\"3\"/></technique_common></source><vertices id="
    );
    edited("<vertices id=", &source)
        .replace(
            "offset=\"0\"/>",
            "offset=\"0\"/><input semantic=\"NORMAL\" source=\"#normals\" offset=\"1\"/>",
        )
        .replace("0 1 2 0 2 3", indices)
}

#[test]
fn invalid_normals_are_computed() {
    let valid = "0 0 1 1 2 1  0 1 2 1 3 0";
    let cases = [
        ("0 3 4 nan 0 0", valid, "is not finite"),
        (
            "0 3 4 x 0 0",
            valid,
            "`x` in <float_array id=\"n\"> is not a number",
        ),
        (
            "0 3 4 1 0 0",
            "0 0 1 1 2 7  0 1 2 1 3 0",
            "triangles with a normal out of range: 1",
        ),
    ];
    for (normals, indices, title) in cases {
        let text = with_normals(normals, indices);
        let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
        assert!(titles(&loaded)[0].contains(title), "{:?}", titles(&loaded));
        assert_eq!(loaded.warnings.len(), 1);
        assert_eq!(loaded.scene.triangles[0].n2, Vec3::Z);
    }
}

#[test]
fn positions_may_have_two_coordinates() {
    let text = edited("0 0 0  1 0 0  1 1 0  0 1 0", "0 0  1 0  1 1  0 1")
        .replace("count=\"12\"", "count=\"8\"")
        .replace("stride=\"3\"", "stride=\"2\"")
        .replace("<param name=\"Z\"/>", "");
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(titles(&loaded), ["<accessor> reads two numbers per entry"]);
    assert_eq!(loaded.scene.triangles, read(SMALL).triangles);
}

#[test]
fn accessors_without_a_stride_or_names_read_three_numbers() {
    for (from, to) in [
        (" stride=\"3\"", ""),
        (
            "<param name=\"X\"/><param name=\"Y\"/><param name=\"Z\"/>",
            "<param type=\"float\"/><param type=\"float\"/><param type=\"float\"/>",
        ),
    ] {
        assert_eq!(read(&edited(from, to)), read(SMALL), "{to}");
    }
}

#[test]
fn the_polygons_of_a_polylist_may_be_in_several_lists() {
    let text = edited(
        "<triangles material=\"paint\" count=\"2\">",
        "<polylist material=\"paint\" count=\"2\"><vcount>3 3</vcount>",
    )
    .replace("</triangles>", "</polylist>")
    .replace("<p>0 1 2 0 2 3</p>", "<p>0 1 2 0</p><p/><p>2 3</p>");
    assert_eq!(read(&text), read(SMALL));
}

#[test]
fn indices_out_of_range_are_found_in_every_list() {
    let error = load_edited("<p>0 1 2 0 2 3</p>", "<p>0 1 2</p>\n<p/><p>0 2 9</p>").unwrap_err();
    assert_eq!(error.0.line_and_column(), Some((37, 12)), "{error}");
}

#[test]
fn holes_outside_of_their_polygon_are_ignored() {
    let text = edited("count=\"12\">", "count=\"21\">5 5 0 6 5 0 6 6 0 ")
        .replace("count=\"4\"", "count=\"7\"")
        .replace(
            "<triangles material=\"paint\" count=\"2\">",
            "<polygons material=\"paint\" count=\"1\">",
        )
        .replace("</triangles>", "</polygons>")
        .replace(
            "<p>0 1 2 0 2 3</p>",
            "<ph><p>3 4 5 6</p><h>0 1 2</h><h>0 1</h></ph>",
        );
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(titles(&loaded), ["holes outside of their polygon: 1"]);
    assert_eq!(loaded.scene.triangles, read(SMALL).triangles);
}

#[test]
fn meshes_without_primitives_are_empty() {
    let mesh =
        "<geometry id=\"none\"><mesh><source id=\"s\"/></mesh></geometry><geometry id=\"ball\">";
    let text = edited("<geometry id=\"ball\">", mesh).replace(
        "<node id=\"lamp-node\">",
        "<node id=\"lamp-node\"><instance_geometry url=\"#none\"/>",
    );
    assert_eq!(read(&text), read(SMALL));
}

#[test]
fn shears_move_points_along_the_first_axis() {
    // A shear of x by y, as Maya writes it.
    let text = edited(
        "<matrix>1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1</matrix>",
        "<skew>45 2 0 0 0 3 0</skew>",
    );
    let points = read(&text).triangles[0];
    for (found, expected) in [
        (points.p0, Vec3::ZERO),
        (points.p1, Vec3::X),
        (points.p2, Vec3::new(2.0, 1.0, 0.0)),
    ] {
        assert!(found.distance(expected) < 1e-15, "{found}");
    }
}

/// The small file whose square is an instance of this controller, under a node at (0, 0, 2).
fn controlled(controllers: &str) -> Result<Loaded, scenes::SceneError> {
    let text = edited("0 0 1 0  0 0 0 1", "0 0 1 2  0 0 0 1")
        .replace(
            "<library_visual_scenes>",
            &format!(
                "<library_controllers>{controllers}</library_controllers><library_visual_scenes>"
            ),
        )
        .replace(
            "<instance_geometry url=\"#square\">",
            "<instance_controller url=\"#first\">",
        )
        .replacen("</instance_geometry>", "</instance_controller>", 1);
    scenes::parse("small.dae", &text)
}

#[test]
fn skins_of_morphs_are_followed_to_the_mesh() {
    let loaded = controlled(
        "<controller id=\"first\"><skin source=\"#second\"/></controller>\
         <controller id=\"second\"><morph source=\"#square\"/></controller>",
    );
    let loaded = loaded.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        titles(&loaded),
        [
            "<skin> does not deform its mesh",
            "<morph> does not deform its mesh"
        ]
    );
    // Without <bind_shape_matrix>, a skin is in the coordinates of the visual scene.
    assert_eq!(loaded.scene.triangles, read(SMALL).triangles);
}

#[test]
fn controllers_without_a_mesh_are_left_out_or_an_error() {
    for cycle in [
        "<controller id=\"first\"/>",
        "<controller id=\"first\"><morph source=\"#first\"/></controller>",
    ] {
        let loaded = controlled(cycle).unwrap_or_else(|e| panic!("{e}"));
        let last = loaded.warnings.last().expect("a warning");
        assert_eq!(last.0.title(), "<controller id=\"first\"> has no mesh");
        assert!(loaded.scene.triangles.is_empty());
    }
    let missing = controlled("<controller id=\"first\"><skin source=\"#none\"/></controller>");
    let title = "there is no <geometry> with the id `none`";
    assert_eq!(missing.unwrap_err().0.title(), title);
}

#[test]
fn old_versions_are_refused_with_advice() {
    let text = "<COLLADA version=\"1.3.1\"><library type=\"GEOMETRY\"/><scene id=\"s\"/></COLLADA>";
    let error = scenes::parse("small.dae", text).unwrap_err();
    let help = error.0.what_to_do().expect("advice");
    assert!(
        help.contains("versions before 1.4 are not supported"),
        "{help}"
    );
}
