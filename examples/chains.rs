//! Chains: how linking, smoothing and fitting change the edges of the view map.
//!
//! ```sh
//! cargo run --example chains [-- MODEL]
//! ```

use ligne::chains::{self, ChainOptions};
use ligne::drawing::{Length, Unit};
use ligne::lines::{self, HiddenLines, LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::view::View;
use ligne::visibility;
use ligne::{Camera, Error, Scene};

fn main() -> Result<(), Error> {
    let teapot = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/teapot.obj");
    let scene = Scene::open(std::env::args().nth(1).unwrap_or_else(|| teapot.to_owned()))?;
    let options = LineOptions::default();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let surface = Surface::new(Mesh::build(scene.to_soup()), &options).finer_for(&camera);
    let view = View::new(&surface.mesh, &camera);
    let map = visibility::build(&surface.mesh, &view, &lines::extract(&surface, &view, &options), &options);
    let visible = map.edges.iter().filter(|edge| edge.invisibility == 0).count();
    println!("{visible} visible view edges");

    // A length of 0 disables its step. Without any step, chains consist of mesh edges.
    let off = ChainOptions {
        smooth: Length::px(0.0),
        simplify: Length::px(0.0),
        tidy: Length::px(0.0),
        fit: false,
        ..ChainOptions::default()
    };
    let ways = [
        ("only linked", off.clone()),
        ("and tidied", ChainOptions { tidy: Length::px(4.0), ..off.clone() }),
        ("and simplified", ChainOptions { tidy: Length::px(4.0), simplify: Length::px(0.05), ..off }),
        ("as by default", ChainOptions::default()),
    ];
    for (name, options) in ways {
        // Hidden contours are linked as well, but not drawn here.
        let mut chains = chains::link(&map, &options, Unit::Px, HiddenLines::None);
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
