//! Sections of assemblies: cut areas per part against an exact sweep of the section plane, and hatching
//! inside its part.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use ligne::drawing::{LayerKind, Page, Unit};
use ligne::edit::section::{Plane, Section, cut};
use ligne::kurbo::{ParamCurve as _, PathEl, Point};
use ligne::pipeline::{Renderer, with_cut_hatching};
use ligne::scene::{Geometry, NamedView, Part, Projection};
use ligne::{Camera, Scene, Style};

use crate::library::support::scenes::solids::{Solid, cuboid};

/// Segment where a triangle crosses the plane, in plane coordinates. Material is always on the same side.
struct SectionEdge {
    from: DVec2,
    to: DVec2,
    part: usize,
}

/// Section outlines of all parts. Where parts overlap, the part with the lowest `rank`, the smallest volume,
/// owns the area.
struct ReferenceSection {
    outlines: Vec<SectionEdge>,
    rank: Vec<usize>,
}

fn reference_section(scene: &Scene, plane: &Plane) -> ReferenceSection {
    let mut outlines = Vec::new();
    let mut volumes = vec![0.0_f64; scene.parts.len()];
    for (number, part) in scene.parts.iter().enumerate() {
        let Some(shape) = scene.geometry_of(part) else { continue };
        let corner = |v: u32| part.world_from_part.transform_point3(shape.positions[v as usize]);
        for t in &shape.triangles {
            let corners = t.map(corner);
            volumes[number] += corners[0].dot(corners[1].cross(corners[2])) / 6.0;
            let far = corners.map(|p| plane.distance(p));
            let mut ends = [None; 2];
            for k in 0..3 {
                let n = (k + 1) % 3;
                let rises = far[k] <= 0.0 && far[n] > 0.0;
                if rises || far[k] > 0.0 && far[n] <= 0.0 {
                    // Gives the same result for both faces at an edge.
                    let is_first = corners[k].to_array() < corners[n].to_array();
                    let [a, b, from, to] = if is_first {
                        [
                            plane.flat(corners[k]),
                            plane.flat(corners[n]),
                            DVec2::splat(far[k]),
                            DVec2::splat(far[n]),
                        ]
                    } else {
                        [
                            plane.flat(corners[n]),
                            plane.flat(corners[k]),
                            DVec2::splat(far[n]),
                            DVec2::splat(far[k]),
                        ]
                    };
                    ends[usize::from(rises)] = Some(a + (b - a) * (from / (from - to)));
                }
            }
            if let [Some(from), Some(to)] = ends {
                outlines.push(SectionEdge { from, to, part: number });
            }
        }
    }
    let mut order: Vec<usize> = (0..volumes.len()).collect();
    order.sort_by(|a, b| volumes[*a].abs().total_cmp(&volumes[*b].abs()));
    let mut rank = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, part)| rank[*part] = k);
    ReferenceSection { outlines, rank }
}

impl ReferenceSection {
    fn owner(&self, turns: &BTreeMap<usize, i32>) -> Option<usize> {
        turns
            .iter()
            .filter(|(_, times)| **times != 0)
            .map(|(part, _)| *part)
            .min_by_key(|part| self.rank[*part])
    }

    /// Exact area of each part. Between consecutive heights of corners and crossings, outlines are straight
    /// and keep their order.
    fn areas(&self) -> BTreeMap<usize, f64> {
        let span = |o: &SectionEdge| (o.from.y.min(o.to.y), o.from.y.max(o.to.y));
        let mut order: Vec<&SectionEdge> = self.outlines.iter().filter(|o| o.from.y != o.to.y).collect();
        order.sort_by(|a, b| span(a).0.total_cmp(&span(b).0));
        let mut heights: Vec<f64> = order.iter().flat_map(|o| [o.from.y, o.to.y]).collect();
        for (k, a) in order.iter().enumerate() {
            for b in order[k + 1..].iter().take_while(|b| span(b).0 < span(a).1) {
                let (u, v) = (a.to - a.from, b.to - b.from);
                let share = (b.from - a.from).perp_dot(v) / u.perp_dot(v);
                let other = (b.from - a.from).perp_dot(u) / u.perp_dot(v);
                if (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&other) {
                    heights.push(a.from.y + u.y * share);
                }
            }
        }
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let mut areas = BTreeMap::new();
        let (mut active, mut next): (Vec<&SectionEdge>, usize) = (Vec::new(), 0);
        for pair in heights.windows(2) {
            while next < order.len() && span(order[next]).0 <= pair[0] {
                active.push(order[next]);
                next += 1;
            }
            active.retain(|o| span(o).1 >= pair[1]);
            let y = (pair[0] + pair[1]) / 2.0;
            let across =
                |o: &SectionEdge| o.from.x + (o.to.x - o.from.x) * (y - o.from.y) / (o.to.y - o.from.y);
            let mut row: Vec<(f64, &SectionEdge)> = active.iter().map(|o| (across(o), *o)).collect();
            row.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut turns: BTreeMap<usize, i32> = BTreeMap::new();
            for pieces in row.windows(2) {
                let (x, o) = pieces[0];
                *turns.entry(o.part).or_default() += if o.to.y > o.from.y { 1 } else { -1 };
                if let Some(part) = self.owner(&turns) {
                    *areas.entry(part).or_default() += (pieces[1].0 - x) * (pair[1] - pair[0]);
                }
            }
        }
        areas
    }

