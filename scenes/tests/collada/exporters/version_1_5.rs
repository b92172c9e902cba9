//! COLLADA 1.5: another namespace, `<coverage>` in the asset, `<ref>` in images, samplers that
//! refer to images, parameters of effects, solid bodies (`<brep>`), two visual scenes, kinematics.

use super::load;
use kit::{Material, Spectrum};

const DOCUMENT: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<c:COLLADA xmlns:c="http://www.collada.org/2008/03/COLLADASchema" version="1.5.0" xml:base="maps/scene.dae">
  <c:asset>
    <c:coverage><c:geographic_location>
      <c:longitude>-105.2830</c:longitude><c:latitude>40.0170</c:latitude><c:altitude mode="relativeToGround">0</c:altitude>
    </c:geographic_location></c:coverage>
    <c:created>2010-01-01T00:00:00Z</c:created><c:modified>2010-01-01T00:00:00Z</c:modified>
    <c:unit meter="0.01" name="centimeter"/><c:up_axis>X_UP</c:up_axis>
  </c:asset>
  <c:library_images><c:image id="tiles"><c:init_from><c:ref>tiles.png</c:ref></c:init_from></c:image></c:library_images>
  <c:library_effects>
    <c:effect id="tiled"><c:profile_COMMON>
      <c:newparam sid="sampler"><c:sampler2D><c:instance_image url="#tiles"/></c:sampler2D></c:newparam>
      <c:technique sid="t"><c:blinn><c:diffuse><c:texture texture="sampler" texcoord="UV"/></c:diffuse></c:blinn></c:technique>
    </c:profile_COMMON></c:effect>
    <c:effect id="plain">
      <c:newparam sid="tint"><c:float3>0.1 0.2 0.3</c:float3></c:newparam>
      <c:profile_COMMON><c:technique sid="t"><c:lambert><c:diffuse><c:param ref="tint"/></c:diffuse></c:lambert></c:technique></c:profile_COMMON>
    </c:effect>
  </c:library_effects>
  <c:library_materials>
    <c:material id="tiled-material"><c:instance_effect url="#tiled"/></c:material>
    <c:material id="plain-material"><c:instance_effect url="#plain"/></c:material>
    <c:material id="set-material"><c:instance_effect url="#plain"><c:setparam ref="tint"><c:float4>0.4 0.5 0.6 1</c:float4></c:setparam></c:instance_effect></c:material>
  </c:library_materials>
  <c:library_geometries>
    <c:geometry id="body"><c:brep><c:vertices id="bv"/></c:brep></c:geometry>
    <c:geometry id="mesh"><c:mesh>
      <c:source id="p">
        <c:float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</c:float_array>
        <c:technique_common><c:accessor source="#pa" count="4" stride="3"><c:param name="X" type="float"/><c:param name="Y" type="float"/><c:param name="Z" type="float"/></c:accessor></c:technique_common>
      </c:source>
      <c:vertices id="v"><c:input semantic="POSITION" source="#p"/></c:vertices>
      <c:triangles count="1" material="tiled-material"><c:input semantic="VERTEX" source="#v" offset="0"/><c:p>0 1 2</c:p></c:triangles>
      <c:polylist count="1" material="plain-material"><c:input semantic="VERTEX" source="#v" offset="0"/><c:vcount>4</c:vcount><c:p>0 1 2 3</c:p></c:polylist>
      <c:trifans count="2" material="set-material"><c:input semantic="VERTEX" source="#v" offset="0"/><c:p>0 1 2 3</c:p><c:p>1 2 3 0</c:p></c:trifans>
      <c:triangles count="0"><c:p/></c:triangles>
      <c:polylist count="0"><c:input semantic="VERTEX" source="#v" offset="0"/><c:vcount/><c:p/></c:polylist>
    </c:mesh></c:geometry>
  </c:library_geometries>
  <c:library_kinematics_scenes/>
  <c:library_visual_scenes>
    <c:visual_scene id="other"/>
    <c:visual_scene id="main">
      <c:node id="n"><c:asset/><c:instance_geometry url="#mesh"/></c:node>
      <c:node id="b"><c:instance_geometry url="#body"/></c:node>
      <c:evaluate_scene/>
    </c:visual_scene>
  </c:library_visual_scenes>
  <c:scene><c:instance_visual_scene url="#main"/><c:instance_kinematics_scene url="#k"/></c:scene>
</c:COLLADA>
"##;

#[test]
fn elements_of_the_newer_version_are_read() {
    let scene = load(
        "1.5.dae",
        DOCUMENT,
        &[("<brep> is not supported", "<c:brep>")],
    )
    .scene;
    assert_eq!(scene.triangles.len(), 1 + 2 + 4);
    // Symbols that are not bound are ids of materials.
    let colors: Vec<Material> = scene.materials.iter().map(|m| m.material).collect();
    let diffuse = |r, g, b| Material::Diffuse {
        reflectance: Spectrum::new(r, g, b),
    };
    assert_eq!(
        colors,
        [
            diffuse(1.0, 1.0, 1.0),
            diffuse(0.1, 0.2, 0.3),
            diffuse(0.4, 0.5, 0.6)
        ]
    );
    assert_eq!(scene.textures.files, ["maps/tiles.png"]);
}

#[test]
fn the_first_scene_is_used_if_none_is_selected() {
    let text = DOCUMENT
        .replace("<c:instance_visual_scene url=\"#main\"/>", "")
        .replace("<c:visual_scene id=\"other\"/>", "");
    let warnings = [
        (
            "no <scene> selects a visual scene",
            "<c:visual_scene id=\"main\">",
        ),
        ("<brep> is not supported", "<c:brep>"),
    ];
    let loaded = load("1.5.dae", &text, &warnings);
    assert_eq!(
        loaded.warnings[0].0.expected(),
        Some("using the only visual scene")
    );
    let two = text.replace(
        "</c:library_visual_scenes>",
        "<c:visual_scene id=\"other\"/></c:library_visual_scenes>",
    );
    let loaded = load("1.5.dae", &two, &warnings);
    assert_eq!(
        loaded.warnings[0].0.expected(),
        Some("using the first visual scene")
    );
    assert_eq!(loaded.scene.triangles.len(), 7);
}
