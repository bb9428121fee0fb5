//! Paper pictures lie behind the drawing, and `page.tooth` lets their dark grain show through ink. Expected
//! pixel colours are computed from the paper.

use std::path::PathBuf;

use glam::DVec3;
use ligne::colour::pixel_picture::Picture;
use ligne::drawing::{Drawing, LayerKind};
use ligne::export::{Grouping, PngOptions, SvgOptions};
use ligne::pipeline::render;
use ligne::style::Style;

use crate::library::support::pipeline::{self, orthographic};
use crate::library::support::scenes::solids::cuboid;

/// Whether a column of the laid paper is dark: 4 pixels in every 16.
fn is_dark_column(x: u32) -> bool {
    x % 16 < 4
}

const LIGHT: [u8; 3] = [250, 240, 220];
const DARK: [u8; 3] = [200, 190, 170];

/// Temporary PNG file with laid paper.
struct Sheet(PathBuf);

impl Sheet {
    fn new(name: &str) -> Self {
        let file = std::env::temp_dir().join(format!("ligne-paper-{}-{name}.png", std::process::id()));
        let mut encoder = png::Encoder::new(std::fs::File::create(&file).unwrap(), 64, 32);
        encoder.set_color(png::ColorType::Rgb);
        let pixels: Vec<u8> =
            (0..64 * 32).flat_map(|k| if is_dark_column(k % 64) { DARK } else { LIGHT }).collect();
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        Self(file)
    }

    /// Drawing of a black box in the middle of the page.
    fn drawing(&self, sets: &[&str]) -> Drawing {
        let scene = pipeline::scene([cuboid(DVec3::splat(-1.0), DVec3::splat(1.0))]);
        let camera = orthographic(DVec3::new(0.0, -5.0, 0.0), DVec3::ZERO, 4.0);
        let file = self.0.display().to_string().replace('\\', "/");
        let mut all = vec![format!("page.paper='{file}'"), "fills.palette=['#000000']".to_owned()];
        all.extend(sets.iter().map(|set| (*set).to_owned()));
        render(&scene, &camera, &Style::load_with("flat", &all).unwrap_or_else(|error| panic!("{error}")))
            .unwrap()
    }
}

impl Drop for Sheet {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

fn pixels(drawing: &Drawing) -> Picture {
    Picture::decode(&drawing.to_png(&PngOptions::default()).unwrap()).unwrap()
}

#[test]
fn dark_paper_grain_shows_through_ink() {
    let sheet = Sheet::new("through");
    for (tooth, through) in [("page.tooth=0", 0.0), ("page.tooth=0.6", 0.6)] {
        let drawing = sheet.drawing(&[tooth]);
        assert_eq!(drawing.layers.iter().any(|layer| layer.kind == LayerKind::Tooth), through > 0.0);
        let drawn = pixels(&drawing);
        for k in 0..2000_u32 {
            let (x, y) = (k * 37 % 1000, k * 91 % 1000);
            // Skips columns that blend with their neighbours, and the lines of the box.
            let column = x % 16;
            let is_mixed = [0, 3, 4, 15].contains(&column);
            let off = [x, y].map(|i| (f64::from(i) - 500.0).abs());
            let (inside, outside) = (off.iter().all(|off| *off < 245.0), off.iter().any(|off| *off > 255.0));
            if is_mixed || !(inside || outside) {
                continue;
            }
            let paper = if is_dark_column(x) { DARK } else { LIGHT };
            let shows = if outside {
                1.0
            } else if is_dark_column(x) {
                through
            } else {
                0.0
            };
            let own = drawn.at(x as usize, y as usize);
            for (own, paper) in [own.r, own.g, own.b].into_iter().zip(paper) {
                // Full strength is reached two standard deviations below the mean. A quarter of the paper is
                // dark, so dark pixels lie 1.73 deviations below, at 0.87 of full strength.
                let least = f64::from(paper) * if outside { 1.0 } else { 0.8 * shows };
                let most = f64::from(paper) * shows;
                let own = f64::from(own);
                assert!(own >= least - 2.5 && own <= most + 2.5, "{x} {y} {tooth}: {own}, {least} to {most}");
            }
        }
    }
}

#[test]
fn paper_tooth_stays_on_top_when_grouped_by_part() {
    let sheet = Sheet::new("grouped");
    let drawing = sheet.drawing(&["page.tooth=0.6"]);
    for options in [SvgOptions::default(), SvgOptions::default().grouped_by(Grouping::Part)] {
        let svg = drawing.to_svg(&options);
        let (last_use, last_part) = (svg.rfind("<use").unwrap(), svg.rfind("data-part").unwrap());
        assert!(last_use > last_part, "{svg}");
    }
}

#[test]
fn invalid_paper_settings_are_refused() {
    for set in ["page.paper=no-such.png", "page.paper=Cargo.toml", "page.paper_width=0", "page.tooth=2"] {
        assert!(Style::load_with("ink", &[set.to_owned()]).is_err(), "{set}");
    }
}
