//! [`AffineFit`]: least-squares affine map between the page and a texture image, fitted to facet corners.
//!
//! Vector formats can only place images by affine maps. A group of facets that one map fits well can
//! therefore be drawn as one image.
//!
//! Page points are in user units, and *places* are points of the image in texels. The sums are additive, so
//! facets can be added to a cluster one by one.

use glam::{DMat2, DVec2};

use crate::images::facets::facet::FacetCorner;
use crate::images::tolerances;

/// Affine map from the page to the texels of an image, and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AffineFit {
    /// Mean of the points on the page, and of their places in the image.
    centre: [DVec2; 2],
    place_from_page: DMat2,
    page_from_place: DMat2,
}

impl AffineFit {
    /// Place in the image that is shown at a point of the page.
    pub(crate) fn place(&self, page: DVec2) -> DVec2 {
        self.centre[1] + self.place_from_page * (page - self.centre[0])
    }

    /// Map from places to the page: its matrix, and the page position of the image's origin.
    pub(crate) fn to_page(self) -> (DMat2, DVec2) {
        (self.page_from_place, self.centre[0] - self.page_from_place * self.centre[1])
    }

    /// Error of the map at a corner: distance on the page, and in texels.
    pub(crate) fn error(&self, corner: &FacetCorner) -> (f64, f64) {
        let off = corner.place - self.place(corner.image.truncate());
        ((self.page_from_place * off).length(), off.length())
    }
}

/// Sums over corners for the normal equations of the map, relative to an origin.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct AffineSums {
    origin: [DVec2; 2],
    count: f64,
    page: DVec2,
    place: DVec2,
    /// Sums of x², xy and y² on the page.
    squares: [f64; 3],
    /// Sums of x·place and y·place.
    products: [DVec2; 2],
}

/// Smallest extent of the points in the image, texels. A narrower extent is widened, so that the map can be
/// inverted. The image shows one colour in that direction anyway.
const MIN_SPAN_TEXELS: f64 = 0.25;

impl AffineSums {
    /// Empty sums with a corner as origin. Small offsets keep the precision of the sums.
    pub(crate) fn about(corner: &FacetCorner) -> Self {
        Self { origin: [corner.image.truncate(), corner.place], ..Self::default() }
    }

    /// Adds a corner.
    pub(crate) fn add(&mut self, corner: &FacetCorner) {
        let (p, t) = (corner.image.truncate() - self.origin[0], corner.place - self.origin[1]);
        self.count += 1.0;
        self.page += p;
        self.place += t;
        self.squares.iter_mut().zip([p.x * p.x, p.x * p.y, p.y * p.y]).for_each(|(sum, term)| *sum += term);
        self.products.iter_mut().zip([t * p.x, t * p.y]).for_each(|(sum, value)| *sum += value);
    }

    /// Solves for the map; `None` if the corners are collinear on the page.
    pub(crate) fn solved(&self) -> Option<AffineFit> {
        let (page, place) = (self.page / self.count, self.place / self.count);
        let n = self.count;
        let (xx, xy, yy) = (
            self.squares[0] - n * page.x * page.x,
            self.squares[1] - n * page.x * page.y,
            self.squares[2] - n * page.y * page.y,
        );
        let determinant = xx * yy - xy * xy;
        if determinant.is_nan() || determinant <= (xx + yy).powi(2) * tolerances::MIN_SPREAD_DETERMINANT_SHARE
        {
            return None;
        }
        let [x, y] = [self.products[0] - place * (n * page.x), self.products[1] - place * (n * page.y)];
        let found = DMat2::from_cols((x * yy - y * xy) / determinant, (y * xx - x * xy) / determinant);
        let extent = ((xx + yy) / n).sqrt() * 2.0;
        let place_from_page = widened(found, MIN_SPAN_TEXELS / extent);
        let inverse = place_from_page.inverse();
        let centre = [page + self.origin[0], place + self.origin[1]];
        inverse.is_finite().then_some(AffineFit { centre, place_from_page, page_from_place: inverse })
    }
}

