//! Texel scale: how many texels of each picture fall on a px in a view, as a mean and from place to place.

use crate::geometry::lists::disjoint_sets::UnionFind;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::geometry::numbers::portable_math;
use crate::mesh::{EdgeFaces, FaceId, Mesh};
use crate::scene::textures::texel_plane::TexelPlane;
use crate::view::View;

/// Pictures on a mesh in a view.
pub(crate) struct PictureView<'a, N> {
    pub mesh: &'a Mesh,
    pub view: &'a View,
    /// A px in user units.
    pub px: f64,
    /// Returns the index of the picture that a face shows.
    pub number: N,
    /// Texels of each picture.
    pub texels: &'a [Option<TexelPlane>],
}

/// Scale of a picture in a view.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// Texels per px on faces towards the camera, as a mean over the visible page.
    pub mean: f64,
    /// Smallest and largest number of texels per px as powers of two, if they differ much.
    pub range: Option<[i32; 2]>,
}

/// Texel density at a corner of a face: one value for texels per px area, and one for texels per px along the
/// direction of foreshortening. Both are scaled so that they are linear on plane faces.
pub(crate) type Density = [f64; 2];

/// Largest foreshortening of details that are still drawn.
const MAX_SLANT_RATIO: f64 = 3.0;

/// Areas of a face that is turned to the camera.
#[derive(Debug, Clone, Copy, Default)]
struct TexelAreas {
    /// Twice its area in texels.
    texels: f64,
    /// Twice its area in space.
    world: f64,
    /// Twice its area on the page if seen from depth 1, px².
    page: f64,
}

/// Ratio of largest to smallest depth above which a picture may have several scales.
const MIN_DEPTH_RATIO: f64 = 4.0;

/// Share of the visible area that must differ from the mean scale by more than [`MAX_SCALE_OFFSET_LOG2`] for several scales.
const MIN_OFF_SCALE_SHARE: f64 = 0.04;

/// Difference from the mean scale that counts for [`MIN_OFF_SCALE_SHARE`], in powers of two.
const MAX_SCALE_OFFSET_LOG2: f64 = 2.0;

/// Share of the visible area that is ignored at both ends of the scale range.
const IGNORED_TAIL_SHARE: f64 = 0.005;

/// Lower end of the scale range, as a power of two. Texels larger than a px are all drawn alike.
const MIN_SCALE_LOG2: i32 = -1;

/// Upper end of the scale range, as a power of two.
const MAX_SCALE_LOG2: i32 = 14;

/// Approximate side length of the pieces of a sampled face, px.
const SAMPLE_SIDE_PX: f64 = 24.0;

/// Maximum number of pieces along a side.
const MAX_SAMPLES_PER_SIDE: f64 = 48.0;

/// Corners of a face in texel coordinates.
pub(crate) fn texels(
    mesh: &Mesh,
    face: u32,
    place: impl Fn([f32; 2]) -> Option<DVec2>,
) -> Option<[DVec2; 3]> {
    let corners = mesh.corner_uvs.get(face as usize)?;
    let [a, b, c] = corners.map(|uv| place(*mesh.uvs.get(uv as usize)?));
    Some([a?, b?, c?])
}

