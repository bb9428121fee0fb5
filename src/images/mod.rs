//! Images of materials, as pieces of the page that show them.
//!
//! 1. Visible triangles with an image are cut where other faces pass through them, and until one affine map
//!    per piece is accurate.
//! 2. Pieces with the same map or colour are joined into clusters.
//! 3. The clusters are sorted from back to front and get outlines with a small overlap.
//! 4. The shown part of the image is resampled to the size it has on the page.
//!
//! The clip path of the mark limits the result to the visible part of the surface.
//! Files, in reading order: [`facets`] step 1; [`clusters`] steps 2 and 3; [`image_part`] step 4;
//! [`tone_veils`] transparent layers that give an image its shading; [`tolerances`] all thresholds for
//! rounding.

mod clusters;
pub(crate) mod facets;
mod image_part;
mod tolerances;
pub(crate) mod tone_veils;

use std::sync::Arc;

use glam::DVec2;

use crate::colour::pixel_picture::Picture;
use crate::colour::srgb::Colour;
use crate::drawing::{ImagePaint, ImagePiece, PieceContent};
use crate::mesh::PartId;
use crate::scene::textures::EmbeddedTexture;
use clusters::cluster_arrangement::{ClusterArrangement, MAX_PIECES, TOLERANCE_PX};
use clusters::facet_cluster::{ClusterFit, ClusterPaint, FacetCluster, FacetNeighbours};
use facets::facet::Facet;
pub(crate) use facets::image_context::ImageContext;
use image_part::{ImagePart, MappedPiece};

/// Overlap of pieces under their neighbours, px.
const OVERLAP_PX: f64 = 0.5;

/// Width of a repetition below which the mean colour is shown, px.
const MIN_PERIOD_PX: f64 = 1.5;

/// Largest width and height in the drawing of a picture that is repeated, pixels, unless one repetition is
/// larger.
const MAX_SPAN_PIXELS: f64 = 1024.0;

/// Length below which a piece shows its mean colour, px.
const MIN_MAPPED_PIECE_PX: f64 = 2.5;

/// Share of the visible area of a picture that may be shown less finely than requested.
const MAX_COARSE_SHARE: f64 = 0.1;

/// Result for one picture in a view.
pub(crate) struct ImagePieces {
    /// Pieces of each part of the model.
    pub of_part: Vec<(PartId, ImagePaint)>,
    /// Largest displacement, px, if it is larger than usual, and the number of pieces left out.
    pub coarse: Option<(f64, usize)>,
}

/// Pieces of a picture, with colours changed by `toned`; `None` if it is not visible.
pub(crate) fn pictures(
    stage: &ImageContext,
    imaged: &EmbeddedTexture,
    toned: impl Fn(&mut Picture) + Copy,
) -> Option<ImagePieces> {
    let ImageContext { view, px, offset, .. } = *stage;
    let facets = facets::face_subdivision::visible_facets(stage, imaged);
    let periods = imaged.texels().periods().map(|period| period.map(|count| count as f64));
    let scale = (stage.max_pixels_per_px * stretch(&facets, px)?).min(1.0);
    let spans = periods.map(|period| {
        let period = period?;
        Some(period * (MAX_SPAN_PIXELS / (period * scale)).floor().max(1.0))
    });
    let mut facets = facets::facet::cut_to_spans(facets, spans, periods, MIN_PERIOD_PX * px, &view.frame);
    for facet in &mut facets {
        let [low, high] = facet.places();
        facet.colour = imaged.one_colour(low, high);
    }
    let neighbours = FacetNeighbours::of(&facets);
    let fit = ClusterFit { tolerance: px, spans, reach: px, perspective: view.frame.perspective };
    let ClusterArrangement { mut clusters, tolerance } =
        clusters::cluster_arrangement::arrange_clusters(stage.screen, &facets, &neighbours, fit);
    let too_many = clusters.len().saturating_sub(MAX_PIECES);
    for cluster in &mut clusters {
        if length(cluster, &facets) < MIN_MAPPED_PIECE_PX * px {
            cluster.shows = ClusterPaint::Colour(mean(imaged, cluster, &facets));
        }
    }
    if too_many > 0 {
        let mut areas: Vec<f64> = clusters.iter().map(|cluster| cluster.area(&facets)).collect();
        areas.sort_by(|a, b| b.total_cmp(a));
        let min_area = areas[MAX_PIECES];
        clusters.retain(|cluster| cluster.area(&facets) > min_area);
    }

    let mut mapped = Vec::new();
    let mut shown: Vec<(PartId, PieceFill)> = Vec::new();
    for cluster in &clusters {
        let Some(outline) =
            clusters::cluster_outline::outline(cluster, &facets, &neighbours, (OVERLAP_PX * px, px), offset)
        else {
            continue;
        };
        let piece_fill = match cluster.shows {
            ClusterPaint::Colour(colour) => PieceFill::Flat(outline, colour),
            ClusterPaint::Picture(map) => {
                mapped.push(MappedPiece::new(outline, map, offset, periods));
                PieceFill::Mapped(mapped.len() - 1)
            }
        };
        shown.push((cluster.part, piece_fill));
    }
    let part = ImagePart::of(imaged, &mapped, scale, periods);
    let toned_colour = |colour| {
        let mut picture = Picture { width: 1, height: 1, pixels: vec![colour] };
        toned(&mut picture);
        picture.at(0, 0)
    };
    // Where all pieces have one colour, the drawing holds one white pixel as their picture.
    let blank = Picture { width: 1, height: 1, pixels: vec![Colour::WHITE] };
    let transform = |piece: &MappedPiece| part.as_ref().map(|part| part.transform(piece, offset));
    shown.sort_by_key(|(part, _)| *part);
    let mut of_part: Vec<(PartId, Vec<ImagePiece>)> = Vec::new();
    for (owner, content) in shown {
        let piece = match content {
            PieceFill::Flat(outline, colour) => {
                ImagePiece { outline, shows: PieceContent::Colour(toned_colour(colour)) }
            }
            PieceFill::Mapped(number) => match transform(&mapped[number]) {
                Some(affine) => ImagePiece {
                    outline: mapped[number].outline.clone(),
                    shows: PieceContent::Pixels(affine),
                },
                None => continue,
            },
        };
        match of_part.last_mut().filter(|(last, _)| *last == owner) {
            Some((_, pieces)) => pieces.push(piece),
            None => of_part.push((owner, vec![piece])),
        }
    }
    let mut picture = part.map_or(blank, |part| part.picture);
    toned(&mut picture);
    let picture = Arc::new(picture);
    let with = |(part, pieces)| (part, ImagePaint { picture: Arc::clone(&picture), pieces });
    let coarse = (tolerance > TOLERANCE_PX).then_some((tolerance, too_many));
    Some(ImagePieces { of_part: of_part.into_iter().map(with).collect(), coarse })
}

