//! Chains: how linking, smoothing and fitting change the edges of the view map.
//!
//! ```sh
//! cargo run --example chains [-- MODEL]
//! ```

use ligne::drawing::Unit;
use ligne::pipeline::{Chain, FeatureLines, Mesh, Surface, View, ViewMap};
use ligne::{Camera, Error, Scene, Style};

fn main() -> Result<(), Error> {
    let teapot = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/teapot.obj");
    let scene = Scene::open(std::env::args().nth(1).unwrap_or_else(|| teapot.to_owned()))?;
    let style = Style::default();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let surface = Surface::of(Mesh::of(&scene), &style).finer_for(&camera, 0.15);
    let view = View::of(&surface, &camera);
    let map = ViewMap::of(&surface, &view, &FeatureLines::of(&surface, &view, &style), &style);
    let visible = map.edges.iter().filter(|edge| edge.invisibility == 0).count();
    println!("{visible} visible view edges");

    // A length of 0 disables its step. Without any step, chains consist of mesh edges.
    let mut linked = style.clone();
    linked.set("chain.smooth", 0)?.set("chain.simplify", 0)?.set("chain.tidy", 0)?.set("chain.fit", false)?;
    let tidied = linked.clone().set("chain.tidy", 4)?.clone();
    let simplified = tidied.clone().set("chain.simplify", 0.05)?.clone();
    let ways = [
        ("only linked", linked),
        ("and tidied", tidied),
        ("and simplified", simplified),
        ("as by default", style),
    ];
    for (name, style) in ways {
        // Hidden contours are linked as well, but not drawn here.
        let mut chains = Chain::link(&map, &style, Unit::Px);
        chains.retain(|chain| chain.invisibility == 0);
        let closed = chains.iter().filter(|chain| chain.closed).count();
        // The first element of a path moves the pen. Each further one is a line or a curve.
        let pieces: usize = chains.iter().map(|chain| chain.path.elements().len() - 1).sum();
        let longest = chains.iter().map(|chain| chain.points.len()).max().unwrap_or(0);
        println!(
            "{name:15} {:4} chains, {closed:3} closed, {pieces:5} lines and curves, \
             the longest has {longest} points",
            chains.len()
        );
    }
    Ok(())
}
