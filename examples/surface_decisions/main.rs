//! Writes what ligne decides of each edge and face of a model, for measurements of its surface rules.
//!
//! `cargo run --release --example surface_decisions -- MODEL OUT [evidence]`
//!
//! With `evidence`, as with `--set lines.surfaces=evidence`. OUT is little-endian: the number of vertices, edges and faces as u64; the position of each vertex as three f64;
//! for each edge two vertices and its flags, for each face three vertices and its flags, as u32. The flags are those
//! of `ligne::internals::decision_flags`.

use std::io::Write;

use ligne::Scene;
use ligne::internals::{SurfaceDecisions, surface_decisions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (model, out, by_evidence) = match arguments.as_slice() {
        [model, out] => (model, out, false),
        [model, out, word] if word == "evidence" => (model, out, true),
        _ => return Err("usage: surface_decisions MODEL OUT [evidence]".into()),
    };
    let SurfaceDecisions { positions, edges, faces } = surface_decisions(&Scene::open(model)?, by_evidence);
    let mut bytes: Vec<u8> = Vec::new();
    for count in [positions.len(), edges.len(), faces.len()] {
        bytes.extend((count as u64).to_le_bytes());
    }
    bytes.extend(positions.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(edges.iter().flatten().chain(faces.iter().flatten()).flat_map(|x| x.to_le_bytes()));
    std::fs::File::create(out)?.write_all(&bytes)?;
    println!("{model}: {} vertices, {} edges, {} faces", positions.len(), edges.len(), faces.len());
    Ok(())
}
