//! [`arrange`]: which view stands where on a sheet, and at which scale.
//!
//! Source: ISO 128-3:2020 and ISO 5456-2:1996: places of views in first- and third-angle projection.

use kurbo::{Point, Rect};

use super::method::Method;
use super::pack::Room;
use super::scales::SERIES;
use super::sight::Sight;
use crate::scene::NamedView;

/// Room between views in a row, and around those that stand alone, mm.
pub(super) const BETWEEN: f64 = 22.0;
const AROUND: f64 = 7.0;

/// Room at the border of the sheet for the lengths of the first views, mm.
const BESIDE: f64 = 9.0;

/// Views without a scale are up to so many times as large as the others, and are made smaller by this factor until they fit.
const LARGEST: f64 = 2.0;
const FREE_STEP: f64 = 0.94;
const FREE_STEPS: i32 = 60;

/// Height of a title above a view.
pub(super) const TITLE: f64 = 8.0;

/// Views that stand alone may be smaller than the others by so many steps of the series.
const SMALLER: usize = 3;

/// A view that is to be put somewhere.
#[derive(Debug)]
pub(super) struct Placed {
    pub sight: Sight,
    pub stands: Stands,
    /// Room that it needs on all sides, mm.
    pub margin: f64,
}

/// Where a view may stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stands {
    /// In the row and column of the front view.
    Beside(NamedView),
    /// Anywhere, at the scale of the sheet, or at a smaller one.
    Alone,
    /// Anywhere, as large as it may be there.
    Free,
    /// Anywhere, at a scale so many times that of the sheet.
    Enlarged(f64),
    /// Anywhere, at that scale.
    At(f64),
}

/// A scale, and those of the series that are a little smaller.
fn smaller(scale: f64, place: usize) -> Vec<f64> {
    [scale].into_iter().chain(SERIES.iter().skip(place + 1).copied().take(SMALLER)).collect()
}

/// The column and the row of a view.
fn field(view: NamedView, method: Method) -> [i32; 2] {
    let towards = if method == Method::First { 1 } else { -1 };
    match view {
        NamedView::Left => [towards, 0],
        NamedView::Right => [-towards, 0],
        NamedView::Top => [0, towards],
        NamedView::Bottom => [0, -towards],
        NamedView::Back => [2, 0],
        _ => [0, 0],
    }
}

/// Puts all views in a space, of which some is taken; `unit_mm` is what a unit of the model is. Gives the scale.
pub(super) fn arrange(
    views: &mut [Placed],
    (space, taken): (Rect, &[Rect]),
    (method, unit_mm, told): (Method, f64, Option<f64>),
) -> Option<f64> {
    let mut room = Room::new(space);
    taken.iter().for_each(|taken| room.take(*taken));
    let told = told.map(|scale| vec![scale]);
    told.as_deref().unwrap_or(&SERIES).iter().copied().find(|scale| {
        let mut room = room.clone();
        try_scale(views, (&mut room, space), method, *scale, unit_mm).is_some()
    })
}

fn try_scale(
    views: &mut [Placed],
    (room, space): (&mut Room, Rect),
    method: Method,
    scale: f64,
    unit_mm: f64,
) -> Option<()> {
    let unit = scale * unit_mm;
    let group = |views: &[Placed]| -> Vec<(usize, [i32; 2])> {
        let of = |(k, placed): (usize, &Placed)| match placed.stands {
            Stands::Beside(view) => Some((k, field(view, method))),
            _ => None,
        };
        views.iter().enumerate().filter_map(of).collect()
    };
    let beside = group(views);
    if !beside.is_empty() {
        // How far views reach from the middle of the model, in each column and row.
        let reach = |line: usize, at: i32| {
            let own = beside.iter().filter(|(_, field)| field[line] == at);
            own.fold(None, |reach: Option<[f64; 2]>, (k, _)| {
                let (low, high) = (views[*k].sight.low * unit, views[*k].sight.high * unit);
                let [before, after] = if line == 0 { [-low.x, high.x] } else { [high.y, -low.y] };
                let [b, a] = reach.unwrap_or([f64::NEG_INFINITY; 2]);
                Some([b.max(before), a.max(after)])
            })
        };
        let mut middles = [Vec::new(), Vec::new()];
        for (line, middles) in middles.iter_mut().enumerate() {
            let mut at = BETWEEN / 2.0 + BESIDE;
            for k in -2..=3 {
                if let Some([before, after]) = reach(line, k) {
                    middles.push((k, at + before));
                    at += before + after + BETWEEN;
                }
            }
        }
        let titled = beside.iter().any(|(k, _)| views[*k].sight.title.is_some());
        let above = if titled { TITLE } else { 0.0 };
        let place = space;
        let mut taken = Vec::new();
        for (k, field) in &beside {
            let middle = |line: usize| {
                middles[line].iter().find(|(at, _)| *at == field[line]).map_or(0.0, |(_, middle)| *middle)
            };
            let sight = &mut views[*k].sight;
            sight.unit = unit;
            sight.corner = Point::new(
                place.x0 + middle(0) + sight.low.x * unit,
                place.y0 + above + middle(1) - sight.high.y * unit,
            );
            let titled = if sight.title.is_some() { TITLE } else { 0.0 };
            let own = sight.rect().inflate(BETWEEN / 2.0, BETWEEN / 2.0);
            taken.push(Rect { y0: own.y0 - titled, ..own });
        }
        // They stand in the upper left corner; what lies in the angle between them is free.
        if !taken.iter().all(|rect| room.has(*rect)) {
            return None;
        }
        taken.into_iter().for_each(|rect| room.take(rect));
    }
    for placed in views.iter_mut() {
        let from = SERIES.iter().position(|own| *own <= scale * (1.0 + 1e-9)).unwrap_or_default();
        let scales: Vec<f64> = match placed.stands {
            Stands::Beside(_) => continue,
            Stands::Enlarged(times) => vec![scale * times],
            Stands::At(scale) => vec![scale],
            Stands::Alone => smaller(scale, from),
            // Nobody measures in it.
            Stands::Free => (0..FREE_STEPS).map(|k| scale * LARGEST * FREE_STEP.powi(k)).collect(),
        };
        let margin = placed.margin + AROUND;
        let title = if placed.sight.title.is_some() { TITLE } else { 0.0 };
        let found = scales.into_iter().find_map(|scale| {
            let [w, h] = placed.sight.size(scale * unit_mm);
            room.put(w + 2.0 * margin, h + 2.0 * margin + title).map(|place| (scale, place))
        });
        let (scale, place) = found?;
        placed.sight.unit = scale * unit_mm;
        placed.sight.corner = Point::new(place.x0 + margin, place.y0 + margin + title);
    }
    Some(())
}
