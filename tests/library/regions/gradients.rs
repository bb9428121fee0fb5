//! Stepped gradients: painted light agrees with closed-form Lambert light, with no more bands than can be
//! seen.

use glam::{DVec2, DVec3};
use kurbo::{Point, Shape};
use ligne::colour::srgb::Colour;
use ligne::drawing::{LayerKind, Mark, Paint};
use ligne::geometry::numbers::portable_math::{cos, sin};
use ligne::scene::Camera;
use ligne::{Style, SvgOptions, render};

use crate::library::support::pipeline::{orthographic, scene};
use crate::library::support::references::textbook_camera::TextbookCamera;
use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::round_solids::icosphere;
use crate::library::support::scenes::solids::{Solid, cuboid};

const STEPS: u16 = 128;

/// Steps from black to white under the light of [`towards_light`].
fn steps(more: &str) -> Style {
    let sheet = format!(
        "extends = 'gradient'\n[fills]\nsteps = {STEPS}\npalette = ['#000', '#fff']\nseams = 'exact'\n{more}\n[light]\n\
         sources = [{{ kind = 'directional', direction = [-0.4, 0.6, 0.7], space = 'camera' }}]"
    );
    Style::from_toml(&sheet).expect("a style")
}

fn towards_light(camera: &Camera) -> DVec3 {
    let eye = TextbookCamera::new(camera);
    (eye.right * -0.4 + eye.up * 0.6 - eye.forward * 0.7).normalize()
}

fn fills(drawing: ligne::Drawing) -> Vec<Mark> {
    let layers = drawing.layers.into_iter().filter(|layer| layer.kind == LayerKind::Fills);
    layers.flat_map(|layer| layer.marks).collect()
}

/// Returns the light value that the colour of a region encodes at a point.
fn light_of(mark: &Mark, p: Point) -> f64 {
    let Colour { r, .. } = match &mark.paint {
        Paint::Fill(colour) => *colour,
        Paint::Gradient(gradient) => {
            let way = gradient.end - gradient.start;
            gradient.at(((p - gradient.start).dot(way) / way.hypot2()).clamp(0.0, 1.0))
        }
        _ => panic!("a region"),
    };
    let tone = f64::from(r) / 255.0 * f64::from(STEPS - 1);
    (tone + 0.5) / f64::from(STEPS)
}

