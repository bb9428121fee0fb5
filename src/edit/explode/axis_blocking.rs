//! [`AxisBlocking`]: blocking relations of bodies along one axis, and the groups that move as one.

use crate::geometry::lists::disjoint_sets::UnionFind;
use crate::parallel::prelude::*;
use glam::DVec3;

use super::assembly::{Assembly, frame};
use super::axis_offsets::{AxisExtent, AxisRelation, PairContacts, offsets};
use super::axis_projection::{AxisProjection, PairContact};
use super::body_axes;

/// Blocking relations of some bodies along an axis.
#[derive(Clone)]
pub(crate) struct AxisBlocking {
    pub axis: DVec3,
    /// Indices of the bodies, ascending.
    of: Vec<usize>,
    stretches: Vec<AxisExtent>,
    /// Contacts of pairs, by position in `of`.
    meetings: PairContacts,
}

impl AxisBlocking {
    /// Computes the relations of bodies along an axis.
    pub(crate) fn new(assembly: &Assembly, of: &[usize], axis: DVec3) -> Self {
        let axes = frame(axis);
        let shadows: Vec<AxisProjection> =
            of.par_iter().map(|k| AxisProjection::new(&assembly.bodies[*k], &axes)).collect();
        let stretch = |(unit, shadow): (&usize, &AxisProjection)| AxisExtent {
            low: shadow.bounds.low.z,
            high: shadow.bounds.high.z,
            size: shadow.area * (shadow.bounds.high.z - shadow.bounds.low.z),
            order: assembly.orders[*unit],
        };
        let stretches: Vec<AxisExtent> = of.iter().zip(&shadows).map(stretch).collect();
        let of_one = |a: usize| {
            let meeting = |b: usize| ([a, b], shadows[a].contact_with(&shadows[b], assembly.touch));
            (0..a)
                .map(meeting)
                .filter(|(_, meeting)| meeting.standing() != AxisRelation::Apart)
                .collect::<Vec<_>>()
        };
        let meetings = (0..of.len()).into_par_iter().with_max_len(1).flat_map_iter(of_one).collect();
        Self { axis, of: of.to_vec(), stretches, meetings }
    }

    /// The same relations for a subset of the bodies.
    pub(crate) fn of_some(&self, of: &[usize]) -> Self {
        let new_index: Vec<Option<usize>> = self.of.iter().map(|unit| of.binary_search(unit).ok()).collect();
        let renumbered_pair = |(pair, meeting): (&[usize; 2], &PairContact)| {
            Some(([new_index[pair[0]]?, new_index[pair[1]]?], *meeting))
        };
        let stretches = self.stretches.iter().zip(&new_index).filter(|(_, place)| place.is_some());
        Self {
            axis: self.axis,
            of: of.to_vec(),
            stretches: stretches.map(|(stretch, _)| *stretch).collect(),
            meetings: self.meetings.iter().filter_map(renumbered_pair).collect(),
        }
    }

    fn standing(&self, [a, b]: [usize; 2]) -> AxisRelation {
        let met = self.meetings.get(&[a, b]).map_or(AxisRelation::Apart, |meeting| meeting.standing());
        self.stretches[a].given_relation(&self.stretches[b]).unwrap_or(met)
    }

    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        self.meetings.keys().copied()
    }

    /// Number of pairs that interlock.
    pub(crate) fn held_pairs(&self) -> usize {
        self.pairs().filter(|pair| self.standing(*pair) == AxisRelation::Held).count()
    }

    /// Number of pairs in contact that can be separated.
    pub(crate) fn separable_pairs(&self) -> usize {
        self.meetings.len() - self.held_pairs()
    }

    /// Groups of interlocking bodies, each group at the position of its lowest body.
    pub(crate) fn held(&self) -> Vec<Vec<usize>> {
        self.grouped(UnionFind::new(self.of.len()))
    }

    /// Groups of interlocking bodies, where sub-assemblies at an angle also form groups. They consist of
    /// bodies without an axis along this one. Two of them are joined if they share another axis and are in
    /// contact along it.
    pub(crate) fn groups(&self, assembly: &Assembly) -> Vec<Vec<usize>> {
        let has =
            |k: usize, axis: DVec3| assembly.axes[k].iter().any(|own| body_axes::is_parallel(*own, axis));
        let askew: Vec<usize> = self
            .of
            .iter()
            .copied()
            .filter(|k| !assembly.axes[*k].is_empty() && !has(*k, self.axis))
            .collect();
        let group = UnionFind::new(self.of.len());
        for axis in assembly.shared_axes(&askew) {
            let of: Vec<usize> = askew.iter().copied().filter(|k| has(*k, axis)).collect();
            let level = Self::new(assembly, &of, axis);
            for pair in level.pairs() {
                let [a, b] = pair.map(|k| self.of.binary_search(&level.of[k]).unwrap_or_default());
                group.join(a as u32, b as u32);
            }
        }
        self.grouped(group)
    }

    /// Joins interlocking bodies with the given groups.
    fn grouped(&self, group: UnionFind) -> Vec<Vec<usize>> {
        for [a, b] in self.pairs().filter(|pair| self.standing(*pair) == AxisRelation::Held) {
            group.join(a as u32, b as u32);
        }
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); self.of.len()];
        for (k, unit) in self.of.iter().enumerate() {
            groups[group.root(k as u32) as usize].push(*unit);
        }
        groups.retain(|group| !group.is_empty());
        groups
    }

    /// Displacement of each group along the axis.
    pub(crate) fn offsets(&self, assembly: &Assembly, groups: &[Vec<usize>]) -> Vec<f64> {
        let index_of = |unit: &usize| self.of.binary_search(unit).ok();
        let mut group_of = vec![0; self.of.len()];
        for (number, group) in groups.iter().enumerate() {
            group.iter().filter_map(index_of).for_each(|k| group_of[k] = number);
        }
        let mut meetings = PairContacts::new();
        for (&[a, b], meeting) in &self.meetings {
            let [first_group, second_group] = [group_of[a], group_of[b]];
            let (pair, meeting) = if first_group > second_group {
                ([first_group, second_group], *meeting)
            } else {
                ([second_group, first_group], meeting.turned())
            };
            if first_group != second_group {
                meetings.entry(pair).and_modify(|merged| *merged = merged.or(meeting)).or_insert(meeting);
            }
        }
        let joined = |group: &Vec<usize>| {
            AxisExtent::joined(group.iter().filter_map(index_of).map(|k| self.stretches[k]))
        };
        let stretches: Vec<AxisExtent> = groups.iter().map(joined).collect();
        offsets(&stretches, &meetings, assembly.gap)
    }
}
