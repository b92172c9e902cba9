//! SketchUp: lengths in inches, Z_UP, components in `library_nodes` that contain each other,
//! several materials per mesh, `<lines>` beside `<triangles>`, normals and texture coordinates in
//! `<vertices>`, materials without `<library_lights>`.

use super::load;
use kit::{Material, Spectrum, Vec2, Vec3};

const DOCUMENT: &str = r##"<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
    <asset>
        <contributor><authoring_tool>SketchUp 17.0.18899</authoring_tool></contributor>
        <created>2017-01-01T00:00:00Z</created><modified>2017-01-01T00:00:00Z</modified>
        <unit meter="0.0254000" name="inch" />
        <up_axis>Z_UP</up_axis>
    </asset>
    <library_visual_scenes>
        <visual_scene id="ID1">
            <node name="SketchUp">
                <node id="ID2" name="Wall#1">
                    <matrix>1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
                    <instance_node url="#ID3" />
                </node>
                <node id="ID4" name="Wall#2">
                    <matrix>-1 0 0 20 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
                    <instance_node url="#ID3" />
                </node>
            </node>
        </visual_scene>
    </library_visual_scenes>
    <library_nodes>
        <node id="ID3" name="Wall">
            <node id="ID5" name="Face">
                <matrix>1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1</matrix>
                <instance_geometry url="#ID6">
                    <bind_material><technique_common>
                        <instance_material symbol="Material2" target="#ID20">
                            <bind_vertex_input semantic="UVSET0" input_semantic="TEXCOORD" input_set="0" />
                        </instance_material>
                        <instance_material symbol="Material3" target="#ID21"/>
                        <instance_material symbol="Material4" target="#ID22"/>
                    </technique_common></bind_material>
                </instance_geometry>
            </node>
        </node>
    </library_nodes>
    <library_geometries>
        <geometry id="ID6">
            <mesh>
                <source id="ID7">
                    <float_array id="ID8" count="12">0 0 0 4 0 0 4 0 2 0 0 2</float_array>
                    <technique_common><accessor count="4" source="#ID8" stride="3">
                        <param name="X" type="float" /><param name="Y" type="float" /><param name="Z" type="float" />
                    </accessor></technique_common>
                </source>
                <source id="ID9">
                    <float_array id="ID10" count="12">0 -1 0 0 -1 0 0 -1 0 0 -1 0</float_array>
                    <technique_common><accessor count="4" source="#ID10" stride="3">
                        <param name="X" type="float" /><param name="Y" type="float" /><param name="Z" type="float" />
                    </accessor></technique_common>
                </source>
                <source id="ID11">
                    <float_array id="ID12" count="8">0 0 1 0 1 1 0 1</float_array>
                    <technique_common><accessor count="4" source="#ID12" stride="2">
                        <param name="S" type="float" /><param name="T" type="float" />
                    </accessor></technique_common>
                </source>
                <vertices id="ID13">
                    <input semantic="POSITION" source="#ID7" />
                    <input semantic="NORMAL" source="#ID9" />
                    <input semantic="TEXCOORD" source="#ID11" />
                </vertices>
                <triangles count="1" material="Material2"><input offset="0" semantic="VERTEX" source="#ID13" /><p>0 1 2</p></triangles>
                <triangles count="1" material="Material3"><input offset="0" semantic="VERTEX" source="#ID13" /><p>0 2 3</p></triangles>
                <lines count="2" material="Material4"><input offset="0" semantic="VERTEX" source="#ID13" /><p>0 1 1 2</p></lines>
            </mesh>
        </geometry>
    </library_geometries>
    <library_materials>
        <material id="ID20" name="Brick"><instance_effect url="#ID30" /></material>
        <material id="ID21" name="__auto_"><instance_effect url="#ID31" /></material>
        <material id="ID22" name="edge_color000255"><instance_effect url="#ID32" /></material>
    </library_materials>
    <library_effects>
        <effect id="ID30"><profile_COMMON>
            <newparam sid="ID33"><surface type="2D"><init_from>ID35</init_from></surface></newparam>
            <newparam sid="ID34"><sampler2D><source>ID33</source></sampler2D></newparam>
            <technique sid="COMMON"><lambert><diffuse><texture texture="ID34" texcoord="UVSET0" /></diffuse></lambert></technique>
        </profile_COMMON></effect>
        <effect id="ID31"><profile_COMMON><technique sid="COMMON"><lambert>
            <diffuse><color>1 1 1 1</color></diffuse><transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>
        </lambert></technique></profile_COMMON></effect>
        <effect id="ID32"><profile_COMMON><technique sid="COMMON"><constant>
            <transparent opaque="A_ONE"><color>0 0 0 1</color></transparent>
        </constant></technique></profile_COMMON></effect>
    </library_effects>
    <library_images>
        <image id="ID35"><init_from>my model/Brick_Rough_Dark.jpg</init_from></image>
    </library_images>
    <scene><instance_visual_scene url="#ID1" /></scene>
</COLLADA>
"##;

#[test]
fn components_and_their_materials_are_read() {
    let warnings = [("<lines> is ignored", "<lines count=\"2\"")];
    let scene = load("sketchup.dae", DOCUMENT, &warnings).scene;
    assert_eq!(scene.triangles.len(), 4);
    let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["Brick", "__auto_"], "the edges' material is unused");
    assert_eq!(scene.textures.files, ["my model/Brick_Rough_Dark.jpg"]);
    assert_eq!(scene.textures.coordinates[0][1], Vec2::new(1.0, 0.0));
    let white = Material::Diffuse {
        reflectance: Spectrum::WHITE,
    };
    assert_eq!(scene.materials[1].material, white);
    assert_eq!(scene.camera, None);
}

#[test]
fn lengths_are_those_of_the_file_and_mirrored_components_keep_their_normals() {
    let warnings = [("<lines> is ignored", "<lines count=\"2\"")];
    let scene = load("sketchup.dae", DOCUMENT, &warnings).scene;
    // (10, 0, 5) in inches, Z_UP.
    assert_eq!(scene.triangles[0].p0, Vec3::new(-10.0, 5.0, 0.0));
    for triangle in &scene.triangles {
        let face = (triangle.p1 - triangle.p0).cross(triangle.p2 - triangle.p0);
        assert_eq!(triangle.n0, Vec3::NEG_Z);
        assert_eq!(face.normalize(), Vec3::NEG_Z);
    }
}
