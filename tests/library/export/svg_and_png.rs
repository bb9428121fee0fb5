//! SVG and PNG files contain the drawing at the written precision, checked with independent readers.

use std::sync::Arc;

use kurbo::{BezPath, PathSeg, Point};
use ligne::colour::srgb::Colour;
use ligne::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use ligne::export::{Grouping, PngOptions, Resolution, SvgOptions};

pub(crate) fn stroke(width: f64, colour: Colour) -> Paint {
    Paint::Stroke(StrokePaint {
        width,
        colour,
        cap: Cap::Round,
        join: Join::Round,
        dash: vec![],
        dash_offset: 0.0,
    })
}

pub(crate) fn mark(data: &str, paint: Paint, classes: &[&'static str], part: Option<&str>) -> Mark {
    Mark {
        path: BezPath::from_svg(data).unwrap(),
        paint,
        provenance: Provenance {
            identity: 0,
            places: Arc::default(),
            classes: classes.to_vec(),
            tone: None,
            part: part.map(Arc::from),
            material: None,
            invisibility: 0,
            note: None,
            text: None,
        },
    }
}

pub(crate) fn drawing(marks: Vec<Mark>) -> Drawing {
    let page = Page { width: 100.0, height: 80.0, unit: Unit::Px, background: None };
    Drawing::new("", page, vec![Layer { kind: LayerKind::Lines, pen: None, ordered: false, marks }])
}

/// Deterministic random numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> Point {
        Point::new(self.next() * 1200.0 - 100.0, self.next() * 1200.0 - 100.0)
    }

    /// Random path of lines and curves, with one or two subpaths, some of them closed.
    pub(crate) fn path(&mut self) -> BezPath {
        let mut path = BezPath::new();
        for _ in 0..1 + (self.next() * 2.0) as usize {
            let mut at = self.point();
            path.move_to(at);
            let mut control = at;
            for _ in 0..1 + (self.next() * 12.0) as usize {
                let to = if self.next() < 0.5 { at + (self.point() - at) * 0.01 } else { self.point() };
                match (self.next() * 6.0) as usize {
                    0 => path.line_to(Point::new(to.x, at.y)),
                    1 => path.line_to(Point::new(at.x, to.y)),
                    2 => path.quad_to(self.point(), to),
                    3 => {
                        control = self.point();
                        path.curve_to(self.point(), control, to);
                    }
                    4 => {
                        let mirrored = at + (at - control);
                        control = self.point();
                        path.curve_to(mirrored, control, to);
                    }
                    _ => path.line_to(to),
                }
                at = path.current_position().unwrap();
            }
            if self.next() < 0.3 {
                path.close_path();
            }
        }
        path
    }
}

/// Control points of each segment, rounded to `step`, without zero-length lines.
fn rounded_segments(path: &BezPath, step: f64) -> Vec<Vec<Point>> {
    let round = |p: Point| Point::new((p.x / step).round() * step, (p.y / step).round() * step);
    path.segments()
        .map(|segment| match segment {
            PathSeg::Line(line) => vec![line.p0, line.p1],
            PathSeg::Quad(quad) => vec![quad.p0, quad.p1, quad.p2],
            PathSeg::Cubic(cubic) => vec![cubic.p0, cubic.p1, cubic.p2, cubic.p3],
        })
        .filter(|points| points.iter().any(|p| (round(*p) - round(points[0])).hypot() > step * 0.5))
        .collect()
}

/// Path data of all paths of a document, in order.
fn path_data(svg: &str) -> Vec<String> {
    let paths = svg.split(" d=\"").skip(1);
    paths.map(|rest| rest.split('"').next().unwrap().to_owned()).collect()
}

#[test]
fn paths_read_back_within_half_the_written_precision() {
    let mut random = Random(1);
    let paths: Vec<BezPath> = (0..400).map(|_| random.path()).collect();
    let marks = paths
        .iter()
        .map(|path| Mark {
            path: path.clone(),
            paint: stroke(1.0, Colour::BLACK),
            provenance: Provenance::default(),
        })
        .collect();
    let mut drawing = drawing(marks);
    // Ordered layers keep path directions, so paths can be compared segment by segment.
    drawing.layers[0].ordered = true;
    for precision in [0, 1, 2, 3, 5] {
        let svg = drawing.to_svg(&SvgOptions::default().with_precision(precision));
        let written = path_data(&svg);
        assert_eq!(written.len(), paths.len());
        let step = 10f64.powi(-i32::from(precision));
        for (data, path) in written.iter().zip(&paths) {
            let read = rounded_segments(&BezPath::from_svg(data).unwrap(), step);
            let drawn = rounded_segments(path, step);
            assert_eq!(read.len(), drawn.len(), "{data}\n{}", path.to_svg());
            for (read, drawn) in read.iter().flatten().zip(drawn.iter().flatten()) {
                let off = (read.x - drawn.x).abs().max((read.y - drawn.y).abs());
                assert!(off <= step * 0.5 + 1e-7, "{read:?} {drawn:?} {data}");
            }
        }
    }
}

