//! [`LateShadows`]: the shadows that all views of a surface share, made with the first of them.
//!
//! A light that is fixed in the world casts the same shadows in every view, as long as the view cuts no faces: shadows lie on faces.

use std::sync::{Arc, OnceLock};

use crate::light::Caster;
use crate::mesh::Mesh;
use crate::shadows::Shadows;

/// What is not there before the first view.
#[derive(Debug, Default)]
pub(crate) struct LateShadows {
    first: OnceLock<Arc<Shadows>>,
}

impl LateShadows {
    /// The shadows that these lights cast on the surface's own mesh. Where lights move with the camera they are made anew.
    pub fn of(&self, mesh: &Mesh, casters: &[Caster]) -> Arc<Shadows> {
        if let Some(first) = self.first.get().filter(|first| first.casters() == casters) {
            return Arc::clone(first);
        }
        // Views may be drawn side by side: none waits for another.
        let made = Arc::new(Shadows::new(mesh, casters));
        let _ = self.first.set(Arc::clone(&made));
        made
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Soup;

    #[test]
    fn shadows_are_made_once_for_lights_that_stay() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let mesh = Mesh::build(Soup { positions, triangles: vec![[0, 1, 2]], ..Soup::default() });
        let late = LateShadows::default();
        let light = |towards| [Caster::Directional { towards }];
        let first = late.of(&mesh, &light(DVec3::Z));
        assert!(Arc::ptr_eq(&first, &late.of(&mesh, &light(DVec3::Z))));
        let other = late.of(&mesh, &light(DVec3::X));
        assert_eq!(other.casters(), light(DVec3::X));
        assert!(Arc::ptr_eq(&first, &late.of(&mesh, &light(DVec3::Z))));
    }
}
