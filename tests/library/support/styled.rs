//! A style with changes, and a camera and a page for a scene.

use ligne::Style;
use ligne::drawing::{Page, Unit};
use ligne::scene::{Camera, Scene};

/// A style of the project, changed.
pub fn style(name: &str, sets: &[&str]) -> Style {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Style::load(name, &sets).expect("a style")
}

/// The camera of a figure of a scene.
pub fn camera(scene: &Scene) -> Camera {
    Camera::three_quarter_of(scene.up).fit(scene)
}

/// A page as large as the frame of a camera.
pub fn page(camera: &Camera) -> Page {
    Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None }
}
