//! [`ModelInfo`]: contents and defects of a model file.

use serde::Serialize;

use super::degenerate_elements::{self, LeftOutInfo};
use super::info_args::InfoArgs;
use super::joints::{self, JointInfo};
use super::lights_cameras_clips::{CameraInfo, ClipInfo, LightInfo};
use super::materials::MaterialInfo;
use super::parts::{BoundsInfo, PartInfo, TurnedInfo};
use super::precision;
use crate::animation::Rig;
use crate::cli::library_calls;
use crate::cli::options::values::model_unit::{self, ModelUnit};
use crate::cli::request::model_hints;
use crate::scene::extent::coordinate_limits::bounds;
use crate::scene::extent::drawn_points::{DrawnPoints, used_points};
use crate::scene::{Geometry, Scene, UpAxis};

/// Contents and defects of a model file.
#[derive(Debug, Serialize)]
pub(crate) struct ModelInfo {
    pub file: String,
    pub format: &'static str,
    pub up: &'static str,
    pub triangles: u64,
    /// Stored vertices that are drawn, with each instance counted.
    pub vertices: u64,
    /// Triangles that are wound inward or against their neighbours in the file. They are turned before
    /// drawing.
    pub turned: TurnedInfo,
    pub parts: Vec<PartInfo>,
    pub materials: Vec<MaterialInfo>,
    pub lights: Vec<LightInfo>,
    pub cameras: Vec<CameraInfo>,
    pub joints: Vec<JointInfo>,
    pub animations: Vec<ClipInfo>,
    pub bounds: Option<BoundsInfo>,
    /// Faces without area and lines without length, by part. All other counts exclude them.
    pub left_out: Vec<LeftOutInfo>,
    /// Vertices that no face or line uses.
    pub unused_vertices: u64,
    /// Unit of the model, if the format or an option defines it.
    pub unit: Option<&'static str>,
    pub warnings: Vec<String>,
    /// Hints, each with the option that helps.
    pub notes: Vec<String>,
}

impl ModelInfo {
    /// Collects contents and defects of a scene.
    pub(crate) fn of(scene: &Scene, rig: &Rig, args: &InfoArgs) -> Self {
        let DrawnPoints { points, parts: drawn } = DrawnPoints::of(scene);
        let unused = |geometry: &Geometry| (geometry.positions.len() - used_points(geometry).len()) as u64;
        let unused_vertices = scene.unused_vertices + scene.geometries.iter().map(unused).sum::<u64>();
        let left_out = degenerate_elements::by_part(scene, &drawn);
        let mut boxes = vec![None; scene.parts.len()];
        for drawn_part in &drawn {
            if let (Some(slot), Some(part_points)) =
                (boxes.get_mut(drawn_part.part), points.get(drawn_part.points.clone()))
            {
                *slot = bounds(part_points);
            }
        }
        let (of_mesh, mesh) = library_calls::mesh_findings(scene);
        let parts: Vec<PartInfo> = left_out
            .iter()
            .zip(precision::by_part(scene, &mesh))
            .zip(boxes)
            .enumerate()
            .filter_map(|(part, ((left_out, precision), bounds))| {
                PartInfo::of(scene, part, left_out, &mesh.turned, precision, bounds)
            })
            .collect();
        let left_out = LeftOutInfo::of(scene, &left_out);
        let mut warnings = scene.warnings.clone();
        warnings.extend(&of_mesh);
        let mut warnings = warnings.lines();
        let bounds = bounds(&points);
        let unit =
            (args.unit.is_some() || model_unit::is_stated(scene)).then(|| ModelUnit::of(scene, args.unit));
        if let Some((min, max)) = bounds.filter(|_| args.unit.is_none()) {
            warnings.extend(model_unit::implausible_size(scene, (max - min).max_element()));
        }
        Self {
            file: args.model.display().to_string(),
            format: scene.format,
            up: match scene.up {
                UpAxis::Y => "y",
                UpAxis::Z => "z",
            },
            triangles: parts.iter().map(|part| part.triangles).sum(),
            vertices: points.len() as u64,
            turned: TurnedInfo::of(&mesh.turned),
            parts,
            materials: scene.materials.iter().map(|material| MaterialInfo::of(scene, material)).collect(),
            lights: scene.lights.iter().map(LightInfo::of).collect(),
            cameras: scene.cameras.iter().map(CameraInfo::of).collect(),
            animations: rig.clips.iter().map(ClipInfo::of).collect(),
            joints: joints::of_rig(rig),
            bounds: bounds.map(|bounds| BoundsInfo::new(bounds, unit)),
            left_out,
            unused_vertices,
            unit: unit.map(ModelUnit::name),
            warnings,
            notes: model_hints::of_scene(scene).into_iter().map(|hint| hint.text).collect(),
        }
    }
}
