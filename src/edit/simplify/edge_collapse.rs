//! [`Collapser`]: a surface that is simplified by half-edge collapses, one after another.
//!
//! A collapse moves a point onto a neighbour, never to a position between them. The simplified surface
//! therefore consists of original vertices with their normals, texture coordinates, colours, joints and morph
//! targets, and undoing a collapse is exact.

use glam::DVec3;

use super::collapse_record::{Collapse, CollapseRecord, NO_INDEX, WedgeChange};
use super::flat_surface::IndexedSurface;
use super::point_constraints::{PointConstraint, Site, sites};
use super::point_faces::PointFaces;

/// Number of the step that removes degenerate faces.
pub(crate) const DEGENERATE_STEP: u32 = NO_INDEX;

/// Minimum cosine of the turn of a face in one collapse.
const MIN_TURN_COSINE: f64 = 0.2;

/// A face is a sliver if its height is less than this fraction of its longest side.
const SLIVER_HEIGHT_RATIO: f64 = 0.05;

/// Minimum fraction of its height ratio that a sliver must keep in one collapse.
const MIN_SLIVER_SHARE_KEPT: f64 = 0.3;

/// A surface under simplification.
pub(crate) struct Collapser {
    pub flat: IndexedSurface,
    /// Points of each face; [`NO_INDEX`] for removed faces.
    pub corners: Vec<[u32; 3]>,
    pub fans: PointFaces,
    pub sites: Vec<Site>,
    pub record: CollapseRecord,
    /// For each point, the number of the query that marked it last.
    marks: Vec<u32>,
    question: u32,
    /// Changes and removed faces of the collapse that was checked last.
    changes: Vec<WedgeChange>,
    removed: Vec<u32>,
    /// For each removed face, its wedges at both points and its geometry.
    carried: Vec<[u32; 3]>,
}

impl Collapser {
    /// The surface before any collapse. A first step removes faces with two corners at one point.
    pub(crate) fn new(flat: IndexedSurface) -> Self {
        let mut corners = flat.corners();
        let is_none = |[a, b, c]: [u32; 3]| a == b || b == c || c == a;
        let fans = PointFaces::new(flat.points.len(), &corners, |face| is_none(corners[face]));
        let sites = sites(&flat, &corners, &fans);
        let mut faces = vec![[NO_INDEX; 3]; flat.faces.len()];
        for (number, wedges) in flat.in_file.iter().zip(&flat.faces) {
            faces[*number as usize] = *wedges;
        }
        let (wedges, ranges) = (flat.wedges.clone(), flat.ranges.clone());
        let mut record = CollapseRecord { wedges, faces, ranges, ..CollapseRecord::default() };
        for (face, corners) in corners.iter_mut().enumerate().filter(|(_, corners)| is_none(**corners)) {
            if corners[0] != NO_INDEX {
                record.removed.push(flat.in_file[face]);
            }
            *corners = [NO_INDEX; 3];
        }
        if !record.removed.is_empty() {
            let removed_end = record.removed.len() as u32;
            record.steps.push(Collapse {
                from: DEGENERATE_STEP,
                to: DEGENERATE_STEP,
                changes_end: 0,
                removed_end,
            });
        }
        let marks = vec![0; flat.points.len()];
        let (changes, removed, carried, question) = (Vec::new(), Vec::new(), Vec::new(), 0);
        Self { flat, corners, fans, sites, record, marks, question, changes, removed, carried }
    }

    /// Collects the neighbours of a point, each once, in the order of its faces.
    pub(crate) fn neighbours(&mut self, point: u32, into: &mut Vec<u32>) {
        into.clear();
        self.question += 1;
        for &face in self.fans.about(point) {
            let corners = self.corners[face as usize];
            for other in opposite_points(corners, point) {
                if corners[0] != NO_INDEX && self.marks[other as usize] != self.question {
                    self.marks[other as usize] = self.question;
                    into.push(other);
                }
            }
        }
    }

