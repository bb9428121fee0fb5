//! What is asked of places, and what is found: [`Wish`], [`Room`] and [`Placed`].

use kurbo::Point;

use crate::page::figure::Cover;
use crate::page::layout::{Polygon, Reading};

/// A balloon that wants a place.
#[derive(Debug, Clone)]
pub struct Wish {
    /// The shapes that it may have, the best first; of each a polygon around it, its middle at 0, 0.
    pub hulls: Vec<Polygon>,
    /// What its tail points at, and towards which point of it.
    pub target: Option<(Polygon, Point)>,
    /// The em of its letters.
    pub em: f64,
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
    /// Which of its shapes it has.
    pub shape: usize,
    /// Its middle.
    pub middle: Point,
    /// Where its tail ends.
    pub tip: Option<Point>,
    /// Around it.
    pub hull: Polygon,
}
