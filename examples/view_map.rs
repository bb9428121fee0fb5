//! Visible and hidden lines: lengths in the view map, and the kinds of ends of its edges.
//!
//! ```sh
//! cargo run --example view_map [-- MODEL]
//! ```

use std::collections::{BTreeMap, BTreeSet};

use ligne::pipeline::{FeatureLines, Mesh, Surface, View, ViewMap, ViewVertexKind};
use ligne::{Camera, Error, Scene, Style};

fn main() -> Result<(), Error> {
    let bracket = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/bracket.stl");
    let scene = Scene::open(std::env::args().nth(1).unwrap_or_else(|| bracket.to_owned()))?;

    // Hidden lines are dropped and not counted unless they are requested.
    let mut style = Style::default();
    style.set("lines.hidden", "solid")?;
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let surface = Surface::of(Mesh::of(&scene), &style).finer_for(&camera, 0.15);
    let view = View::of(&surface, &camera);
    let feature_lines = FeatureLines::of(&surface, &view, &style);
    let map = ViewMap::of(&surface, &view, &feature_lines, &style);

    // Each edge of the map is a straight piece of one line with constant invisibility.
    let mut lengths: BTreeMap<u16, f64> = BTreeMap::new();
    for edge in &map.edges {
        let [a, b] = [edge.start, edge.end].map(|vertex| map.vertices[vertex.index()].position);
        *lengths.entry(edge.invisibility).or_default() += a.distance(b);
    }
    println!("{} feature segments became {} view edges", feature_lines.segments.len(), map.edges.len());
    for (surfaces, length) in &lengths {
        println!("  {length:9.1} px of line behind {surfaces} surfaces");
    }

    // Visible lines end where another surface passes in front, at computed points instead of pixels.
    let seen = map.edges.iter().filter(|edge| edge.invisibility == 0);
    let ends: BTreeSet<_> = seen.flat_map(|edge| [edge.start, edge.end]).collect();
    let junctions = ends.iter().map(|vertex| map.vertices[vertex.index()]);
    let junctions: Vec<_> = junctions.filter(|vertex| vertex.kind == ViewVertexKind::TJunction).collect();
    println!("{} T-junctions; the first of them:", junctions.len());
    for vertex in junctions.iter().take(5) {
        println!("  ({:.6}, {:.6}) at depth {:.3}", vertex.position.x, vertex.position.y, vertex.depth);
    }
    Ok(())
}
