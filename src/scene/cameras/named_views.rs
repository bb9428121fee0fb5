//! [`NamedView`]: the views of technical drawing and the three-quarter view, as directions.
//!
//! `d` is the direction from the model to the eye in a z-up world, where the front faces -y. In a y-up world
//! (x, y, z) becomes (x, z, -y), so that the front faces +z.

use glam::DVec3;

use super::camera::{DEFAULT_FOV_Y_DEG, DEFAULT_FRAME_PX};
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::scene::{Camera, Projection, UpAxis};

/// Azimuth of the default view, degrees to the right of the front.
pub(crate) const THREE_QUARTER_AZIMUTH_DEG: f64 = 35.0;

/// Elevation of the default view, degrees above the horizon.
pub(crate) const THREE_QUARTER_ELEVATION_DEG: f64 = 22.0;

/// Elevation in degrees above which the vertical is too close to the view direction to serve as up in the
/// picture.
const MAX_UPRIGHT_ELEVATION_DEG: f64 = 89.0;

/// A view with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum NamedView {
    /// From the front.
    Front,
    /// From behind.
    Back,
    /// From the left of the front view.
    Left,
    /// From the right of the front view.
    Right,
    /// From above, front edge at the bottom of the picture.
    Top,
    /// From below, front edge at the top of the picture.
    Bottom,
    /// Isometric, from the front, right and above: all three axes equally foreshortened.
    Iso,
    /// Dimetric: width and height equally foreshortened, depth half as long (DIN ISO 5456-3).
    Dimetric,
    /// Trimetric: each axis foreshortened differently.
    Trimetric,
}

impl NamedView {
    /// All views.
    pub const ALL: [Self; 9] = [
        Self::Front,
        Self::Back,
        Self::Left,
        Self::Right,
        Self::Top,
        Self::Bottom,
        Self::Iso,
        Self::Dimetric,
        Self::Trimetric,
    ];

    /// Name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::Iso => "iso",
            Self::Dimetric => "dimetric",
            Self::Trimetric => "trimetric",
        }
    }

    /// Alternative name.
    pub(crate) const fn other_name(self) -> Option<&'static str> {
        match self {
            Self::Iso => Some("isometric"),
            _ => None,
        }
    }

    /// Finds a view by its name in any letter case; `isometric` is `iso`.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        let is_its = |own: &str| own.eq_ignore_ascii_case(name);
        Self::ALL.into_iter().find(|view| is_its(view.name()) || view.other_name().is_some_and(is_its))
    }

    /// Direction to the eye, and up, in a z-up world.
    fn direction_and_up(self) -> (DVec3, DVec3) {
        let d = match self {
            Self::Front => DVec3::NEG_Y,
            Self::Back => DVec3::Y,
            Self::Left => DVec3::NEG_X,
            Self::Right => DVec3::X,
            Self::Top => return (DVec3::Z, DVec3::Y),
            Self::Bottom => return (DVec3::NEG_Z, DVec3::NEG_Y),
            Self::Iso => DVec3::new(1.0, -1.0, 1.0),
            // Axes foreshorten by sqrt(1 - d_i^2) = sqrt(8)/3, sqrt(2)/3, sqrt(8)/3.
            Self::Dimetric => DVec3::new(1.0, -f64::sqrt(7.0), 1.0),
            Self::Trimetric => DVec3::new(0.9, -1.4, 0.75),
        };
        (d.normalize(), DVec3::Z)
    }
}

/// Transforms a vector of a z-up world to a world with the given up axis.
fn turned(v: DVec3, up: UpAxis) -> DVec3 {
    match up {
        UpAxis::Z => v,
        UpAxis::Y => DVec3::new(v.x, v.z, -v.y),
    }
}

/// Camera at distance 1 from the origin.
fn looking_from(d: DVec3, up: DVec3, axis: UpAxis, projection: Projection) -> Camera {
    Camera {
        eye: turned(d, axis),
        target: DVec3::ZERO,
        up: turned(up, axis),
        projection,
        width: DEFAULT_FRAME_PX,
        height: DEFAULT_FRAME_PX,
        near: None,
    }
}

impl Camera {
    /// The default view: perspective, from the front, right and above. Sets a direction only; [`Camera::fit`]
    /// frames a model. Y is up; for other models see [`Camera::three_quarter_of`].
    #[must_use]
    pub fn three_quarter() -> Self {
        Self::three_quarter_of(UpAxis::Y)
    }

    /// The default view of a model whose `up` axis is given.
    #[must_use]
    pub fn three_quarter_of(up: UpAxis) -> Self {
        Self::azimuth_elevation(THREE_QUARTER_AZIMUTH_DEG, THREE_QUARTER_ELEVATION_DEG, up)
    }

    /// A named view, orthographic. Sets a direction only; [`Camera::fit`] frames a model.
    #[must_use]
    pub fn named(view: NamedView, up: UpAxis) -> Self {
        let (d, page_up) = view.direction_and_up();
        looking_from(d, page_up, up, Projection::Orthographic { height: 1.0 })
    }

