//! Rasterised drawings, whole or in a small window.

use resvg::tiny_skia::{Pixmap, PremultipliedColorU8, Rect, Transform};

use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::picture::Picture;
use crate::export::raster::tree_painter::{PaintOverride, TreePainter};
use crate::geometry::tolerances::F32_STEP;

/// A drawing and the aspects to ignore.
pub(crate) struct Canvas<'a> {
    picture: &'a Picture,
    ignore: Ignore,
}

/// A square window of a drawing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CanvasWindow {
    /// Upper left corner in px.
    pub x: f64,
    pub y: f64,
    /// Side in pixels.
    pub size: usize,
    /// Pixels per px.
    pub scale: f64,
}

impl<'a> Canvas<'a> {
    pub(crate) fn new(picture: &'a Picture, ignore: Ignore) -> Self {
        Self { picture, ignore }
    }

    /// Rasterises the whole drawing with anti-aliasing.
    pub(crate) fn coarse(
        &self,
        columns: usize,
        rows: usize,
        scale: f64,
    ) -> Option<Vec<PremultipliedColorU8>> {
        let mut pixmap = Pixmap::new(u32::try_from(columns).ok()?, u32::try_from(rows).ok()?)?;
        let to = Transform::from_scale(scale as f32, scale as f32);
        self.paint(
            TreePainter { precise: true, ..TreePainter::default() },
            self.picture.drawn.smooth(),
            to,
            &mut pixmap,
        );
        Some(pixmap.pixels().to_vec())
    }

    /// Rasterises a window without anti-aliasing: each pixel is covered completely or not at all.
    pub(crate) fn spot(&self, spot: CanvasWindow) -> Option<Vec<PremultipliedColorU8>> {
        let size = u32::try_from(spot.size).ok()?;
        let mut pixmap = Pixmap::new(size, size)?;
        let side = spot.size as f64 / spot.scale;
        // The bounding boxes used for culling are in single precision.
        let slack = 2.0 / spot.scale + (spot.x.abs() + spot.y.abs() + side) * F32_STEP * 4.0;
        let window = Rect::from_ltrb(
            (spot.x - slack) as f32,
            (spot.y - slack) as f32,
            (spot.x + side + slack) as f32,
            (spot.y + side + slack) as f32,
        )?;
        let painter = TreePainter { window: Some(window), crisp: true, ..TreePainter::default() };
        let scale = spot.scale as f32;
        let to = Transform::from_row(
            scale,
            0.0,
            0.0,
            scale,
            (-spot.x * spot.scale) as f32,
            (-spot.y * spot.scale) as f32,
        );
        self.paint(painter, self.picture.drawn.crisp(), to, &mut pixmap);
        Some(pixmap.pixels().to_vec())
    }

    /// Paints the drawing without the ignored aspects.
    fn paint(&self, painter: TreePainter, tree: &usvg::Tree, to: Transform, pixmap: &mut Pixmap) {
        let Ignore { colours, widths, text, .. } = self.ignore;
        if !(colours || widths || text) {
            painter.nodes(tree.root(), to, &mut pixmap.as_mut());
            return;
        }
        let look = |path: &usvg::Path| match self.picture.drawn.stand_in(path.id()) {
            Some(is_text) if is_text && text => PaintOverride::Absent,
            Some(_) => PaintOverride::Own,
            None if colours || widths => PaintOverride::Plain { black: colours, thin: widths },
            None => PaintOverride::Own,
        };
        let painter = TreePainter { override_of_path: Some(&look), plain: colours, ..painter };
        painter.nodes(tree.root(), to, &mut pixmap.as_mut());
    }
}
