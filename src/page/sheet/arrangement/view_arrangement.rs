//! [`arrange`]: which view stands where on a sheet, and at which scale.
//!
//! Source: ISO 128-3:2020 and ISO 5456-2:1996: places of views in first- and third-angle projection.

use kurbo::{Point, Rect};

use super::free_rectangles::Room;
use crate::geometry::numbers::portable_math::ln;
use crate::page::sheet::annotations::Board;
use crate::page::sheet::view::projection_method::Method;
use crate::page::sheet::view::scale_series::SERIES;
use crate::page::sheet::view::sheet_view::Sight;
use crate::scene::NamedView;

/// Least room around a view, mm.
pub(crate) const AROUND: f64 = 7.0;

/// How far views start from the border of the room where centring marks are in their way, mm.
const PAST_MARKS: f64 = 9.0;

/// From what is written on a view to the border of its place, mm.
pub(crate) const ELEMENTS_CLEAR: f64 = 3.0;

/// Views without a scale are up to so many times as large as the others, and are made smaller by this factor until they fit.
const LARGEST: f64 = 4.0;
const FREE_STEP: f64 = 0.94;
const FREE_STEPS: i32 = 72;

/// Views that stand alone may be smaller than the others by so many steps of the series.
const SMALLER: usize = 3;

/// A view that is to be put somewhere.
#[derive(Debug)]
pub(crate) struct Placed {
    pub sight: Sight,
    pub stands: Stands,
    /// Room that it needs for what is written on it, more than its margin, on the left, above, on the right and below, mm: at the lengths
    /// on paper of a unit at which that is known.
    pub rooms: Vec<(f64, [f64; 4])>,
    /// The place that it has with all that, on the page.
    place: Rect,
}

impl Placed {
    /// A view that needs no room but its own.
    pub fn new(sight: Sight, stands: Stands) -> Self {
        Self { sight, stands, rooms: Vec::new(), place: Rect::ZERO }
    }
}

impl Placed {
    /// The room around it at a length on paper of a unit of the model. At a scale at which it is not known there is none yet; of pictorial
    /// views, which have any scale, it is that found last.
    pub fn around_at(&self, unit: f64) -> [f64; 4] {
        let known = self.rooms.iter().find(|(known, _)| (known / unit - 1.0).abs() < 1e-9);
        if let Some((_, around)) = known {
            return *around;
        }
        let last = self.rooms.last().filter(|_| self.stands.largest(unit).is_some());
        last.map_or([0.0; 4], |(_, around)| *around)
    }

    /// Notes that at its present scale it needs that much room.
    pub fn make_room(&mut self, needed: [f64; 4]) {
        let unit = self.sight.unit;
        let own = self.around_at(unit);
        self.rooms.retain(|(known, _)| (known / unit - 1.0).abs() >= 1e-9);
        self.rooms.push((unit, [0, 1, 2, 3].map(|side| own[side].max(needed[side]))));
    }

    /// Makes it larger or smaller around its middle.
    pub fn enlarge(&mut self, from: f64, to: f64) {
        let ([w, h], [wide, high]) = (self.sight.size(from), self.sight.size(to));
        self.sight.unit = to;
        self.sight.corner += kurbo::Vec2::new((w - wide) / 2.0, (h - high) / 2.0);
    }

    /// Whether it, and what is written on it, lie within its place.
    pub fn has_room_for(&self, board: &Board) -> bool {
        let rect = self.sight.rect();
        let extents = board.extents().map_or(rect, |extents| extents.union(rect));
        let own = self.place.inflate(1e-6 - ELEMENTS_CLEAR, 1e-6 - ELEMENTS_CLEAR);
        own.contains_rect(extents) && board.unplaced.is_empty()
    }
}

/// Where a view may stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stands {
    /// In the row and column of the front view.
    Beside(NamedView),
    /// Anywhere, at the scale of the sheet, or at a smaller one.
    Alone,
    /// Anywhere, at the scale of the sheet, or as large as it may be there: nobody measures in it.
    Pictorial,
    /// Anywhere, as large as it may be there.
    Free,
    /// Anywhere, at a scale so many times that of the sheet.
    Enlarged(f64),
    /// Anywhere, at that scale.
    At(f64),
}