/// Fill of a piece before assembly.
enum PieceFill {
    Flat(kurbo::BezPath, Colour),
    /// Index of the mapped piece.
    Mapped(usize),
}

/// Longer side of the bounding box of a cluster.
fn length(cluster: &FacetCluster, facets: &[Facet]) -> f64 {
    let empty_box = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let corners = cluster.facets.iter().flat_map(|facet| facets[*facet as usize].corners);
    let (low, high) = corners.fold(empty_box, |(low, high), corner| {
        let at = corner.image.truncate();
        (low.min(at), high.max(at))
    });
    (high - low).max_element()
}

/// Mean colour of a small cluster: that of the bounding box of its places.
fn mean(imaged: &EmbeddedTexture, cluster: &FacetCluster, facets: &[Facet]) -> Colour {
    let empty_box = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let texel_points = cluster.facets.iter().flat_map(|facet| facets[*facet as usize].places());
    let (low, high) = texel_points.fold(empty_box, |(low, high), p| (low.min(p), high.max(p)));
    // At least a texel, and at most an area that is cheap to average.
    let (middle, half) =
        ((low + high) / 2.0, ((high - low) / 2.0).clamp(DVec2::splat(0.5), DVec2::splat(32.0)));
    imaged.part(middle - half, middle + half, [1, 1]).at(0, 0)
}

/// Largest width or height of a texel, px, in nearly all of the visible area; `None` if nothing is visible.
fn stretch(facets: &[Facet], px: f64) -> Option<f64> {
    let of = |facet: &Facet| {
        let [a, b, c] = facet.corners;
        let (p, q) = (b.place - a.place, c.place - a.place);
        let determinant = p.perp_dot(q);
        let (x, y) = ((b.image - a.image).truncate(), (c.image - a.image).truncate());
        let (u, v): (DVec2, DVec2) = ((x * q.y - y * p.y) / determinant, (y * p.x - x * q.x) / determinant);
        // The greater singular value of the matrix with these columns.
        let (sum, turn) = (u.length_squared() + v.length_squared(), u.perp_dot(v));
        let max_stretch = f64::midpoint(sum, (sum * sum - 4.0 * turn * turn).max(0.0).sqrt()).sqrt() / px;
        max_stretch.is_finite().then_some((max_stretch, facet.area2().abs()))
    };
    if facets.is_empty() {
        return None;
    }
    let mut stretches: Vec<(f64, f64)> = facets.iter().filter_map(of).collect();
    stretches.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut remaining_area = stretches.iter().map(|(_, area)| area).sum::<f64>() * MAX_COARSE_SHARE;
    let reaches = |(_, area): &&(f64, f64)| {
        remaining_area -= area;
        remaining_area <= 0.0
    };
    Some(stretches.iter().find(reaches).or(stretches.last()).map_or(1.0, |(factor, _)| *factor))
}
