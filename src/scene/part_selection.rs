//! Selection of parts by name.

use super::Scene;
use crate::geometry::names::glob::glob_matches;

impl Scene {
    /// Keeps the parts whose names match a pattern of `only` (all, if it is empty) and none of `hide`.
    ///
    /// `*` matches any characters, `?` any one; letter case matters.
    pub fn keep_parts(&mut self, only: &[String], hide: &[String]) {
        let matches = |globs: &[String], name: &str| globs.iter().any(|glob| glob_matches(glob, name));
        let stays = |name: &str| (only.is_empty() || matches(only, name)) && !matches(hide, name);
        let keep: Vec<bool> = self.parts.iter().map(|part| stays(&part.name)).collect();
        self.retain_parts(&keep);
    }

    /// Keeps the parts marked in `keep`. Returns a new index for each old part: for a removed one, that of
    /// the next remaining part.
    pub(crate) fn retain_parts(&mut self, keep: &[bool]) -> Vec<usize> {
        let stays = |part: usize| keep.get(part).copied().unwrap_or(false);
        let mut place = 0;
        let places: Vec<usize> = (0..self.parts.len())
            .map(|part| {
                place += usize::from(stays(part));
                place - usize::from(stays(part))
            })
            .collect();
        let mut part = 0..;
        self.parts.retain(|_| part.next().is_some_and(stays));
        if let Some(movers) = &mut self.movers {
            movers.retain_mut(|mover| {
                let place = places.get(mover.part).copied().filter(|_| stays(mover.part));
                place.inspect(|place| mover.part = *place).is_some()
            });
        }
        places
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::super::Part;
    use super::*;

    #[test]
    fn keep_parts_applies_only_and_hide_patterns() {
        let part = |name: &str| Part { name: name.into(), geometry: 0, world_from_part: DAffine3::IDENTITY };
        let scene = Scene { parts: ["wheel 1", "wheel 2", "axle"].map(part).into(), ..Scene::default() };
        let kept = |only: &[&str], hide: &[&str]| {
            let mut scene = scene.clone();
            scene.keep_parts(
                &only.iter().map(|s| s.to_string()).collect::<Vec<_>>(),
                &hide.iter().map(|s| s.to_string()).collect::<Vec<_>>(),
            );
            scene.parts.into_iter().map(|p| p.name).collect::<Vec<_>>()
        };
        assert_eq!(kept(&[], &[]).len(), 3);
        assert_eq!(kept(&["wheel*"], &["*2"]), ["wheel 1"]);
        assert_eq!(kept(&[], &["wheel ?"]), ["axle"]);
    }
}
