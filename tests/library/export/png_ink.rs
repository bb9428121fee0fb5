//! Ink in PNG files: strokes, dashes, fills and image strokes cover their exact area at all angles, widths
//! and positions.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use kurbo::{Affine, BezPath, Circle, Point, Rect, Shape, Vec2};
use ligne::colour::pixel_picture::Picture;
use ligne::colour::srgb::Colour;
use ligne::drawing::{
    Cap, Drawing, ImagePaint, ImagePiece, Join, Layer, LayerKind, Mark, Page, Paint, PieceContent,
    Provenance, StrokePaint, Unit,
};
use ligne::export::Resolution;
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::{PngOptions, SvgOptions};

const PAGE_SIDE_PX: f64 = 120.0;

/// White page with marks.
fn drawing(marks: Vec<Mark>) -> Drawing {
    let page =
        Page { width: PAGE_SIDE_PX, height: PAGE_SIDE_PX, unit: Unit::Px, background: Some(Colour::WHITE) };
    Drawing::new("ink", page, vec![Layer { kind: LayerKind::Lines, pen: None, ordered: false, marks }])
}

fn mark(path: BezPath, paint: Paint) -> Mark {
    Mark { path, paint, provenance: Provenance::default() }
}

/// Black stroke with butt ends. `dash` is as in SVG.
fn stroke(path: BezPath, width: f64, dash: &[f64]) -> Mark {
    let paint = StrokePaint {
        width,
        colour: Colour::BLACK,
        cap: Cap::Butt,
        join: Join::Round,
        dash: dash.to_vec(),
        dash_offset: 0.0,
    };
    mark(path, Paint::Stroke(paint))
}

/// Darkness of each pixel from 0 to 1, row by row, at `scale` pixels per px.
fn darkness(marks: Vec<Mark>, scale: f64) -> Vec<f64> {
    let options = PngOptions::of_resolution(Resolution::Dpi(96.0 * scale));
    let pixels = drawing(marks).to_pixels(&options).unwrap();
    pixels.rgba.chunks_exact(4).map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).collect()
}

/// Total ink of the marks, px².
fn ink(marks: Vec<Mark>) -> f64 {
    darkness(marks, 1.0).iter().sum()
}

fn direction(angle: f64) -> Vec2 {
    Vec2::new(cos(angle), sin(angle))
}

/// Line of 90 px at an angle, `shift` px off the centre of the page.
fn line(degrees: f64, shift: f64) -> BezPath {
    let way = direction(degrees.to_radians());
    let middle = Point::new(60.0, 60.0) + Vec2::new(-way.y, way.x) * shift;
    let mut path = BezPath::new();
    path.move_to(middle - way * 45.0);
    path.line_to(middle + way * 45.0);
    path
}

const WIDTHS_PX: [f64; 14] = [0.2, 0.3, 0.45, 0.6, 0.8, 0.95, 1.0, 1.01, 1.1, 1.2, 1.5, 2.0, 2.7, 4.3];

#[test]
fn lines_have_the_ink_of_their_width_at_all_angles() {
    for width in WIDTHS_PX {
        for step in 0..=24 {
            for shift in [0.0, 0.13, 0.37, 0.5] {
                let degrees = 7.5 * f64::from(step);
                let ink = ink(vec![stroke(line(degrees, shift), width, &[])]);
                let share = ink / (width * 90.0);
                assert!((share - 1.0).abs() < 0.03, "{width} px at {degrees} degrees, {shift}: {share}");
            }
        }
    }
}

#[test]
fn ink_grows_linearly_with_line_width() {
    for degrees in [0.0, 17.0, 45.0, 90.0] {
        let inks: Vec<f64> =
            (4..60).map(|k| ink(vec![stroke(line(degrees, 0.2), f64::from(k) * 0.05, &[])])).collect();
        for pair in inks.windows(2) {
            let more = (pair[1] - pair[0]) / (90.0 * 0.05);
            assert!((0.7..1.3).contains(&more), "{degrees}: {more}");
        }
    }
}

