//! [`Trial`]: compares a model's drawing with that of a rewritten file, and reduces and saves failures.

use std::cell::OnceCell;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use kurbo::Point;
use ligne::pipeline::render;
use ligne::scene::Scene;
use ligne::style::Style;

use super::model::RandomModel;
use super::pens::{LinesByPen, PenDifference};
use super::relations::{Relation, RewrittenFile, reference_file};
use crate::library::support::scenes::random_dice::Dice;

/// Maximum distance between lines of flat bodies, px.
const MAX_FLAT_DISTANCE_PX: f64 = 0.06;
/// Maximum distance between lines of rounded bodies, px.
const MAX_ROUND_DISTANCE_PX: f64 = 0.5;
/// Maximum differing length of equal drawings, px: the round caps of a line.
const MAX_DIFFERENT_LENGTH_PX: f64 = 1.0;

/// Result of a comparison.
#[derive(Debug, Clone)]
pub(crate) enum Outcome {
    /// The relation does not apply to the model.
    NotApplicable,
    Same,
    Different(PenDifference),
    /// A file was rejected, or drawing it failed.
    Failed(String),
}

impl Outcome {
    pub(crate) fn is_failure(&self) -> bool {
        matches!(self, Self::Different(_) | Self::Failed(_))
    }

    /// The length that differs, px; infinite if drawing failed.
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Different(difference) => difference.length(),
            Self::Failed(_) => f64::INFINITY,
            _ => 0.0,
        }
    }

    fn description(&self) -> String {
        match self {
            Self::Different(difference) => difference.to_string(),
            Self::Failed(words) => words.clone(),
            Self::NotApplicable => "does not apply".into(),
            Self::Same => "the same".into(),
        }
    }
}

#[derive(Debug, Clone)]
/// A model, a relation, and the result of their comparison.
pub(crate) struct Trial {
    pub model: RandomModel,
    pub relation: Relation,
    pub outcome: Outcome,
}

/// Reads a file and draws it; a panic becomes an error.
fn draw_file(file: &RewrittenFile) -> Result<LinesByPen, String> {
    let draw = || {
        let scene = Scene::from_bytes(&file.bytes, file.format).map_err(|error| error.to_string())?;
        let drawing = render(&scene, &file.camera, &Style::load("ink").unwrap());
        Ok(LinesByPen::of(&drawing.map_err(|error| error.to_string())?))
    };
    catch_unwind(AssertUnwindSafe(draw)).unwrap_or_else(|_| Err("drawing panics".into()))
}

/// The reference file and the rewritten file; `None` if the relation does not apply.
fn file_pair(model: &RandomModel, relation: Relation) -> Option<[RewrittenFile; 2]> {
    let reference = relation.reference(model);
    let other = relation.rewrite(&reference, &mut Dice::new(model.seed))?;
    Some([reference_file(&reference), other])
}

/// Cached drawings of the reference file, with parts and in one part.
#[derive(Default)]
struct ReferenceDrawings([OnceCell<Result<LinesByPen, String>>; 2]);

impl ReferenceDrawings {
    fn get(&self, relation: Relation, file: &RewrittenFile) -> Result<&LinesByPen, String> {
        let drawn = self.0[usize::from(relation.is_in_one_part())].get_or_init(|| draw_file(file));
        drawn.as_ref().map_err(Clone::clone)
    }
}

fn compare_drawings(model: &RandomModel, relation: Relation, references: &ReferenceDrawings) -> Outcome {
    let Some([reference, other]) = file_pair(model, relation) else { return Outcome::NotApplicable };
    let drawn = references.get(relation, &reference).and_then(|one| Ok((one, draw_file(&other)?)));
    let (one, two) = match drawn {
        Ok(pens) => pens,
        Err(words) => return Outcome::Failed(words),
    };
    let place = |p: Point| {
        let p = Point::new(p.x / other.scale, p.y / other.scale);
        if other.is_mirrored { Point::new(reference.camera.width - p.x, p.y) } else { p }
    };
    let tolerance = if model.is_round() { MAX_ROUND_DISTANCE_PX } else { MAX_FLAT_DISTANCE_PX };
    let difference = one.difference(&two.moved(place), tolerance / other.scale.min(1.0));
    if difference.length() > MAX_DIFFERENT_LENGTH_PX { Outcome::Different(difference) } else { Outcome::Same }
}

impl Trial {
    pub(crate) fn run(model: &RandomModel, relation: Relation) -> Self {
        let outcome = compare_drawings(model, relation, &ReferenceDrawings::default());
        Self { model: model.clone(), relation, outcome }
    }

    /// Runs all relations; the reference file is drawn once.
    pub(crate) fn run_all(model: &RandomModel, relations: &[Relation]) -> Vec<Self> {
        let references = ReferenceDrawings::default();
        let run = |relation: &Relation| {
            let outcome = compare_drawings(model, *relation, &references);
            Self { model: model.clone(), relation: *relation, outcome }
        };
        relations.iter().map(run).collect()
    }

    /// One line with the scene, its seed, the relation and the difference.
    pub(crate) fn description(&self) -> String {
        let (kind, seed) = (&self.model.kind, self.model.seed);
        let (relation, words) = (self.relation.name(), self.outcome.description());
        format!("{kind}, seed {seed}, {relation}: {words}")
    }

    /// The failure reduced to as few bodies as possible.
    pub(crate) fn reduced(&self) -> Self {
        let mut least = self.clone();
        let mut k = 0;
        while k < least.model.bodies.len() && least.model.bodies.len() > 1 {
            let mut model = least.model.clone();
            model.bodies.remove(k);
            let kept = Self::run(&model, self.relation);
            model.fit_camera();
            let framed = Self::run(&model, self.relation);
            // Prefer the refitted view if it still fails.
            match [framed, kept].into_iter().find(|trial| trial.outcome.is_failure()) {
                Some(fewer) => least = fewer,
                None => k += 1,
            }
        }
        least
    }

    /// Writes both files, both cameras and the difference into a separate folder.
    pub(crate) fn save_in(&self, folder: &Path) {
        let Some(files) = file_pair(&self.model, self.relation) else { return };
        let word = |text: &str| text.replace(", ", "-").replace(' ', "-");
        let name = format!("{}-{}", word(&self.model.kind), self.model.seed);
        let folder = folder.join(word(self.relation.name())).join(name);
        fs::create_dir_all(&folder).unwrap();
        let mut note =
            format!("{}\n{:?}, {} bodies\n", self.description(), self.model.view, self.model.bodies.len());
        for (name, file) in ["a", "b"].into_iter().zip(&files) {
            let ending = file.extension();
            fs::write(folder.join(format!("{name}.{ending}")), &file.bytes).unwrap();
            fs::write(folder.join(format!("{name}.json")), file.camera.to_json()).unwrap();
            note += &format!("ligne draw {name}.{ending} {name}.svg --camera {name}.json\n");
        }
        fs::write(folder.join("note.txt"), note).unwrap();
    }
}
