//! Textures are drawn as regions of a few colours; the reference is the closed-form colour along the line of
//! sight at each point.

use glam::{DVec2, DVec3};
use kurbo::{Point, Shape as _};
use ligne::colour::srgb::Colour;
use ligne::drawing::{LayerKind, Mark};
use ligne::geometry::numbers::portable_math::{acos, atan2};
use ligne::lines::LineKind;
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

use crate::library::support::measures::line_picture::SegmentGrid;
use crate::library::support::measures::plain_fills::{filled_marks, flat_fill_style};
use crate::library::support::references::drawing_judge::{centre_line, visible_line_marks};
use crate::library::support::references::textbook_camera::TextbookCamera;

const CREAM: [u8; 3] = [246, 239, 224];
const SECTORS: [[u8; 3]; 6] = [[214, 66, 52], CREAM, [240, 180, 41], CREAM, [45, 110, 178], CREAM];
const CLOTH: [[u8; 3]; 3] = [[52, 122, 84], [148, 190, 160], [250, 247, 238]];

/// The ball on the cloth, from `examples/models`.
fn picnic() -> Scene {
    Scene::open(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/picnic.obj")).unwrap()
}

/// Returns the texture colour that a line of sight meets: a ball of radius 1/4 on a square cloth of side 1.
/// `None` if it meets neither.
fn true_colour(eye: &TextbookCamera, p: Point) -> Option<[u8; 3]> {
    let (near, far) = (eye.unproject(p, 0.0), eye.unproject(p, 1.0));
    let way = (far - near).normalize();
    let middle = DVec3::new(0.0, 0.25, 0.0);
    let along = (middle - near).dot(way);
    let off2 = (near + way * along - middle).length_squared();
    if off2 < 0.0625 {
        let at = (near + way * (along - (0.0625 - off2).sqrt()) - middle) / 0.25;
        let down = acos(at.y) / std::f64::consts::PI;
        let turn = (atan2(-at.z, at.x) / std::f64::consts::TAU).rem_euclid(1.0);
        let is_cap = !(1.0 / 12.0..11.0 / 12.0).contains(&down);
        return Some(if is_cap { CREAM } else { SECTORS[(turn * 6.0) as usize % 6] });
    }
    let at = near - way * (near.y / way.y);
    let place = DVec2::new(at.x + 0.5, 0.5 - at.z);
    if place.min_element() < 0.0 || place.max_element() > 1.0 {
        return None;
    }
    // The first row of the picture has the largest v.
    let checks = place * 5.0 - (place * 5.0).floor();
    let stripes = usize::from(checks.x < 0.5) + usize::from(checks.y > 0.5);
    Some(CLOTH[2 - stripes])
}

#[test]
fn every_point_has_the_colour_of_its_texture() {
    let scene = picnic();
    for [azimuth, elevation] in [[30.0, 25.0], [-75.0, 50.0], [160.0, 12.0]] {
        let camera = Camera::azimuth_elevation(azimuth, elevation, scene.up).fit(&scene);
        let eye = TextbookCamera::new(&camera);
        let drawing = render(&scene, &camera, &flat_fill_style(&[])).unwrap();
        let fills = filled_marks(&drawing);
        assert!(fills.len() < 120, "{} regions: colours are cut up", fills.len());
        let mut seen = 0;
        for k in 0..200 * 200 {
            let p = Point::new((k % 200) as f64 + 0.5, (k / 200) as f64 + 0.5);
            let p = Point::new(p.x * camera.width / 200.0, p.y * camera.height / 200.0);
            // Skips points near a border, because the ball is a polyhedron and borders have round corners.
            let round = (0..8).map(|k| std::f64::consts::TAU * f64::from(k) / 8.0);
            let mut near = round.map(|t| p + kurbo::Vec2::from_angle(t) * 2.0);
            let Some(own) =
                true_colour(&eye, p).filter(|own| near.all(|q| true_colour(&eye, q) == Some(*own)))
            else {
                continue;
            };
            let top = fills.iter().rev().find(|(mark, _)| mark.path.winding(p) != 0);
            let [r, g, b] = own;
            let off = top.map(|(_, c)| c.r.abs_diff(r).max(c.g.abs_diff(g)).max(c.b.abs_diff(b)));
            assert!(
                off.is_some_and(|off| off <= 4),
                "{p} is {:?}, not {own:?}",
                top.map(|(_, colour)| colour)
            );
            seen += 1;
        }
        assert!(seen > 6000, "{seen} points");
    }
}

#[test]
fn textures_can_be_reduced_to_their_mean_or_ignored() {
    let scene = picnic();
    let camera = Camera::three_quarter().fit(&scene);
    let colours = |changes: &[&str]| {
        let drawing = render(&scene, &camera, &flat_fill_style(changes)).unwrap();
        let mut colours: Vec<Colour> = filled_marks(&drawing).into_iter().map(|(_, colour)| colour).collect();
        colours.sort_unstable();
        colours.dedup();
        colours
    };
    assert_eq!(colours(&["fills.texture='off'"]), [Colour::WHITE]);
    assert_eq!(colours(&["fills.texture='mean'"]).len(), 2);
    assert_eq!(colours(&[]).len(), 6);
    // The ball's texture is a palette, so its colours are kept.
    assert_eq!(colours(&["fills.texture_colours=2"]).len(), 5);
}

#[test]
fn lines_do_not_depend_on_textures() {
    let scene = picnic();
    let camera = Camera::three_quarter().fit(&scene);
    let ink = |change: &str| {
        let style = Style::load_with("toon", &[change.to_owned()]).unwrap();
        let drawing = render(&scene, &camera, &style).unwrap();
        drawing.layers.into_iter().find(|layer| layer.kind == LayerKind::Lines)
    };
    assert_eq!(ink("fills.texture='regions'"), ink("fills.texture='off'"));
}

#[test]
fn artist_lines_follow_colour_changes_of_textures() {
    let scene = picnic();
    let camera = Camera::azimuth_elevation(30.0, 25.0, scene.up).fit(&scene);
    let eye = TextbookCamera::new(&camera);
    let round = |p: Point, radius: f64| {
        (0..16)
            .map(move |k| p + kurbo::Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / 16.0) * radius)
    };
    for style in ["ink", "toon"] {
        let change = "lines.kinds=['contour','border','artist']".to_owned();
        let style = Style::load_with(style, &[change]).unwrap();
        let drawing = render(&scene, &camera, &style).unwrap();
        let is_artist = |mark: &&Mark| mark.provenance.classes.contains(&LineKind::Artist.name());
        let drawn: Vec<[Point; 2]> =
            visible_line_marks(&drawing).filter(is_artist).flat_map(centre_line).collect();
        assert!(drawn.len() > 50, "{} pieces", drawn.len());
        for [a, b] in &drawn {
            let p = a.midpoint(*b);
            let mut seen: Vec<_> = round(p, 2.5).map(|q| true_colour(&eye, q)).collect();
            seen.dedup();
            assert!(seen.len() > 1, "a line at {p}, where nothing changes");
        }
        let all: Vec<[Point; 2]> = visible_line_marks(&drawing).flat_map(centre_line).collect();
        let ink = SegmentGrid::new(all, 4.0);
        let step = camera.width / 300.0;
        for k in 0..300 * 300 {
            let p = Point::new((k % 300) as f64 * step, (k / 300) as f64 * step);
            if p.y < camera.height
                && true_colour(&eye, p) != true_colour(&eye, p + kurbo::Vec2::new(1.0, 0.0))
            {
                assert!(ink.distance(p) < 3.0, "no line at {p}");
            }
        }
    }
    // With a tolerance of 1, no two colours are far enough apart for a line.
    let far = Style::load_with(
        "ink",
        &["lines.kinds=['artist']".to_owned(), "lines.artist_tolerance=1".to_owned()],
    )
    .unwrap();
    assert_eq!(visible_line_marks(&render(&scene, &camera, &far).unwrap()).count(), 0);
}
