//! [`LightView`]: the view of the mesh from a light, in one image or six.

use crate::parallel::prelude::*;
use glam::DVec3;

use crate::geometry::numbers::portable_math::atan2;
use crate::light::Caster;
use crate::mesh::Mesh;
use crate::scene::{Camera, Projection};
use crate::view::View;

/// Side of the image, user units. A thousandth of it is the px of the line tolerances.
const IMAGE_SIDE_UNITS: f64 = 1000.0;

/// Width of the image, relative to the bounding sphere of the mesh.
const IMAGE_MARGIN_FACTOR: f64 = 1.001;

/// A point light farther than this from the centre of the mesh, in radii of its bounding sphere, needs only
/// one image.
const MIN_SINGLE_VIEW_RADII: f64 = 1.3;

/// View from a light in one direction.
#[derive(Debug, Clone)]
pub(crate) struct LightView {
    pub(crate) view: View,
    /// For one of six images: the axis of its direction (0 to 2), and whether it is the positive direction.
    side: Option<(usize, bool)>,
}

impl LightView {
    /// Whether a point belongs to this image.
    pub(crate) fn shows(&self, point: DVec3) -> bool {
        let Some((axis, upward)) = self.side else { return true };
        let d = point - self.view.frame.eye;
        let size = d.abs();
        let largest = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        largest == axis && (d[axis] > 0.0) == upward
    }
}

/// Views of a light over a mesh; none for a light without valid position or direction.
pub(crate) fn views(mesh: &Mesh, caster: &Caster) -> Vec<LightView> {
    let (middle, radius) = mesh.extents.counted_ball();
    let camera = |eye: DVec3, forward: DVec3, projection: Projection| {
        let up = forward.any_orthonormal_vector();
        Camera {
            eye,
            target: eye + forward * radius,
            up,
            projection,
            width: IMAGE_SIDE_UNITS,
            height: IMAGE_SIDE_UNITS,
            near: None,
        }
    };
    let whole = |camera: Camera| vec![LightView { view: View::new(mesh, &camera), side: None }];
    match *caster {
        Caster::Directional { towards } => {
            let Some(towards) = towards.try_normalize() else { return Vec::new() };
            let height = 2.0 * radius * IMAGE_MARGIN_FACTOR;
            whole(camera(middle + towards * (2.0 * radius), -towards, Projection::Orthographic { height }))
        }
        Caster::Point { position } if !position.is_finite() => Vec::new(),
        Caster::Point { position } => {
            let distance = position.distance(middle);
            if distance > MIN_SINGLE_VIEW_RADII * radius {
                let half = atan2(radius, (distance * distance - radius * radius).sqrt());
                let fov_y_deg = 2.0 * IMAGE_MARGIN_FACTOR * half.to_degrees();
                let towards = (middle - position) / distance;
                return whole(camera(position, towards, Projection::Perspective { fov_y_deg }));
            }
            let projection = Projection::Perspective { fov_y_deg: 90.0 };
            (0..6_usize)
                .into_par_iter()
                .map(|k| {
                    let (axis, upward) = (k / 2, k % 2 == 1);
                    let mut forward = DVec3::ZERO;
                    forward[axis] = if upward { 1.0 } else { -1.0 };
                    let mut camera = camera(position, forward, projection);
                    // The sides of the images are planes through other axes.
                    camera.up = DVec3::ZERO;
                    camera.up[(axis + 1) % 3] = 1.0;
                    LightView { view: View::new(mesh, &camera), side: Some((axis, upward)) }
                })
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    fn mesh() -> Mesh {
        let positions = vec![DVec3::NEG_ONE, DVec3::ONE, DVec3::new(-1.0, 1.0, -1.0)];
        Mesh::build(Soup { positions, triangles: vec![[0, 1, 2]], ..Soup::default() })
    }

    #[test]
    fn each_vertex_is_shown_in_one_light_view() {
        let mesh = mesh();
        for caster in [
            Caster::Directional { towards: DVec3::new(0.0, 0.0, 7.0) },
            Caster::Point { position: DVec3::new(9.0, 1.0, 2.0) },
            Caster::Point { position: DVec3::new(0.1, -0.2, 0.05) },
        ] {
            let views = views(&mesh, &caster);
            for p in &mesh.positions {
                let shown: Vec<&LightView> = views.iter().filter(|v| v.shows(*p)).collect();
                assert_eq!(shown.len(), 1);
                let image = shown[0].view.frame.image_from_local(*p);
                assert!(
                    image.x >= 0.0
                        && image.x <= IMAGE_SIDE_UNITS
                        && image.y >= 0.0
                        && image.y <= IMAGE_SIDE_UNITS,
                    "{image}"
                );
            }
        }
    }

    #[test]
    fn invalid_lights_have_no_light_views() {
        for caster in [Caster::Directional { towards: DVec3::ZERO }, Caster::Point { position: DVec3::NAN }] {
            assert!(views(&mesh(), &caster).is_empty());
        }
    }
}
