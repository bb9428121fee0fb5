//! Vertices that Draco compression rounded to a lattice: the model is drawn as the original surface, without
//! the rounding noise. Closed-form torus contours are the reference.

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, MeshEncoder, PointAttribute,
    PointIndex,
};
use glam::DVec3;
use kurbo::Point;
use ligne::lines::{LineKind, LineOptions};
use ligne::load::ModelFormat;
use ligne::scene::{Camera, Scene};

use crate::library::support::measures::line_picture::length_farther_than;
use crate::library::support::pipeline::{orthographic, run_stages, scene_of_geometries};
use crate::library::support::readers::glb_writer::glb;
use crate::library::support::references::torus_contour::{self, VisibleArc, visible_arcs};
use crate::library::support::scenes::solids::{Solid, torus};

/// Returns the Draco stream of a solid with positions of `bits` bits.
fn draco_stream(solid: &Solid, bits: i32) -> Vec<u8> {
    let mut position = PointAttribute::new();
    position.init(GeometryAttributeType::Position, 3, DataType::Float32, false, solid.positions.len());
    for (k, p) in solid.positions.iter().enumerate() {
        let bytes: Vec<u8> = p.as_vec3().to_array().iter().flat_map(|x| x.to_le_bytes()).collect();
        position.buffer_mut().write(12 * k, &bytes);
    }
    let mut mesh = draco_core::Mesh::new();
    mesh.add_attribute(position);
    mesh.set_num_faces(solid.triangles.len());
    for (k, triangle) in solid.triangles.iter().enumerate() {
        mesh.set_face(FaceIndex(k as u32), triangle.map(PointIndex));
    }
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let mut options = EncoderOptions::new();
    options.set_attribute_int(0, "quantization_bits", bits);
    let mut out = EncoderBuffer::new();
    encoder.encode(&options, &mut out).unwrap();
    out.data().to_vec()
}

/// Returns a GLB file of one compressed solid.
fn draco_glb(solid: &Solid, bits: i32) -> Vec<u8> {
    let mut bin = draco_stream(solid, bits);
    let length = bin.len();
    bin.resize(length.next_multiple_of(4), 0);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":
            {{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":0}}}}}}}}]}}],
        "accessors":[{{"componentType":5126,"count":{},"type":"VEC3"}},
            {{"componentType":5125,"count":{},"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":{length}}}],"buffers":[{{"byteLength":{}}}]}}"#,
        solid.positions.len(),
        3 * solid.triangles.len(),
        bin.len()
    );
    glb(json, &bin)
}

fn cameras() -> impl Iterator<Item = Camera> {
    let eyes = [[1.0, 0.4, 3.0], [2.0, -1.0, 1.5], [-1.0, 2.0, 1.2], [0.3, -2.0, -2.0], [1.5, 1.5, 2.2]];
    eyes.into_iter().map(|eye| orthographic(DVec3::from_array(eye) * 2.0, DVec3::ZERO, 3.0))
}

/// Returns over all views the drawn length away from the true contours, the true length not drawn (px), and
/// the number of visible creases.
fn contour_errors(scene: &Scene) -> ([f64; 2], usize) {
    let mut sums = [0.0; 2];
    let mut creases = 0;
    for camera in cameras() {
        let drawn = run_stages(scene, &camera, &LineOptions::default());
        let truth = visible_arcs(&torus_contour::torus_contours(1.0, 0.25, &camera, 4000));
        let should: Vec<[Point; 2]> = truth.iter().flat_map(VisibleArc::segments).collect();
        let is = drawn.visible_segments();
        sums[0] += length_farther_than(&is, &should, 3.0);
        sums[1] += length_farther_than(&should, &is, 3.0);
        creases += drawn.visible_segments_of_kind(LineKind::Crease).len();
    }
    (sums, creases)
}

#[test]
fn an_8_bit_torus_has_its_contours_and_no_creases() {
    let solid = torus(360, 120, 1.0, 0.25);
    let scene = Scene::from_bytes(&draco_glb(&solid, 8), ModelFormat::Gltf).unwrap();
    let found = &scene.geometries[0];
    assert_eq!(found.triangles.len(), solid.triangles.len());
    let ([extra, missing], creases) = contour_errors(&scene);
    // The same positions on the lattice, as an uncompressed file would have them.
    let step = 2.5 / 255.0;
    let mut rounded = found.clone();
    let low = -DVec3::new(1.25, 1.25, 0.25);
    rounded.positions.iter_mut().for_each(|p| *p = low + ((*p - low) / step).round() * step);
    let farthest = found.positions.iter().zip(&rounded.positions).map(|(p, q)| (*p - *q).abs().max_element());
    assert!(farthest.fold(0.0, f64::max) <= 0.501 * step);
    let ([rough_extra, _], rough_creases) = contour_errors(&scene_of_geometries(vec![rounded]));
    println!(
        "{extra} px extra, {missing} px missing, {creases} creases; rounded {rough_extra} px, {rough_creases}"
    );
    assert_eq!(creases, 0);
    assert!(extra < 100.0 && missing < 40.0, "{extra} px extra, {missing} px missing");
    assert!(rough_extra > 500.0 && rough_creases > 100, "{rough_extra} px extra, {rough_creases} creases");
}
