//! Edge visibility of glTF files (EXT_mesh_primitive_edge_visibility) overrides the creases found by dihedral
//! angle.

use glam::DVec3;
use ligne::Scene;
use ligne::load::gltf;
use ligne::mesh::{EdgeMark, Mesh};
use ligne::surface::HardEdges;
use serde_json::{Value, json};

use EdgeMark::{Contour, Hard, Hidden, Unmarked};

const CREASE_DEG: f64 = 40.0;

/// Heights of a strip of paper at x = 0, 1, 2, 3. It is folded by 90 degrees at x = 1 and by 45 at x = 2.
const STRIP_HEIGHTS: [f32; 4] = [0.0, 1.0, 0.0, 0.0];

/// Two triangles for each of the three squares of the strip. Vertices 2x and 2x + 1 are at x.
const STRIP_TRIANGLES: [[u32; 3]; 6] = [[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3], [4, 6, 7], [4, 7, 5]];

/// Visibility values of the triangle sides, with every value present. The folds are hidden (0) and a
/// silhouette (1); the diagonals of two flat squares are hard (2 and 3, and 3 alone).
const VISIBILITY_VALUES: [[u8; 3]; 6] = [[2, 0, 2], [3, 0, 2], [0, 1, 3], [0, 0, 0], [0, 2, 0], [0, 0, 0]];

/// Builds a GLB file in memory.
#[derive(Default)]
struct GlbBuilder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl GlbBuilder {
    /// Adds an accessor with its own buffer view and returns its index.
    fn add(&mut self, component: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        self.views.push(json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()}));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = self.views.len() - 1;
        self.accessors
            .push(json!({"bufferView": view, "componentType": component, "count": count, "type": shape}));
        self.accessors.len() - 1
    }

    fn points(&mut self, points: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = points.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
        self.add(5126, "VEC3", points.len(), &bytes)
    }

    fn shorts(&mut self, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.add(5123, "SCALAR", values.len(), &bytes)
    }

    fn octets(&mut self, values: &[u8]) -> usize {
        self.add(5121, "SCALAR", values.len(), values)
    }

    /// Returns the bytes of a file with one primitive and the extension.
    fn glb(self, points: usize, indices: usize, mode: u32, edges: &Value) -> Vec<u8> {
        let name = "EXT_mesh_primitive_edge_visibility";
        let primitive = json!({
            "attributes": {"POSITION": points}, "indices": indices, "mode": mode, "material": 0,
            "extensions": {name: edges},
        });
        let json = json!({
            "asset": {"version": "2.0"}, "extensionsUsed": [name], "extensionsRequired": [name],
            "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{}, {"name": "edges"}],
            "meshes": [{"primitives": [primitive]}],
            "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": self.bytes.len()}],
        });
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut glb = b"glTF".to_vec();
        for word in [2, 28 + json.len() + self.bytes.len(), json.len()] {
            glb.extend((word as u32).to_le_bytes());
        }
        glb.extend(
            [&b"JSON"[..], &json, &(self.bytes.len() as u32).to_le_bytes(), b"BIN\0", &self.bytes].concat(),
        );
        glb
    }

    /// Reads the file as a scene.
    fn read(self, points: usize, indices: usize, mode: u32, edges: &Value) -> Result<Scene, String> {
        let glb = self.glb(points, indices, mode, edges);
        gltf::read_bytes(&glb, &|_, _| Err(std::io::ErrorKind::NotFound.into())).map_err(|e| e.to_string())
    }
}

/// Packs two-bit values into bytes, lowest bits first.
fn packed(values: &[u8]) -> Vec<u8> {
    let byte = |four: &[u8]| four.iter().rev().fold(0, |byte, value| byte << 2 | value);
    values.chunks(4).map(byte).collect()
}

fn strip_points() -> Vec<[f32; 3]> {
    (0..8).map(|i| [(i / 2) as f32, (i % 2) as f32, STRIP_HEIGHTS[i / 2]]).collect()
}

/// Reads the strip with edge data; `make` adds the accessors that the data needs.
fn strip(make: impl FnOnce(&mut GlbBuilder) -> Value) -> Result<Scene, String> {
    let mut file = GlbBuilder::default();
    let points = file.points(&strip_points());
    let indices = file.shorts(&STRIP_TRIANGLES.as_flattened().iter().map(|i| *i as u16).collect::<Vec<_>>());
    let edges = make(&mut file);
    file.read(points, indices, 4, &edges)
}

fn marks(scene: &Scene) -> &[[EdgeMark; 3]] {
    &scene.geometries[0].edge_marks
}

/// Returns the creases as the columns and rows of their ends, sorted.
fn creases(scene: &Scene) -> Vec<[(i32, i32); 2]> {
    let mesh = Mesh::build(scene.to_soup());
    let hard = HardEdges::above(&mesh, CREASE_DEG);
    let place = |v: u32| {
        let p: DVec3 = mesh.positions[v as usize] + mesh.origin;
        (p.x.round() as i32, p.y.round() as i32)
    };
    let ends = |e: usize| {
        let mut ends = mesh.edges.vertices[e].map(place);
        ends.sort_unstable();
        ends
    };
    let mut found: Vec<_> = (0..mesh.edges.len()).filter(|e| hard.is_hard(*e)).map(ends).collect();
    found.sort_unstable();
    found
}

const FOLDS: [[(i32, i32); 2]; 2] = [[(1, 0), (1, 1)], [(2, 0), (2, 1)]];
const DIAGONALS: [[(i32, i32); 2]; 2] = [[(0, 0), (1, 1)], [(1, 0), (2, 1)]];

