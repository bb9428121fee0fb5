//! How large the texels of pictures are seen in a view, on the whole and from place to place.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::geometry::numbers::portable_math;
use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::scene::textures::texel_plane::Texels;
use crate::view::View;

/// Where pictures lie on a mesh that is seen.
pub(crate) struct Seen<'a, N> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    /// A px in user units.
    pub px: f64,
    /// The number of the picture that a face shows.
    pub number: N,
    /// The texels of each picture.
    pub texels: &'a [Option<Texels>],
}

/// How large the texels of a picture are seen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// How many lie along a px where it turns to the eye, in the mean over what is seen of the page.
    pub mean: f64,
    /// The least and the greatest number of them along a px, if they differ much: powers of two.
    pub range: Option<[i32; 2]>,
}

/// How dense texels lie at a corner of a face: a number for how many lie on a px, and one for how many along it in the direction
/// in which the face turns away, each of which runs straight along plane faces.
pub(crate) type Density = [f64; 2];

/// What is this many times as narrow as it is long, because its face turns away, is drawn all the same.
const SLANT: f64 = 3.0;

/// What is seen of a face that turns to the eye.
#[derive(Debug, Clone, Copy, Default)]
struct Share {
    /// How large it is in texels, twice.
    texels: f64,
    /// How large it is, twice.
    world: f64,
    /// How large it is on a page on which it is seen from a depth of 1, px, twice.
    page: f64,
}

/// A picture has several scales where some of it is seen from so many times farther away than other parts, ...
const DEEP: f64 = 4.0;

/// ... and more of what is seen of it than this has texels more than [`FAR`] times as large, or as
/// small, as they are in the mean.
const SHARE: f64 = 0.04;

/// See [`SHARE`]; in powers of two.
const FAR: f64 = 2.0;

/// What is seen of less than this part of a picture needs no scale of its own.
const LITTLE: f64 = 0.005;

/// Texels larger than a px are drawn alike, however large they are.
const LARGEST: i32 = -1;

/// No picture is made smaller by more than this power of two.
const SMALLEST: i32 = 14;

/// Faces are looked at in pieces that are about as long as this, px.
const PIECE_PX: f64 = 24.0;

/// No face is looked at in more pieces along a side.
const MOST_PIECES: f64 = 48.0;

/// The corners of a face in the plane of the texels.
pub(crate) fn texels(
    mesh: &Mesh,
    face: u32,
    place: impl Fn([f32; 2]) -> Option<DVec2>,
) -> Option<[DVec2; 3]> {
    let corners = mesh.corner_uvs.get(face as usize)?;
    let [a, b, c] = corners.map(|uv| place(*mesh.uvs.get(uv as usize)?));
    Some([a?, b?, c?])
}

