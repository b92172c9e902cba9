//! The `pathtracer` program, for scenes with light.

use crate::common::{folder_of, own_scenes, run, square};
use exr::prelude::{ReadChannels, ReadLayers};
use std::fs;
use std::path::Path;

/// A grey square under an area light without a mesh.
fn scene() -> String {
    let light = r##"<library_lights><light id="lamp" name="lamp">
    <technique_common><point><color>5 5 5</color></point></technique_common>
    <extra><technique profile="CGL"><area><color>5 5 5</color></area></technique></extra>
  </light></library_lights>"##;
    let above = r##"<node id="above"><translate>1.4 1.4 2</translate><instance_light url="#lamp"/></node>"##;
    square(light, above)
}

fn folder() -> tempfile::TempDir {
    folder_of("lit.dae", &scene())
}

/// Runs the program. Returns its stdout and stderr.
fn pathtracer(folder: &Path, args: &str) -> (String, String) {
    let (code, out, notes) = run(folder, args);
    assert_eq!(code, 0, "{notes}");
    (out, notes)
}

/// A lamp without a mesh has a surface of two triangles, of which normals show nothing.
#[test]
fn the_summary_counts_the_primitives_that_are_rendered() {
    let folder = folder();
    for (flags, count) in [("", 4), ("--shade normals", 2)] {
        let flags = format!("-f a.png -r 4 4 --accel bvh {flags} lit.dae");
        let (output, _) = pathtracer(folder.path(), &flags);
        for line in [
            format!("dae: {count} primitives"),
            format!("over {count} primitives"),
        ] {
            assert!(output.contains(&line), "{output}");
        }
    }
}

/// Large enough for several blocks of each format.
#[test]
fn the_same_command_writes_the_same_bytes() {
    let folder = folder();
    let run = |name: &str| {
        pathtracer(
            folder.path(),
            &format!("-f {name} -r 200 150 -s 2 -t 2 --layers layers.exr lit.dae"),
        );
        [name, "layers.exr"].map(|name| fs::read(folder.path().join(name)).expect("a picture"))
    };
    for name in ["a.png", "a.hdr", "a.exr"] {
        let first = run(name);
        for _ in 0..4 {
            assert!(run(name) == first, "{name} or its layers differ");
        }
    }
}

fn refused(args: &str, sentence: &str) {
    let folder = folder();
    let (code, _, output) = run(folder.path(), args);
    assert_eq!(code, 2, "`{args}` prints:\n{output}");
    assert!(output.contains(sentence), "`{args}` prints:\n{output}");
}

#[test]
fn errors_name_the_allowed_values() {
    refused("-f a.png --time 0 lit.dae", "a finite number above 0");
    refused("-f a.png --error x lit.dae", "a finite number above 0");
    refused("-f a.png --error 0.1 -a 8 0.1 lit.dae", "--adaptive");
    let flags = "-f a.png -r 4 4 -m 2 --reuse-paths --accel bvh lit.dae";
    refused(flags, "only paths in packets do this: use --accel simd");
    refused("-f a.png --time inf lit.dae", "a finite number above 0");
    refused("-f a.png --error inf lit.dae", "a finite number above 0");
    refused("-f a.png --lens-radius 0.1 lit.dae", "--focus");
    refused("-f a.png --focus inf --lens-radius 1 lit.dae", "finite");
    refused("-f a.png -a 8 inf lit.dae", "a finite number");
    refused("-f a.png --lens-radius -1 --focus 2 lit.dae", "at least 0");
    refused("-f a.png --lens-radius 1 --focus 0 lit.dae", "above 0");
    refused("-f a.png --layers b.png lit.dae", "ends in .exr");
    refused(
        "-f a.exr --layers ./a.exr lit.dae",
        "--layers: ./a.exr is also the picture",
    );
    refused(
        "-f a.exr -e a.exr lit.dae",
        "-f: a.exr is also the map of -e",
    );
    refused("--export mitsuba a.xml a.xml", "a.xml is also the scene");
    refused("-f a.png -e lit.dae lit.dae", "ends in .exr or .hdr");
    refused("-f a.png -e missing.hdr lit.dae", "missing.hdr");
    refused("-f a.png -H --mis lit.dae", "--mis");
    refused("-f a.png --exposure bright lit.dae", "from -64 to 64");
    refused("-f a.png --tone film lit.dae", "assignment, filmic, agx");
    refused("-f a.png --rate-scale assignment lit.dae", "--adaptive");
    refused(
        "-f a.png --sampler stars lit.dae",
        "independent, stratified, sobol",
    );
}

