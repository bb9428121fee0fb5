//! Placing: where balloons go so that they cover nothing they should not, are read in their order, and their tails do not cross.
//!
//! Places are tried from the best on, one balloon after another; where the next finds none, the last one moves on. What a place
//! must hold is never weighed against anything: only what is left is compared by cost.

use kurbo::{Point, Rect, Vec2};

use super::figure::Cover;
use super::layout::{Polygon, Reading};

/// Places tried across and down a panel.
const ACROSS: usize = 26;

/// Places looked at, at most, until it is clear that there is no way.
const MOST_LOOKS: usize = 2_000;

/// From the tip of a tail to what it points at, in gaps.
const SHORT_OF: f64 = 0.6;

/// How many mm of a longer way a balloon that covers models wholly is worth.
const COVERING: f64 = 40.0;

/// A balloon that wants a place.
#[derive(Debug, Clone)]
pub struct Wish {
    /// Around it, its middle at 0, 0.
    pub hull: Polygon,
    /// What its tail points at, and towards which point of it.
    pub target: Option<(Polygon, Point)>,
    /// How long its tail is at least.
    pub tail: f64,
    /// Half the width of its tail where it begins.
    pub foot: f64,
    /// Where it is told to be.
    pub at: Option<Point>,
    /// Whether it stands in the corner where reading begins, or near to it.
    pub cornered: bool,
}

/// Where balloons may be.
#[derive(Debug, Clone)]
pub struct Room {
    /// Within this.
    pub outline: Polygon,
    /// On none of these; tails may reach them.
    pub kept: Vec<Polygon>,
    /// On none of these, and with no tail over them.
    pub obstacles: Vec<Polygon>,
    /// What of the panel models cover; balloons stay on what is free if they can.
    pub cover: Option<Cover>,
    /// From one to the other, at least.
    pub gap: f64,
    /// In which direction they are read.
    pub reading: Reading,
}

/// A balloon in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its middle.
    pub middle: Point,
    /// Where its tail ends.
    pub tip: Option<Point>,
    /// Around it.
    pub hull: Polygon,
}

impl Placed {
    /// Around its tail, from the middle to the tip, with room for a bend.
    fn tail(&self, foot: f64) -> Option<Polygon> {
        let tip = self.tip?;
        let way = tip - self.middle;
        let across = Vec2::new(-way.y, way.x).normalize();
        let (wide, narrow) = (across * (foot + BEND * way.hypot()), across * (0.3 * foot));
        Some(Polygon(vec![self.middle - wide, tip - narrow, tip + narrow, self.middle + wide]))
    }
}

/// How far tails bend aside, in shares of their length.
const BEND: f64 = 0.03;

/// A place of one balloon that holds whatever becomes of the others.
struct Candidate {
    place: Placed,
    tail: Option<Polygon>,
    /// Around the balloon and its tail.
    bounds: Rect,
    cost: f64,
}

/// Places for all balloons, in their order.
///
/// # Errors
/// Which of them found none.
pub fn place(wishes: &[Wish], room: &Room) -> Result<Vec<Placed>, usize> {
    let all: Vec<Vec<Candidate>> = wishes.iter().map(|wish| candidates(wish, room)).collect();
    if let Some(none) = all.iter().position(Vec::is_empty) {
        return Err(none);
    }
    let (mut placed, mut looks, mut farthest) = (Vec::new(), 0, 0);
    if next((wishes, &all), room, &mut placed, &mut looks, &mut farthest) {
        return Ok(placed.into_iter().map(|candidate| candidate.place.clone()).collect());
    }
    Err(farthest)
}

