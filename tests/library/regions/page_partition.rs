//! Regions partition the visible page; rays at random points and closed-form tone borders are the reference.

use crate::library::support::scenes::random_scenes;
use crate::library::support::scenes::round_solids;
use std::collections::BTreeMap;

use crate::library::support::pipeline::{orthographic, perspective, scene};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::solids::{Solid, cuboid, sphere, torus};
use glam::DVec3;
use kurbo::{BezPath, ParamCurve, PathSeg, Point, Shape};
use ligne::drawing::{LayerKind, Mark, Paint};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::lines::Contours;
use ligne::regions::Seams;
use ligne::scene::{Camera, Scene};
use ligne::{Drawing, Style, SvgOptions, render};

/// Two tones under the key light of [`towards_light`]. Regions end at their borders.
fn two_tones() -> Style {
    let sheet = "extends = 'toon'\n[fills]\nthresholds = [0.5]\nseams = 'exact'\n[light]\n\
                 sources = [{ kind = 'directional', direction = [-0.4, 0.6, 0.7], space = 'camera' }]";
    Style::from_toml(sheet).expect("a style")
}

/// Returns the direction towards that light, in world coordinates.
fn towards_light(camera: &Camera) -> DVec3 {
    let eye = TextbookCamera::new(camera);
    (eye.right * -0.4 + eye.up * 0.6 - eye.forward * 0.7).normalize()
}

/// Returns the marks of a layer.
fn marks(drawing: &Drawing, kind: LayerKind) -> Vec<Mark> {
    drawing.layers.iter().filter(|layer| layer.kind == kind).flat_map(|layer| layer.marks.clone()).collect()
}

fn fills(drawing: &Drawing) -> Vec<Mark> {
    marks(drawing, LayerKind::Fills)
}

/// Returns the tones of the regions that contain a point.
fn tones_at(fills: &[Mark], p: Point) -> Vec<u16> {
    fills.iter().filter(|mark| mark.path.winding(p) != 0).filter_map(|mark| mark.provenance.tone).collect()
}

/// Returns points along a path, at most `step` apart.
fn samples(path: &BezPath, step: f64) -> Vec<Point> {
    let along = |segment: PathSeg| {
        let chord = (segment.end() - segment.start()).hypot();
        let count = (chord / step).ceil().max(1.0) as usize * 2;
        (0..=count).map(move |k| segment.eval(k as f64 / count as f64)).collect::<Vec<Point>>()
    };
    path.segments().flat_map(along).collect()
}

#[test]
fn a_cube_has_three_regions_with_exact_corners() {
    let cube = scene([cuboid(DVec3::splat(-1.0), DVec3::ONE)]);
    let camera = perspective(DVec3::new(3.1, 2.3, 4.7), DVec3::ZERO, 40.0);
    // Thresholds between the light values of the three sides.
    let light = towards_light(&camera);
    let mut falls: Vec<f64> = [light.x, light.y, light.z].iter().map(|x| x.max(0.0)).collect();
    falls.sort_by(f64::total_cmp);
    let mut style = two_tones();
    let thresholds: Vec<f64> = falls.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
    assert!(thresholds[0] < thresholds[1]);
    style.tones.scale = ligne::light::tones::tone_options::ToneScale::Thresholds(thresholds);
    let drawing = render(&cube, &camera, &style).unwrap();
    let fills = fills(&drawing);
    assert_eq!(fills.len(), 3);
    let eye = TextbookCamera::new(&camera);
    for (axis, fill) in fills.iter().map(|fill| {
        let tone = fill.provenance.tone.expect("a tone");
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| light[*a].total_cmp(&light[*b]));
        (order[usize::from(tone)], fill)
    }) {
        assert_eq!(fill.path.segments().count(), 4, "{}", fill.path.to_svg());
        let corner = |u: f64, v: f64| {
            let mut p = DVec3::ONE;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            eye.project(p)
        };
        let corners = [corner(-1., -1.), corner(1., -1.), corner(1., 1.), corner(-1., 1.)];
        for corner in corners {
            let near =
                fill.path.segments().map(|s| (s.start() - corner).hypot()).fold(f64::INFINITY, f64::min);
            assert!(near < 2e-3, "a corner is {near} px off");
        }
    }
}

