//! Where a model is cut open, and how it is taken apart.

use clap::Args;
use glam::DVec3;

use super::model_unit::ModelUnit;
use crate::error::Error;
use crate::explode::{Explosion, explode, with_trails};
use crate::math::glob::Glob;
use crate::scene::Scene;
use crate::section::{CutPlane, Section, cut};

/// Where a model is cut open, and what stays whole.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct SectionArgs {
    /// Cut the model open along a plane, and take away what is between that and the eye: x, y or z through the middle of the model,
    /// x=12.5 in its unit, x=10mm, x=30% of its extent, or normal:1,0,1@5. A sign says which side is taken away: +x what has more x
    #[arg(long, value_name = "PLANE", help_heading = "View", allow_hyphen_values = true, value_parser = CutPlane::parse)]
    pub(super) section: Option<CutPlane>,

    /// Leave the parts whole whose name matches where the plane goes through them, may be given again
    #[arg(long, value_name = "GLOB", help_heading = "View", requires = "section")]
    pub(super) uncut: Vec<String>,

    /// Take the model apart along the axis x, y or z, or the best one (auto), with trail lines; :FACTOR says how far [default: 1]
    #[arg(long, value_name = "AXIS[:FACTOR]", help_heading = "View", value_parser = explosion)]
    pub(super) explode: Option<Explosion>,
}

/// Reads `z`, `auto`, `x:1.5` or `:2`.
fn explosion(text: &str) -> Result<Explosion, String> {
    let (axis, factor) = text.split_once(':').map_or((text, None), |(axis, factor)| (axis, Some(factor)));
    let wrong = || "write x, y, z or auto, and how far behind a colon: z:1.5".to_owned();
    let axis = match axis.trim() {
        "x" | "X" => Some(DVec3::X),
        "y" | "Y" => Some(DVec3::Y),
        "z" | "Z" => Some(DVec3::Z),
        "" | "auto" => None,
        _ => return Err(wrong()),
    };
    let factor = factor.map_or(Ok(1.0), |factor| factor.trim().parse::<f64>().map_err(|_| wrong()))?;
    if (0.0..=1000.0).contains(&factor) { Ok(Explosion { axis, factor }) } else { Err(wrong()) }
}

impl SectionArgs {
    /// Whether the model is drawn otherwise than it stands.
    pub(super) fn is_asked(&self) -> bool {
        self.section.is_some() || self.explode.is_some()
    }

    /// Takes the scene apart, if it is to be.
    pub(super) fn take_apart(&self, scene: &mut Scene) -> bool {
        let Some(explosion) = &self.explode else { return false };
        let ways = explode(scene, explosion);
        *scene = with_trails(std::mem::take(scene), &ways);
        true
    }

    /// The scene as it is cut open, if it is to be.
    pub(super) fn cut(
        &self,
        scene: &mut Scene,
        unit: Option<ModelUnit>,
        forward: DVec3,
    ) -> Result<Option<Section>, Error> {
        let Some(plane) = &self.section else { return Ok(None) };
        let plane = plane
            .of(scene, ModelUnit::of(scene, unit).mm(), forward)
            .map_err(|error| error.at("--section"))?;
        let uncut: Vec<Glob> = self.uncut.iter().map(|glob| Glob::new(glob.as_str())).collect();
        let mut section = cut(std::mem::take(scene), &plane, &uncut);
        *scene = std::mem::take(&mut section.scene);
        if scene.parts.is_empty() {
            return Err(Error::new("nothing is left of the model behind the plane")
                .at("--section")
                .remedy("move it"));
        }
        Ok(Some(section))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_explosions() {
        let apart = |axis, factor| Ok(Explosion { axis, factor });
        assert_eq!(explosion("z"), apart(Some(DVec3::Z), 1.0));
        assert_eq!(explosion("auto:1.5"), apart(None, 1.5));
        assert!(["w", "z:", "z:-1", "z:a"].iter().all(|wrong| explosion(wrong).is_err()));
    }
}
