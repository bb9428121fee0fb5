//! [`Relation`]: the ways to write a model that must not change its drawing.

use glam::{DAffine3, DMat3, DVec3};
use ligne::load::ModelFormat;
use ligne::scene::{Camera, NamedView, Projection, UpAxis};

use super::binary_files::{write_glb_baked, write_glb_nested, write_ply_single, write_stl};
use super::changes;
use super::model::{RandomModel, ViewChoice};
use super::text_files::{Digits, write_obj, write_obj_in_groups, write_ply};
use crate::library::support::scenes::random_dice::Dice;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
/// A way to write a model that must not change its drawing.
pub(crate) enum Relation {
    AllReversed,
    SomeReversed,
    ObjSixDecimals,
    ObjSinglePrecision,
    Stl,
    Ply,
    PlySinglePrecision,
    GlbNested,
    GlbSinglePrecision,
    Turned,
    Scaled,
    MovedFar,
    Mirrored,
    CameraRecord,
    CameraRecordRounded,
    CameraByAngles,
    CameraByName,
    FacesSplit,
    VertexInEdge,
    VertexInEdgeOneSided,
    OtherDiagonals,
    FacesDoubled,
    FacesWithoutArea,
    GroupPerFace,
    OtherOrder,
    HiddenPart,
    PictureSize,
}

/// A model file, its camera, and the map from its drawing to the reference drawing.
pub(crate) struct RewrittenFile {
    pub bytes: Vec<u8>,
    pub format: ModelFormat,
    pub camera: Camera,
    /// Whether the picture is mirrored left to right.
    pub is_mirrored: bool,
    /// Scale of the picture relative to the reference.
    pub scale: f64,
}

impl RewrittenFile {
    /// The extension of the model's file.
    pub(crate) fn extension(&self) -> &'static str {
        match self.format {
            ModelFormat::Obj => "obj",
            ModelFormat::Stl => "stl",
            ModelFormat::Ply => "ply",
            _ => "glb",
        }
    }
}

