//! Where visible contours of rounded surfaces stop, from 26 sides, and how far they lie from the contour of
//! the polyhedron.
//!
//! ```sh
//! cargo run --release --example contour_validity -- MODEL…
//! ```

#[path = "../tests/support/ink.rs"]
mod ink;
#[path = "../tests/support/polygon_truth.rs"]
mod polygon_truth;
#[path = "../tests/support/validity.rs"]
mod validity;

use ligne::Scene;
use ligne::lines::{LineOptions, Surface};
use ligne::mesh::Mesh;
use polygon_truth::{Both, summary};
use validity::{Tally, cameras, check, view_map};

fn main() -> Result<(), ligne::Error> {
    let options = LineOptions::default();
    let mut table = vec![Tally::header()];
    let mut distances = Vec::new();
    for path in std::env::args().skip(1) {
        let scene = Scene::open(&path)?;
        let surface = Surface::new(Mesh::build(scene.to_soup()), &options);
        let both = Both::of(&scene);
        let mut tally = Tally::default();
        let mut far = Vec::new();
        for camera in cameras(&scene) {
            let found = check(&view_map(&surface, &camera, &options));
            let from = (camera.eye - camera.target).normalize();
            for stop in &found.unexplained {
                println!("{path} from {from:.2}, {:?}: {stop}", camera.projection);
            }
            tally.add(found);
            if tally.views % 4 == 1 {
                far.extend(both.distances(&camera).unwrap_or_default());
            }
        }
        let name = path.rsplit('/').next().unwrap_or(&path);
        table.push(tally.row(name));
        far.sort_by(f64::total_cmp);
        let [half, most, all, share] = summary(&far);
        distances.push(format!(
            "{name:24} {half:.3} px at half, {most:.3} at 95 %, {all:.3} at most; {share:.2} % within 0.5 px"
        ));
    }
    println!("{}\n\nfrom the contour of the polyhedron:\n{}", table.join("\n"), distances.join("\n"));
    Ok(())
}
