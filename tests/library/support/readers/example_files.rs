//! Reference readers for the example models: OBJ, STL, PLY and GLB, without the library.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::Value;

/// Coordinates x, y, z.
pub(crate) type Coordinates = [f64; 3];

/// A part: its name, its points and its triangles.
pub(crate) struct FilePart {
    pub name: String,
    pub points: Vec<Coordinates>,
    pub faces: Vec<[usize; 3]>,
}

/// The path of an example model.
pub(crate) fn example_path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name)
}

pub(crate) fn example_bytes(name: &str) -> Vec<u8> {
    std::fs::read(example_path(name)).unwrap()
}

/// The objects of an OBJ file, with faces fan-triangulated. Each part holds all points of the file.
pub(crate) fn read_obj(name: &str) -> Vec<FilePart> {
    let mut points: Vec<Coordinates> = Vec::new();
    let mut parts: Vec<FilePart> = Vec::new();
    for line in String::from_utf8(example_bytes(name)).unwrap().lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[0] {
            "o" => parts.push(FilePart { name: words[1].to_owned(), points: Vec::new(), faces: Vec::new() }),
            "v" => points.push([1, 2, 3].map(|k| words[k].parse().unwrap())),
            "f" => {
                let id = |word: &str| word.split('/').next().unwrap().parse::<usize>().unwrap() - 1;
                let corners: Vec<usize> = words[1..].iter().map(|word| id(word)).collect();
                let fan = corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]);
                parts.last_mut().unwrap().faces.extend(fan);
            }
            _ => {}
        }
    }
    parts.iter_mut().for_each(|part| part.points = points.clone());
    parts
}

fn f32_at(bytes: &[u8]) -> f64 {
    f64::from(f32::from_le_bytes(bytes[..4].try_into().unwrap()))
}

fn u32_at(bytes: &[u8]) -> usize {
    u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize
}

pub(crate) fn read_stl(name: &str) -> FilePart {
    let bytes = example_bytes(name);
    let count = u32_at(&bytes[80..]);
    assert_eq!(bytes.len(), 84 + 50 * count);
    let corners = (0..3 * count).map(|i| {
        let start = 84 + 50 * (i / 3) + 12 + 12 * (i % 3);
        [0, 4, 8].map(|k| f32_at(&bytes[start + k..]))
    });
    let faces = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    FilePart { name: name.to_owned(), points: corners.collect(), faces }
}

pub(crate) fn read_ply(name: &str) -> FilePart {
    let bytes = example_bytes(name);
    let mark = b"end_header\n";
    let end = bytes.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len();
    let header = String::from_utf8(bytes[..end].to_vec()).unwrap();
    let count = |what: &str| -> usize {
        header.lines().find_map(|line| line.strip_prefix(what)).unwrap().trim().parse().unwrap()
    };
    let (vertices, faces) = (count("element vertex"), count("element face"));
    let stride = if header.contains("property float nx") { 24 } else { 12 };
    assert_eq!(bytes.len(), end + stride * vertices + 13 * faces);
    let points = (0..vertices).map(|i| [0, 4, 8].map(|k| f32_at(&bytes[end + stride * i + k..]))).collect();
    let start = end + stride * vertices;
    let faces = (0..faces).map(|i| [1, 5, 9].map(|k| u32_at(&bytes[start + 13 * i + k..]))).collect();
    FilePart { name: name.to_owned(), points, faces }
}

/// The part with bitwise equal points merged.
pub(crate) fn weld_points(part: &FilePart) -> FilePart {
    let mut known: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    let mut points = Vec::new();
    let ids: Vec<usize> = part
        .points
        .iter()
        .map(|point| {
            *known.entry(point.map(|value| (value + 0.0).to_bits())).or_insert_with(|| {
                points.push(*point);
                points.len() - 1
            })
        })
        .collect();
    let faces = part.faces.iter().map(|face| face.map(|corner| ids[corner])).collect();
    FilePart { name: part.name.clone(), points, faces }
}

/// A GLB file: its JSON document and its binary buffer.
pub(crate) struct Glb {
    pub document: Value,
    buffer: Vec<u8>,
}

impl Glb {
    pub(crate) fn read(name: &str) -> Self {
        let bytes = example_bytes(name);
        assert_eq!(&bytes[..4], b"glTF");
        let end = 20 + u32_at(&bytes[12..]);
        let document = serde_json::from_slice(&bytes[20..end]).unwrap();
        Self { document, buffer: bytes[end + 8..].to_vec() }
    }

    pub(crate) fn list(&self, name: &str) -> &[Value] {
        self.document[name].as_array().unwrap()
    }

    /// The values of an accessor as slices of `width` bytes.
    pub(crate) fn values(&self, accessor: &Value, width: usize) -> impl Iterator<Item = &[u8]> {
        let accessor = &self.list("accessors")[accessor.as_u64().unwrap() as usize];
        let view = &self.list("bufferViews")[accessor["bufferView"].as_u64().unwrap() as usize];
        assert!(view["byteStride"].is_null(), "values lie close");
        let offset = |of: &Value| of["byteOffset"].as_u64().unwrap_or(0) as usize;
        let start = offset(accessor) + offset(view);
        self.buffer[start..].chunks_exact(width).take(accessor["count"].as_u64().unwrap() as usize)
    }

    pub(crate) fn points(&self, accessor: &Value) -> impl Iterator<Item = Coordinates> {
        self.values(accessor, 12).map(|point| [0, 4, 8].map(|at| f32_at(&point[at..])))
    }

    pub(crate) fn indices(&self, accessor: &Value) -> Vec<usize> {
        match self.list("accessors")[accessor.as_u64().unwrap() as usize]["componentType"].as_u64().unwrap() {
            5121 => self.values(accessor, 1).map(|id| usize::from(id[0])).collect(),
            5123 => self.values(accessor, 2).map(|id| usize::from(id[0]) | usize::from(id[1]) << 8).collect(),
            _ => self.values(accessor, 4).map(u32_at).collect(),
        }
    }
}
