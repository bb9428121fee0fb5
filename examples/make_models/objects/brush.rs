//! Picture of a stroke with a drying brush: full ink at the start, streaks of bristles at the end.

use ligne::internals::geometry::{hash, unit_interval, value_noise};

const WIDTH: usize = 640;
const HEIGHT: usize = 64;

/// PNG file, dark on white.
pub fn dry() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(png::ColorType::Grayscale);
    let shades: Vec<u8> = (0..WIDTH * HEIGHT).map(|k| shade(k % WIDTH, k / WIDTH)).collect();
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&shades).expect("pixels");
    drop(writer);
    bytes
}

fn shade(column: usize, row: usize) -> u8 {
    let (x, y) = ((column as f64 + 0.5) / WIDTH as f64, (row as f64 + 0.5) / HEIGHT as f64 - 0.5);
    // Neighbouring bristles stick together. Each has a different amount of ink and loses it unevenly.
    let bristle = row as f64 / 2.6;
    let load = 0.75 * value_noise(1, bristle) + 0.25 * (2.0 * unit_interval(hash(2, &[row as u64])) - 1.0);
    let uneven = value_noise(3 + (row / 2) as u64, column as f64 / 42.0);
    let wet = 0.95 + 0.55 * load + 0.3 * uneven - 1.35 * ((x - 0.18).max(0.0) / 0.82);
    // Edges of the stroke: round at the start, ragged where it is dry.
    let round = (x / 0.045).min(1.0);
    let half = 0.46 * (round * (2.0 - round)).sqrt();
    let ragged = 0.03 * value_noise(90 + u64::from(y > 0.0), column as f64 / 30.0);
    let inside = (half + ragged - y.abs()) * HEIGHT as f64;
    let ink = (wet * 6.0).clamp(0.0, 1.0).min(inside.clamp(0.0, 1.0));
    (255.0 * (1.0 - ink)).round() as u8
}
