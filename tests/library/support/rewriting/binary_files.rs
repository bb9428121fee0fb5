//! Writers for models in single precision: STL, PLY, and GLB with placed nodes.

use glam::{DQuat, DVec3};
use serde_json::{Value, json};

use super::body::Body;
use super::model::RandomModel;
use crate::library::support::readers::glb_writer::glb;
use crate::library::support::scenes::random_dice::Dice;

fn push_f32_point(bytes: &mut Vec<u8>, point: DVec3) {
    point.as_vec3().to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
}

pub(crate) fn write_stl(model: &RandomModel) -> Vec<u8> {
    let mut facets = Vec::new();
    let mut count = 0_u32;
    for body in &model.bodies {
        let points = model.world_points(body);
        for [a, b, c] in body.faces.iter().flat_map(|face| body.triangles(face, 0)) {
            let corners = [a, b, c].map(|corner| points[corner as usize]);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
            push_f32_point(&mut facets, normal);
            corners.into_iter().for_each(|corner| push_f32_point(&mut facets, corner));
            facets.extend([0, 0]);
            count += 1;
        }
    }
    let mut bytes = vec![b' '; 80];
    bytes.extend(count.to_le_bytes());
    bytes.extend(facets);
    bytes
}

pub(crate) fn write_ply_single(model: &RandomModel) -> Vec<u8> {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let (mut first, mut face_count) = (0, 0);
    for body in &model.bodies {
        model.world_points(body).into_iter().for_each(|point| push_f32_point(&mut vertices, point));
        for face in &body.faces {
            faces.push(face.corners.len() as u8);
            face.corners.iter().for_each(|corner| faces.extend((first + corner).to_le_bytes()));
            face_count += 1;
        }
        first += body.points.len() as u32;
    }
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {first}\nproperty float x\nproperty float y\n\
         property float z\nelement face {face_count}\nproperty list uchar uint vertex_indices\nend_header\n"
    )
    .into_bytes();
    bytes.extend(vertices);
    bytes.extend(faces);
    bytes
}

/// A glTF document under construction.
#[derive(Default)]
struct GltfBuilder {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    bytes: Vec<u8>,
}

impl GltfBuilder {
    fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn accessor(&mut self, data: &[u8], mut accessor: Value) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": data.len() }));
        self.bytes.extend(data);
        accessor["bufferView"] = json!(self.views.len() - 1);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds the mesh of a part, with one primitive per colour; `place` maps points to written coordinates.
    fn mesh(&mut self, part: &[Body], has_colours: bool, place: impl Fn(DVec3) -> DVec3) -> usize {
        let points: Vec<DVec3> = part.iter().flat_map(|body| &body.points).map(|p| place(*p)).collect();
        let mut data = Vec::new();
        points.iter().for_each(|point| push_f32_point(&mut data, *point));
        let [low, high] = [DVec3::min, DVec3::max]
            .map(|pick| points.iter().copied().reduce(pick).unwrap().as_vec3().to_array());
        let positions = self.accessor(
            &data,
            json!({ "componentType": 5126, "type": "VEC3", "count": points.len(), "min": low, "max": high }),
        );
        let mut primitives = Vec::new();
        for colour in 0..4_u8 {
            let (mut indices, mut first) = (Vec::new(), 0);
            for body in part {
                for face in body.faces.iter().filter(|face| face.colour == colour) {
                    let triangles = body.triangles(face, 0);
                    indices.extend(triangles.into_iter().flatten().map(|corner| first + corner));
                }
                first += body.points.len() as u32;
            }
            if indices.is_empty() {
                continue;
            }
            let data: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
            let accessor = json!({ "componentType": 5125, "type": "SCALAR", "count": indices.len() });
            let indices = self.accessor(&data, accessor);
            let mut primitive = json!({ "attributes": { "POSITION": positions }, "indices": indices });
            if has_colours {
                primitive["material"] = json!(colour);
            }
            primitives.push(primitive);
        }
        self.meshes.push(json!({ "primitives": primitives }));
        self.meshes.len() - 1
    }

    fn bytes(self, roots: &[usize]) -> Vec<u8> {
        let material = |k: u8| json!({ "name": format!("colour{k}") });
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": roots }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": (0..4).map(material).collect::<Vec<_>>(),
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        });
        glb(json.to_string(), &self.bytes)
    }
}

/// A GLB file with world coordinates and untransformed nodes.
pub(crate) fn write_glb_baked(model: &RandomModel) -> Vec<u8> {
    let mut document = GltfBuilder::default();
    let mut roots = Vec::new();
    for part in model.parts() {
        let mesh = document.mesh(part, model.has_colours(), |p| model.world_from_model.transform_point3(p));
        roots.push(document.node(json!({ "name": part[0].part, "mesh": mesh })));
    }
    document.bytes(&roots)
}

/// A GLB file with short coordinates under nodes that move, scale, mirror and rotate them.
pub(crate) fn write_glb_nested(model: &RandomModel, dice: &mut Dice) -> Vec<u8> {
    let mut document = GltfBuilder::default();
    let mut groups = Vec::new();
    for part in model.parts() {
        let shift = DVec3::new(dice.below(9) as f64, dice.below(9) as f64, dice.below(9) as f64) - 4.0;
        let mut scale = DVec3::splat([0.5, 1.0, 2.0, 4.0][dice.below(4)]);
        if dice.below(3) == 0 {
            scale.x = -scale.x;
        }
        // A mirroring node reverses the winding, so the part is written with reversed faces.
        let mut part = part.to_vec();
        if scale.x < 0.0 {
            part.iter_mut().for_each(Body::reverse);
        }
        let mesh = document.mesh(&part, model.has_colours(), |p| (p - shift) / scale);
        let name = &part[0].part;
        let leaf = document.node(json!({ "name": name, "mesh": mesh, "scale": scale.to_array() }));
        groups.push(document.node(json!({ "children": [leaf], "translation": shift.to_array() })));
    }
    let turn = DQuat::from_mat3(&model.world_from_model.matrix3);
    let root = document.node(json!({
        "children": groups,
        "rotation": turn.to_array(),
        "translation": model.world_from_model.translation.to_array(),
    }));
    document.bytes(&[root])
}