/// Returns the distance of an image point from the image of a circle in space.
fn distance_to_circle(eye: &TextbookCamera, centre: DVec3, axis: DVec3, radius: f64, p: Point) -> f64 {
    let u = axis.any_orthonormal_vector();
    let v = axis.cross(u);
    let count = 20_000;
    let at = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / f64::from(count);
        eye.project(centre + (u * cos(angle) + v * sin(angle)) * radius)
    };
    (0..count as usize).map(|k| (at(k) - p).hypot()).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_tone_border_of_a_sphere_is_a_circle() {
    // Flat faces lie inside the sphere, so coarse meshes also have an inaccurate border.
    for (level, off) in [(4, 0.5), (5, 0.1)] {
        let ball = scene([round_solids::icosphere(level)]);
        for camera in [
            orthographic(DVec3::Z * 5.0, DVec3::ZERO, 2.2),
            perspective(DVec3::new(2., 1., 4.), DVec3::ZERO, 30.0),
        ] {
            let drawing = render(&ball, &camera, &two_tones()).unwrap();
            let fills = fills(&drawing);
            assert_eq!(fills.len(), 2);
            let (eye, light) = (TextbookCamera::new(&camera), towards_light(&camera));
            // The border is the circle n·L = 1/2.
            let (centre, radius) = (light * 0.5, 0.75_f64.sqrt());
            let dark = fills.iter().find(|fill| fill.provenance.tone == Some(0)).expect("a dark side");
            let lit = fills.iter().find(|fill| fill.provenance.tone == Some(1)).expect("a lit side");
            let shared: Vec<Point> = samples(&lit.path, 5.0)
                .into_iter()
                .filter(|p| samples(&dark.path, 5.0).iter().any(|q| (*p - *q).hypot() < 1e-6))
                .collect();
            assert!(shared.len() > 40, "{}", shared.len());
            let worst = shared
                .iter()
                .map(|p| distance_to_circle(&eye, centre, light, radius, *p))
                .fold(0.0, f64::max);
            println!("icosphere {level}: the border is {worst:.4} px off at most");
            assert!(worst < off, "icosphere {level}: {worst} px");
        }
    }
}

/// Each border is one curve shared by both regions, and the outline occurs once. The fills cover the
/// silhouette without gaps or overlaps.
#[test]
fn neighbouring_regions_share_their_borders() {
    let mut dice = Dice::new(5);
    for (kind, model) in [
        ("torus", scene([torus(64, 32, 1.0, 0.4)])),
        ("boxes", random_scenes::random_scene("boxes", &mut dice)),
        ("spheres", random_scenes::random_scene("spheres", &mut dice)),
    ] {
        let camera = Camera::three_quarter().fit(&model);
        let drawing = render(&model, &camera, &two_tones()).unwrap();
        let fills = fills(&drawing);
        assert!(!fills.is_empty());
        let mut uses: BTreeMap<String, i32> = BTreeMap::new();
        for mark in &fills {
            for segment in mark.path.segments() {
                let (there, back) = (format!("{segment:?}"), format!("{:?}", segment.reverse()));
                *uses.entry(there).or_default() += 1;
                *uses.entry(back).or_default() -= 1;
            }
        }
        // The remaining segments form the outline, in one direction.
        let outline: Vec<&String> = uses.iter().filter(|(_, count)| **count > 0).map(|(s, _)| s).collect();
        assert!(uses.values().all(|count| count.abs() <= 1), "{kind}: a border stands twice");
        let inner = fills.iter().map(|mark| mark.path.segments().count()).sum::<usize>() - outline.len();
        assert!(inner > 0 && inner.is_multiple_of(2), "{kind}: {inner} pieces have no counterpart");
        for mark in &fills {
            // Between two curves fitted within 0.15 px, a sliver may be thinner than that and have negative
            // area.
            let area = mark.path.area();
            assert!(area > -0.5, "{kind}: regions turn from x to y, {area}");
        }
    }
}

