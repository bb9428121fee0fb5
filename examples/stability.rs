//! How much of a drawing stays in place when the camera turns by a tenth of a degree, and which lines do not.
//!
//! ```sh
//! cargo run --release --example stability -- MODEL…
//! ```

#[path = "../tests/support/eye.rs"]
mod eye;
#[path = "../tests/support/ink.rs"]
mod ink;
#[path = "../tests/support/turning.rs"]
mod turning;
#[path = "../tests/support/validity.rs"]
mod validity;

use ligne::lines::LineOptions;
use ligne::{Camera, Scene};
use turning::{Stability, compare, surface, turned};

fn main() -> Result<(), ligne::Error> {
    let options = LineOptions::default();
    for path in std::env::args().skip(1) {
        let scene = Scene::open(&path)?;
        let surface = surface(&scene, &options);
        let name = path.rsplit('/').next().unwrap_or(&path);
        let mut all = Stability::default();
        for azimuth in [35.0, 125.0, 215.0, 305.0] {
            let camera = Camera::azimuth_elevation(azimuth, 22.0, scene.up).fit(&scene);
            let found = compare(&surface, &options, [&camera, &turned(&camera, &scene, 0.1)]);
            println!("{name:24} azimuth {azimuth}: {:.2} % of {:.0} px", found.share(), found.length / 2.0);
            let mut pops = found.pops.clone();
            pops.sort_by(|a, b| b.gone.total_cmp(&a.gone));
            for pop in pops.iter().take(6) {
                println!("    {pop}");
            }
            all.add(found);
        }
        println!("{name:24} {:.2} % stays, {} lines pop", all.share(), all.pops.len());
    }
    Ok(())
}
