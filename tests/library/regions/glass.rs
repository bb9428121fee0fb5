//! Transparent materials: exactly the lines and fills behind glass are drawn thin or tinted; rays through
//! every triangle are the reference.

use std::path::Path;

use glam::DVec3;
use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind, Paint};
use ligne::mesh::{FaceId, Mesh};
use ligne::pipeline::render;
use ligne::scene::{Camera, Scene};
use ligne::style::Style;
use ligne::view::Frame;

use crate::library::support::measures::line_picture::{SegmentGrid, flatten_path, sample_segments};

fn jar() -> (Scene, Camera) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/jar.obj");
    let scene = Scene::open(path).unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    (scene, camera)
}

fn drawn(scene: &Scene, camera: &Camera, style: &str, sets: &[&str]) -> Drawing {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    render(scene, camera, &Style::load_with(style, &sets).unwrap_or_else(|error| panic!("{error}"))).unwrap()
}

const DRAW_GLASS: &str = "glass.draw=glass";
const MESH_CONTOURS: &str = "lines.contours=mesh";

/// Returns the lines behind glass if `veiled` is set, and all other lines otherwise.
fn lines(drawing: &Drawing, veiled: bool) -> Vec<[Point; 2]> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let of = marks.filter(|mark| mark.provenance.tone.is_none());
    of.filter(|mark| mark.provenance.classes.contains(&"veiled") == veiled)
        .flat_map(|mark| flatten_path(&mark.path, 0.01))
        .collect()
}

/// All triangles as ray targets, with a glass flag for each.
struct RayScene {
    mesh: Mesh,
    glass: Vec<bool>,
    frame: Frame,
}

impl RayScene {
    fn new(scene: &Scene, camera: &Camera) -> Self {
        let mesh = Mesh::build(scene.to_soup());
        let is_glass = |face: usize| {
            let material = scene.materials.get(mesh.face_material[face].index());
            material.is_some_and(|material| material.opacity() < 1.0)
        };
        let glass = (0..mesh.triangles.len()).map(is_glass).collect();
        let frame = Frame::new(camera, mesh.origin);
        Self { mesh, glass, frame }
    }

    /// Returns the depth of each surface along the ray through an image point, and whether it is glass.
    fn hits(&self, p: Point) -> Vec<(f64, bool)> {
        let at = self.frame.local_from_image(DVec3::new(p.x, p.y, self.frame.nearness_of(1.0)));
        let way = at - self.frame.eye;
        let hit = |face: usize| {
            let [a, b, c] = self.mesh.corners(FaceId(face as u32));
            let (u, v) = (b - a, c - a);
            let (from, h) = (self.frame.eye - a, way.cross(v));
            let area = u.dot(h);
            let (s, q) = (from.dot(h) / area, from.cross(u));
            let t = way.dot(q) / area;
            let inside = area != 0.0 && s >= 0.0 && t >= 0.0 && s + t <= 1.0;
            inside.then(|| (v.dot(q) / area, self.glass[face]))
        };
        (0..self.mesh.triangles.len()).filter_map(hit).filter(|(depth, _)| *depth > 0.0).collect()
    }

    /// Whether glass is the nearest surface to the left and to the right of a line.
    fn glass_beside(&self, [a, b]: [Point; 2], p: Point) -> [bool; 2] {
        let across = (b - a).normalize().turn_90() * 0.7;
        [p + across, p - across].map(|p| {
            let mut met = self.hits(p);
            met.sort_by(|a, b| a.0.total_cmp(&b.0));
            met.first().is_some_and(|(_, glass)| *glass)
        })
    }
}

#[test]
fn thin_lines_are_exactly_the_lines_behind_glass() {
    let (scene, camera) = jar();
    let world = RayScene::new(&scene, &camera);
    let drawing = drawn(
        &scene,
        &camera,
        "ink",
        &[DRAW_GLASS, MESH_CONTOURS, "chain.smooth=0", "chain.tidy=0", "chain.fit=false"],
    );
    let veiled = lines(&drawing, true);
    let mut asked = 0;
    for segment in &veiled {
        for (p, _) in sample_segments(&[*segment], 7.0) {
            // Next to a line behind glass, the nearest surface is glass on at least one side.
            asked += 1;
            let beside = world.glass_beside(*segment, p);
            assert!(beside.iter().any(|glass| *glass), "{p:?} {beside:?}");
        }
    }
    assert!(asked > 100, "{asked}");
    // All lines of the scene without glass are drawn, either thick or thin.
    let absent = drawn(
        &scene,
        &camera,
        "ink",
        &["glass.draw=absent", MESH_CONTOURS, "chain.smooth=0", "chain.tidy=0"],
    );
    let all = [lines(&drawing, false), veiled.clone()].concat();
    let ink = SegmentGrid::new(all, 4.0);
    let missing: f64 = sample_segments(&lines(&absent, false), 0.5)
        .iter()
        .filter(|(p, _)| ink.distance(*p) > 0.3)
        .map(|(_, l)| l)
        .sum();
    assert!(missing < 1.0, "{missing} px of what is behind the glass are not drawn");
    // Where the nearest surface is opaque, lines do not change.
    let opaque =
        drawn(&scene, &camera, "ink", &[MESH_CONTOURS, "chain.smooth=0", "chain.tidy=0", "chain.fit=false"]);
    let opaque = SegmentGrid::new(lines(&opaque, false), 4.0);
    let lost: f64 = sample_segments(&lines(&drawing, false), 0.5)
        .iter()
        .filter(|(p, _)| opaque.distance(*p) > 0.01)
        .map(|(_, length)| length)
        .sum();
    assert!(lost < 1e-6, "{lost}");
}