#[test]
fn gradient_steps_of_a_ball_match_lambert_light() {
    let ball = scene([icosphere(5)]);
    let mut dice = Dice::new(5);
    for height in [2.2, 6.0, 20.0] {
        let camera = orthographic(DVec3::Z * 5.0, DVec3::ZERO, height);
        let (eye, towards) = (TextbookCamera::new(&camera), towards_light(&camera));
        let fills = fills(render(&ball, &camera, &steps("")).unwrap());
        let (mut sum, mut count) = (0.0, 0.0);
        while count < 600.0 {
            let (u, v) = (dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
            // Only points at least 3 px from the contour, and not where the surface turns away.
            if (u * u + v * v).sqrt() > (1.0 - 3.0 / eye.scale).min(0.97) {
                continue;
            }
            let w = (1.0 - u * u - v * v).sqrt();
            let normal = eye.right * u + eye.up * v - eye.forward * w;
            let p: Point = eye.project(normal);
            let Some(mark) = fills.iter().find(|mark| mark.path.winding(p) != 0) else { continue };
            count += 1.0;
            let (lu, lv, lw) = (towards.dot(eye.right), towards.dot(eye.up), -towards.dot(eye.forward));
            let light = normal.dot(towards).max(0.0);
            let steep = DVec2::new(lu - lw * u / w, lv - lw * v / w).length() / eye.scale;
            let off = light_of(mark, p) - light;
            // The bound is half a step, plus the deviation of the facets. Bands are wider than a step only
            // where a px holds several. On the smallest ball almost every px holds four, and bands narrower
            // than a px are merged into neighbours.
            let reach = if eye.scale > 60.0 { 1.1 } else { 2.0 };
            let bound = 0.75 / f64::from(STEPS) + if light > 0.0 { reach * steep } else { 0.0 };
            assert!(off.abs() < bound, "at {p}: {off} off, {bound} at most");
            sum += if light > 0.0 { off } else { 0.0 };
        }
        let mean = sum / count * f64::from(STEPS);
        assert!(mean.abs() < 0.2, "steps are {mean} too light in the mean");
        // Even the smallest ball has no more bands than it has room for.
        assert!(fills.len() < 60 + (2.0 * eye.scale) as usize, "{} for {} px", fills.len(), eye.scale);
    }
}

#[test]
fn hidden_surfaces_do_not_change_gradient_steps() {
    let camera = orthographic(DVec3::Z * 9.0, DVec3::ZERO, 2.4);
    let wall = |z: f64| cuboid(DVec3::new(-0.9, -0.9, z), DVec3::new(0.3, 0.4, z + 0.1));
    let paths = |scene: &ligne::Scene| -> Vec<String> {
        let drawn = fills(render(scene, &camera, &steps("")).unwrap());
        drawn.iter().map(|mark| mark.path.to_svg()).collect()
    };
    let before = scene([icosphere(4), wall(2.0)]);
    // A second ball that is completely behind the wall.
    let mut small = icosphere(4);
    small.positions.iter_mut().for_each(|p| *p = *p * 0.2 + DVec3::new(-0.3, -0.3, 1.5));
    assert_eq!(paths(&before), paths(&scene([icosphere(4), wall(2.0), small])));
    assert!(paths(&before).len() > 60);
}

/// A tube around the y axis. All normals are horizontal.
fn tube(columns: u32) -> Solid {
    let mut tube = Solid { positions: Vec::new(), triangles: Vec::new() };
    for k in 0..columns {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(columns);
        tube.positions.extend([-1.0, 1.0].map(|y| DVec3::new(cos(angle), y, sin(angle))));
        let (a, b) = (2 * k, 2 * ((k + 1) % columns));
        tube.triangles.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
    }
    tube
}

#[test]
fn a_tube_is_drawn_with_few_linear_gradients() {
    let tube = scene([tube(64)]);
    let camera = orthographic(DVec3::new(1.0, 0.0, 5.0), DVec3::ZERO, 2.6);
    let (eye, towards) = (TextbookCamera::new(&camera), towards_light(&camera));
    let bands = fills(render(&tube, &camera, &steps("")).unwrap());
    let drawing = render(&tube, &camera, &steps("steps_as = 'gradients'")).unwrap();
    let (svg, pdf) = (drawing.to_svg(&SvgOptions::default()), drawing.to_pdf());
    let fills = fills(drawing);
    assert!(bands.len() > 50, "{}", bands.len());
    assert!(fills.len() * 3 < bands.len(), "{} of {}", fills.len(), bands.len());
    let graded = fills.iter().filter(|mark| matches!(mark.paint, Paint::Gradient(_))).count();
    assert!(graded > 0 && svg.matches("<linearGradient").count() == graded);
    assert_eq!(svg.matches("fill=\"url(#gradient").count(), graded);
    let text = String::from_utf8_lossy(&pdf);
    assert_eq!(text.matches("/ShadingType 2").count(), graded);
    let mut dice = Dice::new(7);
    let mut count = 0;
    while count < 500 {
        let (u, y) = (dice.between(-0.95, 0.95), dice.between(-0.95, 0.95));
        let normal = eye.right * u - eye.forward * (1.0 - u * u).sqrt();
        let p = eye.project(normal + DVec3::Y * y);
        let Some(mark) = fills.iter().find(|mark| mark.path.winding(p) != 0) else { continue };
        count += 1;
        let light = normal.dot(towards).max(0.0);
        let steep =
            (towards.dot(eye.right) + towards.dot(eye.forward) * u / (1.0 - u * u).sqrt()).abs() / eye.scale;
        let off = light_of(mark, p) - light;
        // Two of the 128 steps. Gradients are linear between the middles of merged steps.
        let bound = 2.0 / f64::from(STEPS) + 1.1 * steep;
        assert!(off.abs() < bound, "at {p}: {off} off, {bound} at most");
    }
}