    /// A perspective camera, `azimuth_deg` degrees to the right of the front (90 = the right view, 180 = the
    /// back) and `elevation_deg` above the horizon (-90 to 90). Sets a direction only; [`Camera::fit`] frames
    /// a model.
    #[must_use]
    pub fn azimuth_elevation(azimuth_deg: f64, elevation_deg: f64, up: UpAxis) -> Self {
        let (azimuth, elevation) = (azimuth_deg.to_radians(), elevation_deg.to_radians());
        let horizontal = DVec3::new(sin(azimuth), -cos(azimuth), 0.0);
        let d = horizontal * cos(elevation) + DVec3::Z * sin(elevation);
        let page_up = if elevation_deg.abs() < MAX_UPRIGHT_ELEVATION_DEG {
            DVec3::Z
        } else {
            DVec3::Z * cos(elevation) - horizontal * sin(elevation)
        };
        looking_from(d, page_up, up, Projection::Perspective { fov_y_deg: DEFAULT_FOV_Y_DEG })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-14
    }

    #[test]
    fn z_up_named_views_have_the_axes_of_technical_drawing() {
        let axes = |view| Camera::named(view, UpAxis::Z).axes();
        let [r, u, f] = axes(NamedView::Front);
        assert!(is_near(r, DVec3::X) && is_near(u, DVec3::Z) && is_near(f, DVec3::Y));
        let [r, u, f] = axes(NamedView::Right);
        assert!(is_near(r, DVec3::Y) && is_near(u, DVec3::Z) && is_near(f, DVec3::NEG_X));
        let [r, u, f] = axes(NamedView::Top);
        assert!(is_near(r, DVec3::X) && is_near(u, DVec3::Y) && is_near(f, DVec3::NEG_Z));
        let [r, u, f] = axes(NamedView::Bottom);
        assert!(is_near(r, DVec3::X) && is_near(u, DVec3::NEG_Y) && is_near(f, DVec3::Z));
        let [r, u, _] = axes(NamedView::Iso);
        assert!(is_near(r, DVec3::new(1.0, 1.0, 0.0) / f64::sqrt(2.0)));
        assert!(is_near(u, DVec3::new(-1.0, 1.0, 2.0) / f64::sqrt(6.0)));
    }

    #[test]
    fn y_up_named_views_match_z_up_views() {
        for view in NamedView::ALL {
            let z_up = Camera::named(view, UpAxis::Z).axes();
            let y_up = Camera::named(view, UpAxis::Y).axes();
            for (z, y) in z_up.into_iter().zip(y_up) {
                assert!(is_near(turned(z, UpAxis::Y), y), "{}", view.name());
            }
            assert_eq!(NamedView::parse(view.name()), Some(view));
        }
        assert_eq!(NamedView::parse("Isometric"), Some(NamedView::Iso));
        assert_eq!((NamedView::parse("TOP"), NamedView::parse("tops")), (Some(NamedView::Top), None));
        let iso = Camera::named(NamedView::Iso, UpAxis::Y);
        assert!(is_near(iso.eye, DVec3::ONE / f64::sqrt(3.0)) && iso.up == DVec3::Y);
    }

    #[test]
    fn dimetric_view_halves_the_depth_axis() {
        let [r, u, _] = Camera::named(NamedView::Dimetric, UpAxis::Z).axes();
        let seen = |axis: DVec3| f64::sqrt(axis.dot(r).powi(2) + axis.dot(u).powi(2));
        assert!((seen(DVec3::X) - seen(DVec3::Z)).abs() < 1e-14);
        assert!((seen(DVec3::Y) * 2.0 - seen(DVec3::X)).abs() < 1e-14);
    }

    #[test]
    fn azimuth_and_elevation_agree_with_the_named_views() {
        let angles = [
            (NamedView::Front, 0.0, 0.0),
            (NamedView::Right, 90.0, 0.0),
            (NamedView::Back, 180.0, 0.0),
            (NamedView::Left, -90.0, 0.0),
            (NamedView::Top, 0.0, 90.0),
            (NamedView::Bottom, 0.0, -90.0),
        ];
        for (view, azimuth, elevation) in angles {
            for up in [UpAxis::Y, UpAxis::Z] {
                let named = Camera::named(view, up).axes();
                let turned = Camera::azimuth_elevation(azimuth, elevation, up).axes();
                assert!(named.into_iter().zip(turned).all(|(a, b)| is_near(a, b)), "{}", view.name());
            }
        }
    }

    #[test]
    fn azimuth_elevation_gives_valid_cameras_for_all_angles() {
        for azimuth in [-720.0, 0.0, 33.0, 359.0] {
            for elevation in [-90.0, -89.9999, -45.0, 0.0, 88.9999, 89.0, 90.0] {
                assert_eq!(Camera::azimuth_elevation(azimuth, elevation, UpAxis::Z).validate(), Ok(()));
            }
        }
    }
}
