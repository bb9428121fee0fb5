//! [`ViewPlan`]: the views of a sheet, and the scenes they show.
//!
//! 1. The model is read once; it is the scene of the regular views.
//! 2. Each section cuts a copy of the model and becomes a view in projection if its direction allows that.
//! 3. If hidden lines are drawn, pictorial views get a copy of the scene without them.
//! 4. The exploded model is another scene; details reuse the scene of their view.

use std::sync::Arc;

use glam::DVec3;
use toml::Spanned;

use super::view_arrangement::{PlacedView, ViewPlacement};
use crate::edit::explode::{explode, with_trails};
use crate::edit::section::{CutPlane, Plane, cut};
use crate::error::Error;
use crate::geometry::names::glob::Glob;
use crate::lines::HiddenLines;
use crate::page::figure;
use crate::page::page_source::PageSource;
use crate::page::sheet::keys::explosion_keys;
use crate::page::sheet::keys::sheet_keys::{DetailKeys, SheetPage};
use crate::page::sheet::lengths::length_format::LengthFormat;
use crate::page::sheet::lengths::true_length::Foreshortening;
use crate::page::sheet::view::scale_series;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances;
use crate::pipeline::{with_cut_hatching_for, with_trail_lines};
use crate::scene::cameras::framing::world_points;
use crate::scene::{Camera, NamedView, Scene};
use crate::style::Style;
use crate::surface::Cylinder;

/// A scene with its style.
pub(crate) struct ShownScene {
    pub scene: Scene,
    pub style: Style,
}

/// A section plane with its letter.
pub(crate) struct CutLine {
    pub label: String,
    pub plane: Plane,
    /// The view that shows the section, and the parts that are not cut.
    pub section_view: usize,
    pub uncut: Vec<Glob>,
}

/// The circle around a detail.
pub(crate) struct DetailCircle {
    pub label: String,
    /// The view that contains the circle, and the view that shows the detail.
    pub source_view: usize,
    pub detail_view: usize,
    pub at: DVec3,
    pub radius: f64,
}

impl DetailCircle {
    /// Whether the circle reaches into a view; otherwise it is not drawn.
    pub(crate) fn meets(&self, sight: &SheetView) -> bool {
        let radius = self.radius * sight.mm_per_unit;
        sight.rect().inflate(radius, radius).contains(sight.to_page(self.at))
    }
}

/// The views of a sheet, and the scenes they show.
pub(crate) struct ViewPlan {
    /// The scenes; the whole model is first.
    pub sets: Vec<Arc<ShownScene>>,
    pub views: Vec<PlacedView>,
    /// The index of each view's scene in `sets`.
    pub scene_of_view: Vec<usize>,
    pub cuts: Vec<CutLine>,
    pub circled: Vec<DetailCircle>,
    /// How lengths are written.
    pub values: LengthFormat,
    /// Centre of the model, world.
    pub middle: DVec3,
    /// The view with balloons, if any.
    pub balloons: Option<usize>,
}

/// The views that a section may be seen from, preferred first.
const SIDE_VIEWS: [NamedView; 6] =
    [NamedView::Front, NamedView::Left, NamedView::Top, NamedView::Right, NamedView::Bottom, NamedView::Back];