#[test]
fn scenes_with_light_are_lit_by_default() {
    let folder = folder();
    let shown = |flags: &str| {
        pathtracer(folder.path(), &format!("-f a.exr -r 31 31 {flags} lit.dae"));
        let picture = image::open(folder.path().join("a.exr")).expect("a picture");
        picture.into_rgb32f().get_pixel(15, 15).0
    };
    let [r, g, b] = shown("-s 64");
    assert!(r == g && g == b && r > 0.01, "grey under a white lamp: {r}");
    assert_eq!(shown("-m 0"), [0.0; 3]);
    assert_eq!(shown("--shade normals"), [0.5, 0.5, 1.0]);
}

/// The picture without flags is that of `sobol4`, a roulette of 4 and 8 rays at the edges of lamps,
/// for every way to trace.
#[test]
fn the_defaults_reduce_noise() {
    let folder = folder();
    let scene = "cornell_spheres.dae";
    fs::copy(own_scenes().join(scene), folder.path().join(scene)).expect("a copy");
    let bytes = |flags: &str| {
        let flags = format!("-f a.exr -r 24 18 -s 16 -m 12 {flags} {scene}");
        pathtracer(folder.path(), &flags);
        fs::read(folder.path().join("a.exr")).expect("a picture")
    };
    let default = bytes("");
    assert!(default == bytes("--sampler sobol4 --roulette 4 --lamp-rays 8"));
    assert!(default == bytes("--accel bvh -t 1"));
    for old in ["--sampler sobol", "--roulette 1", "--lamp-rays 1"] {
        assert!(default != bytes(old), "{old}");
    }
    let direct = format!("-f a.exr -r 24 18 -s 16 -m 1 --stats {scene}");
    let (output, _) = pathtracer(folder.path(), &direct);
    assert!(output.contains(" 0 bounce rays, "), "{output}");
    assert!(!output.contains(" 0 at edges"), "{output}");
}

#[test]
fn an_adaptive_picture_has_a_file_of_sample_counts() {
    let folder = folder();
    let flags = "-f a.png -r 20 20 -s 1024 -a 64 0.1 --explain --stats lit.dae";
    let (output, _) = pathtracer(folder.path(), flags);
    assert!(output.contains("a_rate.png"), "{output}");
    assert!(output.contains("object above"), "{output}");
    assert!(output.contains("million samples per second"), "{output}");
    let rate = || {
        let picture = image::open(folder.path().join("a_rate.png")).expect("a picture");
        picture.into_rgb8()
    };
    // The wall needs about a quarter of the samples, and the background one batch, since nothing is
    // there. Beside the wall, where its edge may be seen, black is never enough: yellow, on top of
    // the legend.
    let is_shown = |picture: &image::RgbImage, colour: [u8; 3]| {
        let mut pixels = picture.enumerate_pixels();
        pixels.any(|(_, y, pixel)| y < 20 && pixel.0 == colour)
    };
    let safe = rate();
    assert!(safe.height() > 20 && safe.width() > 20, "no legend");
    let [r, g, b] = safe.get_pixel(10, 10).0;
    assert!(b > r && b > 100, "{r} {g} {b}");
    let [r, g, b] = safe.get_pixel(0, 0).0;
    assert!(r < 80 && g < 30 && b < 110, "{r} {g} {b}");
    assert!(is_shown(&safe, [253, 231, 37]));

    pathtracer(folder.path(), &format!("--rate-scale assignment {flags}"));
    let assignment = rate();
    assert_eq!(assignment.dimensions(), (20, 20));
    let [_, _, b] = assignment.get_pixel(10, 10).0;
    assert!(b > 100, "{b}");
    let [r, _, b] = assignment.get_pixel(0, 0).0;
    assert!(b > 200 && r == 0, "{r} {b}");
    assert!(is_shown(&assignment, [255, 0, 0]));
}

/// A stop more exposure is brighter; the other curves are other bytes of the same picture.
#[test]
fn exposure_and_tone_change_the_bytes_only() {
    let folder = folder();
    let center = |flags: &str| {
        let args = format!("-f a.png -r 21 21 -s 16 {flags} lit.dae");
        let (_, notes) = pathtracer(folder.path(), &args);
        assert_eq!(notes, "", "{flags}");
        let picture = image::open(folder.path().join("a.png")).expect("a picture");
        picture.into_rgb8().get_pixel(10, 10).0[0]
    };
    let plain = center("-t 1");
    assert_eq!(center("--exposure 0 --tone assignment"), plain);
    let brighter = center("--exposure 1");
    assert!(brighter > plain && center("--exposure -1") < plain);
    assert!(center("--tone filmic") != plain && center("--tone agx") != plain);
    let (_, notes) = pathtracer(
        folder.path(),
        "-f a.exr -r 4 4 --tone agx --exposure 1 lit.dae",
    );
    assert!(notes.contains("no effect: --exposure --tone"), "{notes}");
}

