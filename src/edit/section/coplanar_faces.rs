//! [`CoplanarFaces`] and [`RemainingFaces`]: faces of the model that lie in the section plane and stay uncut.

use glam::DVec2;
use robust::{Coord, orient2d};
use spade::Triangulation as _;

use super::cut_outlines::{CutOutlines, PlaneTriangles, TriangleOwner};
use super::outline_gaps::closed_outlines;
use super::plane::Plane;
use super::plane_clip::Clipped;

/// Faces of a solid that lie in the plane and face forward.
pub(crate) struct CoplanarFaces {
    /// Triangle index and corners of each, counter-clockwise, sorted by lowest x.
    list: Vec<(usize, [DVec2; 3])>,
    /// Largest extent of a face along x.
    widest: f64,
    /// Whether the solid is open. Its winding numbers are then undefined.
    is_open: bool,
}

impl CoplanarFaces {
    pub(crate) fn new(cut: &Clipped, plane: &Plane) -> Self {
        let place = |node: u32| plane.flat(cut.geometry.positions[cut.nodes[node as usize] as usize]);
        let faces = cut.flat.iter().map(|flat| (flat.triangle, flat.nodes.map(place)));
        let mut list: Vec<_> = faces.filter(|(_, [a, b, c])| turn(*a, *b, *c) > 0.0).collect();
        let low = |corners: &[DVec2; 3]| corners[0].min(corners[1]).min(corners[2]).x;
        let high = |corners: &[DVec2; 3]| corners[0].max(corners[1]).max(corners[2]).x;
        list.sort_by(|a, b| low(&a.1).total_cmp(&low(&b.1)).then(a.0.cmp(&b.0)));
        let widest = list.iter().map(|(_, corners)| high(corners) - low(corners)).fold(0.0, f64::max);
        Self { list, widest, is_open: closed_outlines(cut).1 > 0 }
    }

    /// Triangle index of a face.
    pub(crate) fn triangle(&self, face: usize) -> usize {
        self.list[face].0
    }

    /// Faces that contain a point.
    fn around(&self, p: DVec2) -> impl Iterator<Item = usize> {
        let left = |corners: &[DVec2; 3]| corners[0].min(corners[1]).min(corners[2]).x;
        let first = self.list.partition_point(|(_, corners)| left(corners) < p.x - self.widest);
        let near = self.list[first..].iter().take_while(move |(_, corners)| left(corners) <= p.x);
        let is_inside =
            move |corners: &[DVec2; 3]| (0..3).all(|k| turn(corners[k], corners[(k + 1) % 3], p) >= 0.0);
        near.enumerate().filter(move |(_, (_, corners))| is_inside(corners)).map(move |(k, _)| first + k)
    }
}

/// Orientation of three points, exact: positive if counter-clockwise.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// Triangles of the plane that are pieces of model faces.
pub(crate) struct RemainingFaces {
    /// Solid and face of each triangle.
    of: Vec<Option<[usize; 2]>>,
    /// Whether each face of each solid is kept as a whole; `None` if it covers no triangle.
    whole: Vec<Vec<Option<bool>>>,
}

impl RemainingFaces {
    pub(crate) fn new(
        faces: &PlaneTriangles,
        outlines: &CutOutlines,
        owner: &[Option<TriangleOwner>],
        flats: &[CoplanarFaces],
    ) -> Self {
        let mut of = vec![None; owner.len()];
        let mut whole_flats: Vec<Vec<Option<bool>>> =
            flats.iter().map(|solid_flats| vec![None; solid_flats.list.len()]).collect();
        for face in faces.inner_faces() {
            let index = face.fix().index();
            let [a, b, c] = face.vertices().map(|corner| outlines.at(corner.fix().index() as u32));
            let middle = (a + b + c) / 3.0;
            for (solid, flats) in flats.iter().enumerate() {
                let is_kept = match owner[index] {
                    Some(owner) => owner.solid as usize == solid && !owner.is_cut,
                    None => flats.is_open,
                };
                for flat in flats.around(middle) {
                    let is_first = is_kept && of[index].is_none();
                    if is_first {
                        of[index] = Some([solid, flat]);
                    }
                    let is_whole = &mut whole_flats[solid][flat];
                    *is_whole = Some(is_whole.unwrap_or(true) && is_first);
                }
            }
        }
        Self { of, whole: whole_flats }
    }

    /// Solid and face that a triangle is a piece of.
    pub(crate) fn of(&self, triangle: usize) -> Option<[usize; 2]> {
        self.of[triangle]
    }

    /// Whether a face of a solid is kept as a whole.
    pub(crate) fn is_whole(&self, [solid, face]: [usize; 2]) -> bool {
        self.whole[solid][face] == Some(true)
    }

    /// Triangle indices of the faces kept as a whole, ascending, one list per solid.
    pub(crate) fn whole(&self, flats: &[CoplanarFaces]) -> Vec<Vec<usize>> {
        let of_solid = |(solid, flats): (usize, &CoplanarFaces)| {
            let faces = (0..flats.list.len()).filter(|face| self.is_whole([solid, *face]));
            let mut triangles: Vec<usize> = faces.map(|face| flats.triangle(face)).collect();
            triangles.sort_unstable();
            triangles
        };
        flats.iter().enumerate().map(of_solid).collect()
    }
}