impl ViewPlan {
    /// Reads the model and plans its views: views, sections, exploded view, details.
    ///
    /// # Errors
    /// Returns an error at the key that is wrong.
    pub(crate) fn new(sheet: &SheetPage, source: &PageSource) -> Result<Self, Error> {
        let name = sheet.style.clone().unwrap_or_else(|| Spanned::new(0..0, "technical".to_owned()));
        let mut style = figure::style(&name, &sheet.set, source)?.to_scale();
        style.lines.hidden = if sheet.hidden { HiddenLines::Dashed } else { HiddenLines::None };
        if sheet.model.0.is_empty() {
            return Err(Error::new("this sheet has no model")
                .in_file(&source.path)
                .remedy("name one: model = \"part.glb\""));
        }
        let scene = figure::assemble_scene(&sheet.model, None, None, &style, source)?;
        let values = LengthFormat::new(sheet, scene.format == "glTF", source)?;
        let (low, high) = scene.bounds().ok_or_else(|| {
            Error::new("the model has nothing to draw").in_file(&source.path).remedy("name another one")
        })?;
        let points = world_points(&scene);
        let mut plan = Self {
            sets: Vec::new(),
            views: Vec::new(),
            scene_of_view: Vec::new(),
            cuts: Vec::new(),
            circled: Vec::new(),
            values,
            middle: (low + high) / 2.0,
            balloons: None,
        };
        let mut pictorial = style.clone();
        pictorial.lines.hidden = HiddenLines::None;
        let names = |text: &str| Spanned::new(0..0, text.to_owned());
        let views = sheet.views.clone().unwrap_or_else(|| ["front", "top", "left", "iso"].map(names).into());
        let views = views.iter().map(|name| parse_view(name, source)).collect::<Result<Vec<_>, _>>()?;
        for view in &views {
            let placement_of_view = if SIDE_VIEWS.contains(view) {
                ViewPlacement::Projected(*view)
            } else {
                ViewPlacement::Pictorial
            };
            let camera = Camera::named(*view, scene.up);
            plan.add(view.name(), camera, &points, (0, placement_of_view));
        }
        plan.sets.push(Arc::new(ShownScene { scene, style: style.clone() }));
        plan.add_sections(sheet, &views, (&points, &pictorial), source)?;
        if sheet.hidden && views.iter().any(|view| !SIDE_VIEWS.contains(view)) {
            let scene = plan.sets[0].scene.clone();
            plan.sets.push(Arc::new(ShownScene { scene, style: pictorial.clone() }));
            for (placed, set) in plan.views.iter().zip(&mut plan.scene_of_view) {
                if *set == 0 && placed.placement == ViewPlacement::Pictorial {
                    *set = plan.sets.len() - 1;
                }
            }
        }
        plan.add_exploded(sheet, &pictorial, source)?;
        plan.choose_balloons(sheet, source)?;
        let letters = plan.cuts.len();
        for (k, detail) in sheet.detail.iter().enumerate() {
            plan.add_detail(detail, letters + k, source)?;
        }
        Ok(plan)
    }

    fn add(
        &mut self,
        name: &str,
        camera: Camera,
        points: &[DVec3],
        (set, placement): (usize, ViewPlacement),
    ) {
        let same_name_count = self.views.iter().filter(|view| view.sight.name.starts_with(name)).count();
        let name =
            if same_name_count == 0 { name.to_owned() } else { format!("{name}-{}", same_name_count + 1) };
        let sheet_view = SheetView::new(&name, camera, self.middle, points);
        self.views.push(PlacedView::new(sheet_view, placement));
        self.scene_of_view.push(set);
    }

    fn add_sections(
        &mut self,
        sheet: &SheetPage,
        views: &[NamedView],
        (points, style): (&[DVec3], &Style),
        source: &PageSource,
    ) -> Result<(), Error> {
        let mut used_views: Vec<NamedView> = views.to_vec();
        for (k, keys) in sheet.section.iter().enumerate() {
            let uncut_scene = &self.sets[0].scene;
            let span = keys.plane.span();
            let plane_error = |message: String| source.fault(&span, "this is not a plane", &message);
            let cut_plane = CutPlane::parse(keys.plane.get_ref()).map_err(plane_error)?;
            let (normal, _) = cut_plane.normal();
            let forward = |view: &NamedView| Camera::named(*view, uncut_scene.up).axes()[2];
            let is_normal = |forward: &DVec3| forward.dot(normal).abs() > tolerances::MIN_PARALLEL_COSINE;
            let preferred = SIDE_VIEWS.iter().map(forward).find(is_normal);
            let plane = cut_plane
                .of(uncut_scene, self.unit_mm(), preferred.unwrap_or(-normal))
                .map_err(|error| source.about(&span, error))?;
            let is_opposite =
                |view: &NamedView| forward(view).dot(plane.normal()) < -tolerances::MIN_PARALLEL_COSINE;
            let opposite_view = SIDE_VIEWS.into_iter().find(is_opposite);
            let camera = opposite_view.map_or_else(
                || camera_facing(&plane, uncut_scene),
                |view| Camera::named(view, uncut_scene.up),
            );
            let uncut: Vec<Glob> = keys.uncut.iter().map(|glob| Glob::new(glob.as_str())).collect();
            let mut section = cut(uncut_scene.clone(), &plane, &uncut);
            let style = with_cut_hatching_for(style, &mut section.scene, &mut section.faces, &[camera]);
            self.sets.push(Arc::new(ShownScene { scene: std::mem::take(&mut section.scene), style }));
            let placement = match opposite_view.filter(|view| !used_views.contains(view)) {
                Some(view) => {
                    used_views.push(view);
                    ViewPlacement::Projected(view)
                }
                None => ViewPlacement::Separate,
            };
            let label = keys.label.clone().unwrap_or_else(|| label_letter(k));
            let set = self.sets.len() - 1;
            self.add(&format!("section-{label}"), camera, points, (set, placement));
            if let Some(placed) = self.views.last_mut() {
                placed.sight.title = Some(format!("{label}-{label}"));
            }
            self.cuts.push(CutLine { label, plane, section_view: self.views.len() - 1, uncut });
        }
        Ok(())
    }