    /// Whether a point may collapse onto a neighbour: the topology stays the same, no face flips, and each
    /// corner has a matching wedge at the other point.
    pub(crate) fn can_collapse(&mut self, from: u32, to: u32) -> bool {
        self.satisfies_link_condition(from, to) && self.keeps_sides(from, to) && self.find_changes(from, to)
    }

    /// Link condition: every common neighbour of the two points is opposite their edge in a face.
    fn satisfies_link_condition(&mut self, from: u32, to: u32) -> bool {
        self.question += 2;
        let (common, opposite) = (self.question - 1, self.question);
        let (mut opposites, mut stays) = (0, false);
        for &face in self.fans.about(from) {
            let corners = self.corners[face as usize];
            if corners[0] == NO_INDEX {
                continue;
            }
            let with_both = corners.contains(&to);
            stays |= !with_both;
            for opposite_point in opposite_points(corners, from).into_iter().filter(|other| *other != to) {
                let mark = &mut self.marks[opposite_point as usize];
                opposites += u32::from(with_both && *mark != opposite);
                *mark = if with_both { opposite } else { common.max(*mark) };
            }
        }
        for &face in self.fans.about(to) {
            let corners = self.corners[face as usize];
            if corners[0] == NO_INDEX || corners.contains(&from) {
                continue;
            }
            stays = true;
            let [b, c] = opposite_points(corners, to);
            let marks = [self.marks[b as usize], self.marks[c as usize]];
            // A common neighbour without such a face would create an edge with four faces, unless the three
            // points surround a hole, which then closes.
            let mut shared_ends = [b, c].into_iter().zip(marks).filter(|(_, mark)| *mark == common);
            if shared_ends.any(|(end, _)| !self.is_hole([from, to, end])) {
                return false;
            }
            // A face whose other corners are neighbours of both points could become the back of another face.
            if marks.iter().all(|mark| *mark >= common) && self.has_face(from, to, corners) {
                return false;
            }
        }
        stays && opposites > 0
    }

    /// Whether three mutual neighbours surround a hole: each of their edges has exactly one face, and no face
    /// has all three.
    fn is_hole(&self, points: [u32; 3]) -> bool {
        let [a, b, c] = points;
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().all(|[from, to, beyond]| {
            let about = self.fans.about(from).iter().map(|face| self.corners[*face as usize]);
            let mut beside = about.filter(|corners| corners[0] != NO_INDEX && corners.contains(&to));
            beside.next().is_some_and(|corners| !corners.contains(&beyond)) && beside.next().is_none()
        })
    }

    /// Whether a point has a face with the two corners of another face other than `apex`.
    fn has_face(&self, point: u32, apex: u32, [a, b, c]: [u32; 3]) -> bool {
        let has =
            |face: &&u32| [a, b, c].iter().all(|p| *p == apex || self.corners[**face as usize].contains(p));
        self.fans.about(point).iter().find(has).is_some()
    }

    /// Whether no face flips or degenerates to a line.
    fn keeps_sides(&self, from: u32, to: u32) -> bool {
        let (at, target) = (self.sites[from as usize].place, self.sites[to as usize].place);
        self.fans.about(from).iter().all(|face| {
            let corners = self.corners[*face as usize];
            if corners[0] == NO_INDEX || corners.contains(&to) {
                return true;
            }
            let [b, c] = opposite_points(corners, from);
            keeps_side(at, target, [self.sites[b as usize].place, self.sites[c as usize].place])
        })
    }

