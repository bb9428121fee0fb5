//! Where a model is cut open: `x`, `y=12.5`, `z=50%`, `normal:1,0,1@5mm`.

use clap::Args;
use glam::DVec3;

use super::model_unit::ModelUnit;
use crate::drawing::Length;
use crate::drawing::Unit;
use crate::error::Error;
use crate::explode::{Explosion, explode, with_trails};
use crate::math::glob::Glob;
use crate::scene::Scene;
use crate::section::{Plane, Section, cut};

/// Where a model is cut open, and what stays whole.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct SectionArgs {
    /// Cut the model open along a plane, and take away what is between that and the eye: x, y or z through the middle of the model,
    /// x=12.5 in its unit, x=10mm, x=30% of its extent, or normal:1,0,1@5. A sign says which side is taken away: +x what has more x
    #[arg(long, value_name = "PLANE", help_heading = "View", allow_hyphen_values = true, value_parser = cut_plane)]
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

/// A plane as it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CutPlane {
    normal: DVec3,
    /// Whether what lies where the normal points is taken away, whatever the eye.
    signed: bool,
    at: At,
}

/// How far along its normal a plane lies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum At {
    /// Units of the model from its zero.
    Units(f64),
    /// Millimetres from its zero.
    Mm(f64),
    /// A share of the model's extent.
    Share(f64),
}

/// Reads a plane.
pub(super) fn cut_plane(text: &str) -> Result<CutPlane, String> {
    let wrong = || {
        "write a plane such as x, y=12.5, z=10mm, x=30% or normal:1,0,1@5; + or - before it takes that side away"
            .to_owned()
    };
    let text = text.trim();
    let (sign, rest) = match (text.strip_prefix('+'), text.strip_prefix('-')) {
        (Some(rest), _) => (Some(1.0), rest),
        (_, Some(rest)) => (Some(-1.0), rest),
        _ => (None, text),
    };
    let (normal, at) = match rest.strip_prefix("normal:") {
        Some(rest) => {
            let (normal, at) = rest.split_once('@').map_or((rest, None), |(normal, at)| (normal, Some(at)));
            let numbers: Vec<f64> = normal.split(',').filter_map(|n| n.trim().parse().ok()).collect();
            match numbers.as_slice() {
                [x, y, z] if normal.split(',').count() == 3 => (DVec3::new(*x, *y, *z), at),
                _ => return Err(wrong()),
            }
        }
        None => {
            let (axis, at) = rest.split_once('=').map_or((rest, None), |(axis, at)| (axis, Some(at)));
            let normal = match axis.trim() {
                "x" | "X" => DVec3::X,
                "y" | "Y" => DVec3::Y,
                "z" | "Z" => DVec3::Z,
                _ => return Err(wrong()),
            };
            (normal, at)
        }
    };
    let at = match at.map(str::trim) {
        None => At::Share(0.5),
        Some(at) => match at.strip_suffix('%') {
            Some(percent) => At::Share(percent.trim().parse::<f64>().map_err(|_| wrong())? / 100.0),
            None if at.ends_with(|c: char| c.is_ascii_alphabetic()) => {
                At::Mm(Length::parse(at).ok_or_else(wrong)?.in_unit(Unit::Mm))
            }
            None => At::Units(at.parse().map_err(|_| wrong())?),
        },
    };
    let (At::Units(number) | At::Mm(number) | At::Share(number)) = at;
    let normal = normal.try_normalize().filter(|_| number.is_finite()).ok_or_else(wrong)?;
    // Where the plane lies is told along the axis itself, whichever side goes.
    Ok(CutPlane { normal: normal * sign.unwrap_or(1.0), signed: sign.is_some(), at: at.turned(sign) })
}

impl At {
    fn turned(self, sign: Option<f64>) -> Self {
        match self {
            _ if sign != Some(-1.0) => self,
            Self::Units(x) => Self::Units(-x),
            Self::Mm(x) => Self::Mm(-x),
            Self::Share(x) => Self::Share(1.0 - x),
        }
    }
}

impl CutPlane {
    /// The plane in a scene, of which what is in front goes; `forward` is the direction in which the eye looks.
    pub(super) fn of(&self, scene: &Scene, unit: Option<ModelUnit>, forward: DVec3) -> Result<Plane, Error> {
        let (low, high) = scene.bounds().unwrap_or_default();
        let corner = |k: usize| {
            let pick = |bit: usize| if k >> bit & 1 == 0 { low } else { high };
            DVec3::new(pick(0).x, pick(1).y, pick(2).z).dot(self.normal)
        };
        let places: [f64; 8] = std::array::from_fn(corner);
        let least = places.into_iter().fold(f64::INFINITY, f64::min);
        let most = places.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let at = match self.at {
            At::Units(at) => at,
            At::Mm(mm) => mm / ModelUnit::of(scene, unit).mm(),
            At::Share(share) => least + (most - least) * share,
        };
        if !(least..=most).contains(&at) {
            return Err(Error::new(format!("the plane lies beside the model, which reaches from {least} to {most} there"))
                .at("--section")
                .remedy("move the plane, or give a share of the extent such as x=50%"));
        }
        let plane = Plane::new(self.normal * at, self.normal)
            .ok_or_else(|| Error::new("this is no plane").at("--section").remedy("give a plane such as x=50%"))?;
        let before_it = self.signed || plane.normal().dot(forward) <= 0.0;
        Ok(if before_it { plane } else { plane.turned() })
    }
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
        let plane = plane.of(scene, unit, forward)?;
        let uncut: Vec<Glob> = self.uncut.iter().map(|glob| Glob::new(glob.as_str())).collect();
        let mut section = cut(std::mem::take(scene), &plane, &uncut);
        *scene = std::mem::take(&mut section.scene);
        if scene.parts.is_empty() {
            return Err(Error::new("nothing is left of the model behind the plane").at("--section").remedy("move it"));
        }
        Ok(Some(section))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_planes() {
        let plane = |normal, signed, at| Ok(CutPlane { normal, signed, at });
        assert_eq!(cut_plane("x"), plane(DVec3::X, false, At::Share(0.5)));
        assert_eq!(cut_plane("y=12.5"), plane(DVec3::Y, false, At::Units(12.5)));
        assert_eq!(cut_plane("+z = 1cm"), plane(DVec3::Z, true, At::Mm(10.0)));
        assert_eq!(cut_plane("-x=25%"), plane(DVec3::NEG_X, true, At::Share(0.75)));
        assert_eq!(cut_plane("-x=-3"), plane(DVec3::NEG_X, true, At::Units(3.0)));
        assert_eq!(cut_plane("normal:0,0,2@4"), plane(DVec3::Z, false, At::Units(4.0)));
        let apart = |axis, factor| Ok(Explosion { axis, factor });
        assert_eq!(explosion("z"), apart(Some(DVec3::Z), 1.0));
        assert_eq!(explosion("auto:1.5"), apart(None, 1.5));
        assert!(["w", "z:", "z:-1", "z:a"].iter().all(|wrong| explosion(wrong).is_err()));
        for wrong in ["", "w", "x=", "x=a", "x=5furlong", "normal:1,2", "normal:0,0,0", "x=nan", "normal:1,0,0@"] {
            assert!(cut_plane(wrong).is_err(), "{wrong}");
        }
    }
}
