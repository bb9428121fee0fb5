//! A centrifugal pump with its motor: [`pump_assembly`] places the parts of [`pump_parts`] and
//! [`pump_motor`].

pub mod pump_assembly;
mod pump_motor;
pub mod pump_parts;