#[test]
fn circle_strokes_have_even_ink() {
    for width in [0.3, 0.7, 1.0, 1.1, 1.6] {
        let circle = Circle::new((60.0, 60.0), 40.3).to_path(1e-3);
        let dark = darkness(vec![stroke(circle, width, &[])], 1.0);
        let mut sectors = [0.0; 16];
        for (k, dark) in dark.iter().enumerate() {
            // Each pixel is split into 64, so that sectors share the pixels they cut.
            for part in 0..64 {
                let [x, y] = [k % 120, k / 120].map(|place| place as f64);
                let point =
                    Point::new(x + (f64::from(part % 8) + 0.5) / 8.0, y + (f64::from(part / 8) + 0.5) / 8.0);
                let way = point - Point::new(60.0, 60.0);
                let sector = (way.atan2() + PI) / TAU * 16.0;
                sectors[(sector as usize).min(15)] += dark / 64.0;
            }
        }
        let each = width * TAU * 40.3 / 16.0;
        for ink in sectors {
            assert!((ink / each - 1.0).abs() < 0.03, "{width}: {}", ink / each);
        }
    }
}

#[test]
fn dashes_have_the_ink_of_their_lengths() {
    for degrees in [0.0, 30.0, 45.0] {
        let ink = ink(vec![stroke(line(degrees, 0.0), 0.8, &[5.0, 4.0])]);
        assert!((ink / (0.8 * 50.0) - 1.0).abs() < 0.03, "{degrees}: {ink}");
    }
}

#[test]
fn fills_clipped_by_the_page_have_exact_area() {
    let black = |path: BezPath| mark(path, Paint::Fill(Colour::BLACK));
    let half = Circle::new((0.0, 60.0), 30.0).to_path(1e-3);
    assert!((ink(vec![black(half)]) - PI * 450.0).abs() < 1.5);
    let corner = Rect::new(100.25, -50.0, 900.0, 10.6).to_path(1e-3);
    assert!((ink(vec![black(corner)]) - 19.75 * 10.6).abs() < 0.2);
    // The bounds of this path contain the page, but its area does not.
    let around = BezPath::from_svg("M-900 -900H900V-1H-1V900H-900Z").unwrap();
    assert!(ink(vec![black(around)]) < 1e-9);
    // A hole, and two overlapping subpaths.
    let ring = BezPath::from_svg("M10 10H50V50H10ZM20 20V40H40V20Z").unwrap();
    assert!((ink(vec![black(ring)]) - 1200.0).abs() < 0.2);
    let twice = BezPath::from_svg("M10 10H50V50H10ZM20 20H40V40H20Z").unwrap();
    assert!((ink(vec![black(twice)]) - 1600.0).abs() < 0.2);
}

/// Black picture of a stroke, with the opacity `dark(row)`.
fn picture(dark: impl Fn(usize) -> u8) -> Arc<Picture> {
    let pixel = |k: usize| Colour { r: 0, g: 0, b: 0, a: dark(k / 320) };
    Arc::new(Picture { width: 320, height: 32, pixels: (0..320 * 32).map(pixel).collect() })
}

/// Image stroke of 8 by 80 px at an angle. Its pieces extend by 1 px along the stroke and by 0.5 px across
/// it.
fn image_stroke(picture: &Arc<Picture>, degrees: f64, pieces: usize) -> Mark {
    let way = direction(degrees.to_radians());
    let across = Vec2::new(-way.y, way.x);
    let start = Point::new(60.0, 60.0) - way * 40.0 - across * 4.0;
    let to_page = Affine::new([way.x, way.y, across.x, across.y, start.x, start.y]);
    let area = |from: f64, to: f64, more: f64| to_page * Rect::new(from, -more, to, 8.0 + more).to_path(1e-3);
    let long = 80.0 / pieces as f64;
    let piece = |k: usize| ImagePiece {
        outline: area(long * k as f64 - 1.0, long * (k + 1) as f64 + 1.0, 0.5),
        shows: PieceContent::Pixels(to_page * Affine::scale_non_uniform(80.0 / 320.0, 8.0 / 32.0)),
    };
    let image = ImagePaint { picture: Arc::clone(picture), pieces: (0..pieces).map(piece).collect() };
    mark(area(0.0, 80.0, 0.0), Paint::Image(image))
}

