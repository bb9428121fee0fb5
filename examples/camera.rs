//! Cameras: named views, angles, framing, and camera records for other programs.
//!
//! ```sh
//! cargo run --example camera [-- FOLDER]
//! ```

use std::path::PathBuf;

use ligne::scene::{NamedView, Projection};
use ligne::{Camera, Scene, Style, SvgOptions, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(std::env::temp_dir, PathBuf::from);
    let scene = Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/gear.obj"))?;
    let style = Style::default();

    // Every way to choose a view gives a direction. `fit` then moves the camera until the model fills the
    // frame. Set the frame and the projection first.
    let isometric = Camera::named(NamedView::Iso, scene.up).with_frame(800.0, 600.0).fit(&scene);
    let low = Camera::azimuth_elevation(-25.0, 8.0, scene.up).with_frame(800.0, 300.0).fit(&scene);
    let wide = Camera::three_quarter_of(scene.up)
        .with_projection(Projection::Perspective { fov_y_deg: 75.0 })
        .fit(&scene);

    // All values set directly: closer to the axle than framing would be.
    let (least, greatest) = scene.bounds().ok_or("the model is empty")?;
    let near = Camera { target: (least + greatest) / 2.0, eye: wide.target.lerp(wide.eye, 0.6), ..wide };
    near.validate()?;

    for (name, camera) in [("isometric", isometric), ("low", low), ("wide", wide), ("near", near)] {
        let drawing = render(&scene, &camera, &style)?;
        let picture = folder.join(format!("camera-{name}.svg"));
        std::fs::write(&picture, drawing.to_svg(&SvgOptions::default()))?;

        // The record stores all bits, so reading it gives the same camera.
        let record = folder.join(format!("camera-{name}.json"));
        std::fs::write(&record, camera.to_json())?;
        assert_eq!(Camera::open(&record)?, camera);
        println!("{}\n  {}", picture.display(), camera.to_json().trim_end());
    }
    Ok(())
}
