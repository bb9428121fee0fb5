//! Picture brushes: holes are traced, follow bends with the known shares of ink, and leave no fill border
//! uncovered.

use std::path::PathBuf;

use glam::DVec3;
use kurbo::{Point, Shape};
use ligne::colour::pixel_picture::Picture as Pixels;
use ligne::drawing::{Drawing, Mark, Paint};
use ligne::export::{PngOptions, SvgOptions};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;

use crate::library::support::pipeline::{self, orthographic};
use crate::library::support::scenes::solids::{cuboid, sphere};

/// A brush picture in the temporary folder, deleted on drop.
struct BrushPicture(PathBuf);

impl BrushPicture {
    fn new(name: &str, [width, height]: [u32; 2], shade: impl Fn(u32, u32) -> u8) -> Self {
        let file = std::env::temp_dir().join(format!("ligne-dry-{}-{name}.png", std::process::id()));
        let mut encoder = png::Encoder::new(std::fs::File::create(&file).unwrap(), width, height);
        encoder.set_color(png::ColorType::Grayscale);
        let pixels: Vec<u8> = (0..width * height).map(|k| shade(k % width, k / width)).collect();
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        Self(file)
    }

    /// A style with this brush.
    fn style(&self, more: &str, sets: &[&str]) -> Style {
        let image = self.0.display().to_string().replace('\\', "/");
        let mut all = vec![format!("pen.brush={{ image = '{image}'{more} }}")];
        all.extend(["pen.width=20", "pen.silhouette.width=20", "pen.contour.width=20"].map(str::to_owned));
        all.extend(sets.iter().map(|set| (*set).to_owned()));
        Style::load_with("ink", &all).unwrap_or_else(|error| panic!("{error}"))
    }
}

impl Drop for BrushPicture {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// A dark picture with a hole above its middle, half its length and a fifth of its height.
fn picture_with_hole(name: &str) -> BrushPicture {
    BrushPicture::new(
        name,
        [80, 20],
        |x, y| if (20..60).contains(&x) && (4..8).contains(&y) { 255 } else { 0 },
    )
}

fn lines(drawing: &Drawing) -> Vec<&Mark> {
    drawing
        .layers
        .iter()
        .flat_map(|layer| &layer.marks)
        .filter(|mark| !mark.provenance.classes.is_empty())
        .collect()
}

/// A ball whose outline is a circle of radius 250 px around the centre of the page.
fn ball() -> (Scene, Camera) {
    (pipeline::scene([sphere(90, 1.0)]), orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0))
}

#[test]
fn holes_of_a_picture_brush_follow_a_bend() {
    let (scene, camera) = ball();
    let picture = picture_with_hole("bend");
    let drawn = |more: &str| {
        let drawing = render(&scene, &camera, &picture.style(more, &[])).unwrap();
        let [mark] = lines(&drawing)[..] else { panic!("one line") };
        let path = mark.path.clone();
        let middle = Point::new(500.0, 500.0);
        // Share of the circle of a given radius that is inked.
        let inked = |radius: f64| {
            let at = |k: u32| {
                let angle = f64::from(k) / 720.0 * std::f64::consts::TAU;
                middle + kurbo::Vec2::from_angle(angle) * radius
            };
            f64::from((0..720).filter(|k| path.winding(at(*k)) != 0).count() as u32) / 720.0
        };
        let of: Vec<f64> = [-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0].map(|way| inked(250.0 + way)).to_vec();
        (of, path.area().abs())
    };
    let (solid, whole) = drawn(", inside = 'solid'");
    assert!(solid.iter().all(|part| *part > 0.99), "{solid:?}");
    let (traced, less) = drawn("");
    // The hole lies 2 to 6 px to one side of the line and covers half its length.
    let away: Vec<usize> = (0..7).filter(|k| (traced[*k] - 0.5).abs() < 0.02).collect();
    assert!(away == [1] || away == [5], "{traced:?}");
    assert!([0, 2, 3, 4, 6].iter().all(|k| traced[*k] > 0.5), "{traced:?}");
    let hole = 0.5 * 0.2 * whole;
    assert!(((whole - less) / hole - 1.0).abs() < 0.03, "{whole} {less}");
    // In repeat mode, every copy has its hole.
    let (repeated, _) = drawn(", mode = 'repeat'");
    assert!((repeated[away[0]] - 0.5).abs() < 0.02, "{repeated:?}");
}

