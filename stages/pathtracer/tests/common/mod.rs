//! Helpers of several tests.

use snapbox::cmd::{Command, cargo_bin};
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the course's own scenes.
pub(crate) fn own_scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae")
}

/// The scene files in `folders`, those of the first folder first, each folder's sorted. The order
/// does not depend on where the folders lie. There has to be at least one file.
pub(crate) fn scene_files(folders: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for folder in folders {
        let first = files.len();
        let entries = fs::read_dir(folder).expect("a folder of scenes");
        let paths = entries.map(|entry| entry.expect("a file").path());
        files.extend(paths.filter(|path| path.extension().is_some_and(|end| end == "dae")));
        files[first..].sort();
    }
    assert!(!files.is_empty(), "no scenes in {folders:?}");
    files
}

/// A folder with a scene file of this name.
pub(crate) fn folder_of(name: &str, scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join(name), scene).expect("a scene file");
    folder
}

/// A scene of a grey square of two triangles, with these lights and this node.
pub(crate) fn square(lights: &str, node: &str) -> String {
    r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  LIGHTS
  <library_effects><effect id="grey"><profile_COMMON><technique sid="common"><lambert>
    <diffuse><color>0.5 0.5 0.5 1</color></diffuse>
  </lambert></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="paint"><instance_effect url="#grey"/></material></library_materials>
  <library_geometries><geometry id="square"><mesh>
    <source id="corners">
      <float_array id="numbers" count="12">-1 -1 0  1 -1 0  1 1 0  -1 1 0</float_array>
      <technique_common><accessor source="#numbers" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common>
    </source>
    <vertices id="vertices"><input semantic="POSITION" source="#corners"/></vertices>
    <triangles count="2" material="wall"><input semantic="VERTEX" source="#vertices" offset="0"/><p>0 1 2 0 2 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="room">
    <node id="wall"><instance_geometry url="#square"><bind_material><technique_common>
      <instance_material symbol="wall" target="#paint"/>
    </technique_common></bind_material></instance_geometry></node>
    NODE
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#room"/></scene>
</COLLADA>
"##
    .replace("LIGHTS", lights)
    .replace("NODE", node)
}

/// Runs the program. Returns its exit code, stdout and stderr.
pub(crate) fn run(folder: &Path, args: &str) -> (i32, String, String) {
    let run = Command::new(cargo_bin!("pathtracer"))
        .current_dir(folder)
        .args(args.split_whitespace())
        .output()
        .expect("the program runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let code = run.status.code().expect("no signal");
    (code, text(&run.stdout), text(&run.stderr))
}
