//! Feature lines of a model: the number of each kind in several views.
//!
//! ```sh
//! cargo run --example feature_lines [-- MODEL]
//! ```

use ligne::pipeline::{FeatureLines, LineKind, Mesh, Surface, View};
use ligne::scene::NamedView;
use ligne::{Camera, Error, Scene, Style};

fn main() -> Result<(), Error> {
    let castle = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/castle.obj");
    let scene = Scene::open(std::env::args().nth(1).unwrap_or_else(|| castle.to_owned()))?;
    let mesh = Mesh::of(&scene);

    // Borders, creases, material boundaries and intersections depend on the model only. Contours depend on
    // the view.
    let kinds =
        [LineKind::Contour, LineKind::Border, LineKind::Crease, LineKind::Material, LineKind::Intersection];
    print!("{:12}", "view");
    kinds.iter().for_each(|kind| print!("{:>14}", kind.name()));
    println!();
    let mut style = Style::default();
    style.set("lines.crease_deg", 30)?;
    let surface = Surface::of(mesh.clone(), &style);
    for named in [NamedView::Front, NamedView::Right, NamedView::Top, NamedView::Iso] {
        let view = View::of(&surface, &Camera::named(named, scene.up).fit(&scene));
        let found = FeatureLines::of(&surface, &view, &style);

        print!("{:12}", named.name());
        for kind in kinds {
            print!("{:14}", found.segments.iter().filter(|segment| segment.kind == kind).count());
        }
        println!();
    }

    // Only sharp edges, and only very sharp ones.
    style.set("lines.kinds", "['crease']")?;
    for crease_deg in [20.0, 40.0, 80.0] {
        style.set("lines.crease_deg", crease_deg)?;
        let surface = Surface::of(mesh.clone(), &style);
        let view = View::of(&surface, &Camera::named(NamedView::Iso, scene.up).fit(&scene));
        let found = FeatureLines::of(&surface, &view, &style);
        println!("{} edges are creases of more than {crease_deg} degrees", found.segments.len());
    }
    Ok(())
}
