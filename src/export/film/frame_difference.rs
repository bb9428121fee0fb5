//! The changed rectangle of a frame, compared with the previous one.

use crate::error::Error;
use crate::export::Pixels;

/// A rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ChangedRect {
    pub left: u32,
    pub top: u32,
    pub width: u32,
    pub height: u32,
}

impl ChangedRect {
    /// The whole picture.
    pub(crate) fn whole(pixels: &Pixels) -> Self {
        Self { left: 0, top: 0, width: pixels.width, height: pixels.height }
    }

    /// The part of a frame that differs from the frame before, if there is one.
    ///
    /// # Errors
    /// If the frames differ in size.
    pub(crate) fn since(before: Option<&Pixels>, pixels: &Pixels) -> Result<Self, Error> {
        match before {
            Some(before) if [before.width, before.height] != [pixels.width, pixels.height] => {
                Err(Error::new("a frame has another size than the first"))
            }
            Some(before) => Ok(Self::between(before, pixels)),
            None => Ok(Self::whole(pixels)),
        }
    }

    /// Bounding box of all differing pixels of two pictures of equal size; one pixel if there are none.
    pub(crate) fn between(before: &Pixels, after: &Pixels) -> Self {
        let row = (after.width as usize * 4).max(1);
        let (mut top, mut bottom, mut left, mut right) = (u32::MAX, 0, u32::MAX, 0);
        for (y, (old, new)) in (0_u32..).zip(before.rgba.chunks(row).zip(after.rgba.chunks(row))) {
            if old == new {
                continue;
            }
            (top, bottom) = (top.min(y), y + 1);
            let differs = |(old, new): (&[u8], &[u8])| old != new;
            let mut pairs = old.chunks(4).zip(new.chunks(4));
            left = left.min(pairs.position(differs).unwrap_or_default() as u32);
            let mut pairs = old.chunks(4).zip(new.chunks(4));
            right = right.max(pairs.rposition(differs).unwrap_or_default() as u32 + 1);
        }
        if top == u32::MAX {
            return Self { left: 0, top: 0, width: 1, height: 1 };
        }
        Self { left, top, width: right - left, height: bottom - top }
    }

    /// Bounding box of two rectangles.
    pub(crate) fn around(self, other: Self) -> Self {
        let (left, top) = (self.left.min(other.left), self.top.min(other.top));
        let right = (self.left + self.width).max(other.left + other.width);
        let bottom = (self.top + self.height).max(other.top + other.height);
        Self { left, top, width: right - left, height: bottom - top }
    }

    /// The rectangle extended to even left and top coordinates.
    pub(crate) fn even(self) -> Self {
        let (left, top) = (self.left & !1, self.top & !1);
        Self { left, top, width: self.left + self.width - left, height: self.top + self.height - top }
    }

    /// Rows of the rectangle as bytes.
    pub(crate) fn rows<'a>(&self, pixels: &'a Pixels) -> impl Iterator<Item = &'a [u8]> {
        let Self { left, top, width, height } = *self;
        let row = pixels.width as usize * 4;
        let of = move |y: u32| {
            let from = y as usize * row + left as usize * 4;
            pixels.rgba.get(from..from + width as usize * 4).unwrap_or_default()
        };
        (top..top + height).map(of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_rect_contains_all_different_pixels() {
        let before = Pixels { width: 7, height: 5, rgba: vec![9; 140], dpi: 96.0 };
        let mut after = before.clone();
        assert_eq!(
            ChangedRect::between(&before, &after),
            ChangedRect { left: 0, top: 0, width: 1, height: 1 }
        );
        after.rgba[(7 + 3) * 4 + 1] = 0;
        after.rgba[(3 * 7 + 5) * 4] = 0;
        let changed = ChangedRect::between(&before, &after);
        assert_eq!(changed, ChangedRect { left: 3, top: 1, width: 3, height: 3 });
        assert_eq!(changed.even(), ChangedRect { left: 2, top: 0, width: 4, height: 4 });
        assert_eq!(changed.rows(&after).flatten().filter(|byte| **byte == 0).count(), 2);
        assert_eq!(ChangedRect::whole(&after).rows(&after).flatten().count(), 140);
    }
}