/// Smallest and largest darkness well inside the stroke.
fn darkness_range(mark: Mark, degrees: f64, scale: f64) -> (f64, f64) {
    let side = (PAGE_SIDE_PX * scale) as usize;
    let way = direction(degrees.to_radians());
    let inner = darkness(vec![mark], scale).into_iter().enumerate().filter_map(|(k, dark)| {
        let [x, y] = [k % side, k / side].map(|place| (place as f64 + 0.5) / scale);
        let from = Point::new(x, y) - Point::new(60.0, 60.0);
        let (along, across) = (from.dot(way).abs(), from.cross(way).abs());
        (along < 37.0 && across < 2.8).then_some(dark)
    });
    inner.fold((1.0, 0.0), |(low, high), dark| (f64::min(low, dark), f64::max(high, dark)))
}

#[test]
fn image_strokes_are_averaged_along_the_minified_axis() {
    // Streaks of two rows of ink and two of paper. One px has four rows across and four columns along.
    let streaks = picture(|row| if row % 4 < 2 { 255 } else { 0 });
    for degrees in [0.0, 20.0, 45.0, 77.0, 90.0] {
        let (low, high) = darkness_range(image_stroke(&streaks, degrees, 1), degrees, 1.0);
        assert!(low > 0.44 && high < 0.56, "{degrees}: {low} to {high}");
    }
    // One px of the page shows a tenth of a column and four rows.
    let mut long = image_stroke(&streaks, 45.0, 1);
    if let Paint::Image(image) = &mut long.paint {
        let few: Vec<Colour> = image.picture.pixels.chunks(320).flat_map(|row| row[..8].to_vec()).collect();
        image.picture = Arc::new(Picture { width: 8, height: 32, pixels: few });
        for piece in &mut image.pieces {
            if let PieceContent::Pixels(to_page) = &mut piece.shows {
                *to_page *= Affine::scale_non_uniform(40.0, 1.0);
            }
        }
    }
    let (low, high) = darkness_range(long, 45.0, 1.0);
    assert!(low > 0.44 && high < 0.56, "{low} to {high}");
}

#[test]
fn pieces_of_translucent_image_strokes_blend_evenly() {
    let grey = picture(|_| 143);
    for degrees in [0.0, 33.0, 45.0] {
        for scale in [1.0, 4.0] {
            let (low, high) = darkness_range(image_stroke(&grey, degrees, 7), degrees, scale);
            assert!(high - low < 0.02 && (low - 143.0 / 255.0).abs() < 0.02, "{degrees}: {low} to {high}");
        }
    }
    // SVG and PDF paint the stroke in its colour through a mask of opaque pieces.
    let drawing = drawing(vec![image_stroke(&grey, 33.0, 7), image_stroke(&grey, 45.0, 3)]);
    let svg = drawing.to_svg(&SvgOptions::default());
    assert_eq!(svg.matches("<mask ").count(), 2, "{svg}");
    assert_eq!(svg.matches("mask=\"url(#").count(), 2);
    assert!(svg.contains("fill=\"#000\" mask="), "{svg}");
    #[cfg(feature = "pdf")]
    {
        let pdf = drawing.to_pdf();
        let text = String::from_utf8_lossy(&pdf);
        assert_eq!(text.matches("/Luminosity").count(), 2);
    }
    // Opaque pictures and single pieces need only a clip path.
    for mark in [image_stroke(&picture(|_| 255), 33.0, 7), image_stroke(&grey, 33.0, 1)] {
        let svg = self::drawing(vec![mark]).to_svg(&SvgOptions::default());
        assert!(!svg.contains("<mask ") && svg.contains("clip-path="), "{svg}");
    }
}
