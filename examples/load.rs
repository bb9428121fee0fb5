//! Contents of a model file, and the repairs on the way from its parts to one mesh.
//!
//! ```sh
//! cargo run --example load [-- MODEL]
//! ```

use ligne::pipeline::Mesh;
use ligne::{Error, Scene};

fn main() -> Result<(), Error> {
    let pump = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/pump.glb");
    let model = std::env::args().nth(1).unwrap_or_else(|| pump.to_owned());

    let mut scene = Scene::open(&model)?;
    println!("{model}: {}, {} triangles", scene.format, scene.triangle_count());
    for line in scene.warnings.lines() {
        println!("  reading it: {line}");
    }

    // A part is an instance. It refers to a geometry, which is stored once, and has a transform.
    println!("{} parts that show {} geometries", scene.parts.len(), scene.geometries.len());
    for part in scene.parts.iter().take(8) {
        let triangles = scene.geometries[part.geometry].triangles.len();
        let place = part.world_from_part.translation;
        println!("  {:24} {triangles:6} triangles at {place:.3}", part.name);
    }
    for material in &scene.materials {
        println!("  material {:20} {}", material.name, material.colour.hex());
    }

    // Parts are selected by name before the mesh is built.
    let all = scene.parts.len();
    scene.keep_parts(&[], &["*bolt*".to_owned()]);
    println!("{} of {all} parts are no bolts", scene.parts.len());

    // The mesh holds all parts in world space. Vertices at the same position are welded.
    let mesh = Mesh::of(&scene);
    println!("{} faces, {} vertices", mesh.triangles.len(), mesh.positions.len());
    for line in mesh.warnings(&scene).lines() {
        println!("  cleaning it: {line}");
    }
    Ok(())
}
