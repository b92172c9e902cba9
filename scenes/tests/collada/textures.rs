//! Textures: their image files and texture coordinates.

use crate::small::SMALL;
use kit::{Hit, PrimId, Scene, Vec2, Vec3};

const COLOR: &str = "<color>0.8 0.1 0.1 1</color>";
const INPUT: &str = "<input semantic=\"VERTEX\" source=\"#square-vertices\" offset=\"0\"/>";

/// The small file with a texture on its square: with these parameters in the effect, an image
/// library, and texture coordinates, which `<p>` indexes in addition to the positions.
fn textured(parameters: &str, texture: &str, images: &str) -> String {
    let source = "<source id=\"uv\"><float_array id=\"uv-array\" count=\"8\">0 0 2 0 2 1 0 1</float_array>\
                  <technique_common><accessor source=\"#uv-array\" count=\"4\" stride=\"2\">\
                  <param name=\"S\"/><param name=\"T\"/></accessor></technique_common></source>";
    let edits = [
        (
            COLOR,
            format!("<texture texture=\"{texture}\" texcoord=\"UV\"/>"),
        ),
        ("<technique sid", format!("{parameters}<technique sid")),
        ("<library_effects>", format!("{images}<library_effects>")),
        ("<vertices id", format!("{source}<vertices id")),
        (
            INPUT,
            format!("{INPUT}<input semantic=\"TEXCOORD\" source=\"#uv\" offset=\"1\"/>"),
        ),
        (
            "<p>0 1 2 0 2 3</p>",
            "<p>0 0 1 1 2 2 0 0 2 2 3 3</p>".to_owned(),
        ),
    ];
    edits.iter().fold(SMALL.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "`{from}` is not in the small file");
        text.replacen(from, to, 1)
    })
}

const PARAMETERS: &str = "<newparam sid=\"s\"><surface type=\"2D\"><init_from>tiles</init_from></surface></newparam>\
                          <newparam sid=\"t\"><sampler2D><source>s</source></sampler2D></newparam>";
const IMAGES: &str = "<library_images><image id=\"tiles\"><init_from>my%20tiles.png</init_from></image></library_images>";

fn read(text: &str) -> Scene {
    let loaded = scenes::parse("small.dae", text).unwrap_or_else(|e| panic!("{e}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    loaded.scene
}

/// The texture coordinates at the midpoint of the edge from the second to the third vertex of
/// triangle `i`.
fn middle(scene: &Scene, i: u32) -> Vec2 {
    let hit = Hit {
        t: 1.0,
        p: Vec3::ZERO,
        n: Vec3::Z,
        ng: Vec3::Z,
        uv: Vec2::splat(0.5),
        prim: PrimId(i),
    };
    scene.textures.uv(&hit).expect("coordinates")
}

#[test]
fn file_is_found_through_sampler_surface_and_image() {
    let scene = read(&textured(PARAMETERS, "t", IMAGES));
    assert_eq!(scene.textures.files, ["my tiles.png"]);
    assert_eq!(scene.textures.of_material(0), Some(0));
    // The first edge is from (2, 0) to (2, 1), the second from (2, 1) to (0, 1).
    assert_eq!(middle(&scene, 0), Vec2::new(2.0, 0.5));
    assert_eq!(middle(&scene, 1), Vec2::new(1.0, 1.0));
}

#[test]
fn file_is_found_in_collada_1_5_and_by_direct_reference() {
    let newer =
        "<newparam sid=\"t\"><sampler2D><instance_image url=\"#tiles\"/></sampler2D></newparam>";
    let by_ref = IMAGES.replace("my%20tiles.png", "<ref>tiles.png</ref>");
    assert_eq!(
        read(&textured(newer, "t", &by_ref)).textures.files,
        ["tiles.png"]
    );
    assert_eq!(
        read(&textured("", "tiles", IMAGES)).textures.files,
        ["my tiles.png"]
    );
}

#[test]
fn mirrored_surfaces_keep_their_texture_coordinates() {
    let text = textured(PARAMETERS, "t", IMAGES);
    let mirrored = text.replace("1 0 0 0  0 1 0 0  0 0 1 0", "-1 0 0 0  0 1 0 0  0 0 1 0");
    let (plain, mirrored) = (read(&text), read(&mirrored));
    for (i, triangle) in mirrored.triangles.iter().enumerate() {
        let corners = [triangle.p0, triangle.p1, triangle.p2];
        for (p, uv) in corners.iter().zip(mirrored.textures.coordinates[i]) {
            let before = Vec3::new(-p.x, p.y, p.z);
            let old = &plain.triangles[i];
            let k = [old.p0, old.p1, old.p2].iter().position(|q| *q == before);
            assert_eq!(
                plain.textures.coordinates[i][k.expect("the same corner")],
                uv
            );
        }
    }
}

#[test]
fn texture_coordinates_are_not_read_without_a_texture() {
    let text = textured(PARAMETERS, "t", IMAGES);
    let plain = text.replace("<texture texture=\"t\" texcoord=\"UV\"/>", COLOR);
    let damaged = plain.replace("0 0 2 0 2 1 0 1", "");
    assert_eq!(read(&damaged).textures, kit::texture::TextureMap::default());
}

/// The scene with one edit that makes its texture coordinates invalid, and the title of its only
/// warning.
fn damaged(from: &str, to: &str) -> (Scene, String) {
    let text = textured(PARAMETERS, "t", IMAGES);
    assert!(text.contains(from), "`{from}` is not in the file");
    let loaded =
        scenes::parse("small.dae", &text.replacen(from, to, 1)).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.warnings.len(), 1, "{:?}", loaded.warnings);
    (loaded.scene, loaded.warnings[0].0.title().to_owned())
}

#[test]
fn invalid_texture_coordinates_are_ignored() {
    let (scene, title) = damaged("count=\"4\" stride=\"2\"", "count=\"4\" stride=\"1\"");
    assert_eq!(title, "<accessor> does not read two numbers per entry");
    assert_eq!(scene.triangles.len(), 2);
    let (scene, title) = damaged("source=\"#uv\"", "source=\"#uvw\"");
    assert_eq!(title, "there is no <source> with the id `uvw`");
    assert_eq!(scene.triangles.len(), 2);
    let (scene, title) = damaged("2 2 3 3</p>", "2 2 3 9</p>");
    assert_eq!(title, "triangles with a texture coordinate out of range: 1");
    assert_eq!(middle(&scene, 0), Vec2::new(2.0, 0.5));
    assert_eq!(middle(&scene, 1), Vec2::ZERO);
    let (scene, title) = damaged("0 0 2 0 2 1 0 1", "0 0 2 0 2 INF 0 1");
    assert_eq!(
        title,
        "`INF` in <float_array id=\"uv-array\"> is not finite"
    );
    assert_eq!(middle(&scene, 0), Vec2::new(2.0, 0.0));
}

#[test]
fn texture_coordinates_may_be_an_input_of_the_vertices() {
    let text = textured(PARAMETERS, "t", IMAGES)
        .replace(
            "<input semantic=\"TEXCOORD\" source=\"#uv\" offset=\"1\"/>",
            "",
        )
        .replace("<p>0 0 1 1 2 2 0 0 2 2 3 3</p>", "<p>0 1 2 0 2 3</p>")
        .replace(
            "source=\"#points\"/></vertices>",
            "source=\"#points\"/><input semantic=\"TEXCOORD\" source=\"#uv\"/></vertices>",
        );
    let scene = read(&text);
    assert_eq!(middle(&scene, 0), Vec2::new(2.0, 0.5));
    assert_eq!(middle(&scene, 1), Vec2::new(1.0, 1.0));
}