impl Stands {
    /// The largest length on paper of a unit that it may have in views that are not measured.
    pub fn largest(self, unit: f64) -> Option<f64> {
        match self {
            Self::Pictorial | Self::Free => Some(unit * LARGEST),
            _ => None,
        }
    }
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

/// Puts all views in a space, of which some is taken; `unit_mm` is what a unit of the model is. Gives the scale: of the two largest at which
/// everything fits the one at which views together are larger.
pub(crate) fn arrange(
    views: &mut [Placed],
    (space, taken): (Rect, &[Rect]),
    (method, unit_mm, told): (Method, f64, Option<f64>),
) -> Option<f64> {
    let mut room = Room::new(space);
    taken.iter().for_each(|taken| room.take(*taken));
    let told = told.map(|scale| vec![scale]);
    let alone: Vec<usize> =
        (0..views.len()).filter(|k| !matches!(views[*k].stands, Stands::Beside(_))).collect();
    let orders = orders(&alone);
    let mut best: Option<(f64, f64, &Vec<usize>)> = None;
    let mut fitting = 0;
    for scale in told.as_deref().unwrap_or(&SERIES) {
        let mut fits = false;
        for order in &orders {
            let mut room = room.clone();
            if try_scale(views, (&mut room, space), (method, *scale, unit_mm), order).is_none() {
                continue;
            }
            fits = true;
            let size: f64 = views.iter().map(|placed| ln(placed.sight.unit)).sum();
            if best.is_none_or(|(known, ..)| size > known + 1e-9) {
                best = Some((size, *scale, order));
            }
        }
        fitting += usize::from(fits);
        if fitting == 2 {
            break;
        }
    }
    let (_, scale, order) = best?;
    let free = room.clone();
    try_scale(views, (&mut room, space), (method, scale, unit_mm), order)?;
    settle(views, &free, order);
    Some(scale)
}

/// Moves views that stand alone to the middle of the room that others leave around them.
fn settle(views: &mut [Placed], free: &Room, order: &[usize]) {
    for k in order {
        let mut room = free.clone();
        let others = views.iter().enumerate().filter(|(other, _)| other != k);
        others.for_each(|(_, placed)| room.take(placed.place));
        let own = views[*k].place;
        if let Some(around) = room.around(own) {
            let shift = around.center() - own.center();
            views[*k].place = own + shift;
            views[*k].sight.corner += shift;
        }
    }
}

/// The orders in which views may be put in places; that in which they are told first, and no others where there are many.
fn orders(views: &[usize]) -> Vec<Vec<usize>> {
    const MOST: usize = 5;
    let Some((first, rest)) = views.split_first().filter(|_| views.len() <= MOST) else {
        return vec![views.to_vec()];
    };
    let mut all = Vec::new();
    for order in orders(rest) {
        for at in 0..=order.len() {
            let mut order = order.clone();
            order.insert(at, *first);
            all.push(order);
        }
    }
    all.sort();
    all
}

fn try_scale(
    views: &mut [Placed],
    (room, space): (&mut Room, Rect),
    (method, scale, unit_mm): (Method, f64, f64),
    order: &[usize],
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
                let around = views[*k].around_at(unit);
                let [before, after] = if line == 0 {
                    [around[0] - low.x, high.x + around[2]]
                } else {
                    [around[1] + high.y, around[3] - low.y]
                };
                let [b, a] = reach.unwrap_or([f64::NEG_INFINITY; 2]);
                Some([b.max(before), a.max(after)])
            })
        };
        let mut middles = [Vec::new(), Vec::new()];
        for (line, middles) in middles.iter_mut().enumerate() {
            let mut at = AROUND;
            for k in -2..=3 {
                if let Some([before, after]) = reach(line, k) {
                    middles.push((k, at + before));
                    at += before + after + 2.0 * AROUND;
                }
            }
        }
        // The place of a view with all that is written on it, and the corner of the view.
        let place = |placed: &Placed, field: [i32; 2], start: [f64; 2]| {
            let middle = |line: usize| {
                let found = middles[line].iter().find(|(at, _)| *at == field[line]);
                start[line] + found.map_or(0.0, |(_, middle)| *middle)
            };
            let sight = &placed.sight;
            let corner = Point::new(
                space.x0 + middle(0) + sight.low.x * unit,
                space.y0 + middle(1) - sight.high.y * unit,
            );
            let [w, h] = sight.size(unit);
            let [left, above, right, below] = placed.around_at(unit).map(|room| AROUND + room);
            let (x1, y1) = (corner.x + w + right, corner.y + h + below);
            (Rect { x0: corner.x - left, y0: corner.y - above, x1, y1 }, corner)
        };
        // They stand in the upper left corner, within the centring marks or past them; what lies in the angle between them is free.
        let starts = [[0.0, 0.0], [0.0, PAST_MARKS], [PAST_MARKS, 0.0], [PAST_MARKS, PAST_MARKS]];
        let fits =
            |start: &[f64; 2]| beside.iter().all(|(k, field)| room.has(place(&views[*k], *field, *start).0));
        let start = starts.into_iter().find(fits)?;
        for (k, field) in &beside {
            let (place, corner) = place(&views[*k], *field, start);
            let placed = &mut views[*k];
            (placed.place, placed.sight.unit, placed.sight.corner) = (place, unit, corner);
            room.take(place);
        }
    }
    for k in order {
        let placed = &mut views[*k];
        let from = SERIES.iter().position(|own| *own <= scale * (1.0 + 1e-9)).unwrap_or_default();
        let scales: Vec<f64> = match placed.stands {
            Stands::Beside(_) => continue,
            Stands::Enlarged(times) => vec![scale * times],
            Stands::At(scale) => vec![scale],
            Stands::Alone => smaller(scale, from),
            Stands::Pictorial => (0..FREE_STEPS).map(|k| scale * FREE_STEP.powi(k)).collect(),
            Stands::Free => (0..FREE_STEPS).map(|k| scale * LARGEST * FREE_STEP.powi(k)).collect(),
        };
        let found = scales.into_iter().find_map(|scale| {
            let [w, h] = placed.sight.size(scale * unit_mm);
            let [left, above, right, below] = placed.around_at(scale * unit_mm);
            room.put(w + 2.0 * AROUND + left + right, h + 2.0 * AROUND + above + below)
                .map(|place| (scale, place))
        });
        let (scale, place) = found?;
        let [left, above, ..] = placed.around_at(scale * unit_mm);
        placed.place = place;
        placed.sight.unit = scale * unit_mm;
        placed.sight.corner = Point::new(place.x0 + AROUND + left, place.y0 + AROUND + above);
    }
    Some(())
}
