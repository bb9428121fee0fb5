//! Gradients: many steps of light, of which no more are drawn than can be seen, in the colours that the light has.

use glam::DVec3;
use kurbo::{Point, Shape};
use ligne::drawing::{LayerKind, Mark, Paint};
use ligne::math::colour::Colour;
use ligne::scene::Camera;
use ligne::{Style, render};

use crate::support::dice::Dice;
use crate::support::eye::Eye;
use crate::support::pipeline::{orthographic, scene};
use crate::support::round_solids::icosphere;
use crate::support::solids::cuboid;

const STEPS: u16 = 128;

/// Steps from black to white under the light from [`towards_light`].
fn steps(more: &str) -> Style {
    let sheet = format!(
        "extends = 'gradient'\n[fills]\nsteps = {STEPS}\npalette = ['#000', '#fff']\nseams = 'exact'\n{more}\n[light]\n\
         sources = [{{ kind = 'directional', direction = [-0.4, 0.6, 0.7], space = 'camera' }}]"
    );
    Style::from_toml(&sheet).expect("a style")
}

fn towards_light(camera: &Camera) -> DVec3 {
    let eye = Eye::new(camera);
    (eye.right * -0.4 + eye.up * 0.6 - eye.forward * 0.7).normalize()
}

fn fills(drawing: ligne::Drawing) -> Vec<Mark> {
    let layers = drawing.layers.into_iter().filter(|layer| layer.kind == LayerKind::Fills);
    layers.flat_map(|layer| layer.marks).collect()
}

/// The light that the colour of a region stands for.
fn light_of(mark: &Mark) -> f64 {
    let Paint::Fill(Colour { r, .. }) = mark.paint else { panic!("one colour") };
    let tone = f64::from(r) / 255.0 * f64::from(STEPS - 1);
    assert!((tone - f64::from(mark.provenance.tone.expect("a tone"))).abs() < 0.51);
    (tone + 0.5) / f64::from(STEPS)
}

#[test]
fn a_ball_is_as_light_as_it_is() {
    let ball = scene([icosphere(5)]);
    let mut dice = Dice::new(5);
    for height in [2.2, 6.0, 20.0] {
        let camera = orthographic(DVec3::Z * 5.0, DVec3::ZERO, height);
        let (eye, towards) = (Eye::new(&camera), towards_light(&camera));
        let fills = fills(render(&ball, &camera, &steps("")).unwrap());
        let (mut sum, mut count) = (0.0, 0.0);
        while count < 600.0 {
            let (u, v) = (dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
            // No nearer to the contour than 3 px, nor where the surface turns away.
            if (u * u + v * v).sqrt() > (1.0 - 3.0 / eye.scale).min(0.97) {
                continue;
            }
            let w = (1.0 - u * u - v * v).sqrt();
            let normal = eye.right * u + eye.up * v - eye.forward * w;
            let p: Point = eye.image(normal);
            let Some(mark) = fills.iter().find(|mark| mark.path.winding(p) != 0) else { continue };
            count += 1.0;
            let (lu, lv, lw) = (towards.dot(eye.right), towards.dot(eye.up), -towards.dot(eye.forward));
            let light = normal.dot(towards).max(0.0);
            let steep = (lu - lw * u / w).hypot(lv - lw * v / w) / eye.scale;
            let off = light_of(mark) - light;
            // Half a step and what the ball's facets differ by; bands are wider than a step only where a px holds more than one.
            let bound = 0.75 / f64::from(STEPS) + if light > 0.0 { 1.1 * steep } else { 0.0 };
            assert!(off.abs() < bound, "at {p}: {off} off, {bound} at most");
            sum += if light > 0.0 { off } else { 0.0 };
        }
        let mean = sum / count * f64::from(STEPS);
        assert!(mean.abs() < 0.2, "steps are {mean} too light in the mean");
        // As small as it gets, a ball has no more bands than it has room for.
        assert!(fills.len() < 40 + (1.2 * eye.scale) as usize, "{} for {} px", fills.len(), eye.scale);
    }
}

#[test]
fn what_is_hidden_changes_no_step() {
    let camera = orthographic(DVec3::Z * 9.0, DVec3::ZERO, 2.4);
    let wall = |z: f64| cuboid(DVec3::new(-0.9, -0.9, z), DVec3::new(0.3, 0.4, z + 0.1));
    let paths = |scene: &ligne::Scene| -> Vec<String> {
        let drawn = fills(render(scene, &camera, &steps("")).unwrap());
        drawn.iter().map(|mark| mark.path.to_svg()).collect()
    };
    let before = scene([icosphere(4), wall(2.0)]);
    // A second ball, all of it behind the wall.
    let mut small = icosphere(4);
    small.positions.iter_mut().for_each(|p| *p = *p * 0.2 + DVec3::new(-0.3, -0.3, 1.5));
    assert_eq!(paths(&before), paths(&scene([icosphere(4), wall(2.0), small])));
    assert!(paths(&before).len() > 60);
}
