//! Feature lines of a model: the number of each kind in several views.
//!
//! ```sh
//! cargo run --example feature_lines [-- MODEL]
//! ```

use ligne::lines::{self, LineKind, LineOptions, Surface};
use ligne::mesh::Mesh;
use ligne::scene::NamedView;
use ligne::view::View;
use ligne::{Camera, Error, Scene};

fn main() -> Result<(), Error> {
    let castle = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/castle.obj");
    let scene = Scene::open(std::env::args().nth(1).unwrap_or_else(|| castle.to_owned()))?;
    let mesh = Mesh::build(scene.to_soup());

    // Borders, creases, material boundaries and intersections depend on the model only. Contours depend on
    // the view.
    let kinds =
        [LineKind::Contour, LineKind::Border, LineKind::Crease, LineKind::Material, LineKind::Intersection];
    print!("{:12}", "view");
    kinds.iter().for_each(|kind| print!("{:>14}", kind.name()));
    println!();
    let options = LineOptions { crease_deg: 30.0, ..LineOptions::default() };
    let surface = Surface::new(mesh.clone(), &options);
    for named in [NamedView::Front, NamedView::Right, NamedView::Top, NamedView::Iso] {
        let camera = Camera::named(named, scene.up).fit(&scene);
        let view = View::new(&surface.mesh, &camera);
        let found = lines::extract(&surface, &view, &options);

        print!("{:12}", named.name());
        for kind in kinds {
            print!("{:14}", found.segments.iter().filter(|segment| segment.kind == kind).count());
        }
        println!();
    }

    // Options are data: only sharp edges, and only very sharp ones.
    let view = View::new(&mesh, &Camera::named(NamedView::Iso, scene.up).fit(&scene));
    for crease_deg in [20.0, 40.0, 80.0] {
        let options = LineOptions { kinds: vec![LineKind::Crease], crease_deg, ..LineOptions::default() };
        let surface = Surface::new(mesh.clone(), &options);
        let found = lines::extract(&surface, &view, &options);
        println!("{} edges are creases of more than {crease_deg} degrees", found.segments.len());
    }
    Ok(())
}
