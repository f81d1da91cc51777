//! What was measured of time, as a table, as comma-separated text, as JSON Lines and as pictures.
//!
//! | module | what it makes |
//! |---|---|
//! | [`table`] | headings and cells, aligned for a terminal or separated by commas |
//! | [`json`] | one object a row |
//! | [`pictures`] | fronts of error against time, and time against size |

pub mod json;
pub mod pictures;
pub mod table;
