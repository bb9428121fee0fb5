//! Machines and machine parts: turned, bevelled and toothed shapes, and assemblies of many parts.
//!
//! Single parts: [`gear`], [`bracket`], [`elbow`], [`bevels`], [`shaft`], [`drum`]. Assemblies: [`pump`],
//! [`drive`], with the paints and turns of [`workshop`]. Vehicles and cranes: [`biplane`], [`crane`].

pub mod bevels;
pub mod biplane;
pub mod bracket;
pub mod crane;
pub mod drive;
pub mod drum;
pub mod elbow;
pub mod gear;
pub mod pump;
pub mod shaft;
mod workshop;
