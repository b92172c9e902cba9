//! Textures: their image files and texture coordinates.

use crate::collada::small::SMALL;
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

/// The file with a second set of texture coordinates, which begins at (5, 5), and with `binding`
/// inside of its `<instance_material>`.
fn with_two_sets(texcoord: &str, binding: &str) -> String {
    let source = "<source id=\"uv1\"><float_array id=\"uv1-array\" count=\"8\">5 5 6 5 6 6 5 6</float_array>\
                  <technique_common><accessor source=\"#uv1-array\" count=\"4\" stride=\"2\">\
                  <param name=\"S\"/><param name=\"T\"/></accessor></technique_common></source>";
    let input = "<input semantic=\"TEXCOORD\" source=\"#uv\" offset=\"1\"/>";
    let inputs = "<input semantic=\"TEXCOORD\" source=\"#uv\" offset=\"1\" set=\"0\"/>\
                  <input semantic=\"TEXCOORD\" source=\"#uv1\" offset=\"1\" set=\"1\"/>";
    let bound = format!("target=\"#red\">{binding}</instance_material>");
    textured(PARAMETERS, "t", IMAGES)
        .replace("texcoord=\"UV\"", &format!("texcoord=\"{texcoord}\""))
        .replace("<vertices id", &format!("{source}<vertices id"))
        .replace(input, inputs)
        .replace("target=\"#red\"/>", &bound)
}

#[test]
fn the_set_of_texture_coordinates_is_that_of_the_binding() {
    let bind = |semantic: &str, set: &str| {
        format!(
            "<bind_vertex_input semantic=\"{semantic}\" input_semantic=\"TEXCOORD\" input_set=\"{set}\"/>"
        )
    };
    let second = Vec2::new(6.0, 5.5);
    let first = Vec2::new(2.0, 0.5);
    let unbound = "the mesh has 2 sets of texture coordinates";
    for (texcoord, binding, expected, warning) in [
        ("UV", bind("UV", "1"), second, None),
        ("UV", bind("UV", "0"), first, None),
        ("UV", bind("OTHER", "0") + &bind("UV", "1"), second, None),
        ("UV", bind("OTHER", "1"), first, Some(unbound)),
        ("UV", String::new(), first, Some(unbound)),
        (
            "UV",
            bind("UV", "7"),
            first,
            Some("the mesh has no set 7 of texture coordinates"),
        ),
        ("CHANNEL1", String::new(), second, None),
        ("CHANNEL0", String::new(), first, None),
    ] {
        let text = with_two_sets(texcoord, &binding);
        let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(middle(&loaded.scene, 0), expected, "{texcoord} {binding}");
        let titles: Vec<&str> = loaded.warnings.iter().map(|w| w.0.title()).collect();
        assert_eq!(titles.first().copied(), warning, "{texcoord} {binding}");
    }
}

const TWO_IMAGES: &str = "<library_images><image id=\"tiles\"><init_from>a.png</init_from></image>\
                          <image id=\"other\"><init_from>b.png</init_from></image></library_images>";

/// `<setparam>` replaces the surface, or the sampler.
#[test]
fn parameters_of_the_instance_choose_the_image() {
    let sampler = "<newparam sid=\"s2\"><surface type=\"2D\"><init_from>other</init_from></surface></newparam>";
    for (parameters, set) in [
        (
            PARAMETERS.to_owned(),
            "<setparam ref=\"s\"><surface type=\"2D\"><init_from>other</init_from></surface></setparam>",
        ),
        (
            format!("{sampler}{PARAMETERS}"),
            "<setparam ref=\"t\"><sampler2D><source>s2</source></sampler2D></setparam>",
        ),
    ] {
        let instance = format!("<instance_effect url=\"#red-effect\">{set}</instance_effect>");
        let text = textured(&parameters, "t", TWO_IMAGES)
            .replace("<instance_effect url=\"#red-effect\"/>", &instance);
        assert_eq!(read(&text).textures.files, ["b.png"]);
    }
}

#[test]
fn every_way_to_name_an_image_is_read_or_refused_by_name() {
    let surface = |init: &str| PARAMETERS.replace("<init_from>tiles</init_from>", init);
    for init in [
        "<init_planar><all ref=\"tiles\"/></init_planar>",
        "<init_from mip=\"0\">tiles</init_from>",
    ] {
        assert_eq!(
            read(&textured(&surface(init), "t", IMAGES)).textures.files,
            ["my tiles.png"]
        );
    }
    let sampler =
        "<newparam sid=\"t\"><sampler2D><instance_image url=\"#tiles\"/></sampler2D></newparam>";
    let image = |inside: &str| {
        format!("<library_images><image id=\"tiles\">{inside}</image></library_images>")
    };
    let file = "<init_from><ref>a.png</ref></init_from>";
    let created = image(&format!(
        "<create_2d><size_ratio width=\"1\" height=\"1\"/>{file}</create_2d>"
    ));
    for images in [
        image(&format!("<renderable share=\"true\"/>{file}")),
        created,
    ] {
        assert_eq!(
            read(&textured(sampler, "t", &images)).textures.files,
            ["a.png"]
        );
    }
    let refused = |parameters: &str, images: &str, title: &str| {
        let text = textured(parameters, "t", images);
        let loaded = scenes::parse("small.dae", &text).unwrap_or_else(|e| panic!("{e}"));
        let titles: Vec<&str> = loaded.warnings.iter().map(|w| w.0.title()).collect();
        assert_eq!(titles, [title]);
        assert!(loaded.scene.textures.files.is_empty());
    };
    let cube = "the texture `t` is a cube map";
    refused(
        &surface("<init_cube><all ref=\"tiles\"/></init_cube>"),
        IMAGES,
        cube,
    );
    refused(&PARAMETERS.replace("\"2D\"", "\"CUBE\""), IMAGES, cube);
    refused(
        &PARAMETERS.replace("sampler2D", "samplerCUBE"),
        IMAGES,
        cube,
    );
    refused(
        sampler,
        &image(&format!("<create_cube>{file}</create_cube>")),
        cube,
    );
    refused(
        &surface("<init_volume><all ref=\"tiles\"/></init_volume>"),
        IMAGES,
        "the texture `t` is a volume",
    );
    refused(
        PARAMETERS,
        &image("<data>89504e47</data>"),
        "the texture `t` is inside of the scene file",
    );
    refused(
        sampler,
        &image("<init_from><hex format=\"PNG\">8950</hex></init_from>"),
        "the texture `t` is inside of the scene file",
    );
    refused(
        &surface("<init_as_null/>"),
        IMAGES,
        "the texture `t` is made by a program",
    );
}
