//! Seeded random generator for scenes.

use glam::{DMat3, DQuat, DVec3};

/// A splitmix64 generator: the same seed gives the same numbers on every machine.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from `low` to `high`, uniformly distributed.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.word() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// An integer in `0..count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.word() % count as u64) as usize
    }

    /// A point in the cube from −`reach` to `reach`, uniformly distributed.
    pub(crate) fn point(&mut self, reach: f64) -> DVec3 {
        let mut next = || self.between(-reach, reach);
        DVec3::new(next(), next(), next())
    }

    /// A direction, uniformly distributed.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point(1.0);
            if (0.01..=1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }

    /// A rotation, uniformly distributed.
    pub(crate) fn turn(&mut self) -> DMat3 {
        loop {
            let q = glam::DVec4::from((self.point(1.0), self.between(-1.0, 1.0)));
            if (0.01..=1.0).contains(&q.length_squared()) {
                return DMat3::from_quat(DQuat::from_vec4(q.normalize()));
            }
        }
    }

    /// The items in a random order.
    pub(crate) fn shuffled<T>(&mut self, mut items: Vec<T>) -> Vec<T> {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
        items
    }
}