#[test]
fn no_line_is_drawn_both_thick_and_thin() {
    let (scene, camera) = jar();
    let drawing = drawn(&scene, &camera, "ink", &[DRAW_GLASS]);
    let thick = SegmentGrid::new(lines(&drawing, false), 4.0);
    let thin = sample_segments(&lines(&drawing, true), 0.5);
    let whole: f64 = thin.iter().map(|(_, length)| length).sum();
    let twice: f64 = thin.iter().filter(|(p, _)| thick.distance(*p) < 0.3).map(|(_, length)| length).sum();
    // Thin lines touch thick ones where they cross or meet.
    assert!(whole > 1500.0 && twice < 0.03 * whole, "{twice} of {whole}");
    let widths = |veiled: bool| -> Vec<f64> {
        let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
        let own = marks.filter(|mark| mark.provenance.classes.contains(&"veiled") == veiled);
        own.filter_map(|mark| match &mark.paint {
            Paint::Stroke(stroke) => Some(stroke.width),
            _ => None,
        })
        .collect()
    };
    let most = |widths: Vec<f64>| widths.into_iter().fold(0.0, f64::max);
    assert!(most(widths(true)) <= 0.5 * most(widths(false)));
}

#[test]
fn colours_behind_glass_are_tinted_and_others_do_not_change() {
    let (scene, camera) = jar();
    let world = RayScene::new(&scene, &camera);
    let fills = |sets: &[&str]| {
        let drawing = drawn(&scene, &camera, "toon", &[sets, &["lines.enabled=false"]].concat());
        drawing.layers.into_iter().find(|layer| layer.kind == LayerKind::Fills).unwrap().marks
    };
    let (glass, absent, opaque) = (fills(&[DRAW_GLASS]), fills(&["glass.draw=absent"]), fills(&[]));
    // The top colour at a point, and the colour below it for panes.
    let at = |marks: &[ligne::drawing::Mark], p: Point| {
        use kurbo::Shape;
        let mut found =
            marks.iter().rev().filter(|mark| mark.path.contains(p)).filter_map(|mark| match mark.paint {
                Paint::Fill(colour) => Some(colour),
                _ => None,
            });
        (found.next(), found.next())
    };
    let mut counts = [0; 2];
    for k in 0..2_000 {
        let p = Point::new(20.0 + f64::from(k * 37 % 960), 20.0 + f64::from(k * 7919 % 961));
        let mut met = world.hits(p);
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        let around =
            [(2., 0.), (-2., 0.), (0., 2.), (0., -2.)].map(|(x, y)| at(&glass, p + kurbo::Vec2::new(x, y)));
        if around.iter().any(|beside| *beside != at(&glass, p)) {
            continue; // near a border
        }
        match met.first() {
            Some((_, true)) => {
                let (over, under) = at(&glass, p);
                assert_eq!(over.map(|colour| colour.a), Some(89), "{p:?}");
                assert_eq!(under, at(&absent, p).0, "{p:?}");
                counts[0] += 1;
            }
            Some((_, false)) => {
                assert_eq!(at(&glass, p).0, at(&opaque, p).0, "{p:?}");
                counts[1] += 1;
            }
            None => assert_eq!(at(&glass, p), (None, None), "{p:?}"),
        }
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}

#[test]
fn glass_casts_no_shadow() {
    let (scene, camera) = jar();
    let shadows = |sets: &[&str]| {
        let sets = [sets, &["fills.cast_shadows=true", "lines.enabled=false"]].concat();
        let drawing = drawn(&scene, &camera, "toon", &sets);
        let layer = drawing.layers.into_iter().find(|layer| layer.kind == LayerKind::Shadows).unwrap();
        let opaque =
            layer.marks.into_iter().filter(|m| matches!(m.paint, Paint::Fill(colour) if colour.a == 255));
        opaque.map(|mark| kurbo::Shape::area(&mark.path).abs()).sum::<f64>()
    };
    let (glass, absent, opaque) = (shadows(&[DRAW_GLASS]), shadows(&["glass.draw=absent"]), shadows(&[]));
    assert!((glass - absent).abs() < 0.01 * absent, "{glass} {absent}");
    assert!((opaque - absent).abs() > 0.1 * absent, "{opaque} {absent}");
}

#[test]
fn glass_materials_can_be_named_by_the_style() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/helmet.obj"));
    let scene = Scene::open(path).unwrap();
    let camera = Camera::three_quarter_of(scene.up).fit(&scene);
    let marks = |sets: &[&str]| -> Vec<ligne::drawing::Mark> {
        drawn(&scene, &camera, "toon", sets).layers.into_iter().flat_map(|layer| layer.marks).collect()
    };
    assert_eq!(marks(&[DRAW_GLASS]), marks(&[]), "nothing of it is glass");
    let named = marks(&[DRAW_GLASS, "glass.materials=['gla*']", "glass.opacity=0.2"]);
    let fifth = |mark: &ligne::drawing::Mark| matches!(mark.paint, Paint::Fill(colour) if colour.a == 51);
    assert!(named.iter().any(fifth), "a visor of one fifth");
    assert!(marks(&["glass.draw=absent", "glass.materials=['*']"]).is_empty());
}
