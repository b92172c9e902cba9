//! Models in other formats than COLLADA: glTF, OBJ, PLY. The files are made here.

use kit::{Light, Material, PrimId, Scene, Spectrum, Vec2, Vec3};
use scenes::{Loaded, SceneError};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes files into a folder and reads the first.
fn load(files: &[(&str, &[u8])]) -> Result<Loaded, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    scenes::load(folder.path().join(files[0].0))
}

fn loaded(files: &[(&str, &[u8])]) -> Loaded {
    load(files).unwrap_or_else(|e| panic!("{e}"))
}

fn titles(loaded: &Loaded) -> Vec<&str> {
    loaded.warnings.iter().map(|w| w.0.title()).collect()
}

/// A `.glb` file of this JSON and these bytes.
fn glb(json: &str, bytes: &[u8]) -> Vec<u8> {
    let padded = |mut bytes: Vec<u8>, with: u8| {
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, bytes) = (padded(json.into(), b' '), padded(bytes.to_vec(), 0));
    let length = 12 + 8 + json.len() + 8 + bytes.len();
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// The numbers of the square of [`square`]: positions, texture coordinates, then indices.
fn square_bytes() -> Vec<u8> {
    let positions: [f32; 12] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let coordinates: [f32; 8] = [0., 1., 1., 1., 1., 0., 0., 0.];
    let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
    let floats = positions.iter().chain(&coordinates);
    let mut bytes: Vec<u8> = floats.flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

/// A glTF file with a square, whose node has `node`, and with `more` at its top.
fn square(material: &str, node: &str, more: &str) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"name":"wall","mesh":0{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0}}]}}],
        "materials":[{material}],
        "buffers":[{{"byteLength":92}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
          {{"buffer":0,"byteOffset":80,"byteLength":12}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
          {{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},
          {{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}}]{more}}}"#
    );
    glb(&json, &square_bytes())
}

const RED: &str = r#"{"name":"red","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1],"metallicFactor":0}}"#;

