//! Options of sections and exploded views.

use clap::Args;
use glam::DVec3;

use crate::cli::options::values::model_unit::ModelUnit;
use crate::edit::explode::{Explosion, PartExplosion, direction, explode, with_trails};
use crate::edit::section::{CutPlane, Section, cut};
use crate::error::Error;
use crate::geometry::names::glob::Glob;
use crate::scene::Scene;

/// Options of sections and exploded views.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct SectionArgs {
    /// Cut the model open along a plane: x, +x, y=12.5, z=10mm, x=30%, normal:1,0,1@5 (sign: side to remove)
    #[arg(long, value_name = "PLANE", help_heading = "View", allow_hyphen_values = true, value_parser = CutPlane::parse)]
    pub(crate) section: Option<CutPlane>,

    /// Parts the section plane leaves whole; repeatable
    #[arg(long, value_name = "GLOB", help_heading = "View", requires = "section")]
    pub(crate) uncut: Vec<String>,

    /// Exploded view along x, y, z, 1,0,1 or auto, with trail lines; FACTOR scales the distance [default: 1]
    #[arg(long, value_name = "AXIS[:FACTOR]", help_heading = "View", allow_hyphen_values = true, value_parser = explosion)]
    pub(crate) explode: Option<Explosion>,

    /// Rule for exploded parts, such as 'nut*: along=-z distance=12 order=2 group=cover'; repeatable
    #[arg(long, value_name = "GLOB: KEYS", help_heading = "View", requires = "explode", value_parser = part_explosion)]
    explode_part: Vec<PartExplosion>,
}

/// Reads `nut*: along=-z distance=12 order=2 group=cover`.
fn part_explosion(text: &str) -> Result<PartExplosion, String> {
    let wrong = |what: &str| {
        format!("{what}: write the name of the part, a colon, and along=, distance=, order= or group=")
    };
    let (name, keys) = text.rsplit_once(':').ok_or_else(|| wrong("there is no colon"))?;
    let mut part = PartExplosion::new(name.trim());
    for key in keys.split_whitespace() {
        let (key, value) = key.split_once('=').ok_or_else(|| wrong(&format!("`{key}` has no value")))?;
        let number = || {
            let number = value.parse().ok().filter(|number: &f64| number.is_finite());
            number.ok_or_else(|| format!("{key} is not a number: `{value}`"))
        };
        match key {
            "along" => {
                let way = direction(value).ok_or_else(|| {
                    format!("`{value}` is not a direction; write x, -y or three numbers such as 1,0,1")
                })?;
                part.direction = Some(way);
            }
            "distance" => part.distance = Some(number()?),
            "order" => part.order = Some(number()?),
            "group" => part.group = Some(value.to_owned()),
            _ => return Err(wrong(&format!("there is no key `{key}`"))),
        }
    }
    if part == PartExplosion::new(name.trim()) {
        return Err(wrong("there is no key after the colon"));
    }
    Ok(part)
}

/// Reads `z`, `1,0,1`, `auto`, `x:1.5` or `:2`.
fn explosion(text: &str) -> Result<Explosion, String> {
    let (axis, factor) = text.split_once(':').map_or((text, None), |(axis, factor)| (axis, Some(factor)));
    let wrong = || {
        "write x, y, z, three numbers such as 1,0,1, or auto, and a factor after a colon, such as z:1.5"
            .to_owned()
    };
    let axis = match axis.trim() {
        "" | "auto" => None,
        axis => Some(direction(axis).ok_or_else(wrong)?),
    };
    let factor = factor.map_or(Ok(1.0), |factor| factor.trim().parse::<f64>().map_err(|_| wrong()))?;
    if (0.0..=1000.0).contains(&factor) {
        Ok(Explosion { axis, factor, parts: Vec::new() })
    } else {
        Err(wrong())
    }
}

impl SectionArgs {
    /// Whether the model is cut or exploded.
    pub(crate) fn is_requested(&self) -> bool {
        self.section.is_some() || self.explode.is_some()
    }

    /// Explodes the scene if requested. Returns whether it did.
    pub(crate) fn explode(&self, scene: &mut Scene) -> Result<bool, Error> {
        let Some(explosion) = &self.explode else { return Ok(false) };
        let is_unknown =
            |told: &&PartExplosion| !scene.parts.iter().any(|part| told.name.matches(&part.name));
        if let Some(unknown) = self.explode_part.iter().find(is_unknown) {
            return Err(Error::new(format!("no part has the name `{}`", unknown.name.as_str()))
                .at("--explode-part")
                .remedy("`ligne info` lists the names; a pattern such as bolt* matches several"));
        }
        let parts = [explosion.parts.as_slice(), &self.explode_part].concat();
        let ways = explode(scene, &Explosion { parts, ..explosion.clone() });
        *scene = with_trails(std::mem::take(scene), &ways);
        Ok(true)
    }

    /// Cuts the scene if requested. `forward` is the view direction in world space.
    pub(crate) fn cut(
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
            return Err(Error::new("the section plane removes the whole model")
                .at("--section")
                .remedy("move the plane, or turn it with another sign"));
        }
        Ok(Some(section))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn explosion_parses_an_axis_and_a_factor() {
        let apart = |axis, factor| Ok(Explosion { axis, factor, parts: Vec::new() });
        assert_eq!(explosion("z"), apart(Some(DVec3::Z), 1.0));
        assert_eq!(explosion("auto:1.5"), apart(None, 1.5));
        assert_eq!(explosion("1,0,-2:3"), apart(Some(DVec3::new(1.0, 0.0, -2.0)), 3.0));
        assert!(["w", "0,0,0", "1,2", "z:", "z:-1", "z:a"].iter().all(|wrong| explosion(wrong).is_err()));
    }

    #[test]
    fn part_explosion_parses_a_pattern_and_its_settings() {
        let part = part_explosion("M6: nut*: along=-z distance=12.5 order=2 group=cover").unwrap();
        assert_eq!(part.name, Glob::new("M6: nut*"));
        assert_eq!((part.direction, part.distance, part.order), (Some(DVec3::NEG_Z), Some(12.5), Some(2.0)));
        assert_eq!(part.group.as_deref(), Some("cover"));
        for wrong in [
            "nut",
            "nut:",
            "nut: up",
            "nut: along=w",
            "nut: distance=far",
            "nut: distance=inf",
            "nut: size=3",
        ] {
            assert!(part_explosion(wrong).is_err(), "{wrong}");
        }
    }
}
