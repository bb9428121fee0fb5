//! Welding: corners at exactly one place are one point, for the order of collapses alone.

use glam::DVec3;

const FREE: u32 = u32::MAX;

/// Points at different places, or of groups that have nothing in common; a table of hashes that never forgets.
#[derive(Debug)]
pub(super) struct Weld {
    slots: Vec<u32>,
    points: Vec<DVec3>,
    groups: Vec<u32>,
}

impl Weld {
    /// Room for so many points; no more may be asked for.
    pub fn with_room(count: usize) -> Self {
        let slots = (count * 2).max(4).next_power_of_two();
        Self { slots: vec![FREE; slots], points: Vec::with_capacity(count), groups: Vec::with_capacity(count) }
    }

    /// The number of the point at a place: a new one where there is none yet.
    pub fn point(&mut self, group: u32, place: DVec3) -> u32 {
        // Zeros of either sign are one place.
        let place = place + 0.0;
        let mask = self.slots.len() - 1;
        let mut slot = slot_of(group, place) as usize & mask;
        loop {
            let point = self.slots[slot];
            if point == FREE {
                let point = self.points.len() as u32;
                self.slots[slot] = point;
                self.points.push(place);
                self.groups.push(group);
                return point;
            }
            if self.points[point as usize] == place && self.groups[point as usize] == group {
                return point;
            }
            slot = (slot + 1) & mask;
        }
    }

    /// The place of each point.
    pub fn into_points(self) -> Vec<DVec3> {
        self.points
    }
}

fn slot_of(group: u32, place: DVec3) -> u64 {
    let mut hash = u64::from(group);
    for bits in place.to_array().map(f64::to_bits) {
        hash = (hash.rotate_left(23) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    hash ^ (hash >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_place_is_one_point() {
        let mut weld = Weld::with_room(4);
        let places = [DVec3::X, DVec3::ZERO, DVec3::X, -DVec3::ZERO];
        assert_eq!(places.map(|place| weld.point(0, place)), [0, 1, 0, 1]);
        assert_eq!([weld.point(1, DVec3::X), weld.point(1, DVec3::X), weld.point(0, DVec3::Y)], [2, 2, 3]);
        assert_eq!(weld.into_points(), [DVec3::X, DVec3::ZERO, DVec3::X, DVec3::Y]);
    }
}