impl<N: Fn(u32) -> Option<usize>> PictureView<'_, N> {
    /// Scale of each picture in the view.
    pub(crate) fn scales(&self) -> Vec<Scale> {
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
                    let step = step.clamp(4.0 * f64::from(MIN_SCALE_LOG2), 4.0 * f64::from(MAX_SCALE_LOG2));
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
            let mean = power_of_two(*mean).max(f64::from(MIN_SCALE_LOG2));
            let is_far = |step: i32| (f64::from(step) / 4.0 - mean).abs() > MAX_SCALE_OFFSET_LOG2;
            let far: f64 = steps.iter().filter(|(step, _)| is_far(*step)).map(|(_, area)| area).sum();
            if far <= MIN_OFF_SCALE_SHARE * all {
                return None;
            }
            let low = tail_start(steps.iter().copied(), IGNORED_TAIL_SHARE * all)?;
            let high = tail_start(steps.iter().rev().copied(), IGNORED_TAIL_SHARE * all)?;
            Some([low.round() as i32, high.round() as i32])
        };
        let ranges = sums.into_iter().zip(&means).map(range);
        let ranges: Vec<Option<[i32; 2]>> = ranges.collect();
        let scale = |((mean, range), [near, far]): ((f64, Option<[i32; 2]>), [f64; 2])| Scale {
            mean,
            range: range.filter(|_| far > MIN_DEPTH_RATIO * near),
        };
        means.into_iter().zip(ranges).zip(depths).map(scale).collect()
    }

    /// Mean number of texels per px of each picture, over the visible page.
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
        // Sequential, so that sums do not depend on the number of threads.
        for (number, areas) in (0..self.mesh.triangles.len()).filter_map(of_face) {
            sums[number].iter_mut().zip(areas).for_each(|(sum, area)| *sum += area);
        }
        sums.iter().map(|[texels, page]| if *page > 0.0 { (texels / page).sqrt() } else { 1.0 }).collect()
    }

    /// Picture and areas of a face that is turned to the camera.
    fn share(&self, face: u32) -> Option<(usize, TexelAreas)> {
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
        // The projected area shrinks with the square of the depth, and with the cosine of the angle to the
        // camera. That cosine is the distance of the face's plane from the camera, divided by the depth.
        let page = across.dot(to_eye).abs() * self.scale().powi(2);
        let texels = (b - a).perp_dot(c - a).abs();
        (page > 0.0 && texels.is_finite())
            .then_some((number, TexelAreas { texels, world: across.length(), page }))
    }

    /// Px per unit of length at depth 1.
    fn scale(&self) -> f64 {
        self.view.frame.scale / self.px
    }

    /// Texels per px at depth 1: the square root of the area ratio, and the number along the direction of
    /// foreshortening.
    fn texels_per_px(&self, share: &TexelAreas) -> [f64; 2] {
        let TexelAreas { texels, world, page } = share;
        [(texels / page).sqrt(), (texels * world).sqrt() / page * self.scale() / MAX_SLANT_RATIO]
    }

    /// Reduction of the image by depth: lengths are divided by this.
    fn shrinks(&self, depth: f64) -> f64 {
        if self.view.frame.perspective { depth } else { 1.0 }
    }

    /// Visits a face piece by piece: texels per px, depth, and area of the piece on the page.
    fn each_piece(&self, face: u32, share: TexelAreas, mut call: impl FnMut(f64, f64, f64)) {
        let frame = &self.view.frame;
        let points = self.mesh.triangles[face as usize].map(|v| self.view.points[v as usize]);
        let [p, q, r] = points.map(DVec3::truncate);
        let longest = p.distance(q).max(q.distance(r)).max(r.distance(p)) / self.px;
        let is_whole = longest.is_finite() && points.iter().all(|p| p.z.is_finite());
        let count = if is_whole {
            (longest / SAMPLE_SIDE_PX).ceil().clamp(1.0, MAX_SAMPLES_PER_SIDE)
        } else {
            MAX_SAMPLES_PER_SIDE
        };
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

    /// Texel densities at the corners of all faces that show a picture; see [`density_of`]. Faces share
    /// values along edges that turn by less than `crease_deg`.
    pub(crate) fn densities(&self, picture: usize, crease_deg: f64) -> Vec<[Density; 3]> {
        let mesh = self.mesh;
        let count = mesh.triangles.len();
        let shares: Vec<Option<TexelAreas>> = (0..count as u32)
            .map(|face| self.share(face).filter(|(number, _)| *number == picture).map(|(_, share)| share))
            .collect();
        let joined = UnionFind::new(3 * count);
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
        let mut sums = vec![TexelAreas::default(); 3 * count];
        for (face, share) in shares.iter().enumerate() {
            let Some(share) = share else { continue };
            for corner in 3 * face..3 * face + 3 {
                let sum = &mut sums[joined.root(corner as u32) as usize];
                sum.texels += share.texels;
                sum.world += share.world;
                sum.page += share.page;
            }
        }
        let of_corner = |face: usize, k: usize| {
            let share = &sums[joined.root((3 * face + k) as u32) as usize];
            if share.page <= 0.0 {
                return [0.0; 2];
            }
            let depth = self.shrinks(self.view.frame.depth(mesh.positions[mesh.triangles[face][k] as usize]));
            let [on_px, slanted] = self.texels_per_px(share);
            // Faces seen edge-on have unlimited densities.
            [density_of(on_px)[0], density_of(slanted)[1]].map(|density| (density * depth).clamp(-1e9, 1e9))
        };
        (0..count).map(|face| [0, 1, 2].map(|k| of_corner(face, k))).collect()
    }
}

/// First scale whose accumulated area exceeds `little`, as a power of two.
fn tail_start(mut steps: impl Iterator<Item = (i32, f64)>, little: f64) -> Option<f64> {
    let mut sum = 0.0;
    let (step, _) = steps.find(|(_, area)| {
        sum += area;
        sum > little
    })?;
    Some(f64::from(step) / 4.0)
}

/// Logarithm to base 2.
fn power_of_two(number: f64) -> f64 {
    portable_math::ln(number.max(f64::MIN_POSITIVE)) / std::f64::consts::LN_2
}

/// Densities for the given number of texels per px. On a plane, texels per px area grow with depth to the
/// power 3/2, and texels per px along the foreshortened direction with its square. Powers of both make them
/// linear.
pub(crate) fn density_of(texels_per_px: f64) -> Density {
    [portable_math::cbrt(texels_per_px * texels_per_px), texels_per_px.sqrt()]
}