    /// Part that owns a point, by winding numbers.
    fn at(&self, p: DVec2) -> Option<usize> {
        let mut turns: BTreeMap<usize, i32> = BTreeMap::new();
        for o in &self.outlines {
            if (o.from.y <= p.y) != (o.to.y <= p.y) {
                let x = o.from.x + (o.to.x - o.from.x) * (p.y - o.from.y) / (o.to.y - o.from.y);
                if x > p.x {
                    *turns.entry(o.part).or_default() += if o.to.y > o.from.y { 1 } else { -1 };
                }
            }
        }
        self.owner(&turns)
    }
}

fn example(name: &str) -> Scene {
    let path = format!("{}/examples/models/{name}", env!("CARGO_MANIFEST_DIR"));
    Scene::open(path).expect("a model")
}

/// Vertical plane slightly off the shaft axes. No face of the models lies in it.
fn plane_near_axes(z: f64) -> Plane {
    Plane::new(DVec3::new(0.0, 0.0, z), DVec3::Z).expect("a direction")
}

fn areas_by_name(scene: &Scene, areas: impl IntoIterator<Item = (usize, f64)>) -> BTreeMap<String, f64> {
    let mut found = BTreeMap::new();
    areas
        .into_iter()
        .for_each(|(part, area)| *found.entry(scene.parts[part].name.clone()).or_default() += area);
    found
}

fn area(section: &Section) -> f64 {
    section.faces.iter().map(|faces| faces.area).sum()
}

#[test]
fn cut_areas_of_assemblies_are_exact() {
    for name in ["pump.glb", "drive.glb"] {
        let scene = example(name);
        for z in [1e-4, 7.3e-3] {
            let plane = plane_near_axes(z);
            let wanted = areas_by_name(&scene, reference_section(&scene, &plane).areas());
            let section = cut(scene.clone(), &plane, &[]);
            assert!(section.scene.warnings.is_empty(), "{}", section.scene.warnings);
            let own = section.faces.iter().map(|faces| (faces.part, faces.area));
            let found = areas_by_name(&section.scene, own);
            let whole: f64 = wanted.values().sum();
            for (part, exact) in &wanted {
                let own = found.get(part).copied().unwrap_or_default();
                assert!(
                    (own - exact).abs() < 1e-6 * exact + 1e-12 * whole,
                    "{name}, {part}: {own}, not {exact}"
                );
            }
            assert!((area(&section) - whole).abs() < 1e-6 * whole, "{name}: {}, not {whole}", area(&section));
            assert!(wanted.len() > 10, "{name}: {}", wanted.len());
        }
    }
}

/// Largest distance of a hatch line from its part, px. Narrower areas count as the neighbour.
const MAX_OFFSET_PX: f64 = 0.5;

