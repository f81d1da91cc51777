//! The statistics: values by hand, p-values that are uniform on an ideal source, and teeth: a broken source is rejected.

mod autocorrelation;
mod binomial;
mod calibration;
mod chi_square;
mod collisions;
mod correlation;
mod ecdf;
mod fisher_g;
mod gamma_sum;
mod histogram;
mod multiplicity;
mod normal;
mod poisson_binomial;
mod power;
mod seed;
mod sequential;
mod spectrum;
mod two_sample;
mod variance;
