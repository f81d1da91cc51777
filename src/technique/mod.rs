//! What the sources compare with or build upon the hashed threshold: one file a technique, pure functions over numbers.
//!
//! Each file cites its source, computes literally what that says, and tests the sentence that the source says of it.
//!
//! What never lives here: scenes, pictures, files, statistics.
