//! [`FreeRectangles`]: the free paper of a sheet, for placing views one after another.
//!
//! Algorithm: maximal rectangles, with the best short side fit.
//!
//! Source: J. Jylänki, "A thousand ways to pack the bin", 2010.

use kurbo::{Point, Rect};

use crate::page::tolerances::POSITION_ROUNDING_MM;

/// Whether a rectangle lies inside another one.
fn holds(outer: Rect, rect: Rect) -> bool {
    outer.inflate(POSITION_ROUNDING_MM, POSITION_ROUNDING_MM).contains_rect(rect)
}

/// The free paper of a sheet as its maximal free rectangles.
#[derive(Debug, Clone)]
pub(crate) struct FreeRectangles {
    free: Vec<Rect>,
}

impl FreeRectangles {
    pub(crate) fn new(space: Rect) -> Self {
        Self { free: vec![space] }
    }

    /// Places a rectangle of the given size in the upper left corner of the tightest free rectangle; `None`
    /// if it fits nowhere.
    pub(crate) fn put(&mut self, width: f64, height: f64) -> Option<Rect> {
        let fits = |rect: &&Rect| rect.width() >= width && rect.height() >= height;
        let left = |rect: &Rect| (rect.width() - width).min(rect.height() - height);
        let best = self.free.iter().filter(fits).min_by(|a, b| {
            left(a).total_cmp(&left(b)).then(a.y0.total_cmp(&b.y0)).then(a.x0.total_cmp(&b.x0))
        })?;
        let place = Rect::from_origin_size(Point::new(best.x0, best.y0), (width, height));
        self.take(place);
        Some(place)
    }

    /// Whether a rectangle is free.
    pub(crate) fn is_free(&self, rect: Rect) -> bool {
        self.free.iter().any(|own| holds(*own, rect))
    }

    /// The largest free rectangle that contains a rectangle.
    pub(crate) fn around(&self, rect: Rect) -> Option<Rect> {
        let places = self.free.iter().filter(|own| holds(**own, rect)).copied();
        places.max_by(|a, b| a.area().total_cmp(&b.area()))
    }

    /// Removes a rectangle from the free paper.
    pub(crate) fn take(&mut self, taken: Rect) {
        let mut left = Vec::new();
        for rect in std::mem::take(&mut self.free) {
            let both = rect.intersect(taken);
            if both.width() <= 0.0 || both.height() <= 0.0 {
                left.push(rect);
                continue;
            }
            left.extend([
                Rect { x1: taken.x0, ..rect },
                Rect { x0: taken.x1, ..rect },
                Rect { y1: taken.y0, ..rect },
                Rect { y0: taken.y1, ..rect },
            ]);
        }
        left.retain(|rect| rect.width() > 1.0 && rect.height() > 1.0);
        let inside = |k: usize, rect: &Rect| {
            left.iter().enumerate().any(|(n, other)| {
                let holds =
                    other.x0 <= rect.x0 && other.y0 <= rect.y0 && other.x1 >= rect.x1 && other.y1 >= rect.y1;
                n != k && holds && (other != rect || n < k)
            })
        };
        let kept: Vec<Rect> =
            left.iter().enumerate().filter(|(k, rect)| !inside(*k, rect)).map(|(_, rect)| *rect).collect();
        self.free = kept;
    }
}