/// Raises the smaller singular value of a matrix to at least `min_value`.
fn widened(matrix: DMat2, min_value: f64) -> DMat2 {
    // The matrix is the sum of a scaled rotation and a scaled reflection. Their sizes are half the sum and
    // half the difference of the two singular values.
    let [[a, b], [c, d]] = matrix.transpose().to_cols_array_2d();
    let (e, h, f, g) = ((a + d) / 2.0, (c - b) / 2.0, (a - d) / 2.0, (c + b) / 2.0);
    let (turned, mirrored) = ((e * e + h * h).sqrt(), (f * f + g * g).sqrt());
    let (large, small) = (turned + mirrored, turned - mirrored);
    if small.abs() >= min_value {
        return matrix;
    }
    let (large, small) = (large.max(min_value), min_value.copysign(small));
    let (new_turned, new_mirrored) = (f64::midpoint(large, small), (large - small) / 2.0);
    let (e, h) =
        if turned > 0.0 { (e * new_turned / turned, h * new_turned / turned) } else { (new_turned, 0.0) };
    let (f, g) = if mirrored > 0.0 {
        (f * new_mirrored / mirrored, g * new_mirrored / mirrored)
    } else {
        (new_mirrored, 0.0)
    };
    DMat2::from_cols_array_2d(&[[e + f, h + g], [g - h, e - f]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64, y: f64, u: f64, v: f64) -> FacetCorner {
        FacetCorner { image: DVec2::new(x, y).extend(1.0), place: DVec2::new(u, v) }
    }

    fn solved(corners: &[FacetCorner]) -> Option<AffineFit> {
        let mut sums = AffineSums::about(&corners[0]);
        corners.iter().for_each(|corner| sums.add(corner));
        sums.solved()
    }

    #[test]
    fn affine_fit_reproduces_an_affine_map() {
        let affine = |x: f64, y: f64| corner(x, y, 2.0 * x - y + 700.0, 0.5 * y + x - 3.0);
        let map =
            solved(&[affine(1.0, 2.0), affine(30.0, -4.0), affine(9.0, 50.0), affine(3.0, 3.0)]).unwrap();
        let (page, off) = map.error(&affine(500.0, 77.0));
        assert!(page < 1e-9 && off < 1e-9, "{page} {off}");
        let (matrix, origin) = map.to_page();
        let there = matrix * DVec2::new(701.0, -1.5) + origin;
        assert!((there - DVec2::new(1.0, 1.0)).length() < 1e-9, "{there}");
    }

    #[test]
    fn affine_fit_widens_images_collapsed_to_a_line() {
        let line = |x: f64, y: f64| corner(x, y, 5.0 + x, 7.0);
        let corners = [line(0.0, 0.0), line(10.0, 0.0), line(0.0, 10.0)];
        let map = solved(&corners).unwrap();
        let (matrix, _) = map.to_page();
        assert!(matrix.is_finite() && matrix.determinant() != 0.0);
        assert!(corners.iter().all(|corner| map.error(corner).1 < 0.3));
        assert!((map.place(DVec2::new(4.0, 0.0)).x - 9.0).abs() < 0.1);
        assert!(solved(&[line(0.0, 0.0), line(1.0, 1.0), line(2.0, 2.0)]).is_none());
    }

    #[test]
    fn widened_keeps_the_larger_singular_value() {
        let wide = widened(DMat2::from_cols_array(&[3.0, 0.0, 0.0, 0.001]), 0.5);
        assert!((wide.x_axis - DVec2::new(3.0, 0.0)).length() < 1e-12);
        assert!((wide.y_axis - DVec2::new(0.0, 0.5)).length() < 1e-12, "{wide}");
        let mirrored = widened(DMat2::from_cols_array(&[0.0, 2.0, 0.01, 0.0]), 0.1);
        assert!((mirrored.y_axis.length() - 0.1).abs() < 1e-12 && mirrored.determinant() < 0.0);
    }
}
