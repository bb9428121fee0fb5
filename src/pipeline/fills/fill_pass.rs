//! [`FillPass`]: everything below the lines of a drawing: paint and hatching.

use super::glass_pass::BehindGlass;
use super::surface_fills::SurfaceFills;
use super::view_hatching::Hatching;
use super::{pattern_pass, picture_pass};
use crate::drawing::{Layer, LayerKind, Page};
use crate::lines::{FeatureLines, Surface};
use crate::pipeline::report::drawing_report::Stopwatch;
use crate::regions::{HatchRegions, PageBorders};
use crate::scene::Paints;
use crate::scene::{Camera, Scene};
use crate::strokes::{self, MarkOrder};
use crate::style::Style;

/// Layers below the lines of a drawing.
#[derive(Default)]
pub(crate) struct FillPass {
    /// Layers from bottom to top.
    pub layers: Vec<Layer>,
    /// Areas where paint or hatching is black.
    pub blacks: Option<HatchRegions>,
    pub warnings: Vec<String>,
    /// Number of regions.
    pub regions: u64,
    /// Number of cells where different looks were seen.
    pub leaks: u64,
    /// Time for regions, milliseconds.
    pub regions_ms: f64,
    /// Time for hatching, milliseconds.
    pub hatching_ms: f64,
}

/// Lit surface with visible lines, to be painted and hatched.
pub(crate) struct FillInputs<'a> {
    pub scene: &'a Scene,
    pub style: &'a Style,
    pub paints: Option<&'a Paints>,
    pub fills: &'a SurfaceFills<'a>,
    pub surface: &'a Surface,
    pub lines: &'a FeatureLines,
    pub borders: &'a PageBorders,
    pub behind: Option<&'a BehindGlass<'a>>,
}

impl FillPass {
    /// Paints and hatches a surface.
    pub(crate) fn of(on: &FillInputs, page: &Page, camera: &Camera) -> Self {
        let FillInputs { scene, style, paints, fills, surface, lines, borders, behind } = *on;
        let mut watch = Stopwatch::start();
        let mut painted = Self::default();
        let seen =
            behind.map_or_else(|| fills.label_page(borders, page), |behind| behind.label_page(fills, page));
        if style.region.enabled {
            let (mut layers, regions) = fills.paint(&seen, page, camera, style);
            painted.regions = regions.regions.len() as u64;
            if let Some(paints) = paints {
                let clear = behind.map_or(&surface.mesh, BehindGlass::clear);
                let (on, asked) = ((clear, lines), (page, camera, style));
                picture_pass::add(fills, on, (paints, &regions), asked, &mut layers, &mut painted.warnings);
            }
            if let Some(behind) = behind {
                behind.paint(fills, borders, (page, camera, style), &mut layers);
            }
            painted.layers.extend(layers);
        }
        let mut patterned = pattern_pass::marks(fills, &seen, scene, (page, camera, style));
        painted.leaks = seen.leaks;
        painted.regions_ms = watch.lap_ms();
        let hatching = Hatching { fills, scene, page, camera, style };
        let mut hatched = if style.hatch.enabled { hatching.layer(&seen) } else { None };
        if !patterned.is_empty() {
            patterned.extend(hatched.take().into_iter().flat_map(|layer| layer.marks));
            hatched = Some(Layer { kind: LayerKind::Hatching, pen: None, ordered: false, marks: patterned });
        }
        if style.stroke.layers.order == MarkOrder::Travel {
            hatched = hatched.map(strokes::travel_order::in_travel_order);
        }
        painted.layers.extend(hatched);
        if style.hatch.enabled {
            painted.hatching_ms = watch.lap_ms();
        }
        painted.blacks = hatching.black_ground(&seen);
        painted
    }
}
