//! Light, tones and colours in closed form.

mod colours;
mod highlights;
mod lights;

use glam::DVec3;

use super::{LightOptions, Shading, SurfacePoint, ToneOptions};
use crate::mesh::Mesh;
use crate::scene::{Camera, Projection, Scene};
use crate::view::Frame;

/// Camera at `eye` that looks at the world origin, z up.
fn frame(eye: DVec3) -> Frame {
    let projection = Projection::Orthographic { height: 2.0 };
    let camera = Camera {
        eye,
        target: DVec3::ZERO,
        up: DVec3::Z,
        projection,
        width: 100.0,
        height: 100.0,
        near: None,
    };
    Frame::new(&camera, DVec3::ZERO)
}

fn empty_mesh() -> Mesh {
    Mesh::default()
}

/// Shading of a scene seen from the front, and its warnings.
fn shading_and_warnings(scene: &Scene, light: &LightOptions, tones: &ToneOptions) -> (Shading, Vec<String>) {
    let mut warnings = Vec::new();
    let frame = frame(DVec3::new(0.0, -9.0, 0.0));
    (Shading::new(scene, &[], &empty_mesh(), &frame, light, tones, &mut warnings), warnings)
}

fn surface_point(position: DVec3, normal: DVec3) -> SurfacePoint {
    SurfacePoint { position, normal: normal.normalize_or_zero(), ambient_visibility: 1.0 }
}

fn assert_near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12, "{a} is not {b}");
}