#[test]
fn image_brushes_follow_a_bend_and_are_embedded_once() {
    let (scene, camera) = ball();
    // Below the middle half as dark as above it, with a hole in the upper half.
    let picture = BrushPicture::new("itself", [80, 20], |x, y| match (x, y) {
        (20..60, 4..8) => 255,
        (_, 10..) => 128,
        _ => 0,
    });
    let style = picture.style(", inside = 'image'", &["pen.colour='#000'", "page.background='#fff'"]);
    let drawing = render(&scene, &camera, &style).unwrap();
    let [mark] = lines(&drawing)[..] else { panic!("one line") };
    assert!(matches!(mark.paint, Paint::Image(_)));
    let seen = Pixels::decode(&drawing.to_png(&PngOptions::default()).unwrap()).unwrap();
    // Mean darkness of the circle at a given distance from the line.
    let dark = |way: f64| {
        let at = |k: u32| {
            let angle = f64::from(k) / 720.0 * std::f64::consts::TAU;
            let p = Point::new(500.0, 500.0) + kurbo::Vec2::from_angle(angle) * (250.0 + way);
            1.0 - f64::from(seen.at(p.x as usize, p.y as usize).r) / 255.0
        };
        (0..720).map(at).sum::<f64>() / 720.0
    };
    let mut of = [-8.5, -4.0, 4.0, 8.5].map(dark);
    // The line may run in either direction.
    if of[0] > of[3] {
        of.reverse();
    }
    let expected = [0.5, 0.5, 0.5, 1.0];
    assert!(of.iter().zip(expected).all(|(own, right)| (own - right).abs() < 0.03), "{of:?}");
    // Many lines with few widths and one ink share the image.
    let box_scene = pipeline::scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
    let camera = orthographic(DVec3::new(3.0, -5.0, 4.0), DVec3::ZERO, 4.0);
    let drawing = render(&box_scene, &camera, &style).unwrap();
    assert!(lines(&drawing).len() > 1);
    assert_eq!(drawing.to_svg(&SvgOptions::default()).matches("<image").count(), 1);
}

#[test]
fn fill_borders_stay_under_dry_brush_ink() {
    // Bristles at both edges of the stroke, nothing between them.
    let picture = BrushPicture::new("bare", [64, 32], |_, y| if (6..26).contains(&y) { 255 } else { 0 });
    let scene = pipeline::scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
    let camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0);
    let bare = |sets: &[&str]| {
        let drawing = render(&scene, &camera, &picture.style("", sets)).unwrap();
        let inked = |p: Point| lines(&drawing).iter().any(|mark| mark.path.winding(p) != 0);
        // Along the 500 px upper edge of the face, away from its corners.
        let at = |k: i32, y: f64| Point::new(500.0 + f64::from(k), 250.0 + y);
        let count = |y: f64| (-200..200).filter(|k| !inked(at(*k, y))).count();
        [count(0.0), count(0.2), count(-0.2), count(3.0), count(-3.0), count(8.5), count(-8.5)]
    };
    assert!(bare(&[])[0] > 390, "the measure sees paper");
    let painted = bare(&["fills.enabled=true"]);
    assert_eq!(painted[..3], [0; 3], "{painted:?}");
    // Away from the border, paper shows between the bristles and the bristles stay in place.
    assert!(painted[3] > 390 && painted[4] > 390 && painted[5] == 0 && painted[6] == 0, "{painted:?}");
}

#[test]
fn ragged_brush_pictures_are_traced_at_page_resolution() {
    let (scene, camera) = ball();
    let dice = |x: u32, y: u32| {
        let mixed = (x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b)).wrapping_mul(0xc2b2_ae35);
        (mixed >> 13) as u8
    };
    let picture = BrushPicture::new("ragged", [2048, 256], dice);
    let drawing = render(&scene, &camera, &picture.style("", &["pen.silhouette.width=6"])).unwrap();
    let count: usize = lines(&drawing).iter().map(|mark| mark.path.elements().len()).sum();
    // The stroke covers 1571 by 6 px. With nine picture samples a pixel, and at least three samples a speck.
    assert!(count > 100 && count < 60_000, "{count}");
}