    fn add_exploded(&mut self, sheet: &SheetPage, style: &Style, source: &PageSource) -> Result<(), Error> {
        let Some(keys) = &sheet.exploded else { return Ok(()) };
        let view = keys.view.as_ref().map_or(Ok(NamedView::Iso), |view| parse_view(view, source))?;
        let assembled_scene = &self.sets[0].scene;
        let displacements =
            explode(assembled_scene, &explosion_keys::explosion(keys, assembled_scene, source)?);
        let scene = with_trails(assembled_scene.clone(), &displacements);
        let (points, camera) = (world_points(&scene), Camera::named(view, scene.up));
        self.sets.push(Arc::new(ShownScene { scene, style: with_trail_lines(style) }));
        let set = self.sets.len() - 1;
        self.add("exploded", camera, &points, (set, ViewPlacement::Free));
        Ok(())
    }

    fn choose_balloons(&mut self, sheet: &SheetPage, source: &PageSource) -> Result<(), Error> {
        if !sheet.has_parts_list() {
            return Ok(());
        }
        let find = |name: &str| self.views.iter().position(|view| view.sight.name == name);
        let chosen = match &sheet.balloons {
            Some(name) if name.get_ref() == "none" => None,
            Some(name) => Some(self.view(name, source)?),
            None => find("exploded").or_else(|| find("iso")).or(Some(0)),
        };
        self.balloons = chosen;
        Ok(())
    }

    fn add_detail(&mut self, keys: &DetailKeys, number: usize, source: &PageSource) -> Result<(), Error> {
        let source_index = keys.of.as_ref().map_or(Ok(0), |of| self.view(of, source))?;
        let radius = *keys.radius.get_ref();
        let (is_right, advice) = (radius.is_finite() && radius > 0.0, "write units of the model above 0");
        source.check([&keys.radius], |_| is_right, "this is not a radius", advice)?;
        let label = keys.label.clone().unwrap_or_else(|| label_letter(number));
        let at = DVec3::from_array(keys.at);
        let mut detail_sheet_view =
            self.views[source_index].sight.detail(&format!("detail-{label}"), at, radius);
        detail_sheet_view.title = Some(label.clone());
        // A step of the series enlarges by 2 or 2.5; two steps by about 5.
        let placement = match &keys.scale {
            None => ViewPlacement::Enlarged(5.0),
            Some(scale_text) => ViewPlacement::At(read_scale(scale_text, source)?),
        };
        self.circled.push(DetailCircle {
            label,
            source_view: source_index,
            detail_view: self.views.len(),
            at,
            radius,
        });
        self.views.push(PlacedView::new(detail_sheet_view, placement));
        self.scene_of_view.push(self.scene_of_view[source_index]);
        Ok(())
    }

    /// Millimetres per model unit.
    pub(crate) fn unit_mm(&self) -> f64 {
        self.values.unit_mm()
    }

