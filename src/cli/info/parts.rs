//! [`PartInfo`]: contents and precision of a part.

use serde::Serialize;

use super::lists::named;
use super::precision::PrecisionInfo;
use crate::cli::number::counted;
use crate::mesh::TurnedFaces;
use crate::scene::Scene;
use crate::scene::drawn_points::LeftOut;

/// Contents and precision of a part.
#[derive(Debug, Serialize)]
pub(super) struct PartInfo {
    pub name: String,
    pub triangles: u64,
    pub wires: u64,
    /// Whether the file says where pictures lie on it.
    pub texture_coordinates: bool,
    /// Whether its vertices are painted.
    pub vertex_colours: bool,
    pub turned: TurnedInfo,
    #[serde(flatten)]
    pub precision: PrecisionInfo,
}

/// How many triangles are turned, and in how many connected surfaces.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(super) struct TurnedInfo {
    pub triangles: u64,
    pub surfaces: u64,
}

impl PartInfo {
    /// Describes a part of a scene, without elements that are left out of it; none for a number that no part has.
    pub fn of(
        scene: &Scene,
        number: usize,
        left_out: &LeftOut,
        turned: &[TurnedFaces],
        precision: PrecisionInfo,
    ) -> Option<Self> {
        let part = scene.parts.get(number)?;
        let geometry = scene.geometries.get(part.geometry);
        let triangles = geometry.map_or(0, |geometry| geometry.triangles.len() as u64);
        let wires = geometry.map_or(0, |geometry| geometry.wires.len() as u64);
        let turned = turned.iter().filter(|own| own.part.index() == number);
        Some(Self {
            name: part.name.clone(),
            triangles: triangles - left_out.faces,
            wires: wires - left_out.wires,
            texture_coordinates: geometry.is_some_and(|geometry| !geometry.corner_uvs.is_empty()),
            vertex_colours: geometry.is_some_and(|geometry| !geometry.colours.is_empty()),
            turned: TurnedInfo::of(turned),
            precision,
        })
    }

    /// The part's entry in the list for people, with its precision or without.
    pub fn line(&self, has_precision: bool) -> String {
        let lines = if self.wires > 0 { format!(", {}", counted(self.wires, "line")) } else { String::new() };
        let painted = match (self.texture_coordinates, self.vertex_colours) {
            (true, true) => ", texture coordinates, coloured vertices",
            (true, false) => ", texture coordinates",
            (false, true) => ", coloured vertices",
            (false, false) => "",
        };
        let turned = self.turned.words().map_or_else(String::new, |turned| format!(", {turned}"));
        let precision = self.precision.words().filter(|_| has_precision);
        let precision = precision.map_or_else(String::new, |words| format!(", {words}"));
        let triangles = counted(self.triangles, "triangle");
        format!("{}: {triangles}{lines}{painted}{turned}{precision}", named(&self.name))
    }
}

impl TurnedInfo {
    /// The counts of some parts together.
    pub fn of<'a>(parts: impl IntoIterator<Item = &'a TurnedFaces>) -> Self {
        parts.into_iter().fold(Self::default(), |sum, own| Self {
            triangles: sum.triangles + own.faces,
            surfaces: sum.surfaces + own.surfaces,
        })
    }

    /// The counts, for people; none if nothing is turned.
    pub fn words(&self) -> Option<String> {
        let Self { triangles, surfaces } = *self;
        let is_any = triangles > 0;
        is_any
            .then(|| format!("{} turned in {}", counted(triangles, "triangle"), counted(surfaces, "surface")))
    }
}
