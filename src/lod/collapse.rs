//! [`Collapser`]: a surface whose points fall onto their neighbours, one after another.
//!
//! A point falls onto a neighbour and stays nowhere between: so what remains of a surface are vertices that it had, with
//! their normals, texture coordinates, colours, joints and morph targets, and undoing is exact.

use glam::DVec3;

use super::fans::Fans;
use super::flat::{Flat, NONE};
use super::kinds::{Kind, Site, doubled_area, sites};
use super::record::{Change, Record, Step};

/// The number of the step that takes away faces without area.
pub(super) const SWEEP: u32 = NONE;

/// A face may not turn by more than the angle of this cosine in one collapse.
const TURN_COSINE: f64 = 0.2;

/// A face whose area is less than this part of the square of its longest side is none.
const NEEDLE: f64 = 1e-7;

/// A surface whose points fall onto their neighbours.
pub(super) struct Collapser {
    pub flat: Flat,
    /// The points of each face, [`NONE`] for those that are gone.
    pub corners: Vec<[u32; 3]>,
    pub fans: Fans,
    pub sites: Vec<Site>,
    pub record: Record,
    geometry: Vec<u32>,
    /// What is marked, by the number of the question that marked it last.
    marks: Vec<u32>,
    question: u32,
    /// What the collapse that was asked for last would change and remove.
    changes: Vec<Change>,
    removed: Vec<u32>,
}

impl Collapser {
    /// The surface as it is at first, without faces that have no area because corners lie at one place: these go in
    /// a first step.
    pub fn new(flat: Flat) -> Self {
        let mut corners = flat.corners();
        let is_none = |[a, b, c]: [u32; 3]| a == b || b == c || c == a;
        let fans = Fans::new(flat.points.len(), &corners, |face| is_none(corners[face]));
        let sites = sites(&flat, &corners, &fans);
        let mut record = Record {
            wedges: flat.wedges.clone(),
            faces: flat.faces.clone(),
            ranges: flat.ranges.clone(),
            ..Record::default()
        };
        for (face, corners) in corners.iter_mut().enumerate().filter(|(_, corners)| is_none(**corners)) {
            if corners[0] != NONE {
                record.removed.push(face as u32);
            }
            *corners = [NONE; 3];
        }
        if !record.removed.is_empty() {
            let removed_end = record.removed.len() as u32;
            record.steps.push(Step { from: SWEEP, neighbour: 0, changes_end: 0, removed_end });
        }
        let (geometry, marks) = (flat.geometry_of(), vec![0; flat.points.len()]);
        let (changes, removed, question) = (Vec::new(), Vec::new(), 0);
        Self { flat, corners, fans, sites, record, geometry, marks, question, changes, removed }
    }

    /// The neighbours of a point, each once, in the order of its faces.
    pub fn neighbours(&mut self, point: u32, into: &mut Vec<u32>) {
        into.clear();
        self.question += 1;
        for &face in self.fans.about(point) {
            for other in self.corners[face as usize] {
                if other != NONE && other != point && self.marks[other as usize] != self.question {
                    self.marks[other as usize] = self.question;
                    into.push(other);
                }
            }
        }
    }

    /// Whether a point may fall onto a neighbour: the surface stays as connected as it is, no face turns over, and each
    /// corner finds a wedge at the other point. `ring` are the neighbours of the point.
    pub fn may(&mut self, from: u32, to: u32, ring: &[u32]) -> bool {
        self.is_sound(from, to, ring) && self.keeps_sides(from, to) && self.find_changes(from, to)
    }

    /// The link condition: the neighbours that both have are those that a face has with both.
    fn is_sound(&mut self, from: u32, to: u32, ring: &[u32]) -> bool {
        self.question += 2;
        let (common, opposite) = (self.question - 1, self.question);
        for point in ring {
            self.marks[*point as usize] = common;
        }
        let (mut opposites, mut stays) = (0, false);
        for &face in self.fans.about(from) {
            let corners = self.corners[face as usize];
            let with_both = corners.contains(&to);
            stays |= corners[0] != NONE && !with_both;
            for other in corners {
                if with_both && other != from && other != to && self.marks[other as usize] == common {
                    self.marks[other as usize] = opposite;
                    opposites += 1;
                }
            }
        }
        let doubled = |corners: [u32; 3]| {
            let beside = corners.iter().filter(|p| self.marks[**p as usize] == opposite).count();
            beside == 2
        };
        for &face in self.fans.about(to) {
            let corners = self.corners[face as usize];
            if corners[0] == NONE || corners.contains(&from) {
                continue;
            }
            stays = true;
            // A neighbour of both that no face has with both would become an edge of four faces, and a face beyond
            // two opposite points the back of another.
            if corners.iter().any(|p| self.marks[*p as usize] == common && *p != to) {
                return false;
            }
            if opposites > 1 && doubled(corners) && self.has_face(from, to, corners) {
                return false;
            }
        }
        stays && opposites > 0
    }

    /// Whether a point has a face with the two corners that are not `apex` of another face.
    fn has_face(&self, point: u32, apex: u32, [a, b, c]: [u32; 3]) -> bool {
        let has = |face: &&u32| [a, b, c].iter().all(|p| *p == apex || self.corners[**face as usize].contains(p));
        self.fans.about(point).iter().find(has).is_some()
    }

    /// Whether no face turns over or shrinks to a line.
    fn keeps_sides(&self, from: u32, to: u32) -> bool {
        let place = |point: u32| self.flat.points[point as usize];
        let target = place(to);
        self.fans.about(from).iter().all(|face| {
            let corners = self.corners[*face as usize];
            if corners[0] == NONE || corners.contains(&to) {
                return true;
            }
            let before = corners.map(place);
            let after = [0, 1, 2].map(|k| if corners[k] == from { target } else { before[k] });
            keeps_side(before, after)
        })
    }

