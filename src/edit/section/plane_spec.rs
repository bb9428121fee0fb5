//! [`CutPlane`]: plane as written in options: `x`, `y=12.5`, `z=50%`, `normal:1,0,1@5mm`.

use glam::DVec3;

use super::Plane;
use crate::error::Error;
use crate::geometry::numbers::length_units::LENGTH_UNITS_MM;
use crate::scene::Scene;

/// Plane as written in an option.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutPlane {
    normal: DVec3,
    /// Whether the normal defines the side to remove. Otherwise the view does.
    signed: bool,
    at: PlaneOffset,
}

/// Position of a plane along its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PlaneOffset {
    /// Distance from the origin, model units.
    Units(f64),
    /// Distance from the origin, mm.
    Mm(f64),
    /// Share of the model's extent.
    Share(f64),
}

impl CutPlane {
    /// Reads a plane.
    ///
    /// - Direction: an axis, or `normal:` and three numbers.
    /// - Position, after `=` or `@`: in model units, with a unit (mm, cm, m, in, ft), or as a share of the
    ///   extent in percent. The default is the centre of the model.
    /// - Optional sign before it: the side to remove.
    ///
    /// # Errors
    /// Returns the expected form.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wrong = || {
            "write a plane such as x, y=12.5, z=10mm, x=30% or normal:1,0,1@5; + or - selects the side to remove"
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
                let (normal, at) =
                    rest.split_once('@').map_or((rest, None), |(normal, at)| (normal, Some(at)));
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
            None => PlaneOffset::Share(0.5),
            Some(at) => match at.strip_suffix('%') {
                Some(percent) => {
                    PlaneOffset::Share(percent.trim().parse::<f64>().map_err(|_| wrong())? / 100.0)
                }
                None if at.ends_with(|c: char| c.is_ascii_alphabetic()) => {
                    let number = at.trim_end_matches(|c: char| c.is_ascii_alphabetic());
                    let unit = LENGTH_UNITS_MM
                        .iter()
                        .find(|(name, _)| *name == &at[number.len()..])
                        .ok_or_else(wrong)?;
                    PlaneOffset::Mm(number.trim().parse::<f64>().map_err(|_| wrong())? * unit.1)
                }
                None => PlaneOffset::Units(at.parse().map_err(|_| wrong())?),
            },
        };
        let (PlaneOffset::Units(number) | PlaneOffset::Mm(number) | PlaneOffset::Share(number)) = at;
        let normal = normal.try_normalize().filter(|_| number.is_finite()).ok_or_else(wrong)?;
        // The position is given along the axis, independent of the sign.
        Ok(CutPlane { normal: normal * sign.unwrap_or(1.0), signed: sign.is_some(), at: at.turned(sign) })
    }

    /// The normal, and whether it defines the side to remove.
    #[must_use]
    pub fn normal(&self) -> (DVec3, bool) {
        (self.normal, self.signed)
    }

    /// Plane in a scene. `unit_mm` is the length of a model unit in mm. The removed side is in front: the
    /// side of the sign, or without a sign the side of a camera that looks along `forward`.
    ///
    /// # Errors
    /// If the plane misses the model.
    pub fn of(&self, scene: &Scene, unit_mm: f64, forward: DVec3) -> Result<Plane, Error> {
        let (low, high) = scene.bounds().unwrap_or_default();
        let corner = |k: usize| {
            let pick = |bit: usize| if k >> bit & 1 == 0 { low } else { high };
            DVec3::new(pick(0).x, pick(1).y, pick(2).z).dot(self.normal)
        };
        let corner_offsets: [f64; 8] = std::array::from_fn(corner);
        let min_offset = corner_offsets.into_iter().fold(f64::INFINITY, f64::min);
        let max_offset = corner_offsets.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let at = match self.at {
            PlaneOffset::Units(at) => at,
            PlaneOffset::Mm(mm) => mm / unit_mm,
            PlaneOffset::Share(share) => min_offset + (max_offset - min_offset) * share,
        };
        if !(min_offset..=max_offset).contains(&at) {
            return Err(Error::new(format!(
                "the plane misses the model, which extends from {min_offset} to {max_offset} there"
            ))
            .remedy("move the plane, or give a share of the extent such as x=50%"));
        }
        let plane = Plane::new(self.normal * at, self.normal)
            .ok_or_else(|| Error::new("this is not a plane").remedy("give a plane such as x=50%"))?;
        let before_it = self.signed || plane.normal().dot(forward) <= 0.0;
        Ok(if before_it { plane } else { plane.turned() })
    }
}

impl PlaneOffset {
    fn turned(self, sign: Option<f64>) -> Self {
        match self {
            _ if sign != Some(-1.0) => self,
            Self::Units(x) => Self::Units(-x),
            Self::Mm(x) => Self::Mm(-x),
            Self::Share(x) => Self::Share(1.0 - x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cut_plane_parses_axes_offsets_and_normals() {
        let plane = |normal, signed, at| Ok(CutPlane { normal, signed, at });
        assert_eq!(CutPlane::parse("x"), plane(DVec3::X, false, PlaneOffset::Share(0.5)));
        assert_eq!(CutPlane::parse("y=12.5"), plane(DVec3::Y, false, PlaneOffset::Units(12.5)));
        assert_eq!(CutPlane::parse("+z = 1cm"), plane(DVec3::Z, true, PlaneOffset::Mm(10.0)));
        assert_eq!(CutPlane::parse("-x=25%"), plane(DVec3::NEG_X, true, PlaneOffset::Share(0.75)));
        assert_eq!(CutPlane::parse("-x=-3"), plane(DVec3::NEG_X, true, PlaneOffset::Units(3.0)));
        assert_eq!(CutPlane::parse("normal:0,0,2@4"), plane(DVec3::Z, false, PlaneOffset::Units(4.0)));
        for wrong in
            ["", "w", "x=", "x=a", "x=5furlong", "normal:1,2", "normal:0,0,0", "x=nan", "normal:1,0,0@"]
        {
            assert!(CutPlane::parse(wrong).is_err(), "{wrong}");
        }
    }
}