    /// Finds the changes and the removed faces of a collapse; false if a corner has no matching wedge of its
    /// geometry.
    fn find_changes(&mut self, from: u32, to: u32) -> bool {
        self.changes.clear();
        self.removed.clear();
        self.carried.clear();
        for &face in self.fans.about(from) {
            let corners = self.corners[face as usize];
            if corners.contains(&to) {
                self.removed.push(face);
                let wedge = |point: u32| {
                    corners
                        .iter()
                        .position(|p| *p == point)
                        .map_or(NO_INDEX, |k| self.flat.faces[face as usize][k])
                };
                self.carried.push([wedge(from), wedge(to), self.flat.geometry[face as usize]]);
            }
        }
        for &face in self.fans.about(from) {
            let corners = self.corners[face as usize];
            if corners[0] == NO_INDEX || corners.contains(&to) {
                continue;
            }
            let Some(k) = corners.iter().position(|p| *p == from) else { continue };
            let before = self.flat.faces[face as usize][k];
            let Some(after) = self.wedge_for(face, before, to) else { return false };
            self.changes.push(WedgeChange { corner: 3 * face + k as u32, before, after });
        }
        true
    }

    /// Wedge at `to` that continues the wedge of a face.
    ///
    /// First choice is a removed face that had the same wedge at the other point, then one with a similar
    /// wedge, then the most similar wedge at `to`.
    fn wedge_for(&self, face: u32, wedge: u32, to: u32) -> Option<u32> {
        let geometry = self.flat.geometry[face as usize];
        let carried = self.carried.iter().filter(|[.., carried_geometry]| *carried_geometry == geometry);
        if let Some([_, at_to, _]) = carried.clone().find(|[at_from, ..]| *at_from == wedge) {
            return Some(*at_to);
        }
        let like = carried.map(|[at_from, at_to, _]| (self.likeness(wedge, *at_from), *at_to));
        if let Some((_, wedge)) = best_match(like.filter(|(likeness, _)| *likeness >= 0.0)) {
            return Some(wedge);
        }
        let faces_at_point = self
            .fans
            .about(to)
            .iter()
            .filter(|other_face| self.flat.geometry[**other_face as usize] == geometry);
        let wedges = faces_at_point.filter_map(|other_face| {
            let k = self.corners[*other_face as usize].iter().position(|point| *point == to)?;
            Some(self.flat.faces[*other_face as usize][k])
        });
        best_match(wedges.map(|candidate| (self.likeness(wedge, candidate), candidate)))
            .map(|(_, wedge)| wedge)
    }

    /// Similarity of two wedges: 0 to 2 by their normals, negative if an attribute that must be continuous
    /// along an edge differs.
    fn likeness(&self, a: u32, b: u32) -> f32 {
        let normal = |wedge: u32| self.flat.normals.get(wedge as usize).copied().unwrap_or([0.0; 3]);
        let ([ax, ay, az], [bx, by, bz]) = (normal(a), normal(b));
        let same = self.flat.class[a as usize] == self.flat.class[b as usize];
        (1.0 + ax * bx + ay * by + az * bz).max(0.0) - if same { 0.0 } else { 4.0 }
    }

    /// Repeats a collapse that was read from a file; false if the points are not neighbours.
    pub(crate) fn replay(&mut self, from: u32, to: u32) -> bool {
        let fits = self.find_changes(from, to) && !self.removed.is_empty();
        if fits {
            self.collapse(from, to);
        }
        fits
    }

    /// Applies the collapse that [`Self::can_collapse`] checked last.
    pub(crate) fn collapse(&mut self, from: u32, to: u32) {
        for change in &self.changes {
            let (face, k) = ((change.corner / 3) as usize, (change.corner % 3) as usize);
            self.flat.faces[face][k] = change.after;
            self.corners[face][k] = to;
        }
        for face in &self.removed {
            self.corners[*face as usize] = [NO_INDEX; 3];
        }
        let corners = &self.corners;
        let alive = |face: u32| corners[face as usize][0] != NO_INDEX;
        self.fans.merge(from, to, alive, alive);
        let quadric = self.sites[from as usize].quadric;
        self.sites[to as usize].take(&quadric);
        self.mend_lines(from, to);
        let in_file = &self.flat.in_file;
        let corner = |corner: u32| 3 * in_file[(corner / 3) as usize] + corner % 3;
        let changes =
            self.changes.iter().map(|change| WedgeChange { corner: corner(change.corner), ..*change });
        self.record.changes.extend(changes);
        self.record.removed.extend(self.removed.iter().map(|face| in_file[*face as usize]));
        let (changes_end, removed_end) = (self.record.changes.len() as u32, self.record.removed.len() as u32);
        self.record.steps.push(Collapse { from, to, changes_end, removed_end });
    }

