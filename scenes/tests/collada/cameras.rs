//! Cameras that cannot be used. They are left out, with one warning, and the scene is framed.

use crate::collada::small::{SMALL, edited, load_edited};
use kit::{FilmSize, Scene};
use scenes::placement;

const FILM: FilmSize = FilmSize { w: 480, h: 360 };

const LEFT_OUT: &str = "the camera is left out: without another one, the scene is framed";

/// Checks that the scene has no camera but everything else, and one warning with this title and
/// `what_to_do`.
fn assert_left_out(from: &str, to: &str, title: &str) {
    let loaded = load_edited(from, to).unwrap_or_else(|e| panic!("{e}"));
    let found: Vec<&str> = loaded.warnings.iter().map(|w| w.0.title()).collect();
    assert_eq!(found, [title]);
    let warning = &loaded.warnings[0];
    assert_eq!(warning.0.what_to_do(), Some(LEFT_OUT));
    assert!(warning.0.line_and_column().is_some());
    let whole = scenes::parse("small.dae", SMALL).expect("valid").scene;
    let expected = Scene {
        camera: None,
        ..whole
    };
    assert_eq!(loaded.scene, expected);
    let view = placement::place(&loaded.scene, FILM);
    assert_eq!(view.target, expected.bounds().centroid());
    let diagonal = expected.bounds().extent().length();
    let distance = view.camera.pos.distance(view.target);
    assert!((distance - 1.5 * diagonal).abs() < 1e-12);
}

#[test]
fn cameras_with_an_invalid_transform_are_left_out() {
    let place = "<translate>0 0 5</translate>";
    // A number is missing in the middle: which one cannot be known.
    assert_left_out(
        place,
        "<matrix>-1 0 0 0  0 0 1 3  0 0 0  0 0 0 1</matrix>",
        "<matrix> has 15 numbers",
    );
    assert_left_out(
        place,
        "<matrix>1 0 0 0  0 1 0 0  0 0 1 0  0 0 5 1</matrix>",
        "the last row of <matrix> is not 0 0 0 1",
    );
    assert_left_out(
        place,
        "<translate>0 0 nan</translate>",
        "a number in <translate> is NaN",
    );
    assert_left_out(
        place,
        "<lookat>1 1 1  1 1 1  0 1 0</lookat>",
        "<lookat> has no valid direction: the camera is at its target, so it has no viewing direction: move one of them",
    );
}

#[test]
fn cameras_in_nodes_of_an_invalid_node_are_left_out() {
    assert_left_out(
        "<translate>0 0 5</translate><instance_camera url=\"#cam\"/>",
        "<scale>1 2</scale><node><instance_camera url=\"#cam\"/></node><node/>",
        "<scale> has 2 numbers",
    );
}

#[test]
fn cameras_without_a_valid_angle_of_view_are_left_out() {
    let title = "<perspective> has no angle of view";
    assert_left_out("<xfov>50</xfov>", "", title);
    assert_left_out(
        "url=\"#cam\"",
        "url=\"#can\"",
        "there is no <camera> with the id `can`",
    );
    let loaded = load_edited("<xfov>50</xfov>", "<xfov>0</xfov>").unwrap();
    let found: Vec<&str> = loaded.warnings.iter().map(|w| w.0.title()).collect();
    assert_eq!(found, ["xfov is 0", title]);
    assert_eq!(loaded.scene.camera, None);
}

#[test]
fn another_camera_of_the_file_is_used_instead() {
    let text = edited(
        "<node id=\"cam-node\">",
        "<node id=\"bad\"><matrix>1 0 0 0  0 1 0 0  0 0 1  0 0 0 1</matrix><instance_camera url=\"#cam\"/></node>\
         <node id=\"cam-node\">",
    );
    let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.warnings.len(), 1);
    assert_eq!(
        loaded.scene,
        scenes::parse("small.dae", SMALL).unwrap().scene
    );
}

#[test]
fn an_invalid_transform_of_anything_else_is_an_error() {
    let matrix = "<matrix>1 0 0 0  0 1 0 0  0 0 1  0 0 0 1</matrix>";
    for place in [
        "<translate>3 0 0</translate>",
        "<translate>0 5 0</translate>",
    ] {
        let error = load_edited(place, matrix).expect_err("a sphere or a light is misplaced");
        assert_eq!(error.0.title(), "<matrix> has 15 numbers");
    }
}

#[test]
fn an_invalid_angle_is_ignored_if_the_other_one_is_valid() {
    let yfov = "<xfov>400</xfov><yfov>40</yfov>";
    let camera = load_edited("<xfov>50</xfov>", yfov).unwrap().scene.camera;
    assert_eq!(camera.expect("a camera").v_fov, 40.0);
    let far = load_edited("<zfar>100", "<zfar>0").unwrap().scene.camera;
    assert_eq!(far.expect("a camera").f_clip, placement::FAR_AWAY);
}
