//! [`ViewDrawings`]: the drawings of the views, and their lines as chords that occupy paper.
//!
//! A view is drawn at one scale. While the sheet is arranged, its lines are only scaled. It is drawn again
//! once its scale is settled.

use kurbo::{Point, Shape as _, Vec2};

use crate::drawing::{Paint, PlacedDrawing};
use crate::error::Error;
use crate::page::sheet::arrangement::titles_and_notes::detail_circle;
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::canvas::annotation_board::for_each_chord;
use crate::page::sheet::view::sheet_view::LINE_MARGIN_MM;
use crate::page::tolerances;
use crate::pipeline::Renderer;
use crate::scene::warnings::add_new;

/// Tolerance of curves that are clipped to a circle, mm.
const CLIP_TOLERANCE_MM: f64 = 0.01;

/// The drawing of a view.
struct ViewDrawing {
    item: PlacedDrawing,
    warnings: Vec<String>,
    /// Length on paper of a model unit at the time of drawing, mm.
    unit: f64,
    /// Chords of its lines relative to the corner of the view, and line widths, mm.
    chords: Vec<([Vec2; 2], f64)>,
}

/// The drawings of the views.
pub(crate) struct ViewDrawings<'a> {
    prepared: Vec<Option<Renderer<'a>>>,
    views: Vec<Option<ViewDrawing>>,
}

impl<'a> ViewDrawings<'a> {
    /// Empty, for prepared scenes, with room for `views` drawings.
    pub(crate) fn new(prepared: Vec<Option<Renderer<'a>>>, views: usize) -> Self {
        Self { prepared, views: (0..views).map(|_| None).collect() }
    }

    /// Draws the views that are missing or were drawn at another scale. Returns whether there were any.
    ///
    /// # Errors
    /// Returns an error if a view cannot be drawn.
    pub(crate) fn update(&mut self, plan: &ViewPlan) -> Result<bool, Error> {
        let mut any = false;
        for view in 0..plan.views.len() {
            let unit = plan.views[view].sight.mm_per_unit;
            let is_outdated = |drawn: &ViewDrawing| {
                (drawn.unit / unit - 1.0).abs() > tolerances::MAX_DRAWN_SCALE_DIFFERENCE_SHARE
            };
            if self.views[view].as_ref().is_none_or(is_outdated) {
                self.views[view] = self.drawn(view, plan)?;
                any = true;
            }
        }
        Ok(any)
    }

    fn drawn(&self, view: usize, plan: &ViewPlan) -> Result<Option<ViewDrawing>, Error> {
        let sight = &plan.views[view].sight;
        let Some(prepared) = self.prepared.get(plan.scene_of_view[view]).and_then(Option::as_ref) else {
            return Ok(None);
        };
        let (mut item, mut warnings) = sight.draw(prepared)?;
        if let Some(circled) = plan.circled.iter().find(|circled| circled.detail_view == view) {
            let circle = detail_circle(sight).to_path(tolerances::MAX_CLIP_CIRCLE_ERROR_MM);
            let circle = item.place.inverse() * circle;
            item.drawing.cut(&circle, CLIP_TOLERANCE_MM);
            if item.drawing.layers.iter().all(|layer| layer.marks.is_empty()) {
                // This warning is more useful than the one about an empty drawing.
                warnings.clear();
                warnings.push(format!(
                    "the detail `{}` shows nothing: no line of the model is in its circle; move `at` or \
                     make `radius` larger",
                    circled.label
                ));
            }
        }
        let mut chords = Vec::new();
        let corner = Vec2::new(LINE_MARGIN_MM, LINE_MARGIN_MM);
        for mark in item.drawing.layers.iter().flat_map(|layer| &layer.marks) {
            let width = if let Paint::Stroke(stroke) = &mark.paint { stroke.width } else { 0.0 };
            for_each_chord(&mark.path, |a, b| {
                chords.push(([a, b].map(|p: Point| p.to_vec2() - corner), width));
            });
        }
        Ok(Some(ViewDrawing { item, warnings, unit: sight.mm_per_unit, chords }))
    }

    /// The chords of a view at its present position and scale, with their widths.
    pub(crate) fn chords(
        &self,
        view: usize,
        plan: &ViewPlan,
    ) -> impl Iterator<Item = ([Point; 2], f64)> + '_ {
        let sight = &plan.views[view].sight;
        let (corner, unit) = (sight.corner, sight.mm_per_unit);
        let of = move |drawn: &'_ ViewDrawing| {
            let larger = unit / drawn.unit;
            drawn
                .chords
                .iter()
                .map(move |(ends, width)| (ends.map(|p| corner + p * larger), *width))
                .collect::<Vec<_>>()
        };
        self.views[view].as_ref().map(of).unwrap_or_default().into_iter()
    }

    /// The drawings at their positions, and their distinct warnings.
    pub(crate) fn into_items(self, plan: &ViewPlan) -> (Vec<PlacedDrawing>, Vec<String>) {
        let (mut items, mut warnings) = (Vec::new(), Vec::new());
        for (view, drawn) in self.views.into_iter().enumerate() {
            let Some(drawn) = drawn else { continue };
            items.push(PlacedDrawing { place: plan.views[view].sight.frame_to_page(), ..drawn.item });
            let scene = &plan.sets[plan.scene_of_view[view]].scene;
            add_new(&mut warnings, scene.warnings.lines().into_iter().chain(drawn.warnings));
        }
        (items, warnings)
    }
}