    /// Reconnects the lines (borders and seams) through the removed point at the remaining point.
    fn mend_lines(&mut self, from: u32, to: u32) {
        let Site { kind, along, .. } = self.sites[from as usize];
        match kind {
            PointConstraint::Plain => {}
            PointConstraint::Line => {
                let beyond = along[usize::from(along[0] == to)];
                self.relink(to, from, beyond);
                self.relink(beyond, from, to);
                // Around a hole that has closed there is no line any more.
                let ends = [to, beyond].map(|point| self.sites.get(point as usize).map(|site| site.along));
                if ends == [Some([beyond; 2]), Some([to; 2])] {
                    [to, beyond]
                        .iter()
                        .for_each(|point| self.sites[*point as usize].kind = PointConstraint::Knot);
                }
            }
            PointConstraint::Knot | PointConstraint::Corner => {
                let target = &mut self.sites[to as usize].kind;
                *target = if *target == PointConstraint::Corner { PointConstraint::Corner } else { kind };
                for at in 0..self.fans.about(to).len() {
                    for point in self.corners[self.fans.about(to)[at] as usize] {
                        self.relink(point, from, to);
                    }
                }
            }
        }
    }

    fn relink(&mut self, point: u32, before: u32, after: u32) {
        if let Some(site) = self.sites.get_mut(point as usize) {
            site.along.iter_mut().filter(|next| **next == before).for_each(|next| *next = after);
        }
    }

    /// Faces removed by the last collapse, or by the collapse checked last.
    pub(crate) fn removed(&self) -> &[u32] {
        &self.removed
    }
}

/// First choice with the greatest similarity.
fn best_match(choices: impl Iterator<Item = (f32, u32)>) -> Option<(f32, u32)> {
    choices.reduce(|best, other| if other.0 > best.0 { other } else { best })
}

/// The other two corners of a face, in order.
#[inline]
pub(crate) fn opposite_points([a, b, c]: [u32; 3], point: u32) -> [u32; 2] {
    match point {
        _ if a == point => [b, c],
        _ if b == point => [c, a],
        _ => [a, b],
    }
}

/// Whether a face keeps its orientation after its first corner has moved, and does not become a sliver.
#[inline]
fn keeps_side(before: DVec3, after: DVec3, [b, c]: [DVec3; 2]) -> bool {
    let side = c - b;
    let (old, new) = ((b - before).cross(side), (b - after).cross(side));
    let (old_squared, new_squared) = (old.length_squared(), new.length_squared());
    let longest =
        |at: DVec3| side.length_squared().max((b - at).length_squared()).max((c - at).length_squared());
    let (old_longest, new_longest) = (longest(before), longest(after));
    // Squared ratio of twice the area to the square of the longest side.
    let (old_stout, new_stout) =
        (old_squared * new_longest * new_longest, new_squared * old_longest * old_longest);
    let is_slim = new_squared < SLIVER_HEIGHT_RATIO * SLIVER_HEIGHT_RATIO * new_longest * new_longest;
    if is_slim && new_stout < MIN_SLIVER_SHARE_KEPT * MIN_SLIVER_SHARE_KEPT * old_stout || new_squared == 0.0
    {
        return old_squared == 0.0;
    }
    let turned = old.dot(new);
    turned >= 0.0 && turned * turned >= MIN_TURN_COSINE * MIN_TURN_COSINE * old_squared * new_squared
}