/// A point on the nearest triangle: its depth, part and light.
struct FrontPoint {
    depth: f64,
    part: usize,
    light: f64,
}

/// Returns the nearest triangle at an image point by testing all triangles, with flat shading.
fn front_point(scene: &Scene, eye: &TextbookCamera, light: DVec3, p: Point) -> Option<FrontPoint> {
    let mut nearest: Option<FrontPoint> = None;
    for (index, part) in scene.parts.iter().enumerate() {
        let geometry = &scene.geometries[part.geometry];
        for triangle in &geometry.triangles {
            let corners =
                triangle.map(|v| part.world_from_part.transform_point3(geometry.positions[v as usize]));
            let [a, b, c] = corners.map(|corner| eye.project(corner));
            let area = (b - a).cross(c - a);
            let weights =
                [(b - p).cross(c - p), (c - p).cross(a - p), (a - p).cross(b - p)].map(|w| w / area);
            if area == 0.0 || weights.iter().any(|w| w.is_nan() || *w < 0.0) {
                continue;
            }
            let inverse: f64 = (0..3).map(|k| weights[k] / eye.depth(corners[k])).sum();
            let depth = if eye.perspective {
                1.0 / inverse
            } else {
                (0..3).map(|k| weights[k] * eye.depth(corners[k])).sum()
            };
            if nearest.as_ref().is_none_or(|known| depth < known.depth) {
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
                let to_eye = if eye.perspective { eye.position - corners[0] } else { -eye.forward };
                let normal = if normal.dot(to_eye) < 0.0 { -normal } else { normal };
                nearest = Some(FrontPoint { depth, part: index, light: normal.dot(light).max(0.0) });
            }
        }
    }
    nearest
}

#[test]
fn fills_match_the_part_and_tone_of_the_front_triangle() {
    let mut dice = Dice::new(11);
    let mut style = two_tones();
    style.lines.contours = Contours::Mesh;
    // Every edge separates two flat faces.
    style.lines.crease_deg = 0.01;
    for kind in ["tetrahedra", "boxes", "interpenetrating boxes", "mixtures"] {
        for _ in 0..4 {
            let model = random_scenes::random_scene(kind, &mut dice);
            // The camera is outside, so nothing lies behind it.
            let turn = dice.turn();
            let camera = Camera { up: turn * DVec3::Y, ..Camera::three_quarter() };
            let camera =
                Camera { eye: camera.target + turn * (camera.eye - camera.target), ..camera }.fit(&model);
            let drawing = render(&model, &camera, &style).unwrap();
            let fills = fills(&drawing);
            let (eye, light) = (TextbookCamera::new(&camera), towards_light(&camera));
            let borders: Vec<Point> = fills.iter().flat_map(|mark| samples(&mark.path, 1.0)).collect();
            let (mut asked, mut wrong) = (0, 0);
            for _ in 0..400 {
                let p =
                    Point::new(dice.between(5.0, camera.width - 5.0), dice.between(5.0, camera.height - 5.0));
                // Small regions are merged into neighbours, so points near a border are skipped.
                if borders.iter().any(|border| (*border - p).hypot() < 3.0) {
                    continue;
                }
                asked += 1;
                let seen = front_point(&model, &eye, light, p);
                let painted: Vec<&Mark> = fills.iter().filter(|mark| mark.path.winding(p) != 0).collect();
                let right = match (&seen, painted.as_slice()) {
                    (None, []) => true,
                    (Some(front), [mark]) => {
                        let part = model.parts[front.part].name.as_str();
                        let tone = u16::from(front.light >= 0.5);
                        let near = (front.light - 0.5).abs() < 1e-3;
                        mark.provenance.part.as_deref() == Some(part)
                            && (near || mark.provenance.tone == Some(tone))
                    }
                    _ => false,
                };
                if !right {
                    let painted: Vec<_> = painted.iter().map(|mark| &mark.provenance).collect();
                    let seen = seen.map(|front| (front.part, front.light));
                    println!("{kind} at {p:?}: {seen:?} is painted as {painted:?}");
                }
                wrong += u32::from(!right);
            }
            assert!(asked > 50, "{kind}: {asked}");
            assert_eq!(wrong, 0, "{kind}: wrong at {wrong} of {asked} points");
        }
    }
}