    /// How lengths in a view relate to lengths of the model.
    pub(crate) fn foreshortening(&self, view: usize) -> Foreshortening {
        let shown = self.circled.iter().find(|circled| circled.detail_view == view);
        match (shown, self.views[view].placement) {
            (Some(detail), _) => self.foreshortening(detail.source_view),
            (None, ViewPlacement::Pictorial) => Foreshortening::Pictorial,
            (None, ViewPlacement::Free) => Foreshortening::Moved,
            (None, _) => Foreshortening::None,
        }
    }

    /// The part of a cylinder that remains in a section; the whole cylinder without a section.
    pub(crate) fn remaining_cylinder(
        &self,
        cylinder: &Cylinder,
        section: Option<&CutLine>,
    ) -> Option<Cylinder> {
        let Some(section) = section else { return Some(*cylinder) };
        let scene = &self.sets[0].scene;
        let part = scene.parts.get(cylinder.part.index());
        if let Some(part) = part.filter(|part| section.uncut.iter().any(|glob| glob.matches(&part.name))) {
            let positions = scene.geometry_of(part).map(|geometry| &*geometry.positions).unwrap_or_default();
            let is_behind = |p: &DVec3| section.plane.side(part.world_from_part.transform_point3(*p)) < 0;
            return positions.iter().any(is_behind).then_some(*cylinder);
        }
        let end_distances =
            cylinder.ends.map(|end| section.plane.distance(cylinder.point + cylinder.axis * end));
        let tolerance = tolerances::MAX_OFFSET_OF_RADIUS * cylinder.radius;
        if (end_distances[0] - end_distances[1]).abs() <= tolerance {
            return (end_distances[0] <= tolerance).then_some(*cylinder);
        }
        // The end in front of the plane is moved into the plane.
        let share = end_distances[0] / (end_distances[0] - end_distances[1]);
        let cut_end = cylinder.ends[0] + share * (cylinder.ends[1] - cylinder.ends[0]);
        let ends = [0, 1].map(|k| if end_distances[k] > 0.0 { cut_end } else { cylinder.ends[k] });
        ((ends[1] - ends[0]).abs() > tolerance).then_some(Cylinder { ends, ..*cylinder })
    }

    /// The section plane of a section view.
    pub(crate) fn section_of(&self, view: usize) -> Option<&CutLine> {
        self.cuts.iter().find(|cut| cut.section_view == view)
    }

    /// The index of a view, by its name.
    pub(crate) fn view(&self, name: &Spanned<String>, source: &PageSource) -> Result<usize, Error> {
        let names: Vec<&str> = self.views.iter().map(|view| view.sight.name.as_str()).collect();
        names
            .iter()
            .position(|view_name| view_name == name.get_ref())
            .ok_or_else(|| source.unknown(name, "view on this sheet", &names))
    }
}

/// Parses a scale.
pub(crate) fn read_scale(scale_text: &Spanned<String>, source: &PageSource) -> Result<f64, Error> {
    scale_series::parse_scale(scale_text.get_ref())
        .ok_or_else(|| source.fault(&scale_text.span(), "this is not a scale", "write such as 1:5 or 2:1"))
}

fn parse_view(name: &Spanned<String>, source: &PageSource) -> Result<NamedView, Error> {
    let known: Vec<&str> = NamedView::ALL.map(NamedView::name).into();
    NamedView::parse(name.get_ref()).ok_or_else(|| source.unknown(name, "view", &known))
}

/// The letter of a section or detail: A, B, C and so on, without I, O and Q.
fn label_letter(number: usize) -> String {
    let letters: Vec<char> = ('A'..='Z').filter(|c| !matches!(c, 'I' | 'O' | 'Q')).collect();
    letters.get(number).map_or_else(|| format!("S{number}"), char::to_string)
}

/// A camera that faces a plane, from the side of its normal.
fn camera_facing(plane: &Plane, scene: &Scene) -> Camera {
    let up = Camera::named(NamedView::Front, scene.up).up;
    let normal = plane.normal();
    let is_horizontal = normal.cross(up).length() < tolerances::MIN_UPWARD_SINE;
    let up = if is_horizontal { Camera::named(NamedView::Top, scene.up).up } else { up };
    Camera { eye: normal, target: DVec3::ZERO, up, ..Camera::named(NamedView::Front, scene.up) }
}