/// The wall is diffuse: a mirror is not called for, so it counts operations only if forced on.
#[test]
fn explain_counts_the_operations_of_forced_effects() {
    let folder = folder();
    let (output, _) = pathtracer(
        folder.path(),
        "-f a.png -r 20 20 -s 4 -m 2 --explain lit.dae",
    );
    let line = |effect: &str| -> Vec<String> {
        let line = output.lines().find(|line| line.starts_with(effect));
        let columns = line.unwrap_or_else(|| panic!("no {effect} in\n{output}"));
        columns.split_whitespace().map(str::to_owned).collect()
    };
    let mirror = line("mirror");
    assert_eq!(mirror[1..3], ["no", "0"]);
    assert!(mirror[3].parse::<u64>().unwrap() > 0, "{output}");
    let lens = line("lens");
    assert_eq!(lens[1..4], ["no", "0", "1600"], "one for each camera ray");
    assert!(!output.contains("Clamp") && !output.contains("Terminator"));
}

/// The wall is flat, and light meets it once.
#[test]
fn explain_measures_what_flags_cost() {
    let folder = folder();
    let flags = "-f a.png -r 20 20 -s 4 -m 2 --clamp 0.01 --soft-terminator --explain lit.dae";
    let (output, _) = pathtracer(folder.path(), flags);
    let clamp = "Clamp       --clamp 0.01 removed a luminance of 0.000000 from the mean of 0.";
    assert!(output.contains(clamp), "{output}");
    let terminator = output
        .lines()
        .find(|line| line.starts_with("Terminator  soft:"));
    let terminator = terminator.unwrap_or_else(|| panic!("{output}"));
    assert!(
        terminator.contains(": 0.000 % of the light is missing"),
        "{terminator}"
    );
}

#[test]
fn flags_and_lights_without_effect_are_noted() {
    let folder = folder();
    let (output, notes) = pathtracer(folder.path(), "-f a.png -r 4 4 -H --lens-radius 0 lit.dae");
    assert_eq!(notes, "");
    assert!(
        !output.contains("Noise"),
        "one sample has no noise estimate: {output}"
    );
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 -a 32 0.05 lit.dae");
    assert!(output.contains("no effect: -a 32 0.05"), "{output}");
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 --clamp 2 lit.dae");
    assert!(output.contains("no effect: --clamp 2: -m 1"), "{output}");
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 --reuse-paths lit.dae");
    assert!(
        output.contains("no effect: --reuse-paths: -m 1"),
        "{output}"
    );
    let (_, output) = pathtracer(
        folder.path(),
        "-f a.png -r 4 4 -m 2 --guide-caustics lit.dae",
    );
    assert!(
        output.contains("no effect: --guide-caustics: with -m 2 no mirror"),
        "{output}"
    );
    let flags = "-f a.png --export mitsuba a.xml lit.dae";
    let (_, output) = pathtracer(folder.path(), flags);
    assert!(output.contains("no effect: -f: --export"), "{output}");
    let point = scene().replace("area>", "point>");
    fs::write(folder.path().join("point.dae"), point).expect("a scene file");
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 -H point.dae");
    assert!(output.contains("-H never hits them"), "{output}");
    let glass = scene().replace(
        "</profile_COMMON></effect>",
        "</profile_COMMON><extra><technique profile=\"CGL\"><glass><reflectance>1 1 1</reflectance>\
         <transmittance>1 1 1</transmittance><roughness>0.005</roughness><ior>1.5</ior></glass>\
         </technique></extra></effect>",
    );
    fs::write(folder.path().join("glass.dae"), glass).expect("a scene file");
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 glass.dae");
    assert!(
        output.contains("is nearly smooth: without --mis"),
        "{output}"
    );
    let (_, output) = pathtracer(folder.path(), "-f a.png -r 4 4 --mis glass.dae");
    assert!(!output.contains("nearly smooth"), "{output}");
}