#[test]
fn hatch_lines_of_cut_faces_lie_in_their_part() {
    for name in ["pump.glb", "drive.glb"] {
        let scene = example(name);
        let plane = plane_near_axes(1e-4);
        let slice = reference_section(&scene, &plane);
        let camera = Camera::named(NamedView::Front, scene.up).fit(&scene);
        let camera = Camera { width: 2.0 * camera.width, height: 2.0 * camera.height, ..camera };
        let section = cut(scene.clone(), &plane, &[]);
        let style = with_cut_hatching(&Style::preset("technical").expect("a style"), &section);
        let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
        let (drawing, _) = Renderer::new(&section.scene, &style).draw(&camera, page).expect("a drawing");
        let Projection::Orthographic { height } = camera.projection else { unreachable!("a parallel view") };
        let unit = camera.height / height;
        let [right, up, _] = camera.axes();
        let place = |p: Point| {
            let (x, y) = ((p.x - camera.width / 2.0) / unit, (camera.height / 2.0 - p.y) / unit);
            plane.flat(camera.target + right * x + up * y)
        };
        let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Hatching).expect("hatching");
        let mut lines = 0;
        for mark in layer.marks.iter().filter(|mark| mark.provenance.classes == ["pattern"]) {
            let part = mark.provenance.part.as_deref().expect("a part");
            let mut start = Point::ZERO;
            for element in mark.path.elements() {
                let (from, to) = match element {
                    PathEl::LineTo(p) => (std::mem::replace(&mut start, *p), *p),
                    PathEl::MoveTo(p) => {
                        start = *p;
                        continue;
                    }
                    other => panic!("{other:?}"),
                };
                for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let at = from.lerp(to, share);
                    let owner = |dx: f64, dy: f64| {
                        let near = Point::new(at.x + dx, at.y + dy);
                        slice.at(place(near)).map(|part| scene.parts[part].name.as_str())
                    };
                    // Ends lie on region borders, which are exact to a fraction of a px.
                    let is_near = |far: f64| {
                        let around = (0..16).map(|k| f64::from(k) * std::f64::consts::TAU / 16.0);
                        around.into_iter().any(|turn| {
                            owner(
                                far * ligne::geometry::numbers::portable_math::cos(turn),
                                far * ligne::geometry::numbers::portable_math::sin(turn),
                            ) == Some(part)
                        })
                    };
                    let found = owner(0.0, 0.0);
                    let steps = (1..=8).map(|k| MAX_OFFSET_PX * f64::from(k) / 8.0);
                    let is_own = found == Some(part) || steps.into_iter().any(is_near);
                    assert!(is_own, "{name} at {at:?}, {share}: {found:?}, not {part}");
                }
                lines += 1;
            }
        }
        assert!(lines > 300, "{name}: {lines}");
    }
}

fn add_part(scene: &mut Scene, name: &str, solid: Solid) {
    let geometry = scene.geometries.len();
    let Solid { positions, triangles } = solid;
    scene.geometries.push(Geometry { positions, triangles, ..Geometry::default() });
    scene.parts.push(Part { name: name.into(), geometry, world_from_part: glam::DAffine3::IDENTITY });
}

/// A plate with a bolt through it. `bolt_first` sets the order of the parts.
fn bolted(bolt_first: bool) -> Scene {
    let mut scene = Scene::default();
    let plate = cuboid(DVec3::new(-4.0, -4.0, -1.0), DVec3::new(4.0, 4.0, 1.0));
    let mut bolt = cuboid(DVec3::new(-1.0, -1.0, -2.0), DVec3::new(1.0, 1.0, 1.0));
    bolt.add(cuboid(DVec3::new(-2.0, -2.0, 0.5), DVec3::new(2.0, 2.0, 2.0)));
    let mut parts = [("plate", plate), ("bolt", bolt)];
    if bolt_first {
        parts.reverse();
    }
    parts.into_iter().for_each(|(name, solid)| add_part(&mut scene, name, solid));
    scene
}

#[test]
fn a_bolt_owns_its_overlap_with_a_plate() {
    let plane = Plane::new(DVec3::new(0.0, 0.25, 0.0), DVec3::NEG_Y).expect("a direction");
    for bolt_first in [false, true] {
        let section = cut(bolted(bolt_first), &plane, &[]);
        let own = section.faces.iter().map(|faces| (faces.part, faces.area));
        let areas = areas_by_name(&section.scene, own);
        // The shank is 2 wide from z = -2 to 0.5, the head 4 wide up to z = 2. The plate has the rest of
        // 8 by 2.
        assert!((areas["bolt"] - 11.0).abs() < 1e-12 && (areas["plate"] - 11.0).abs() < 1e-12, "{areas:?}");
        let kinds: Vec<usize> = section.faces.iter().map(|faces| faces.kind).collect();
        assert_ne!(kinds[0], kinds[1]);
    }
}