impl<N: Fn(u32) -> Option<usize>> Seen<'_, N> {
    /// How large the texels of each picture are seen.
    pub fn scales(&self) -> Vec<Scale> {
        let means = self.means();
        let single = |mean: f64| Scale { mean, range: None };
        if !self.view.frame.perspective {
            return means.into_iter().map(single).collect();
        }
        let mut sums: Vec<FxHashMap<i32, f64>> = vec![FxHashMap::default(); means.len()];
        let mut depths = vec![[f64::INFINITY, 0.0_f64]; means.len()];
        for face in 0..self.mesh.triangles.len() as u32 {
            if let Some((number, share)) = self.share(face) {
                self.each_piece(face, share, |density, depth, area| {
                    let step = (power_of_two(density) * 4.0).round();
                    let step = step.clamp(4.0 * f64::from(LARGEST), 4.0 * f64::from(SMALLEST));
                    *sums[number].entry(step as i32).or_default() += area;
                    let [near, far] = &mut depths[number];
                    (*near, *far) = (near.min(depth), far.max(depth));
                });
            }
        }
        let range = |(sums, mean): (FxHashMap<i32, f64>, &f64)| {
            let mut steps: Vec<(i32, f64)> = sums.into_iter().collect();
            steps.sort_unstable_by_key(|(step, _)| *step);
            let all: f64 = steps.iter().map(|(_, area)| area).sum();
            let mean = power_of_two(*mean).max(f64::from(LARGEST));
            let is_far = |step: i32| (f64::from(step) / 4.0 - mean).abs() > FAR;
            let far: f64 = steps.iter().filter(|(step, _)| is_far(*step)).map(|(_, area)| area).sum();
            if far <= SHARE * all {
                return None;
            }
            let low = end(steps.iter().copied(), LITTLE * all)?;
            let high = end(steps.iter().rev().copied(), LITTLE * all)?;
            Some([low.round() as i32, high.round() as i32])
        };
        let ranges = sums.into_iter().zip(&means).map(range);
        let ranges: Vec<Option<[i32; 2]>> = ranges.collect();
        let scale = |((mean, range), [near, far]): ((f64, Option<[i32; 2]>), [f64; 2])| Scale {
            mean,
            range: range.filter(|_| far > DEEP * near),
        };
        means.into_iter().zip(ranges).zip(depths).map(scale).collect()
    }

    /// How many texels of each picture lie along a px, in the mean over what is seen of the page.
    fn means(&self) -> Vec<f64> {
        let (width, height) = (self.view.frame.width, self.view.frame.height);
        let of_face = |face: usize| -> Option<(usize, [f64; 2])> {
            let number = (self.number)(face as u32)?;
            if !self.view.facing[face] {
                return None;
            }
            let [p, q, r] = self.mesh.triangles[face].map(|v| self.view.points[v as usize]);
            let is_out = |p: DVec3| p.is_nan() || p.x < 0.0 || p.y < 0.0 || p.x > width || p.y > height;
            if is_out(p) && is_out(q) && is_out(r) {
                return None;
            }
            let own = self.texels[number]?;
            let [a, b, c] = texels(self.mesh, face as u32, |uv| own.place(uv))?;
            let on_page = (q - p).truncate().perp_dot((r - p).truncate()).abs();
            let in_texels = (b - a).perp_dot(c - a).abs();
            (on_page.is_finite()).then_some((number, [in_texels, on_page / (self.px * self.px)]))
        };
        let mut sums = vec![[0.0_f64; 2]; self.texels.len()];
        // One after another, so that sums are the same with any number of threads.
        for (number, areas) in (0..self.mesh.triangles.len()).filter_map(of_face) {
            sums[number].iter_mut().zip(areas).for_each(|(sum, area)| *sum += area);
        }
        sums.iter().map(|[texels, page]| if *page > 0.0 { (texels / page).sqrt() } else { 1.0 }).collect()
    }

    /// The picture of a face that turns to the eye, and what is seen of it.
    fn share(&self, face: u32) -> Option<(usize, Share)> {
        let number = (self.number)(face)?;
        if !self.view.facing[face as usize] {
            return None;
        }
        let own = self.texels[number]?;
        let [a, b, c] = texels(self.mesh, face, |uv| own.place(uv))?;
        let frame = &self.view.frame;
        let [p, q, r] = self.mesh.corners(FaceId(face));
        let across = (q - p).cross(r - p);
        let to_eye = if frame.perspective { frame.eye - p } else { -frame.forward };
        // The page shrinks with the square of the depth, and as the face turns away with the cosine, which is the distance of
        // its plane from the eye by the depth.
        let page = across.dot(to_eye).abs() * self.scale().powi(2);
        let texels = (b - a).perp_dot(c - a).abs();
        (page > 0.0 && texels.is_finite()).then_some((number, Share { texels, world: across.length(), page }))
    }

    /// Px to a unit of length at a depth of 1.
    fn scale(&self) -> f64 {
        self.view.frame.scale / self.px
    }

    /// How many texels lie on a px, its root, at a depth of 1; and along a px in the direction in which the face turns away.
    fn texels_per_px(&self, share: &Share) -> [f64; 2] {
        let Share { texels, world, page } = share;
        [(texels / page).sqrt(), (texels * world).sqrt() / page * self.scale() / SLANT]
    }

    /// By how much depth the page shrinks.
    fn shrinks(&self, depth: f64) -> f64 {
        if self.view.frame.perspective { depth } else { 1.0 }
    }

    /// Goes through a face piece by piece: how many texels lie along a px there, how deep, and how large the piece is on the page.
    fn each_piece(&self, face: u32, share: Share, mut call: impl FnMut(f64, f64, f64)) {
        let frame = &self.view.frame;
        let points = self.mesh.triangles[face as usize].map(|v| self.view.points[v as usize]);
        let [p, q, r] = points.map(DVec3::truncate);
        let longest = p.distance(q).max(q.distance(r)).max(r.distance(p)) / self.px;
        let is_whole = longest.is_finite() && points.iter().all(|p| p.z.is_finite());
        let count = if is_whole { (longest / PIECE_PX).ceil().clamp(1.0, MOST_PIECES) } else { MOST_PIECES };
        let [a, b, c] = self.mesh.corners(FaceId(face));
        let least = frame.near.unwrap_or_default();
        let [on_px, slanted] = self.texels_per_px(&share);
        let mut piece = |x: f64, y: f64| {
            let at = a + (b - a) * (x / count) + (c - a) * (y / count);
            let on = frame.camera_from_local(at);
            if frame.perspective && on.z <= least {
                return;
            }
            let image = frame.image_from_camera(on);
            if image.x < 0.0 || image.y < 0.0 || image.x > frame.width || image.y > frame.height {
                return;
            }
            let depth = self.shrinks(on.z);
            let (on_px, slanted) = (on_px * depth.powi(3).sqrt(), slanted * depth * depth);
            call(on_px.max(slanted), depth, share.page / depth.powi(3) / (count * count));
        };
        let third = 1.0 / 3.0;
        for i in 0..count as u32 {
            for j in 0..count as u32 - i {
                piece(f64::from(i) + third, f64::from(j) + third);
                if i + j + 1 < count as u32 {
                    piece(f64::from(i) + 2.0 * third, f64::from(j) + 2.0 * third);
                }
            }
        }
    }

    /// For each corner of each face that shows a picture how dense texels lie there, the same on both faces of an edge that turn
    /// by less than `crease_deg`; see [`density_of`].
    pub fn densities(&self, picture: usize, crease_deg: f64) -> Vec<[Density; 3]> {
        let mesh = self.mesh;
        let count = mesh.triangles.len();
        let shares: Vec<Option<Share>> = (0..count as u32)
            .map(|face| self.share(face).filter(|(number, _)| *number == picture).map(|(_, share)| share))
            .collect();
        let mut joined = Joined((0..3 * count as u32).collect());
        let normal = |face: u32| DVec3::from_array(mesh.face_normals[face as usize].map(f64::from));
        let least = portable_math::cos(crease_deg.to_radians());
        for edge in 0..mesh.edges.len() {
            let EdgeFaces::Two { faces: [first, second], .. } = mesh.edges.faces(edge) else { continue };
            let is_here = [first, second].iter().all(|face| shares[*face as usize].is_some());
            if is_here && normal(first).dot(normal(second)) >= least {
                for v in mesh.edges.vertices[edge] {
                    let corner = |face: u32| {
                        let at = mesh.triangles[face as usize].iter().position(|own| *own == v);
                        3 * face + at.unwrap_or_default() as u32
                    };
                    joined.join(corner(first), corner(second));
                }
            }
        }
        let mut sums = vec![Share::default(); 3 * count];
        for (face, share) in shares.iter().enumerate() {
            let Some(share) = share else { continue };
            for corner in 3 * face..3 * face + 3 {
                let sum = &mut sums[joined.root(corner as u32) as usize];
                sum.texels += share.texels;
                sum.world += share.world;
                sum.page += share.page;
            }
        }
        let of_corner = |face: usize, k: usize, joined: &mut Joined| {
            let share = &sums[joined.root((3 * face + k) as u32) as usize];
            if share.page <= 0.0 {
                return [0.0; 2];
            }
            let depth = self.shrinks(self.view.frame.depth(mesh.positions[mesh.triangles[face][k] as usize]));
            let [on_px, slanted] = self.texels_per_px(share);
            // Faces seen edge-on have more texels on a px than there are numbers.
            [density_of(on_px)[0], density_of(slanted)[1]].map(|density| (density * depth).clamp(-1e9, 1e9))
        };
        (0..count).map(|face| [0, 1, 2].map(|k| of_corner(face, k, &mut joined))).collect()
    }
}

/// Where some steps add up to more than a little, as a power of two.
fn end(mut steps: impl Iterator<Item = (i32, f64)>, little: f64) -> Option<f64> {
    let mut sum = 0.0;
    let (step, _) = steps.find(|(_, area)| {
        sum += area;
        sum > little
    })?;
    Some(f64::from(step) / 4.0)
}

/// The power of two that a number is.
fn power_of_two(number: f64) -> f64 {
    portable_math::ln(number.max(f64::MIN_POSITIVE)) / std::f64::consts::LN_2
}

/// The densities at which so many texels lie along a px. On a plane those on a px grow with the power 3/2 of the depth, those along
/// it in the direction in which the plane turns away with its square: powers of them grow evenly.
pub(crate) fn density_of(texels_per_px: f64) -> Density {
    [portable_math::cbrt(texels_per_px * texels_per_px), texels_per_px.sqrt()]
}

/// What is one, by the least number of it.
struct Joined(Vec<u32>);

impl Joined {
    fn root(&mut self, of: u32) -> u32 {
        let mut at = of;
        while self.0[at as usize] != at {
            self.0[at as usize] = self.0[self.0[at as usize] as usize];
            at = self.0[at as usize];
        }
        at
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
