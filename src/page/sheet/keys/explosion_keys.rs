//! The settings of a sheet's exploded view, checked and converted.

use glam::DVec3;
use toml::Spanned;

use super::sheet_keys::{ExplodedKeys, PartExplosionKeys};
use crate::edit::explode::{Explosion, PartExplosion, direction};
use crate::error::Error;
use crate::page::page_source::PageSource;
use crate::scene::Scene;

/// Converts the keys to the settings of an explosion.
///
/// # Errors
///
/// Returns an error if an axis or direction is invalid, a number is out of range, or no part has a name.
pub(crate) fn explosion(keys: &ExplodedKeys, scene: &Scene, source: &PageSource) -> Result<Explosion, Error> {
    let axis = keys.axis.as_ref().map(|axis| direction_of(axis, "axis", source)).transpose()?;
    let factor = keys.factor.as_ref().map_or(1.0, |factor| *factor.get_ref());
    let (is_right, advice) = ((0.0..=1000.0).contains(&factor), "write a number from 0 to 1000");
    source.check(&keys.factor, |_| is_right, "this is not a factor for an exploded view", advice)?;
    let parts = keys.part.iter().map(|part| part_explosion(part, scene, source)).collect::<Result<_, _>>()?;
    Ok(Explosion { axis, factor, parts })
}

fn part_explosion(
    keys: &PartExplosionKeys,
    scene: &Scene,
    source: &PageSource,
) -> Result<PartExplosion, Error> {
    let name = keys.name.get_ref();
    if !scene.parts.iter().any(|part| name.matches(&part.name)) {
        let advice = "write a name of the model, or a pattern such as bolt*; `ligne info` lists the names";
        return Err(source.fault(&keys.name.span(), "no part has this name", advice));
    }
    let number = |told: &Option<Spanned<f64>>| {
        source.check(told, |n| n.is_finite(), "this is not a number", "write a number such as 12.5")?;
        Ok(told.as_ref().map(|told| *told.get_ref()))
    };
    Ok(PartExplosion {
        name: name.clone(),
        direction: keys.along.as_ref().map(|along| direction_of(along, "direction", source)).transpose()?,
        distance: number(&keys.distance)?,
        order: number(&keys.order)?,
        group: keys.group.clone(),
    })
}

fn direction_of(text: &Spanned<String>, what: &str, source: &PageSource) -> Result<DVec3, Error> {
    direction(text.get_ref()).ok_or_else(|| {
        let message = format!("there is no {what} `{}`", text.get_ref());
        source.fault(&text.span(), &message, "write x, -y, or three numbers such as 1,0,1")
    })
}