/// Width and sorted end points (in tenths of a px) of each line segment in a front view.
fn line_segments(scene: &Scene, style: &Style) -> Vec<(f64, [[i64; 2]; 2])> {
    let camera = Camera {
        width: 100.0,
        height: 100.0,
        projection: Projection::Orthographic { height: 10.0 },
        ..Camera::named(NamedView::Front, ligne::scene::UpAxis::Z).fit(scene)
    };
    let camera = Camera { target: DVec3::ZERO, eye: DVec3::NEG_Y * 20.0, ..camera };
    let page = Page { width: 100.0, height: 100.0, unit: Unit::Px, background: None };
    let (drawing, _) = Renderer::new(scene, style).draw(&camera, page).expect("a drawing");
    let mut found = Vec::new();
    for layer in drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines) {
        for mark in &layer.marks {
            let ligne::drawing::Paint::Stroke(stroke) = &mark.paint else { continue };
            for segment in mark.path.segments() {
                let ends = [segment.eval(0.0), segment.eval(1.0)];
                let mut ends = ends.map(|p| [(p.x * 10.0).round() as i64, (p.y * 10.0).round() as i64]);
                ends.sort_unstable();
                found.push((stroke.width, ends));
            }
        }
    }
    found.sort_by_key(|a| a.1);
    found
}

#[test]
fn borders_between_cut_parts_are_single_wide_lines() {
    let plane = Plane::new(DVec3::new(0.0, 0.25, 0.0), DVec3::NEG_Y).expect("a direction");
    let mut style = Style::preset("technical").expect("a style");
    style.lines.hidden = ligne::lines::HiddenLines::None;
    let section = cut(bolted(false), &plane, &[]);
    let lines = line_segments(&section.scene, &with_cut_hatching(&style, &section));
    // 10 px per unit, in tenths of a px, y down from the centre. The plate has a lower edge at z = -1, two
    // sides, and an upper edge at z = 1 next to the bolt head. The bolt is outlined all round.
    let point = |x: f64, z: f64| [(500.0 + x * 100.0) as i64, (500.0 - z * 100.0) as i64];
    let corners = |way: &[(f64, f64)]| -> Vec<[[i64; 2]; 2]> {
        let ends = |pair: &[(f64, f64)]| {
            let mut ends = [point(pair[0].0, pair[0].1), point(pair[1].0, pair[1].1)];
            ends.sort_unstable();
            ends
        };
        way.windows(2).map(ends).collect()
    };
    let bolt = [
        (-1.0, -2.0),
        (1.0, -2.0),
        (1.0, 0.5),
        (2.0, 0.5),
        (2.0, 2.0),
        (-2.0, 2.0),
        (-2.0, 0.5),
        (-1.0, 0.5),
        (-1.0, -2.0),
    ];
    let plate = [
        [(-2.0, 1.0), (-4.0, 1.0)],
        [(-4.0, 1.0), (-4.0, -1.0)],
        [(-4.0, -1.0), (-1.0, -1.0)],
        [(1.0, -1.0), (4.0, -1.0)],
        [(4.0, -1.0), (4.0, 1.0)],
        [(4.0, 1.0), (2.0, 1.0)],
    ];
    let mut wanted = corners(&bolt);
    plate.iter().for_each(|side| wanted.extend(corners(side)));
    // Lines may be split at junctions, so covered lengths are compared.
    let covered = |side: &[[i64; 2]; 2]| {
        let long = |a: [i64; 2], b: [i64; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
        let on = |p: [i64; 2]| {
            (0..2).all(|k| p[k] >= side[0][k].min(side[1][k]) - 1 && p[k] <= side[0][k].max(side[1][k]) + 1)
        };
        let own = lines.iter().filter(|(_, ends)| ends.iter().all(|p| on(*p)));
        (long(side[0], side[1]), own.map(|(_, ends)| long(ends[0], ends[1])).sum::<i64>())
    };
    for side in &wanted {
        let (long, own) = covered(side);
        assert!((long - own).abs() <= 3, "{side:?}: {own} of {long} drawn; {lines:?}");
    }
    let sum = |all: &mut dyn Iterator<Item = [[i64; 2]; 2]>| -> i64 {
        all.map(|ends| (ends[0][0] - ends[1][0]).abs() + (ends[0][1] - ends[1][1]).abs()).sum()
    };
    let (all, told) = (sum(&mut lines.iter().map(|(_, ends)| *ends)), sum(&mut wanted.iter().copied()));
    assert!((all - told).abs() <= 20, "{all} drawn, {told} wanted: {lines:?}");
    let wide = 0.5 * 96.0 / 25.4;
    assert!(lines.iter().all(|(width, _)| (width - wide).abs() < 1e-9), "{lines:?}");
}