impl Relation {
    pub(crate) const ALL: [Self; 27] = [
        Self::AllReversed,
        Self::SomeReversed,
        Self::ObjSixDecimals,
        Self::ObjSinglePrecision,
        Self::Stl,
        Self::Ply,
        Self::PlySinglePrecision,
        Self::GlbNested,
        Self::GlbSinglePrecision,
        Self::Turned,
        Self::Scaled,
        Self::MovedFar,
        Self::Mirrored,
        Self::CameraRecord,
        Self::CameraRecordRounded,
        Self::CameraByAngles,
        Self::CameraByName,
        Self::FacesSplit,
        Self::VertexInEdge,
        Self::VertexInEdgeOneSided,
        Self::OtherDiagonals,
        Self::FacesDoubled,
        Self::FacesWithoutArea,
        Self::GroupPerFace,
        Self::OtherOrder,
        Self::HiddenPart,
        Self::PictureSize,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::AllReversed => "all faces reversed",
            Self::SomeReversed => "faces of some bodies reversed",
            Self::ObjSixDecimals => "OBJ, six decimals",
            Self::ObjSinglePrecision => "OBJ, single precision",
            Self::Stl => "STL",
            Self::Ply => "PLY, double precision",
            Self::PlySinglePrecision => "PLY, single precision",
            Self::GlbNested => "GLB, nested transforms",
            Self::GlbSinglePrecision => "GLB, world coordinates",
            Self::Turned => "turned with the camera",
            Self::Scaled => "scaled with the camera",
            Self::MovedFar => "moved far with the camera",
            Self::Mirrored => "mirrored with the camera",
            Self::CameraRecord => "camera as record",
            Self::CameraRecordRounded => "camera as record, nine decimals",
            Self::CameraByAngles => "camera by angles",
            Self::CameraByName => "camera by name",
            Self::FacesSplit => "faces split",
            Self::VertexInEdge => "vertices in edges, both sides",
            Self::VertexInEdgeOneSided => "vertices in edges, one side",
            Self::OtherDiagonals => "other diagonals",
            Self::FacesDoubled => "faces doubled",
            Self::FacesWithoutArea => "faces without area",
            Self::GroupPerFace => "a group for each face",
            Self::OtherOrder => "parts and faces in another order",
            Self::HiddenPart => "a hidden part added",
            Self::PictureSize => "another picture size",
        }
    }

    /// The model to compare with: in one part if the format has neither parts nor colours.
    pub(crate) fn reference(self, model: &RandomModel) -> RandomModel {
        if self.is_in_one_part() { model.clone().in_one_part() } else { model.clone() }
    }

    /// Whether the format has neither parts nor colours.
    pub(crate) fn is_in_one_part(self) -> bool {
        matches!(self, Self::Stl | Self::Ply | Self::PlySinglePrecision)
    }

    /// Writes the reference in another way; `None` if the relation does not apply.
    pub(crate) fn rewrite(self, model: &RandomModel, dice: &mut Dice) -> Option<RewrittenFile> {
        let mut other = model.clone();
        match self {
            Self::AllReversed => changes::reverse_all_faces(&mut other),
            Self::SomeReversed => changes::reverse_some_bodies(&mut other, dice)?,
            Self::ObjSixDecimals => {
                return Some(rewritten_file(model, write_obj(model, Digits::Six), ModelFormat::Obj));
            }
            Self::ObjSinglePrecision => {
                return Some(rewritten_file(model, write_obj(model, Digits::Single), ModelFormat::Obj));
            }
            Self::Stl => return Some(rewritten_file(model, write_stl(model), ModelFormat::Stl)),
            Self::Ply => return Some(rewritten_file(model, write_ply(model), ModelFormat::Ply)),
            Self::PlySinglePrecision => {
                return Some(rewritten_file(model, write_ply_single(model), ModelFormat::Ply));
            }
            Self::GlbNested => {
                return Some(rewritten_file(model, write_glb_nested(model, dice), ModelFormat::Gltf));
            }
            Self::GlbSinglePrecision => {
                return Some(rewritten_file(model, write_glb_baked(model), ModelFormat::Gltf));
            }
            Self::Turned => transform_model(&mut other, DAffine3::from_mat3(dice.turn())),
            Self::Scaled => {
                let scale = [1000.0, 0.001, 25.4, 1.0 / 3.0][dice.below(4)];
                transform_model(&mut other, DAffine3::from_scale(DVec3::splat(scale)));
            }
            Self::MovedFar => {
                let shift = dice.direction() * [100.0, 1e4, 1e6][dice.below(3)];
                transform_model(&mut other, DAffine3::from_translation(shift.round()));
            }
            Self::Mirrored => {
                transform_model(
                    &mut other,
                    DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0))),
                );
                changes::reverse_all_faces(&mut other);
            }
            Self::CameraRecord => other.camera = Camera::from_json(&model.camera.to_json()).unwrap(),
            Self::CameraRecordRounded => other.camera = round_camera(&model.camera),
            Self::CameraByAngles => other.camera = camera_by_angles(model)?,
            Self::CameraByName => use_next_named_view(&mut other)?,
            Self::FacesSplit => changes::split_faces(&mut other, dice)?,
            Self::VertexInEdge => changes::insert_edge_vertices(&mut other, true, dice)?,
            Self::VertexInEdgeOneSided => changes::insert_edge_vertices(&mut other, false, dice)?,
            Self::OtherDiagonals => changes::triangulate_faces(&mut other, 1),
            Self::FacesDoubled => changes::duplicate_faces(&mut other, dice),
            Self::FacesWithoutArea => changes::add_degenerate_faces(&mut other, dice),
            Self::GroupPerFace => {
                return Some(rewritten_file(model, write_obj_in_groups(model), ModelFormat::Obj));
            }
            Self::OtherOrder => changes::shuffle_model(&mut other, dice),
            Self::HiddenPart => changes::add_hidden_body(&mut other, dice)?,
            Self::PictureSize => {
                let scale = [0.6, 1.5, 2.3][dice.below(3)];
                let size = other.camera.width * scale;
                other.camera = other.camera.with_frame(size, size);
                return Some(RewrittenFile { scale, ..reference_file(&other) });
            }
        }
        Some(RewrittenFile { is_mirrored: self == Self::Mirrored, ..reference_file(&other) })
    }
}