/// The lamp of the scene, and lamps of other units.
#[test]
fn a_picture_in_which_nothing_is_seen_has_a_note() {
    let folder = folder();
    let notes = |lamp: &str, args: &str| {
        let scene = scene().replace("5 5 5", lamp);
        fs::write(folder.path().join("lamp.dae"), scene).expect("a scene file");
        let args = format!("-f a.png -r 20 20 -s 4 {args} lamp.dae");
        pathtracer(folder.path(), &args).1
    };
    assert_eq!(notes("5 5 5", ""), "");
    assert_eq!(notes("0.0005 0.0005 0.0005", "--shade normals"), "");
    for (lamp, name) in [
        ("0.0005 0.0005 0.0005", "black"),
        ("50000 50000 50000", "white"),
    ] {
        let note = notes(lamp, "");
        let (before, exposure) = note.split_once("--exposure ").expect("a proposal");
        assert!(before.contains(&format!("nearly {name}")), "{note}");
        let exposure = exposure.trim().trim_matches('`');
        assert_eq!(notes(lamp, &format!("--exposure {exposure}")), "");
    }
    assert!(notes("5 5 5", "-m 0").contains("black: `-m 0` shows lamps only"));
    let camera = "50 35 1.33 0.1 100\n0 0 9 0 0 10\n0 0 1 0.1 100\n1 0 0 0 -1 0 0 0 -1\n20 20 30\n";
    fs::write(folder.path().join("away.txt"), camera).expect("a camera file");
    let note = notes("5 5 5", "--shade normals -c away.txt");
    assert!(
        note.contains("no ray of the camera hits anything"),
        "{note}"
    );
}

#[test]
fn time_and_error_limits_end_a_picture() {
    let folder = folder();
    let noise = |output: &str| -> f64 {
        let line = output.lines().find(|line| line.starts_with("Noise"));
        let words = line.expect("a line with the noise").split_whitespace();
        let mut numbers = words.filter_map(|word| word.parse().ok());
        numbers.next().expect("a number")
    };
    let (rough, _) = pathtracer(folder.path(), "-f a.png -r 20 20 -s 4 lit.dae");
    let flags = "-f a.png -r 20 20 -s 4 --error 0.03 lit.dae";
    let (fine, _) = pathtracer(folder.path(), flags);
    assert!(noise(&rough) > 3.0 && noise(&fine) <= 3.0, "{rough}{fine}");
    pathtracer(folder.path(), "-f a.png -r 8 8 --time 0.01 lit.dae");
    // What the variance of the samples tells is more than the noise, unless they are independent.
    assert!(rough.contains("Noise       at most "), "{rough}");
    let flags = "-f a.png -r 20 20 -s 4 --sampler independent lit.dae";
    let (independent, _) = pathtracer(folder.path(), flags);
    assert!(!independent.contains("at most"), "{independent}");
}

#[test]
fn layers_have_the_features_of_the_first_hit() {
    let folder = folder();
    pathtracer(
        folder.path(),
        "-f a.hdr --layers b.exr -r 20 20 -s 8 lit.dae",
    );
    let picture = image::open(folder.path().join("a.hdr")).expect("a picture");
    assert!(picture.into_rgb32f().get_pixel(10, 10).0[0] > 0.01);
    let file = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(folder.path().join("b.exr"))
        .expect("layers");
    let center = 10 * 20 + 10;
    let value = |name: &str| {
        let mut channels = file.layer_data.channel_data.list.iter();
        let channel = channels.find(|c| c.name.eq(name)).expect(name);
        channel.sample_data.value_by_flat_index(center).to_f32()
    };
    assert_eq!(value("albedo.G"), 0.5);
    assert_eq!(value("normal.Z"), 1.0);
    assert!(value("depth.Z") > 1.0 && value("variance.Y") > 0.0 && value("R") > 0.01);
    assert!(value("primitive.id") < 2.0);
}

