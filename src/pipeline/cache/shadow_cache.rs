//! [`ShadowCache`]: shadows that all views of a surface share, built with the first view.
//!
//! A light fixed in the world casts the same shadows in every view that splits no faces, because shadows lie
//! on faces.

use std::sync::{Arc, OnceLock};

use crate::light::Caster;
use crate::mesh::Mesh;
use crate::shadows::Shadows;

/// Shadows of the first view.
#[derive(Debug, Default)]
pub(crate) struct ShadowCache {
    first: OnceLock<Arc<Shadows>>,
}

impl ShadowCache {
    /// The shadows of these lights on the surface's mesh. Lights that move with the camera get new shadows.
    pub(crate) fn of(&self, mesh: &Mesh, casters: &[Caster]) -> Arc<Shadows> {
        if let Some(first) = self.first.get().filter(|first| first.casters() == casters) {
            return Arc::clone(first);
        }
        // Views may be drawn in parallel; none waits for another.
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
    fn shadow_cache_reuses_shadows_of_unchanged_lights() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let mesh = Mesh::build(Soup { positions, triangles: vec![[0, 1, 2]], ..Soup::default() });
        let late = ShadowCache::default();
        let light = |towards| [Caster::Directional { towards }];
        let first = late.of(&mesh, &light(DVec3::Z));
        assert!(Arc::ptr_eq(&first, &late.of(&mesh, &light(DVec3::Z))));
        let other = late.of(&mesh, &light(DVec3::X));
        assert_eq!(other.casters(), light(DVec3::X));
        assert!(Arc::ptr_eq(&first, &late.of(&mesh, &light(DVec3::Z))));
    }
}
