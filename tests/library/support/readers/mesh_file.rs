//! Reference reader for OBJ and little-endian PLY meshes, with equal positions welded.

use std::collections::HashMap;

use glam::DVec3;

use super::shared_folder;
use crate::library::support::scenes::solids::Solid;

/// Reads a shared model by name; `None` if it is absent.
pub(crate) fn read_shared_model(name: &str) -> Option<Solid> {
    let bytes = std::fs::read(shared_folder::find(name)?).ok()?;
    let solid = if name.ends_with(".ply") { parse_ply(&bytes) } else { parse_obj(&bytes) };
    Some(weld_vertices(solid))
}

fn parse_obj(bytes: &[u8]) -> Solid {
    let mut solid = Solid::default();
    for line in String::from_utf8_lossy(bytes).lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut number = || words.next().unwrap().parse::<f64>().unwrap();
                solid.positions.push(DVec3::new(number(), number(), number()));
            }
            Some("f") => {
                let corners: Vec<u32> = words
                    .map(|word| {
                        let index: i64 = word.split('/').next().unwrap().parse().unwrap();
                        let count = solid.positions.len() as i64;
                        (if index < 0 { count + index } else { index - 1 }) as u32
                    })
                    .collect();
                triangulate_fan(&corners, &mut solid.triangles);
            }
            _ => {}
        }
    }
    solid
}

fn parse_ply(bytes: &[u8]) -> Solid {
    let marker = b"end_header\n";
    let end = bytes.windows(marker.len()).position(|w| w == marker).unwrap() + marker.len();
    let header = String::from_utf8_lossy(&bytes[..end]);
    let count = |element: &str| -> usize {
        header.lines().find_map(|l| l.strip_prefix(element)).unwrap().trim().parse().unwrap()
    };
    let stride = 4 * header.lines().filter(|l| l.starts_with("property float")).count();
    let mut solid = Solid::default();
    let (vertices, mut rest) = bytes[end..].split_at(count("element vertex") * stride);
    let word = |at: &[u8]| -> [u8; 4] { at[..4].try_into().unwrap() };
    for vertex in vertices.chunks(stride) {
        let number = |n: usize| f64::from(f32::from_le_bytes(word(&vertex[4 * n..])));
        solid.positions.push(DVec3::new(number(0), number(1), number(2)));
    }
    for _ in 0..count("element face") {
        let corners = usize::from(rest[0]);
        let face: Vec<u32> = rest[1..=4 * corners].chunks(4).map(|c| u32::from_le_bytes(word(c))).collect();
        triangulate_fan(&face, &mut solid.triangles);
        rest = &rest[1 + 4 * corners..];
    }
    solid
}

fn triangulate_fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
}

/// Welds vertices with equal positions and drops triangles that become degenerate.
fn weld_vertices(solid: Solid) -> Solid {
    let mut seen = HashMap::new();
    let mut positions = Vec::new();
    let index: Vec<u32> = solid
        .positions
        .iter()
        .map(|&p| {
            *seen.entry([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        })
        .collect();
    let mut triangles: Vec<[u32; 3]> = solid.triangles.iter().map(|t| t.map(|v| index[v as usize])).collect();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    Solid { positions, triangles }
}