#[test]
fn usvg_reads_the_same_paths() {
    let mut random = Random(2);
    let paths: Vec<BezPath> = (0..100).map(|_| random.path()).collect();
    let marks = paths.iter().map(|path| Mark {
        path: path.clone(),
        paint: stroke(1.5, Colour::rgb(10, 20, 30)),
        provenance: Provenance::default(),
    });
    let mut drawing = drawing(marks.collect());
    drawing.layers[0].ordered = true;
    let svg = drawing.to_svg(&SvgOptions::default());
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
    let mut read: Vec<usvg::Path> = Vec::new();
    fn collect(group: &usvg::Group, into: &mut Vec<usvg::Path>) {
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => collect(group, into),
                usvg::Node::Path(path) => into.push((**path).clone()),
                _ => {}
            }
        }
    }
    collect(tree.root(), &mut read);
    assert_eq!(read.len(), paths.len());
    for (read, path) in read.iter().zip(&paths) {
        let drawn: Vec<Point> = path.elements().iter().filter_map(|element| element.end_point()).collect();
        let end = drawn.last().unwrap();
        let points = read.data().points();
        assert!(
            points.iter().any(|p| {
                (f64::from(p.x) - end.x).abs() < 0.006 && (f64::from(p.y) - end.y).abs() < 0.006
            })
        );
        let stroke = read.stroke().unwrap();
        assert!((stroke.width().get() - 1.5).abs() < 1e-6);
        assert_eq!(stroke.paint(), &usvg::Paint::Color(usvg::Color::new_rgb(10, 20, 30)));
    }
}

#[test]
fn svg_documents_match_expected_bytes() {
    let grey = Colour { r: 0x80, g: 0x80, b: 0x80, a: 51 };
    let mut hidden = mark("M1 1L9 1", stroke(0.5, grey), &["crease"], Some("a<b"));
    hidden.provenance.invisibility = 3;
    if let Paint::Stroke(stroke) = &mut hidden.paint {
        stroke.dash = vec![2.0, 1.23456];
        stroke.dash_offset = 1.0;
        stroke.cap = Cap::Butt;
    }
    let ink = Colour::rgb(0x1a, 0x1a, 0x1a);
    let drawing = Drawing::new(
        "Jack & Jill",
        Page { width: 210.0, height: 297.0, unit: Unit::Mm, background: Some(Colour::WHITE) },
        vec![
            Layer {
                kind: LayerKind::Fills,
                pen: None,
                ordered: false,
                marks: vec![mark("M0 0L5 0L5 5Z", Paint::Fill(Colour::rgb(1, 2, 3)), &["tone-0"], None)],
            },
            Layer { kind: LayerKind::HiddenLines, pen: None, ordered: false, marks: vec![hidden] },
            Layer {
                kind: LayerKind::Lines,
                pen: None,
                ordered: false,
                marks: vec![
                    mark("M0 0L1 0", stroke(1.0, ink), &["crease"], Some("a<b")),
                    mark("M0 0L2 0", stroke(1.0, ink), &["crease"], Some("c")),
                    mark("M0 0L3 0", stroke(1.0, ink), &["crease"], None),
                    mark("M0 0L4 0", stroke(2.0, ink), &["contour"], None),
                    mark("M0 0L5.0625 0", stroke(2.0, ink), &["contour", "silhouette"], None),
                    mark("M0 0L6 0", stroke(3.0, Colour::BLACK), &["wire"], None),
                ],
            },
        ],
    );
    let wanted = "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\">\n\
<title>Jack &amp; Jill</title>\n\
<g id=\"paper\" inkscape:groupmode=\"layer\" inkscape:label=\"paper\">\n\
<rect width=\"210\" height=\"297\" fill=\"#fff\"/>\n\
</g>\n\
<g id=\"fills\" inkscape:groupmode=\"layer\" inkscape:label=\"fills\" fill=\"#010203\">\n\
<path class=\"tone-0\" d=\"M0 0h5v5z\"/>\n\
</g>\n\
<g id=\"hidden-lines\" inkscape:groupmode=\"layer\" inkscape:label=\"hidden-lines\" fill=\"none\" stroke=\"#808080\" stroke-opacity=\".2\" stroke-width=\".5\" stroke-linejoin=\"round\">\n\
<path class=\"crease\" data-part=\"a&lt;b\" data-invisibility=\"3\" stroke-dasharray=\"2 1.235\" stroke-dashoffset=\"1\" d=\"M1 1h8\"/>\n\
</g>\n\
<g id=\"lines\" inkscape:groupmode=\"layer\" inkscape:label=\"lines\" fill=\"none\" stroke=\"#1a1a1a\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
<path class=\"crease\" d=\"M0 0h3\"/>\n\
<path class=\"crease\" data-part=\"a&lt;b\" d=\"M0 0h1\"/>\n\
<path class=\"crease\" data-part=\"c\" d=\"M0 0h2\"/>\n\
<g stroke-width=\"2\">\n\
<path class=\"contour\" d=\"M0 0h4\"/>\n\
<path class=\"contour silhouette\" d=\"M0 0h5.063\"/>\n\
</g>\n\
<path class=\"wire\" stroke=\"#000\" stroke-width=\"3\" d=\"M0 0h6\"/>\n\
</g>\n\
</svg>\n";
    assert_eq!(drawing.to_svg(&SvgOptions::default()), wanted);

    let options = SvgOptions::default().grouped_by(Grouping::Part).with_id_prefix("fig 1.").with_precision(1);
    let parts = drawing.to_svg(&options);
    assert!(parts.contains("<g id=\"fig-1-paper\""), "{parts}");
    assert!(parts.contains("<g id=\"fig-1-part-a-b\" fill=\"none\""), "{parts}");
    assert!(parts.contains("<title>a&lt;b</title>\n"), "{parts}");
    assert_eq!(parts.matches("<path").count(), 8);
    usvg::Tree::from_str(&parts, &usvg::Options::default()).unwrap();
}

