//! Built-in styles with overrides, and a default camera and page for a scene.

use ligne::Style;
use ligne::drawing::{Page, Unit};
use ligne::scene::{Camera, Scene};

/// The built-in style `name` with the overrides `sets`, each `key=value`.
pub(crate) fn style_with(name: &str, sets: &[&str]) -> Style {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Style::load_with(name, &sets).expect("a style")
}

/// A three-quarter view that fits the scene.
pub(crate) fn fitted_camera(scene: &Scene) -> Camera {
    Camera::three_quarter_of(scene.up).fit(scene)
}

/// A page in px with the size of the camera's frame, without background.
pub(crate) fn page_of_camera(camera: &Camera) -> Page {
    Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None }
}