/// The reference file of a model: OBJ with all digits.
pub(crate) fn reference_file(model: &RandomModel) -> RewrittenFile {
    rewritten_file(model, write_obj(model, Digits::All), ModelFormat::Obj)
}

fn rewritten_file(model: &RandomModel, bytes: Vec<u8>, format: ModelFormat) -> RewrittenFile {
    RewrittenFile { bytes, format, camera: model.camera, is_mirrored: false, scale: 1.0 }
}

/// Transforms model and camera.
fn transform_model(model: &mut RandomModel, by: DAffine3) {
    model.world_from_model = by * model.world_from_model;
    let camera = &mut model.camera;
    camera.eye = by.transform_point3(camera.eye);
    camera.target = by.transform_point3(camera.target);
    camera.up = by.transform_vector3(camera.up).normalize();
    if let Projection::Orthographic { height } = &mut camera.projection {
        *height *= by.transform_vector3(DVec3::X).length();
    }
}

/// A camera rounded to nine decimals.
fn round_camera(camera: &Camera) -> Camera {
    let short = |number: f64| (number * 1e9).round() / 1e9;
    let point = |p: DVec3| DVec3::new(short(p.x), short(p.y), short(p.z));
    let projection = match camera.projection {
        Projection::Orthographic { height } => Projection::Orthographic { height: short(height) },
        same @ Projection::Perspective { .. } => same,
    };
    let (eye, target, up) = (point(camera.eye), point(camera.target), point(camera.up));
    Camera { eye, target, up, projection, ..*camera }
}

/// Azimuth and elevation of a named view, degrees; `None` for views without simple angles.
fn view_angles(view: NamedView) -> Option<(f64, f64)> {
    Some(match view {
        NamedView::Front => (0.0, 0.0),
        NamedView::Right => (90.0, 0.0),
        NamedView::Back => (180.0, 0.0),
        NamedView::Left => (-90.0, 0.0),
        NamedView::Top => (0.0, 90.0),
        NamedView::Bottom => (0.0, -90.0),
        NamedView::Iso => (45.0, 35.264_389_682_754_654),
        _ => return None,
    })
}

/// The camera of a named view, built from its angles.
fn camera_by_angles(model: &RandomModel) -> Option<Camera> {
    let ViewChoice::Named(view) = model.view else { return None };
    let (azimuth, elevation) = view_angles(view)?;
    let camera = Camera::azimuth_elevation(azimuth, elevation, UpAxis::Y);
    Some(camera.with_projection(Projection::Orthographic { height: 1.0 }).fit(&model.scene()))
}

/// Turns the model by a right angle about the vertical, and uses the next named view, which shows the same.
fn use_next_named_view(model: &mut RandomModel) -> Option<()> {
    let ViewChoice::Named(view) = model.view else { return None };
    let next = match view {
        NamedView::Front => NamedView::Right,
        NamedView::Right => NamedView::Back,
        NamedView::Back => NamedView::Left,
        NamedView::Left => NamedView::Front,
        _ => return None,
    };
    model.world_from_model = DAffine3::from_mat3(DMat3::from_cols(DVec3::NEG_Z, DVec3::Y, DVec3::X));
    model.camera = Camera::named(next, UpAxis::Y).fit(&model.scene());
    Some(())
}