/// The places of a balloon by itself, the best first.
fn candidates(wish: &Wish, room: &Room) -> Vec<Candidate> {
    let mut found = Vec::new();
    for middle in middles(wish, room) {
        let hull = wish.hull.moved(middle.to_vec2());
        if wish.at.is_none() && !hull.0.iter().all(|p| room.outline.holds(*p)) {
            continue;
        }
        let tip = match &wish.target {
            None => None,
            Some((target, aim)) => match tip(middle, &hull, (target, *aim), wish.tail, room.gap) {
                Some(tip) => Some(tip),
                None => continue,
            },
        };
        let place = Placed { middle, tip, hull };
        let tail = place.tail(wish.foot);
        if wish.at.is_some() || is_free(&place, tail.as_ref(), wish, room) {
            let own = place.hull.bounds();
            let bounds = tail.as_ref().map_or(own, |tail| own.union(tail.bounds()));
            let cost = cost(&place, wish, room);
            found.push(Candidate { place, tail, bounds, cost });
        }
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found
}

fn next<'a>(
    (wishes, all): (&[Wish], &'a [Vec<Candidate>]),
    room: &Room,
    placed: &mut Vec<&'a Candidate>,
    looks: &mut usize,
    farthest: &mut usize,
) -> bool {
    let (Some(wish), Some(candidates)) = (wishes.get(placed.len()), all.get(placed.len())) else {
        return true;
    };
    *farthest = placed.len().max(*farthest);
    for own in candidates {
        if !placed.iter().all(|before| goes_with(own, before, wish.at.is_some(), room)) {
            continue;
        }
        *looks += 1;
        if *looks > MOST_LOOKS {
            return false;
        }
        placed.push(own);
        if next((wishes, all), room, placed, looks, farthest) {
            return true;
        }
        placed.pop();
    }
    false
}

/// Where its middle may be.
fn middles(wish: &Wish, room: &Room) -> Vec<Point> {
    if let Some(at) = wish.at {
        return vec![at];
    }
    let (bounds, own) = (room.outline.bounds(), wish.hull.bounds());
    let free = Vec2::new(bounds.width() - own.width(), bounds.height() - own.height());
    if free.x < 0.0 || free.y < 0.0 {
        return Vec::new();
    }
    let from = Point::new(bounds.x0 - own.x0, bounds.y0 - own.y0);
    let step = free / (ACROSS - 1) as f64;
    let places = (0..ACROSS * ACROSS).map(|k| (k % ACROSS, k / ACROSS));
    places.map(|(x, y)| from + Vec2::new(x as f64 * step.x, y as f64 * step.y)).collect()
}

/// Where a tail ends: a little before it reaches what it points at.
fn tip(
    middle: Point,
    hull: &Polygon,
    (target, aim): (&Polygon, Point),
    shortest: f64,
    gap: f64,
) -> Option<Point> {
    let way = aim - middle;
    let length = way.hypot();
    if length < 1e-9 {
        return None;
    }
    let way = way / length;
    let enters = enters(target, middle, aim).unwrap_or(length);
    let leaves = leaves(hull, middle, aim);
    // From within a large part the tail leads to the point itself.
    let end = if target.holds(middle) { length } else { enters } - gap * SHORT_OF;
    (end >= leaves + shortest).then(|| middle + way * end)
}

/// How far it is from a point to where the way to another one enters a polygon.
fn enters(polygon: &Polygon, from: Point, to: Point) -> Option<f64> {
    crossings(polygon, from, to).reduce(f64::min)
}

/// How far it is from a point within a polygon to where the way to another one leaves it.
fn leaves(polygon: &Polygon, from: Point, to: Point) -> f64 {
    crossings(polygon, from, to).fold(0.0, f64::max)
}

fn crossings(polygon: &Polygon, from: Point, to: Point) -> impl Iterator<Item = f64> + '_ {
    let way = to - from;
    polygon.sides().filter_map(move |(a, b)| {
        let side = b - a;
        let area = way.cross(side);
        let (along, across) = ((a - from).cross(side) / area, (a - from).cross(way) / area);
        let is_there = area != 0.0 && (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across);
        is_there.then(|| along * way.hypot())
    })
}

/// Whether a tail keeps off a polygon.
fn is_clear(tail: Option<&Polygon>, other: &Polygon) -> bool {
    tail.is_none_or(|tail| !tail.meets(other, 0.0))
}

/// Whether a balloon covers nothing that is kept, and its tail runs over nothing but what it points at.
fn is_free(own: &Placed, tail: Option<&Polygon>, wish: &Wish, room: &Room) -> bool {
    let free = |other: &Polygon| !own.hull.meets(other, room.gap);
    let is_own = |other: &Polygon| wish.target.as_ref().is_some_and(|(target, _)| target == other);
    room.kept.iter().all(|other| free(other) && (is_own(other) || is_clear(tail, other)))
        && room.obstacles.iter().all(|other| free(other) && is_clear(tail, other))
}

/// Whether a balloon may be where it is beside one before it.
fn goes_with(own: &Candidate, before: &Candidate, told: bool, room: &Room) -> bool {
    let is_read = told || is_read_after(&own.place, &before.place, room.reading);
    let apart = own.bounds.inset(room.gap).intersect(before.bounds).is_zero_area();
    let keeps_off = || {
        let (hull, other) = (&own.place.hull, &before.place.hull);
        !hull.meets(other, room.gap)
            && is_clear(own.tail.as_ref(), other)
            && is_clear(before.tail.as_ref(), hull)
            && before.tail.as_ref().is_none_or(|other| is_clear(own.tail.as_ref(), other))
    };
    is_read && (apart || keeps_off())
}

/// Whether one is read after the other: below its middle, or beside it on the side that is read later and no higher.
fn is_read_after(own: &Placed, before: &Placed, reading: Reading) -> bool {
    let (mine, other) = (own.hull.bounds(), before.hull.bounds());
    let beside = match reading {
        Reading::Ltr => mine.x0 >= other.center().x,
        Reading::Rtl => mine.x1 <= other.center().x,
    };
    (mine.y0 >= other.center().y) || (beside && mine.center().y >= other.center().y - 0.15 * other.height())
}

/// How bad a place is: far from what speaks, low, late in its line, and on what models cover.
fn cost(own: &Placed, wish: &Wish, room: &Room) -> f64 {
    let bounds = room.outline.bounds();
    let down = own.hull.bounds().y0 - bounds.y0;
    let late = match room.reading {
        Reading::Ltr => own.hull.bounds().x0 - bounds.x0,
        Reading::Rtl => bounds.x1 - own.hull.bounds().x1,
    };
    let covers = COVERING * room.cover.as_ref().map_or(0.0, |cover| cover.share(own.hull.bounds()));
    if wish.cornered {
        return 2.0 * down + late + 0.3 * covers;
    }
    let tail = own.tip.map_or(0.0, |tip| tip.distance(own.middle));
    // Steep tails read better than flat ones.
    let flat = own.tip.map_or(0.0, |tip| (tip.x - own.middle.x).abs());
    0.6 * tail + 0.35 * flat + 0.35 * down + 0.12 * late + covers
}