#[test]
fn a_glb_without_camera_and_light_is_framed_and_lit() {
    let file = square(RED, r#","translation":[10,0,0]"#, "");
    let loaded = loaded(&[("a.glb", &file)]);
    assert_eq!(titles(&loaded), [""; 0]);
    let scene = &loaded.scene;
    assert_eq!(scene.triangles.len(), 2);
    assert_eq!(scene.triangles[1].p1, Vec3::new(11.0, 1.0, 0.0));
    // No normals: flat, as the format says.
    assert_eq!(scene.triangles[0].n0, Vec3::Z);
    assert_eq!(scene.objects[0].name, "wall");
    let reflectance = Spectrum::new(0.5, 0.25, 0.125);
    assert_eq!(
        scene.materials[0].material,
        Material::Diffuse { reflectance }
    );
    assert!(loaded.added_light);
    assert!(
        scene
            .lights
            .iter()
            .any(|l| matches!(l.light, Light::Hemisphere { .. }))
    );
    let camera = scene.camera.expect("a camera that frames the scene");
    let center = scene.bounds().centroid();
    let aimed = (center - camera.pos).normalize().dot(-camera.c2w.z_axis);
    assert!((aimed - 1.0).abs() < 1e-12 && camera.pos.y > center.y);
}

/// Each material of glTF, its material here, and what is said about it.
#[test]
fn materials_of_gltf_become_those_of_the_course() {
    let pbr = |factors: &str, more: &str| {
        format!(
            r#"{{"name":"m","pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.5,0.5,1],{factors}}}{more}}}"#
        )
    };
    let reflectance = Spectrum::grey(0.5);
    let cases = [
        (
            pbr(r#""metallicFactor":0.2"#, ""),
            Material::Diffuse { reflectance },
            "",
        ),
        (
            pbr(r#""roughnessFactor":0"#, ""),
            Material::Mirror { reflectance },
            "",
        ),
        (
            pbr(r#""roughnessFactor":0.5"#, ""),
            Material::Glossy {
                reflectance,
                shininess: 30.0,
            },
            "",
        ),
        (
            pbr(
                r#""metallicFactor":0"#,
                r#","emissiveFactor":[1,1,0.5],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}"#,
            ),
            Material::Emission {
                radiance: Spectrum::new(4.0, 4.0, 2.0),
            },
            "lamps that reflect light",
        ),
        (
            pbr(
                r#""metallicFactor":0,"roughnessFactor":0"#,
                r#","extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.25}}"#,
            ),
            Material::Glass {
                reflectance: Spectrum::WHITE,
                transmittance: reflectance,
                roughness: 0.0,
                ior: 1.25,
            },
            "",
        ),
        (
            pbr(r#""metallicFactor":0"#, r#","alphaMode":"MASK""#),
            Material::Diffuse { reflectance },
            "",
        ),
    ];
    for (json, material, warning) in cases {
        let loaded = loaded(&[("a.glb", &square(&json, "", ""))]);
        assert_eq!(loaded.scene.materials[0].material, material, "{json}");
        assert_eq!(titles(&loaded).join(", "), warning, "{json}");
        assert_eq!(loaded.added_light, material.emission().is_black());
    }
}

/// An image in the file, one beside it, and texture coordinates whose v points down.
#[test]
fn textures_of_gltf_are_found() {
    let material =
        r#"{"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}}}"#;
    let more = |image: &str| format!(r#","textures":[{{"source":0}}],"images":[{image}]"#);
    let beside = square(material, "", &more(r#"{"uri":"my%20tiles.png"}"#));
    let scene = loaded(&[("a.glb", &beside)]).scene;
    assert_eq!(scene.textures.files, ["my tiles.png"]);
    let absolute = square(material, "", &more(r#"{"uri":"file:///a/my%20tiles.png"}"#));
    let scene_of_uri = loaded(&[("a.glb", &absolute)]).scene;
    assert_eq!(scene_of_uri.textures.files, ["/a/my tiles.png"]);
    assert_eq!(scene.textures.of_material(0), Some(0));
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE];
    assert_eq!(scene.textures.coordinates[0], corners);
    for image in [
        r#"{"bufferView":2,"mimeType":"image/png"}"#,
        r#"{"uri":"data:image/png;base64,AAABAAIAAAACAAMA"}"#,
        r#"{"uri":"Data:image/png;base64,AAABAAIAAAACAAMA"}"#,
    ] {
        let scene = loaded(&[("a.glb", &square(material, "", &more(image)))]).scene;
        let bytes = &scene.textures.embedded[&scene.textures.files[0]];
        assert_eq!(bytes[..], square_bytes()[80..], "{image}");
    }
    let transform = r#"{"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0,
        "extensions":{"KHR_texture_transform":{"offset":[0.5,0],"scale":[2,1]}}}}}"#;
    let scene = loaded(&[("a.glb", &square(transform, "", &more(r#"{"uri":"a.png"}"#)))]).scene;
    assert_eq!(scene.textures.coordinates[0][1], Vec2::new(2.5, 0.0));
}

/// Of many instances, of nothing that a file has bytes for, and of an extension in quantised form.
#[test]
fn what_gltf_requires_is_bounded_and_checked_once() {
    let required = r#","extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"]"#;
    assert_eq!(
        titles(&loaded(&[("a.glb", &square(RED, "", required))])),
        [""; 0]
    );
    let unlit = RED
        .replace(
            r#""name":"red""#,
            r#""extensions":{"KHR_materials_unlit":{}}"#,
        )
        .replace(r#","metallicFactor":0"#, "");
    let read = loaded(&[("a.glb", &square(&unlit, "", ""))]);
    assert!(matches!(
        read.scene.materials[0].material,
        Material::Diffuse { .. }
    ));
    assert_eq!(
        titles(&read),
        ["materials without light (KHR_materials_unlit)"]
    );
    let text = String::from_utf8_lossy(&square(RED, "", "")[20..]).replace(
        r#""bufferView":0,"componentType":5126,"count":4"#,
        r#""componentType":5126,"count":70000000"#,
    );
    let json = &text[..text.rfind("}]}").expect("the end") + 3];
    let error = load(&[("a.glb", &glb(json, &square_bytes()))])
        .unwrap_err()
        .to_string();
    assert!(error.contains("vertices and indices"), "{error}");
}

/// Attributes of an application, and an empty mesh beside another.
#[test]
fn what_gltf_allows_beside_its_own_is_read() {
    let text = String::from_utf8_lossy(&square(RED, "", "")[20..])
        .replace(r#""TEXCOORD_0":1"#, r#""TEXCOORD_0":1,"_BATCHID":1"#)
        .replace(
            r#""primitives":["#,
            r#""primitives":[{"attributes":{"POSITION":3}},"#,
        )
        .replace(
            r#""count":6,"type":"SCALAR"}"#,
            r#""count":6,"type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":0,"type":"VEC3"}"#,
        );
    let json = &text[..text.rfind("}]}").expect("the end") + 3];
    let scene = loaded(&[("a.glb", &glb(json, &square_bytes()))]).scene;
    assert_eq!(scene.triangles.len(), 2);
}

/// A texture without an image is valid: an extension such as `EXT_texture_webp` has it.
#[test]
fn textures_of_gltf_without_an_image_are_named() {
    let material =
        r#"{"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}}}"#;
    let read = loaded(&[("a.glb", &square(material, "", r#","textures":[{}]"#))]);
    assert!(read.scene.textures.files.is_empty());
    let expected = ["textures whose image is in no format of glTF itself"];
    assert_eq!(titles(&read), expected);
    let more = |image: &str| format!(r#","textures":[{{"source":0}}],"images":[{image}]"#);
    let nowhere = loaded(&[("a.glb", &square(material, "", &more("{}")))]);
    assert_eq!(titles(&nowhere), expected);
    let untyped = square(material, "", &more(r#"{"bufferView":2}"#));
    assert_eq!(
        loaded(&[("a.glb", &untyped)]).scene.textures.embedded.len(),
        1
    );
}

/// Lights and cameras; Blender's lamps are in lumens of 683 to the watt.
#[test]
fn lights_and_cameras_of_gltf_are_read() {
    let light = |kind: &str| {
        format!(
            r#","cameras":[{{"type":"perspective","perspective":{{"yfov":0.5,"znear":0.1,"aspectRatio":2}}}}],
            "extensionsUsed":["KHR_lights_punctual"],
            "extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"{kind}","intensity":683,"color":[1,0.5,0]}}]}}}}"#
        )
    };
    let node =
        r#","camera":0,"translation":[0,3,0],"extensions":{"KHR_lights_punctual":{"light":0}}"#;
    let file = square(RED, node, &light("point"));
    let scene = loaded(&[("a.glb", &file)]).scene;
    let strength = |watts: f64| Spectrum::new(watts, 0.5 * watts, 0.0);
    let position = Vec3::new(0.0, 3.0, 0.0);
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(
        scene.lights[0].light,
        Light::Point {
            position,
            intensity: strength(683.0)
        }
    );
    let camera = scene.camera.expect("a camera");
    assert!((camera.v_fov.to_radians() - 0.5).abs() < 1e-7 && camera.pos == position);
    let json = String::from_utf8_lossy(&file).into_owned();
    assert!(json.contains("\"version\":\"2.0\""));
    let sun = light("directional").replace("\"cameras\"", "\"extras\":{},\"cameras\"");
    let scene = loaded(&[("a.glb", &square(RED, node, &sun))]).scene;
    let direction = Vec3::NEG_Z;
    assert_eq!(
        scene.lights[0].light,
        Light::Directional {
            direction,
            irradiance: strength(683.0)
        }
    );
}

/// A skin whose only joint is moved: its vertices move with the joint, not with their node.
#[test]
fn skins_are_placed_by_their_joints() {
    let mut bytes = square_bytes();
    let weights: Vec<f32> = [1.0, 0.0, 0.0, 0.0].repeat(4);
    bytes.extend([0_u8; 16]);
    bytes.extend(weights.iter().flat_map(|x| x.to_le_bytes()));
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
        "nodes":[{"mesh":0,"skin":0,"translation":[100,0,0]},{"translation":[0,0,7]}],
        "skins":[{"joints":[1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],
        "buffers":[{"byteLength":172}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":80,"byteLength":12},
          {"buffer":0,"byteOffset":92,"byteLength":16},{"buffer":0,"byteOffset":108,"byteLength":64}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
          {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
          {"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},
          {"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"}]}"#;
    let scene = loaded(&[("a.glb", &glb(json, &bytes))]).scene;
    assert_eq!(scene.triangles[0].p1, Vec3::new(1.0, 0.0, 7.0));
}

#[test]
fn a_gltf_that_cannot_be_read_is_an_error_with_its_reason() {
    let message = |bytes: &[u8]| load(&[("a.glb", bytes)]).unwrap_err().to_string();
    let whole = square(RED, "", "");
    assert!(message(&whole[..whole.len() - 40]).contains("not a valid glTF file"));
    assert!(message(b"").contains("not a valid glTF file"));
    let compressed = r#","extensionsRequired":["KHR_draco_mesh_compression"],"extensionsUsed":["KHR_draco_mesh_compression"]"#;
    let error = message(&square(RED, "", compressed));
    assert!(
        error.contains("requires KHR_draco_mesh_compression"),
        "{error}"
    );
    let text = String::from_utf8_lossy(&whole).into_owned();
    let start = text.find('{').expect("JSON");
    let json = text[start..text.find("BIN").expect("bytes") - 4]
        .trim_end()
        .to_owned();
    let short = json.replace("\"count\":6", "\"count\":600");
    let error = message(&glb(&short, &square_bytes()));
    assert!(error.contains("accessor 2 has 600 elements"), "{error}");
}

/// The bounds of positions are nowhere needed. Some exporters leave them out.
#[test]
fn gltf_without_bounds_of_positions_is_read() {
    let file = square(RED, "", "");
    let text = String::from_utf8_lossy(&file[20..]).into_owned();
    let json = text[..text.rfind("}]}").expect("the end") + 3].to_owned();
    let without = json.replace(",\"min\":[0,0,0],\"max\":[1,1,0]", "");
    assert_ne!(without, json);
    let bare = loaded(&[("a.glb", &glb(&without, &square_bytes()))]);
    assert_eq!(
        bare.scene.triangles,
        loaded(&[("a.glb", &file)]).scene.triangles
    );
    assert_eq!(titles(&bare), [""; 0]);
}

/// What is dropped is named, also where the format has room for more than a scene here.
#[test]
fn what_gltf_has_and_a_scene_has_not_is_named() {
    let more = r#","extensionsUsed":["EXT_mesh_gpu_instancing","KHR_lights_punctual"]"#;
    let lamp = RED.replace(
        r#""name":"red""#,
        r#""emissiveFactor":[1,1,1],"doubleSided":true"#,
    );
    for (file, expected) in [
        (square(RED, "", more), &["extensions that are not read"][..]),
        (
            square(&lamp, "", ""),
            &["lamps that shine on both sides", "lamps that reflect light"],
        ),
    ] {
        assert_eq!(titles(&loaded(&[("a.glb", &file)])), expected);
    }
    let far = String::from_utf8_lossy(&square(RED, "", "")[20..])
        .replace(r#""POSITION":0"#, r#""POSITION":99"#);
    let json = &far[..far.rfind("}]}").expect("the end") + 3];
    let error = load(&[("a.glb", &glb(json, &square_bytes()))]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("an accessor that is not in the file"),
        "{error}"
    );
}

/// A number in the header alone makes no room in memory.
#[test]
fn ply_files_do_not_announce_more_than_they_have() {
    let file = PLY.replace("element vertex 4", "element vertex 4000000000");
    assert_ne!(file, PLY);
    let error = load(&[("a.ply", file.as_bytes())]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("more items than the file has bytes"),
        "{error}"
    );
}

/// Files of version 1 are not damaged.
#[test]
fn gltf_of_version_1_is_refused_by_name() {
    let refused = |name: &str, bytes: &[u8]| load(&[(name, bytes)]).unwrap_err().to_string();
    let mut binary = square(RED, "", "");
    binary[4] = 1;
    let text =
        r#"{"accessors":{"a":{}},"asset":{"profile":{"version":"1.0.2"},"version" : "1.0"}}"#;
    for (name, bytes) in [("a.glb", &*binary), ("a.gltf", text.as_bytes())] {
        let error = refused(name, bytes);
        assert!(error.contains("glTF 1, which is not supported"), "{error}");
        assert!(!error.contains("not a valid"), "{error}");
    }
    let damaged = r#"{"accessors":{},"asset":{"version":"2.0"},"extras":{"version":"1.0"}}"#;
    assert!(refused("a.gltf", damaged.as_bytes()).contains("not a valid glTF file"));
}

/// No damaged file makes a reader panic.
#[test]
fn damaged_models_do_not_panic() {
    let files: [(&str, Vec<u8>); 4] = [
        ("a.glb", square(RED, "", "")),
        ("a.obj", OBJ.into()),
        ("a.ply", PLY.into()),
        ("a.mtl", MTL.into()),
    ];
    let folder = tempfile::tempdir().expect("a folder");
    // Of its materials too, each beginning.
    fs::write(folder.path().join("b.obj"), OBJ).expect("a file");
    for end in 0..MTL.len() {
        fs::write(folder.path().join("a.mtl"), &MTL[..end]).expect("a file");
        assert!(scenes::load(folder.path().join("b.obj")).is_ok(), "{end}");
    }
    let mut state = 1_u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    for (name, bytes) in files {
        let path = folder.path().join(name);
        for _ in 0..300 {
            let mut damaged = bytes.clone();
            for _ in 0..=random(3) {
                let at = random(damaged.len());
                match random(3) {
                    0 => damaged[at] = random(256) as u8,
                    1 => damaged.truncate(at.max(1)),
                    _ => damaged[at] = b'9',
                }
            }
            fs::write(&path, &damaged).expect("a file");
            let _ = scenes::load(&path);
            let _ = scenes::load(folder.path().join("b.obj"));
        }
    }
}

const OBJ: &str = "mtllib a.mtl\no house\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\n\
                   vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3 4/4\nf 1 2 5 4\n";

const MTL: &str = "newmtl red\nKd 0.5 0.25 0.125\nKs 0.5 0.5 0.5\nNs 250\nillum 2\n";

/// The second polygon is not convex.
#[test]
fn obj_files_are_read_with_their_materials() {
    let loaded = loaded(&[("a.obj", OBJ.as_bytes()), ("a.mtl", MTL.as_bytes())]);
    assert_eq!(titles(&loaded), [""; 0]);
    let scene = &loaded.scene;
    let area: f64 = (scene.triangles.iter())
        .map(|t| (t.p1 - t.p0).cross(t.p2 - t.p0).length() / 2.0)
        .sum();
    assert!((area - 1.5).abs() < 1e-12, "{area}");
    assert_eq!(scene.objects[0].name, "house");
    let reflectance = Spectrum::new(0.5, 0.25, 0.125);
    assert_eq!(
        scene.materials[0].material,
        Material::Diffuse { reflectance }
    );
}

/// As old and foreign exporters write them.
#[test]
fn obj_files_in_other_dialects_are_the_same_scene() {
    let scene_of = |obj: &[u8], mtl: &str| {
        let loaded = loaded(&[("a.obj", obj), ("a.mtl", mtl.as_bytes())]);
        let titles: Vec<String> = titles(&loaded).into_iter().map(str::to_owned).collect();
        let material = loaded.scene.materials[0].material;
        (loaded.scene.triangles, material, titles)
    };
    let expected = scene_of(OBJ.as_bytes(), MTL);
    let utf16 = |to: fn(u16) -> [u8; 2]| -> Vec<u8> {
        let units = ['\u{feff}'].into_iter().chain(OBJ.chars());
        let text: String = units.collect();
        text.encode_utf16().flat_map(to).collect()
    };
    for obj in [
        [b"# caf\xe9 \xff\n", OBJ.as_bytes()].concat(),
        ["\u{feff}", OBJ].concat().into(),
        utf16(u16::to_le_bytes),
        utf16(u16::to_be_bytes),
        OBJ.replace('\n', "\r\n").into(),
        OBJ.replace('\n', "\r").into(),
        OBJ.replace("f 1 2 5", "f 1 \\\n2 5").into(),
        OBJ.replace("f 1 2 5", "f 1 \\\r\n2 5").into(),
        // A comment is not continued.
        OBJ.replace("f 1 2 5", "# C:\\models\\\nf 1 2 5").into(),
        OBJ.replace("usemtl red", "usemtl\tred").into(),
        OBJ.replace("v 1 0 0\n", "v 1 0 0 # the second\n").into(),
        OBJ.replace("a.mtl", ".\\a.mtl").into(),
        OBJ.replace("a.mtl", "C:\\models\\A.MTL").into(),
        OBJ.replace("a.mtl", "\"a.mtl\"").into(),
    ] {
        let text = String::from_utf8_lossy(&obj);
        assert_eq!(scene_of(&obj, MTL), expected, "{text}");
    }
    let unnamed = scene_of(
        OBJ.replace("usemtl red", "usemtl").as_bytes(),
        &MTL.replace("newmtl red", "newmtl "),
    );
    assert_eq!(unnamed, expected);
    assert_eq!(
        scene_of(
            OBJ.as_bytes(),
            &MTL.replace("Ks 0.5 0.5 0.5", "# C:\\\nKs 0.5")
        ),
        expected
    );
    let optional = scene_of(
        OBJ.as_bytes(),
        &format!("{MTL}map_Kd -s 2 2 1 my tiles.png\n"),
    );
    assert_eq!(optional.2, ["`Kd` beside `map_Kd`", "options of map_Kd"]);
    let foreign = scene_of(OBJ.as_bytes(), &format!("{MTL}Tr 0.5\nPm 1\n"));
    assert_eq!(foreign.2, ["parameters of materials that are not read"]);
    let with_line = scene_of(format!("{OBJ}l 1 2 3\n").as_bytes(), MTL);
    assert_eq!(
        (with_line.0, with_line.2),
        (expected.0.clone(), vec!["points and lines".to_owned()])
    );
    // Colours of vertices at some of them.
    let colored = OBJ.replace("v 1 1 0", "v 1 1 0 0.5 1 0");
    let (triangles, material, titles) = scene_of(colored.as_bytes(), MTL);
    assert_eq!((triangles, material), (expected.0, expected.1));
    assert_eq!(titles, ["the colours of vertices are ignored"]);
}

/// What cannot be read is left out alone and named; an error names the line.
#[test]
fn rare_lines_of_obj_are_read_or_named() {
    let titles_of = |obj: &str, mtl: &str| {
        let files: [(&str, &[u8]); 2] = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())];
        let loaded = loaded(&files);
        assert_eq!(loaded.scene.triangles.len(), 4, "{obj}");
        let textures = loaded.scene.textures.files.join(", ");
        (titles(&loaded).join(", "), textures)
    };
    let unread = "parameters of materials that cannot be read";
    for (line, warning) in [
        ("d -halo 0.7", "materials with transparent parts"),
        ("Ka spectral a.rfl 1", ""),
        ("Kd xyz 0.3 0.3 0.3", unread),
        ("Ns", ""),
        ("illum 2.0", ""),
        ("Kd 1 nothing 0", unread),
        ("map_Kd", unread),
        ("Kd -1 2 0.5", "colours of materials below 0, or above 1"),
    ] {
        let mtl = format!("{MTL}{line}\n");
        assert_eq!(titles_of(OBJ, &mtl).0, warning, "{line}");
    }
    for (value, file) in [
        ("-s 1 1 1 tex\\q1.png", "tex/q1.png"),
        ("-type sphere q.png", "q.png"),
        ("-imfchan r -mm 0 1 my q.png", "my q.png"),
        ("q.png   # comment", "q.png"),
    ] {
        let mtl = format!("newmtl red\nmap_Kd {value}\n");
        assert_eq!(titles_of(OBJ, &mtl).1, file, "{value}");
    }
    for (line, warning) in [
        ("vt 0.5", ""),
        ("cstype bezier", "statements that are not read"),
        ("f 1 2", "faces of fewer than three corners"),
    ] {
        assert_eq!(
            titles_of(&format!("{OBJ}{line}\n"), MTL).0,
            warning,
            "{line}"
        );
    }
    for (line, message) in [
        ("f 1 2 0", "line 17 is not valid: expected vertices"),
        ("f -9 -2 -1", "line 17 is not valid: expected vertices"),
        ("f 1 2 9", "line 17 refers to vertex 9, but there are 5"),
        (
            "f 1 2 4294967297",
            "line 17 is not valid: expected vertices",
        ),
        ("v 1 2", "line 17 is not valid: expected three numbers"),
    ] {
        let obj = format!("{OBJ}vt 0 \\\n 1 # a \\\n{line}\n");
        let error = load(&[("a.obj", obj.as_bytes())]).unwrap_err().to_string();
        assert!(error.contains(message), "{line}: {error}");
    }
}

/// Faces without normals in a file with some do not have those of other faces.
#[test]
fn obj_faces_without_normals_have_their_own() {
    let file = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 0 0\nv 5 1 0\nv 5 1 1\nvn 0 0.6 0.8\n\
                f 1//1 2//1 3//-1\nf 4 5 6\n";
    let scene = loaded(&[("a.obj", file.as_bytes())]).scene;
    let normals: Vec<Vec3> = scene.triangles.iter().flat_map(|t| [t.n0, t.n2]).collect();
    let given = Vec3::new(0.0, 0.6, 0.8);
    assert!(normals[0].distance(given) < 1e-15 && normals[1].distance(given) < 1e-15);
    assert_eq!(normals[2..], [Vec3::X; 2]);
}

#[test]
fn obj_faces_without_normals_are_flat_after_s_off() {
    let roof = |s: &str| {
        let file = format!("v 0 0 0\nv 0 1 0\nv 1 0 1\nv -1 0 1\no roof\n{s}f 1 3 2\n{s}f 1 2 4\n");
        loaded(&[("a.obj", file.as_bytes())])
    };
    for (s, is_flat) in [
        ("", false),
        ("s 1\n", false),
        ("s off\n", true),
        ("s 0\n", true),
    ] {
        let read = roof(s);
        let mut triangles = read.scene.triangles.iter();
        assert_eq!(triangles.all(|t| t.n0 == t.n2), is_flat, "{s}");
        assert_eq!(read.smoothed_note().is_none(), is_flat, "{s}");
    }
}

/// Two faces with a common edge are smooth in one group only, which may come back.
#[test]
fn obj_normals_are_smooth_within_a_group() {
    let roof = |group: &str| {
        let start = "v 0 0 0\nv 0 1 0\nv 1 0 1\nv -1 0 1\ng roof\nusemtl red\nf 1 3 2";
        let file = format!("{start}\n{group}f 1 2 4\n");
        let scene = loaded(&[("a.obj", file.as_bytes())]).scene;
        scene.triangles.iter().all(|t| t.n0 == t.n1 && t.n1 == t.n2)
    };
    for apart in ["o other\n", "usemtl blue\n", "g other\nusemtl red\n"] {
        assert!(roof(apart), "{apart}");
    }
    for same in [
        "",
        "usemtl red\n",
        "g roof\n",
        "g other\nf 1 2 3\ng roof\n",
        "s off\ns 1\n",
    ] {
        assert!(!roof(same), "{same}");
    }
}

/// A material stays in use past the next object, but not in a file of Blender, which writes none
/// for an object without one.
#[test]
fn obj_materials_outlast_objects() {
    for (header, is_same) in [("#", true), ("# Blender 4.5.3 LTS", false)] {
        let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl red\nf 1 2 3\no b\nf 1 2 3\n";
        let file = format!("{header}\nmtllib a.mtl\n{start}");
        let loaded = loaded(&[("a.obj", file.as_bytes()), ("a.mtl", b"newmtl red\n")]);
        let ids = [0, 1].map(|id| loaded.scene.material_number(PrimId(id)));
        assert_eq!(ids[0] == ids[1], is_same, "{header}");
        assert_eq!(titles(&loaded), [""; 0]);
    }
}

/// A square, a curved cloth and one with hills and crooked squares, with faces of both sides on the
/// same vertices: the normals of the sides cancel, so each side has its own.
#[test]
fn faces_of_both_sides_have_normals_of_their_own() {
    let cloth = |size: u32, hills: f64| {
        let at = |i: u32, j: u32| 1 + i * (size + 1) + j;
        let (mut vertices, mut faces) = (String::new(), String::new());
        for (i, j) in (0..=size).flat_map(|i| (0..=size).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(size));
            let z = 0.4 * x * x * y + hills * (6.0 * x).sin() * (6.0 * y).cos();
            let beside = 0.2 * hills * f64::from(7 * i + 3 * j).sin();
            vertices += &format!("v {} {} {z}\n", x + beside, y - beside);
            if i < size && j < size {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                faces += &format!("f {a} {b} {c} {d}\nf {d} {c} {b} {a}\n");
            }
        }
        loaded(&[("a.obj", (vertices + &faces).as_bytes())]).scene
    };
    for (size, hills) in [(1, 0.0), (10, 0.0), (12, 0.1)] {
        for t in &cloth(size, hills).triangles {
            let face = (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
            for n in [t.n0, t.n1, t.n2] {
                assert!(n.dot(face) > 0.9, "{size} {t:?}");
            }
        }
    }
}

#[test]
fn obj_faces_may_refer_to_what_only_their_exporter_had() {
    let file = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1/1/2 2/2/1 3/3/1\n";
    let read = loaded(&[("a.obj", file.as_bytes())]);
    assert_eq!(read.scene.triangles[0].n0, Vec3::Z);
    let said: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
    for what in ["texture coordinates", "normals"] {
        let title = format!("faces refer to {what} that are not in the file");
        assert!(said.iter().any(|line| line.contains(&title)), "{said:?}");
    }
    // Those of the faces, as the warning says, also beside smooth ones.
    let beside = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 1 1 0\nf 1 2 4\nf 1//9 2//9 3//9\n";
    let scene = loaded(&[("a.obj", beside.as_bytes())]).scene;
    let [smooth, face] = &scene.triangles[..] else {
        panic!("two triangles")
    };
    assert_eq!(
        [smooth.n0, face.n0, face.n1, face.n2],
        [Vec3::Z, Vec3::NEG_Y, Vec3::NEG_Y, Vec3::NEG_Y]
    );
}

#[test]
fn obj_files_have_several_libraries() {
    let file = OBJ.replace("a.mtl", "b.mtl a.mtl none.mtl");
    let blue = MTL.replace("red", "blue");
    let loaded = loaded(&[
        ("a.obj", file.as_bytes()),
        ("a.mtl", MTL.as_bytes()),
        ("b.mtl", blue.as_bytes()),
    ]);
    assert_eq!(titles(&loaded), ["material libraries that cannot be read"]);
    assert_eq!(loaded.scene.materials.len(), 2);
}

#[test]
fn materials_of_obj_become_those_of_the_course() {
    for (mtl, material, warning) in [
        (
            "Ke 2 2 2",
            Material::Emission {
                radiance: Spectrum::grey(2.0),
            },
            "",
        ),
        (
            "Kd 0 0 0\nKs 0.75 0.75 0.75\nillum 3",
            Material::Mirror {
                reflectance: Spectrum::grey(0.75),
            },
            "",
        ),
        (
            "illum 7\nNi 1.25",
            Material::Glass {
                reflectance: Spectrum::WHITE,
                transmittance: Spectrum::WHITE,
                roughness: 0.0,
                ior: 1.25,
            },
            "",
        ),
        (
            "Kd 0.5 0.5 0.5\nd 0.5",
            Material::Diffuse {
                reflectance: Spectrum::grey(0.5),
            },
            "materials with transparent parts",
        ),
        (
            "Kd 0.5 0.5 0.5\nKs 1 1 1\nillum 2",
            Material::Diffuse {
                reflectance: Spectrum::grey(0.5),
            },
            "highlights of materials",
        ),
    ] {
        let mtl = format!("newmtl red\n{mtl}\n");
        let loaded = loaded(&[("a.obj", OBJ.as_bytes()), ("a.mtl", mtl.as_bytes())]);
        assert_eq!(loaded.scene.materials[0].material, material, "{mtl}");
        assert_eq!(titles(&loaded).join(", "), warning, "{mtl}");
    }
    // As Blender means them: metal of colour `Kd`, and no glass.
    let reflectance = Spectrum::new(0.75, 0.125, 0.125);
    for (mtl, material, warning) in [
        (
            "Ka 1 1 1\nNs 1000\nillum 3",
            Material::Mirror { reflectance },
            "",
        ),
        (
            "Ka 0.25 0.25 0.25\nNs 250\nillum 3",
            Material::Diffuse { reflectance },
            "",
        ),
        (
            "Ns 250\nd 0.5\nillum 9",
            Material::Diffuse { reflectance },
            "materials with transparent parts",
        ),
    ] {
        let mtl =
            format!("# Blender 4.5.3 MTL File: 'None'\nnewmtl red\nKd 0.75 0.125 0.125\n{mtl}\n");
        let loaded = loaded(&[("a.obj", OBJ.as_bytes()), ("a.mtl", mtl.as_bytes())]);
        assert_eq!(loaded.scene.materials[0].material, material, "{mtl}");
        assert_eq!(titles(&loaded).join(", "), warning, "{mtl}");
    }
    // Beside a library that is in a folder.
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("sub")).expect("a folder");
    let obj = OBJ.replace("a.mtl", "sub/a.mtl");
    for (name, text) in [
        ("a.obj", &*obj),
        ("sub/a.mtl", "newmtl red\nmap_Kd a.png\n"),
        ("sub/a.png", ""),
    ] {
        fs::write(folder.path().join(name), text).expect("a file");
    }
    let loaded_here = scenes::load(folder.path().join("a.obj")).expect("a scene");
    assert_eq!(loaded_here.scene.textures.files, ["sub/a.png"]);
    let textured = loaded(&[
        ("a.obj", OBJ.as_bytes()),
        ("a.mtl", b"newmtl red\nmap_Kd maps\\wall.png\n"),
    ]);
    assert_eq!(textured.scene.textures.files, ["maps/wall.png"]);
    for (mtl, reflectance, warning) in [
        ("", 1.0, ""),
        ("Kd 1 1 1", 1.0, ""),
        ("Kd 0.5 0.5 0.5", 0.5, "`Kd` beside `map_Kd`"),
        ("Kd 0 0 0", 1.0, "a black `Kd` beside `map_Kd`"),
        (
            "# Blender 4.1.1 MTL File: 'a.blend'\nKd 0.8 0.8 0.8",
            1.0,
            "",
        ),
    ] {
        let (comment, color) = mtl.split_once('\n').unwrap_or(("", mtl));
        let lines = format!("{comment}\nnewmtl red\n{color}\nmap_Kd a.png\n");
        let mtl = lines.trim_start();
        let loaded = loaded(&[("a.obj", OBJ.as_bytes()), ("a.mtl", mtl.as_bytes())]);
        let reflectance = Spectrum::grey(reflectance);
        let expected = Material::Diffuse { reflectance };
        assert_eq!(loaded.scene.materials[0].material, expected, "{mtl}");
        assert_eq!(titles(&loaded).join(", "), warning, "{mtl}");
    }
    let bare = loaded(&[(
        "a.obj",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n",
    )]);
    assert_eq!(titles(&bare), [""; 0]);
    let missing = loaded(&[("a.obj", OBJ.as_bytes())]);
    assert_eq!(
        titles(&missing),
        [
            "material libraries that cannot be read",
            "meshes whose material is in no library"
        ]
    );
}

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                   property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0 255\n1 0 0 0\n1 1 0 0\n0 1 0 0\n4 0 1 2 3\n";

#[test]
fn ply_files_are_read_as_text_and_in_binary() {
    let text = loaded(&[("a.ply", PLY.as_bytes())]);
    assert_eq!(titles(&text), ["the colours of vertices are ignored"]);
    assert_eq!(text.scene.triangles.len(), 2);
    let header = PLY.split("0 0 0 255").next().expect("a header");
    for (format, is_little) in [("binary_little_endian", true), ("binary_big_endian", false)] {
        let mut bytes = header.replace("ascii", format).into_bytes();
        let float = |x: f32| {
            if is_little {
                x.to_le_bytes()
            } else {
                x.to_be_bytes()
            }
        };
        let int = |x: i32| {
            if is_little {
                x.to_le_bytes()
            } else {
                x.to_be_bytes()
            }
        };
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            bytes.extend([x, y, 0.0].into_iter().flat_map(float));
            bytes.push(0);
        }
        bytes.push(4);
        bytes.extend((0..4).flat_map(int));
        let binary = loaded(&[("a.ply", &bytes)]);
        assert_eq!(binary.scene.triangles, text.scene.triangles, "{format}");
    }
    let message = |bytes: &[u8]| load(&[("a.ply", bytes)]).unwrap_err().to_string();
    assert!(message(b"ply\nformat ascii 1.0\nend_header\n").contains("has no faces"));
    let outside = PLY.replace("4 0 1 2 3", "4 0 1 2 9");
    assert!(message(outside.as_bytes()).contains("refers to vertex 9, but has 4"));
    let flat = PLY.replace("property float z\n", "");
    assert!(message(flat.as_bytes()).contains("have no property `z`"));
    let far = (PLY.replace("float x", "int x")).replace("\n1 ", "\n1000000001 ");
    let large = loaded(&[("a.ply", far.replace("\n0 ", "\n1000000000 ").as_bytes())]);
    assert_eq!(large.scene.triangles[0].p1.x, 1_000_000_001.0);
    assert!(message(b"plx").contains("not a valid PLY file"));
    let long = [b"plx".as_slice(), &[b' '; 9999]].concat();
    assert!(message(&long).len() < 400, "{}", message(&long).len());
}

/// As `printf` and Mathematica write numbers; `Line 2` alone names the place of what is none.
#[test]
fn numbers_of_ply_are_written_in_several_ways() {
    let of = |number: &str| PLY.replace("\n1 0 0 ", &format!("\n\n{number} .0 -0. "));
    let plain = loaded(&[("a.ply", of("1").as_bytes())]);
    assert_eq!(plain.scene.triangles[0].p1, Vec3::X);
    for number in ["1.", "+1.", ".1e1", "1.0E+00"] {
        let other = loaded(&[("a.ply", of(number).as_bytes())]);
        assert_eq!(other.scene.triangles, plain.scene.triangles, "{number}");
    }
    // What was left out is named where nothing is left.
    let message = |number| {
        let text = of(number).replace("4 0 1 2 3", "3 0 1 2");
        load(&[("a.ply", text.as_bytes())]).unwrap_err().to_string()
    };
    assert!(
        message("one").contains("PLY file: Line "),
        "{}",
        message("one")
    );
    for number in ["nan", "-inf"] {
        let text = message(number);
        assert!(text.contains("coordinate that is not finite"), "{text}");
    }
}

/// Texture coordinates of vertices, and of faces with several textures.
#[test]
fn textures_of_ply_are_read() {
    let comment = "format ascii 1.0\ncomment TextureFile my maps\\wall.png";
    let of_vertices = PLY
        .replace("format ascii 1.0", comment)
        .replace("property uchar red", "property float s\nproperty float t")
        .replace("0 0 0 255", "0 0 0 0 0")
        .replace(
            "0 0 0\n1 1 0 0\n0 1 0 0\n",
            "0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n",
        );
    let read = loaded(&[("a.ply", of_vertices.as_bytes())]);
    assert!(read.warnings.is_empty(), "{of_vertices}");
    assert_eq!(read.scene.textures.files, ["my maps/wall.png"]);
    let reflectance = Spectrum::WHITE;
    let white = Material::Diffuse { reflectance };
    assert_eq!(read.scene.materials[0].material, white);
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE];
    assert_eq!(read.scene.textures.coordinates[0], corners);

    let of_faces = PLY
        .replace(
            "format ascii 1.0",
            &format!("{comment}\ncomment TextureFile b.png"),
        )
        .replace("element face 1", "element face 3")
        .replace(
            "vertex_indices",
            "vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber",
        )
        .replace(
            "4 0 1 2 3",
            "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 0 1 0 2 0\n3 0 1 3 0 -1",
        );
    let read = loaded(&[("a.ply", of_faces.as_bytes())]);
    assert_eq!(titles(&read), ["the colours of vertices are ignored"]);
    let textures = &read.scene.textures;
    assert_eq!(textures.files, ["my maps/wall.png", "b.png"]);
    assert_eq!(
        textures.coordinates[0],
        [Vec2::ZERO, Vec2::Y, Vec2::Y * 2.0]
    );
    assert_eq!(textures.coordinates[1], corners);
    assert_eq!(
        [0, 1, 2].map(|i| textures.of_material(i)),
        [Some(0), Some(1), None]
    );
}

/// A folder is no file, and a file that is missing says so.
#[test]
fn missing_models_are_errors() {
    for name in ["missing.glb", "missing.obj", "missing.PLY"] {
        let error = scenes::load(PathBuf::from("/nowhere").join(Path::new(name))).unwrap_err();
        assert!(error.to_string().contains("cannot be read"), "{error}");
    }
}

/// An edge of a box is smoothed in a format without flat shading, which is reported.
#[test]
fn smoothed_models_are_reported() {
    let folded = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\n";
    let loaded = loaded(&[("a.obj", folded.as_bytes())]);
    assert_eq!(loaded.smoothed.len(), 1);
    let mut scene: Scene = loaded.scene;
    let before = scene.triangles[0].n0;
    scene.flatten_normals();
    assert_eq!(scene.triangles[0].n0, Vec3::Z);
    assert_ne!(before, Vec3::Z);
}
