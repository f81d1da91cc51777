//! What was measured of time, as a table, as comma-separated text, as JSON Lines and as pictures.
//!
//! | module | what it makes |
//! |---|---|
//! | [`table`] | headings and cells, aligned for a terminal or separated by commas |
//! | [`json`] | one object a row |
//! | [`page`] | a table within a page |
//! | [`pictures`] | fronts of error against time, and time against size |

pub mod json;
pub mod page;
pub mod pictures;
pub mod table;