#[test]
fn part_names_with_equal_slugs_get_different_ids() {
    let marks = ["a b", "a-b", "a\u{1}b", "ä", "ö"]
        .map(|part| mark("M0 0L1 1", stroke(1.0, Colour::BLACK), &["crease"], Some(part)));
    let svg = drawing(marks.to_vec()).to_svg(&SvgOptions::default().grouped_by(Grouping::Part));
    for id in ["part-a-b\"", "part-a-b-2\"", "part-a-b-3\"", "part--\"", "part---2\""] {
        assert!(svg.contains(&format!("id=\"{id}")), "{id} {svg}");
    }
    assert!(!svg.contains('\u{1}'));
    usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
}

#[test]
fn pen_layers_are_numbered() {
    let layer = |pen: &str| Layer {
        kind: LayerKind::Lines,
        pen: Some(pen.into()),
        ordered: false,
        marks: vec![mark("M0 0L1 1", stroke(1.0, Colour::BLACK), &["crease"], None)],
    };
    let mut drawing = drawing(vec![]);
    drawing.layers = vec![layer("1 0.35 mm #000000")];
    let svg = drawing.to_svg(&SvgOptions::default());
    assert!(svg.contains("id=\"lines\" inkscape:groupmode=\"layer\" inkscape:label=\"1 0.35 mm #000000\""));
    drawing.layers.push(layer("2 0.7 mm #000000"));
    let svg = drawing.to_svg(&SvgOptions::default());
    assert!(svg.contains("id=\"lines-1\"") && svg.contains("id=\"lines-2\""), "{svg}");
}

#[test]
fn svg_bytes_do_not_depend_on_thread_count() {
    let mut random = Random(3);
    let marks: Vec<Mark> = (0..9000)
        .map(|i| Mark {
            path: random.path(),
            paint: stroke(1.0 + f64::from(i % 3000 / 1000), Colour::BLACK),
            provenance: Provenance { classes: vec!["crease"], ..Provenance::default() },
        })
        .collect();
    let drawing = drawing(marks);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawing.to_svg(&SvgOptions::default()))
    };
    assert!(with(1) == with(3));
}

fn decode(file: &[u8]) -> (png::OutputInfo, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info, pixels)
}

#[test]
fn png_has_the_size_and_the_ink_of_the_drawing() {
    let mut drawing =
        drawing(vec![mark("M10 40L90 40", stroke(10.0, Colour::rgb(200, 0, 0)), &["crease"], None)]);
    let (info, pixels) = decode(&drawing.to_png(&PngOptions::default()).unwrap());
    assert_eq!((info.width, info.height, info.color_type), (100, 80, png::ColorType::Rgba));
    let at = |x: usize, y: usize| pixels[(y * 100 + x) * 4..][..4].to_vec();
    assert_eq!(at(50, 40), [200, 0, 0, 255]);
    assert_eq!(at(50, 60), [0, 0, 0, 0]);

    drawing.page.background = Some(Colour::WHITE);
    let twice = PngOptions::of_resolution(Resolution::Width(200));
    let (info, pixels) = decode(&drawing.to_png(&twice).unwrap());
    assert_eq!((info.width, info.height, info.color_type), (200, 160, png::ColorType::Rgb));
    assert_eq!(pixels[(80 * 200 + 100) * 3..][..3], [200, 0, 0]);
    assert_eq!(pixels[..3], [255, 255, 255]);

    drawing.page.unit = Unit::Mm;
    let (info, _) = decode(&drawing.to_png(&PngOptions::of_resolution(Resolution::Dpi(127.0))).unwrap());
    assert_eq!((info.width, info.height), (500, 400));
}

#[test]
fn png_sizes_without_pixels_or_with_too_many_are_refused() {
    let drawing = drawing(vec![]);
    for resolution in [
        Resolution::Dpi(0.0),
        Resolution::Dpi(f64::NAN),
        Resolution::Dpi(1e9),
        Resolution::Width(0),
        Resolution::Width(100_000),
    ] {
        assert!(drawing.to_png(&PngOptions::of_resolution(resolution)).is_err(), "{resolution:?}");
    }
}