#[test]
fn every_visibility_value_maps_to_its_edge_mark() {
    assert_eq!(creases(&strip(|_| json!({})).unwrap()), FOLDS);
    let scene =
        strip(|file| json!({"visibility": file.octets(&packed(VISIBILITY_VALUES.as_flattened()))})).unwrap();
    let wanted =
        VISIBILITY_VALUES.map(|sides| sides.map(|side| [Hidden, Contour, Hard, Hard][side as usize]));
    assert_eq!(marks(&scene), wanted);
    assert_eq!(creases(&scene), DIAGONALS);
    assert!(scene.warnings.is_empty());
}

#[test]
fn strips_and_fans_are_marked_in_the_order_of_their_triangles() {
    let values = [1, 2, 0, 0, 3, 1];
    let wanted = [[Contour, Hard, Hidden], [Hidden, Hard, Contour]];
    for (mode, order, triangles) in
        [(5, [0, 2, 1, 3], [[0, 2, 1], [2, 3, 1]]), (6, [0, 2, 3, 1], [[2, 3, 0], [3, 1, 0]])]
    {
        let mut file = GlbBuilder::default();
        let (points, indices) = (file.points(&strip_points()), file.shorts(&order));
        let edges = json!({"visibility": file.octets(&packed(&values))});
        let scene = file.read(points, indices, mode, &edges).unwrap();
        assert_eq!(scene.geometries[0].triangles, triangles);
        assert_eq!(marks(&scene), wanted, "mode {mode}");
    }
}

#[test]
fn line_strings_are_hard_and_other_edges_are_hidden() {
    let scene = strip(|file| {
        let (bytes, shorts) = (file.octets(&[0, 3, 5, 255, 2, 3]), file.shorts(&[7, 4]));
        json!({"lineStrings": [{"indices": bytes, "material": 1}, {"indices": shorts}], "material": 1})
    });
    let scene = scene.unwrap();
    assert_eq!(creases(&scene), [DIAGONALS[0], FOLDS[0], [(2, 0), (3, 1)]]);
    assert_eq!(marks(&scene)[0], [Hidden, Hard, Hard]);
    // Borders are drawn as borders, but they keep their marks.
    assert_eq!(marks(&scene)[3], [Hidden, Hard, Hard]);
    assert!(marks(&scene).as_flattened().iter().all(|mark| *mark != Unmarked));
    assert!(scene.warnings.is_empty());

    let both = strip(|file| {
        let visibility = file.octets(&packed(VISIBILITY_VALUES.as_flattened()));
        json!({"visibility": visibility, "lineStrings": [{"indices": file.octets(&[4, 5])}]})
    });
    assert_eq!(creases(&both.unwrap()), [DIAGONALS[0], DIAGONALS[1], FOLDS[1]]);
}

/// With split corners, each face has its own vertices. A line string matches an edge by position, through any
/// of them.
#[test]
fn line_strings_match_edges_by_position() {
    let mut file = GlbBuilder::default();
    let corners = strip_points();
    let split: Vec<[f32; 3]> = STRIP_TRIANGLES.as_flattened().iter().map(|i| corners[*i as usize]).collect();
    let (points, indices) = (file.points(&split), file.shorts(&(0..18).collect::<Vec<_>>()));
    // Vertex 2 of the first triangle and vertex 0 of the third are at the two ends of the first fold.
    let edges = json!({"lineStrings": [{"indices": file.octets(&[2, 6])}]});
    let scene = file.read(points, indices, 4, &edges).unwrap();
    assert_eq!(creases(&scene), [FOLDS[0]]);
}

#[test]
fn invalid_edge_visibility_is_reported() {
    let all = packed(VISIBILITY_VALUES.as_flattened());
    let refused = |make: &dyn Fn(&mut GlbBuilder) -> Value| strip(make).map(|_| ()).unwrap_err();
    let short = refused(&|file| json!({"visibility": file.octets(&all[..4])}));
    assert!(short.contains("accessor 2: 6 triangles need 5 bytes of visibility, there are 4"), "{short}");
    let cut_off = refused(&|file| json!({"visibility": file.add(5121, "SCALAR", 5, &all[..4])}));
    assert!(cut_off.contains("accessor 2") && cut_off.contains("do not fit"), "{cut_off}");
    let absent = refused(&|_| json!({"visibility": 99}));
    assert!(absent.contains("accessor 99"), "{absent}");
    let absent = refused(&|_| json!({"lineStrings": [{"indices": 99}]}));
    assert!(absent.contains("accessor 99"), "{absent}");
    for component in [5120, 5123, 5126] {
        let wide = refused(&|file| json!({"visibility": file.add(component, "SCALAR", 5, &[0; 20])}));
        assert!(wide.contains("accessor 2: bits are stored in unsigned bytes"), "{wide}");
    }

    let scene = strip(|file| json!({"lineStrings": [{"indices": file.octets(&[2, 3, 8, 4, 5])}]})).unwrap();
    assert_eq!(creases(&scene), FOLDS);
    assert_eq!(scene.warnings.lines(), ["2 marked edges left out, with an index that points nowhere"]);
}

#[test]
fn normalized_flags_and_extra_visibility_bytes_are_ignored() {
    let all = packed(VISIBILITY_VALUES.as_flattened());
    let plain = strip(|file| json!({"visibility": file.octets(&all)})).unwrap();
    let normalized = strip(|file| {
        let visibility = file.octets(&[&all[..], &[255, 255]].concat());
        file.accessors[visibility]["normalized"] = json!(true);
        json!({"visibility": visibility, "silhouetteMates": visibility})
    });
    assert_eq!(marks(&plain), marks(&normalized.unwrap()));
}
