//! Hatching of sections: lines lie in the material of their part, at its angle and spacing.

use glam::DVec3;
use ligne::drawing::{LayerKind, Page, Unit};
use ligne::edit::section::cut;
use ligne::kurbo::{PathEl, Point};
use ligne::pipeline::{Renderer, with_cut_hatching};
use ligne::scene::{NamedView, UpAxis};
use ligne::{Camera, Scene, Style};

use super::sections::{add_part, area, inside_out, plane, prism};

#[test]
fn hatch_lines_lie_in_material_at_the_angle_of_their_part() {
    let mut scene = Scene { up: UpAxis::Z, ..Scene::default() };
    let mut pipe = prism(48, 2.0);
    pipe.add(inside_out(prism(48, 1.0)));
    add_part(&mut scene, "pipe", pipe);
    add_part(&mut scene, "core", prism(48, 0.8));
    let whole = scene.clone();
    let section = cut(scene, &plane(DVec3::ZERO, DVec3::Z), &[]);
    let camera = Camera::named(NamedView::Top, UpAxis::Z).fit(&whole);
    for preset in ["ink", "technical", "toon", "pencil"] {
        let style = with_cut_hatching(&Style::preset(preset).expect("a style"), &section);
        let page = Page { width: camera.width, height: camera.height, unit: Unit::Px, background: None };
        let prepared = Renderer::new(&section.scene, &style);
        let (drawing, _) = prepared.draw(&camera, page).expect("a drawing");
        let layer = drawing.layers.iter().find(|layer| layer.kind == LayerKind::Hatching).expect("hatching");
        let patterns = || layer.marks.iter().filter(|mark| mark.provenance.classes == ["pattern"]);
        let unit = camera.height
            / match camera.projection {
                ligne::scene::Projection::Orthographic { height } => height,
                ligne::scene::Projection::Perspective { .. } => unreachable!("a parallel view"),
            };
        let (mut lines, mut inked) = (0, 0.0);
        for mark in patterns() {
            let name = mark.provenance.part.as_deref().expect("a part");
            let (from, to, slope) = if name == "pipe" { (1.0, 2.0, -1.0) } else { (0.0, 0.8, 1.0) };
            let mut start = Point::ZERO;
            for element in mark.path.elements() {
                match element {
                    PathEl::MoveTo(p) => start = *p,
                    PathEl::LineTo(p) => {
                        let way = *p - start;
                        assert!((way.y - slope * way.x).abs() < 1e-6 * way.hypot(), "{preset}: {way:?}");
                        for share in [0.0, 0.5, 1.0] {
                            let at = (start.lerp(*p, share).to_vec2()
                                - ligne::kurbo::Vec2::new(page.width, page.height) / 2.0)
                                .hypot()
                                / unit;
                            // The sides of the polygon lie slightly inside its circle.
                            assert!(at >= from * 0.997 && at < to * 1.001, "{preset}: {name} at {at}");
                        }
                        lines += 1;
                        inked += way.hypot();
                        start = *p;
                    }
                    other => panic!("{other:?}"),
                }
            }
        }
        // Line length times line spacing (2 mm) is the hatched area.
        let covered = inked * 2.0 * 96.0 / 25.4 / (unit * unit);
        assert!(lines > 100 && (covered / area(&section) - 1.0).abs() < 0.02, "{preset}: {lines}, {covered}");
    }
}