#[test]
fn a_scene_is_exported_for_mitsuba() {
    let folder = folder();
    let (output, _) = pathtracer(
        folder.path(),
        "--export mitsuba out.xml -r 40 30 -m 3 lit.dae",
    );
    assert!(
        output.contains("out.xml") && output.contains("out.0.ply"),
        "{output}"
    );
    let xml = fs::read_to_string(folder.path().join("out.xml")).expect("the scene");
    let file = roxmltree::Document::parse(&xml).expect("well-formed");
    let count = |kind: &str| {
        let of_kind = |n: &roxmltree::Node| n.attribute("type") == Some(kind);
        file.descendants().filter(of_kind).count()
    };
    assert_eq!(
        (count("ply"), count("area"), count("perspective")),
        (2, 1, 1)
    );
    assert!(xml.contains("name=\"max_depth\" value=\"4\""));
    assert!(xml.contains("<sampler type=\"multijitter\">"), "{xml}");
    let mesh = fs::read_to_string(folder.path().join("out.0.ply")).expect("a mesh");
    assert!(mesh.contains("element vertex 6") && mesh.ends_with("3 3 4 5\n"));
    refused("--export blender a.xml lit.dae", "use --export mitsuba");
    refused("--export mitsuba a.txt lit.dae", "ends in .xml");
    refused(
        "--export mitsuba a.xml -r 40 30 -e missing.exr lit.dae",
        "omit -e",
    );
    let flags = "--export mitsuba out.xml -r 40 30 -p 0 0 4 4 -H -a 8 0.1 -l 4 lit.dae";
    let (_, output) = pathtracer(folder.path(), flags);
    assert!(
        output.contains("no effect: -p -l -a -H: --export"),
        "{output}"
    );
    refused(
        "--export mitsuba a.xml -r 40 30 --lens-radius 1 --focus 2 lit.dae",
        "omit --lens-radius",
    );
}

#[test]
fn an_export_says_where_mitsuba_means_another_depth() {
    let folder = folder();
    let mirror = scene().replace(
        "</profile_COMMON></effect>",
        "</profile_COMMON><extra><technique profile=\"CGL\"><mirror><reflectance>1 1 1</reflectance>\
         </mirror></technique></extra></effect>",
    );
    fs::write(folder.path().join("mirror.dae"), mirror).expect("a scene file");
    let warned = |scene: &str, depth: u32| {
        let args = format!("--export mitsuba out.xml -r 40 30 -m {depth} {scene}");
        let (_, output) = pathtracer(folder.path(), &args);
        output.contains("such as wall, Mitsuba finds emitters one bounce earlier")
    };
    assert!(warned("mirror.dae", 5));
    assert!(!warned("mirror.dae", 100) && !warned("lit.dae", 5));
}

#[test]
fn a_missing_texture_is_grey_with_a_warning() {
    let folder = folder();
    let textured = scene()
        .replace(
            "<color>0.5 0.5 0.5 1</color>",
            "<texture texture=\"wall-image\" texcoord=\"UV\"/>",
        )
        .replace(
            "<library_effects>",
            "<library_images><image id=\"wall-image\"><init_from>wall.png</init_from></image>\
             </library_images><library_effects>",
        );
    fs::write(folder.path().join("textured.dae"), textured).expect("a scene file");
    let picture = |name: &str, scene: &str| {
        let (_, output) = pathtracer(folder.path(), &format!("-f {name} -r 8 8 {scene}"));
        (
            fs::read(folder.path().join(name)).expect("a picture"),
            output,
        )
    };
    let (grey, output) = picture("grey.png", "lit.dae");
    assert_eq!(output, "");
    let (missing, output) = picture("missing.png", "textured.dae");
    assert!(
        output.contains("cannot read the texture wall.png"),
        "{output}"
    );
    assert!(missing == grey, "a wall without its texture is grey");
    // Any picture serves as the texture.
    fs::copy(
        folder.path().join("grey.png"),
        folder.path().join("wall.png"),
    )
    .expect("a copy");
    let (found, output) = picture("found.png", "textured.dae");
    assert_eq!(output, "");
    assert!(found != grey, "the wall does not show its texture");
    let moved = folder.path().join("WALL.png");
    fs::rename(folder.path().join("wall.png"), &moved).expect("it is renamed");
    let (capital, output) = picture("capital.png", "textured.dae");
    assert!(
        output.contains("there is no texture wall.png; using WALL.png"),
        "{output}"
    );
    assert!(capital == found, "the wall does not show its texture");
    // Targa files have no signature: only the name says what they are.
    fs::remove_file(&moved).expect("it is removed");
    let targa = [&[0, 0, 2][..], &[0; 9], &[1, 0, 1, 0, 24, 0], &[0, 0, 255]].concat();
    fs::write(folder.path().join("wall.tga"), targa).expect("a texture");
    let text = fs::read_to_string(folder.path().join("textured.dae"))
        .expect("the scene")
        .replace("wall.png", "wall.tga");
    fs::write(folder.path().join("targa.dae"), text).expect("a scene file");
    let (targa, output) = picture("targa.png", "targa.dae");
    assert_eq!(output, "");
    assert!(targa != grey, "the wall is not red");
}