    /// Finds what the collapse changes and removes; false if a corner finds no wedge of its geometry.
    fn find_changes(&mut self, from: u32, to: u32) -> bool {
        self.changes.clear();
        self.removed.clear();
        let about = self.fans.about(from);
        let alive = |face: u32| self.corners[face as usize][0] != NONE;
        self.removed.extend(
            about.iter().filter(|face| alive(**face) && self.corners[**face as usize].contains(&to)),
        );
        for &face in about {
            let corners = self.corners[face as usize];
            if corners[0] == NONE || corners.contains(&to) {
                continue;
            }
            let Some(k) = corners.iter().position(|p| *p == from) else { continue };
            let before = self.flat.faces[face as usize][k];
            let Some(after) = self.wedge_for(face, before, from, to) else { return false };
            self.changes.push(Change { corner: 3 * face + k as u32, before, after });
        }
        true
    }

    /// The wedge at `to` that carries on the wedge of a face at `from`: that of a face with both whose wedge at `from` is
    /// the same, or like it; else one of `to` that is like it.
    fn wedge_for(&self, face: u32, wedge: u32, from: u32, to: u32) -> Option<u32> {
        let wedge_at = |face: u32, point: u32| {
            let k = self.corners[face as usize].iter().position(|p| *p == point)?;
            Some(self.flat.faces[face as usize][k])
        };
        let own = |other: &&u32| self.geometry[**other as usize] == self.geometry[face as usize];
        let mut best: Option<(f32, u32)> = None;
        for &other in self.removed.iter().filter(own) {
            let (Some(at_from), Some(at_to)) = (wedge_at(other, from), wedge_at(other, to)) else { continue };
            if at_from == wedge {
                return Some(at_to);
            }
            let likeness = self.likeness(wedge, at_from);
            if likeness >= 0.0 && best.is_none_or(|best| likeness > best.0) {
                best = Some((likeness, at_to));
            }
        }
        if let Some((_, wedge)) = best {
            return Some(wedge);
        }
        let mut best: Option<(f32, u32)> = None;
        for &other in self.fans.about(to).iter().filter(own) {
            let Some(at_to) = wedge_at(other, to) else { continue };
            let likeness = self.likeness(wedge, at_to);
            if best.is_none_or(|best| likeness > best.0) {
                best = Some((likeness, at_to));
            }
        }
        best.map(|best| best.1)
    }

    /// How alike two wedges are: by their normals, 0 to 2, and below 0 if what must not change along an edge differs.
    fn likeness(&self, a: u32, b: u32) -> f32 {
        let normal = |wedge: u32| self.flat.normals.get(wedge as usize).copied().unwrap_or([0.0; 3]);
        let ([ax, ay, az], [bx, by, bz]) = (normal(a), normal(b));
        let same = self.flat.class[a as usize] == self.flat.class[b as usize];
        (1.0 + ax * bx + ay * by + az * bz).max(0.0) - if same { 0.0 } else { 4.0 }
    }

    /// Lets a point fall onto its neighbour, as [`Self::may`] has found it just now.
    pub fn collapse(&mut self, from: u32, to: u32, neighbour: u32) {
        for change in &self.changes {
            let (face, k) = ((change.corner / 3) as usize, (change.corner % 3) as usize);
            self.flat.faces[face][k] = change.after;
            self.corners[face][k] = to;
        }
        for face in &self.removed {
            self.corners[*face as usize] = [NONE; 3];
        }
        let corners = &self.corners;
        let alive = |face: u32| corners[face as usize][0] != NONE;
        self.fans.merge(from, to, alive, alive);
        let quadric = self.sites[from as usize].quadric;
        self.sites[to as usize].quadric.add(&quadric);
        self.mend_lines(from, to);
        self.record.changes.append(&mut self.changes);
        self.record.removed.append(&mut self.removed);
        let (changes_end, removed_end) = (self.record.changes.len() as u32, self.record.removed.len() as u32);
        self.record.steps.push(Step { from, neighbour, changes_end, removed_end });
    }

    /// Lines that went through a point go on from the point that it fell onto.
    fn mend_lines(&mut self, from: u32, to: u32) {
        let Site { kind, along, .. } = self.sites[from as usize];
        match kind {
            Kind::Plain => {}
            Kind::Line => {
                let beyond = along[usize::from(along[0] == to)];
                self.relink(to, from, beyond);
                self.relink(beyond, from, to);
            }
            Kind::Corner => {
                self.sites[to as usize].kind = Kind::Corner;
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

    /// The removed faces of the last collapse.
    pub fn last_removed(&self) -> &[u32] {
        self.record.steps.len().checked_sub(1).map_or(&[], |last| self.record.of_step(last).1)
    }
}

/// Whether a face looks to the same side after a corner has moved, and has an area worth the name if it had one.
fn keeps_side(before: [DVec3; 3], after: [DVec3; 3]) -> bool {
    let (old, new) = (doubled_area(before), doubled_area(after));
    let (old_squared, new_squared) = (old.length_squared(), new.length_squared());
    let [a, b, c] = after;
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    if new_squared <= NEEDLE * NEEDLE * longest * longest {
        return old_squared <= new_squared;
    }
    let turned = old.dot(new);
    turned >= 0.0 && turned * turned >= TURN_COSINE * TURN_COSINE * old_squared * new_squared
}