#[test]
fn lines_are_the_same_with_and_without_fills() {
    for model in
        [scene([torus(48, 24, 1.0, 0.4)]), scene([cuboid(DVec3::splat(-1.0), DVec3::ONE), sphere(24, 1.3)])]
    {
        let camera = Camera::three_quarter().fit(&model);
        let ink = render(&model, &camera, &Style::preset("ink").expect("ink")).unwrap();
        let toon = render(&model, &camera, &Style::preset("toon").expect("toon")).unwrap();
        assert_eq!(marks(&ink, LayerKind::Lines), marks(&toon, LayerKind::Lines));
        let mut bare = Style::preset("toon").expect("toon");
        bare.lines.enabled = false;
        let bare = render(&model, &camera, &bare).unwrap();
        assert!(marks(&bare, LayerKind::Lines).is_empty());
        assert_eq!(fills(&bare).len(), fills(&toon).len());
    }
}

#[test]
fn regions_extend_under_those_painted_later() {
    let ball = scene([sphere(32, 1.0)]);
    let camera = Camera::three_quarter().fit(&ball);
    let mut style = two_tones();
    let exact = fills(&render(&ball, &camera, &style).unwrap());
    style.region.seams = Seams::Underlap;
    let under = fills(&render(&ball, &camera, &style).unwrap());
    assert_eq!((exact.len(), under.len()), (2, 2));
    // The first region grows only along the shared border, and the other does not change.
    assert_eq!(exact[1].path, under[1].path);
    let grown = under[0].path.area() - exact[0].path.area();
    let border = samples(&exact[1].path, 1.0)
        .windows(2)
        .filter(|pair| tones_at(&under[..1], pair[0].midpoint(pair[1])).len() == 1)
        .map(|pair| (pair[1] - pair[0]).hypot())
        .sum::<f64>();
    assert!((grown / border - 0.6).abs() < 0.1, "{grown} over {border}");
}

#[test]
fn fills_carry_tone_and_part_attributes() {
    let model = scene([cuboid(DVec3::splat(-1.0), DVec3::ONE)]);
    let camera = Camera::three_quarter().fit(&model);
    let svg = render(&model, &camera, &Style::preset("toon").expect("toon"))
        .unwrap()
        .to_svg(&SvgOptions::default());
    let fills = svg.find("<g id=\"fills\"").expect("a layer of fills");
    let lines = svg.find("<g id=\"lines\"").expect("a layer of lines");
    assert!(fills < lines, "fills lie below lines");
    let layer = &svg[fills..lines];
    for text in ["class=\"tone-0\"", "data-tone=\"0\"", "data-part=\"part 0\""] {
        assert!(layer.contains(text), "{text} in {layer}");
    }
}

#[test]
fn empty_and_degenerate_scenes_have_no_fills() {
    for model in
        [Scene::default(), scene([Solid { positions: vec![DVec3::ZERO; 3], triangles: vec![[0, 1, 2]] }])]
    {
        let camera = orthographic(DVec3::Z * 5.0, DVec3::ZERO, 2.2);
        let drawing = render(&model, &camera, &two_tones()).unwrap();
        assert!(fills(&drawing).is_empty());
    }
}

#[test]
fn a_camera_inside_a_box_fills_the_page() {
    let room = scene([cuboid(DVec3::splat(-1.0), DVec3::ONE)]);
    let camera = perspective(DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 0.1, 0.2), 90.0);
    let drawing = render(&room, &camera, &two_tones()).unwrap();
    let area: f64 = fills(&drawing)
        .iter()
        .map(|mark| {
            assert!(matches!(mark.paint, Paint::Fill(_)));
            mark.path.area()
        })
        .sum();
    assert!((area - 1e6).abs() < 10.0, "all of the page is painted, not {area}");
}
