//! A composition as a single drawing, for formats without clip paths such as DXF.
//!
//! 1. Each mark is transformed to the page.
//! 2. It is clipped to the clip path of its drawing, if there is one.
//! 3. The marks of all drawings are collected in layers by kind.

use std::collections::BTreeMap;

use kurbo::BezPath;

use super::region_clip::ClipRegion;
use super::{Composition, Drawing, Layer, LayerKind, Mark, Paint, PlacedDrawing, Unit};

/// Tolerance of curves that are clipped, in px and in mm.
const CLIP_TOLERANCE_PX: f64 = 0.05;
const CLIP_TOLERANCE_MM: f64 = 0.01;

impl Composition {
    /// The composition as one drawing. The marks of all drawings are placed, clipped, and grouped in layers
    /// by kind.
    ///
    /// Areas are clipped at convex clip paths only, pictures never. Drawings hide what is below them only
    /// where they paint.
    #[must_use]
    pub fn flattened(&self) -> Drawing {
        let tolerance = match self.page.unit {
            Unit::Px => CLIP_TOLERANCE_PX,
            Unit::Mm => CLIP_TOLERANCE_MM,
        };
        let mut layers: BTreeMap<LayerKind, Vec<Mark>> = BTreeMap::new();
        let mut warnings = Vec::new();
        for PlacedDrawing { drawing, place, clip, .. } in &self.items {
            let region = clip.as_ref().map(|clip| ClipRegion::new(clip, tolerance));
            for layer in &drawing.layers {
                let placed = layer.marks.iter().filter_map(|mark| {
                    let mark = mark.clone().placed(*place);
                    match &region {
                        Some(region) => clip_mark(mark, region, tolerance),
                        None => Some(mark),
                    }
                });
                layers.entry(layer.kind).or_default().extend(placed);
            }
            warnings.extend(drawing.warnings.iter().cloned());
        }
        let layers = layers.into_iter().filter(|(_, marks)| !marks.is_empty());
        let layers = layers.map(|(kind, marks)| Layer { kind, pen: None, ordered: false, marks }).collect();
        Drawing { warnings, ..Drawing::new(self.title.clone(), self.page, layers) }
    }
}

impl Drawing {
    /// Clips lines and areas to the inside of a convex border. A dashed line that is clipped becomes separate
    /// dashes.
    #[cfg(feature = "page")]
    pub(crate) fn cut(&mut self, border: &BezPath, tolerance: f64) {
        let region = ClipRegion::new(border, tolerance);
        for layer in &mut self.layers {
            layer.marks = std::mem::take(&mut layer.marks)
                .into_iter()
                .filter_map(|mut mark| {
                    if let Paint::Stroke(stroke) = &mut mark.paint
                        && !stroke.dash.is_empty()
                        && region.line(&mark.path) != mark.path
                    {
                        let dash = std::mem::take(&mut stroke.dash);
                        mark.path = kurbo::dash(mark.path.iter(), stroke.dash_offset, &dash).collect();
                    }
                    let picture = matches!(mark.paint, Paint::Image(_));
                    if picture {
                        mark.path = region.area(&mark.path, tolerance);
                    }
                    clip_mark(mark, &region, tolerance)
                })
                .collect();
        }
    }
}

/// The part of a mark inside a region; `None` if nothing is left.
fn clip_mark(mut mark: Mark, region: &ClipRegion, tolerance: f64) -> Option<Mark> {
    let is_there = |path: &BezPath| path.elements().len() > 1;
    match &mut mark.paint {
        Paint::Stroke(_) => mark.path = region.line(&mark.path),
        Paint::Fill(_) | Paint::Gradient(_) => mark.path = region.area(&mark.path, tolerance),
        Paint::Outline(outline) => {
            outline.axis = region.line(&outline.axis);
            mark.path = region.area(&mark.path, tolerance);
            return (is_there(&mark.path) && is_there(&outline.axis)).then_some(mark);
        }
        Paint::Image(_) => {}
    }
    is_there(&mark.path).then_some(mark)
}

#[cfg(test)]
mod tests {
    use kurbo::Affine;

    use super::super::{Cap, Join, Page, Provenance, StrokePaint};
    use super::*;
    use crate::colour::srgb::Colour;

    #[test]
    fn flattened_composition_transforms_and_clips_all_drawings() {
        let page = |width| Page { width, height: 100.0, unit: Unit::Mm, background: None };
        let stroke = StrokePaint {
            width: 0.5,
            colour: Colour::BLACK,
            cap: Cap::Round,
            join: Join::Round,
            dash: vec![2.0, 1.0],
            dash_offset: 0.5,
        };
        let path = BezPath::from_svg("M0 5H50").unwrap();
        let mark = Mark { path, paint: Paint::Stroke(stroke), provenance: Provenance::default() };
        let layer = Layer { kind: LayerKind::Lines, pen: None, ordered: false, marks: vec![mark] };
        let drawing = Drawing::new("a line", page(50.0), vec![layer]);
        let item = |name: &str, x: f64, clip: Option<&str>| PlacedDrawing {
            name: name.to_owned(),
            drawing: drawing.clone(),
            place: Affine::translate((x, 10.0)) * Affine::scale(2.0),
            clip: clip.map(|data| BezPath::from_svg(data).unwrap()),
        };
        let items = vec![
            item("a", 0.0, None),
            item("b", 10.0, Some("M20 0H60V50H20Z")),
            item("c", 0.0, Some("M0 50H9V60H0Z")),
        ];
        let flat = Composition::new("two", page(200.0), items).flattened();
        let [layer] = flat.layers.as_slice() else { panic!("{flat:?}") };
        let paths: Vec<String> = layer.marks.iter().map(|mark| mark.path.to_svg()).collect();
        assert_eq!(paths, ["M0,20 L100,20", "M20,20 L60,20"]);
        let Paint::Stroke(stroke) = &layer.marks[1].paint else { panic!() };
        assert_eq!((stroke.width, stroke.dash_offset), (1.0, 1.0));
        assert_eq!(stroke.dash, [4.0, 2.0]);
    }
}
