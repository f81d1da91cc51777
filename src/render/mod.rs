//! Scenes that simulate only the effects they call for: the file, the plan made of it, the run that carries the plan
//! out, and what is measured of the pictures.
//!
//! What never lives here: a technique's mathematics, verdicts on thresholds, printing.
