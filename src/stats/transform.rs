//! The discrete Fourier transform of a block of three axes.

use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlanner};

/// Side of the squares by which a matrix is transposed: two of them fit the first cache.
const TILE: usize = 32;

/// Transforms along all three axes, in the same layout: the first axis is the fastest.
pub(super) fn transform(
    mut field: Vec<Complex64>,
    size: [usize; 3],
    direction: FftDirection,
    planner: &mut FftPlanner<f64>,
) -> Vec<Complex64> {
    let mut turned = vec![Complex64::ZERO; field.len()];
    for n in size {
        planner.plan_fft(n, direction).process(&mut field);
        // The next axis becomes the fastest; after three turns all are where they were.
        transpose(&field, &mut turned, n);
        core::mem::swap(&mut field, &mut turned);
    }
    field
}

/// The three indices of an entry.
pub(super) fn place(at: usize, [nx, ny, _]: [usize; 3]) -> [usize; 3] {
    [at % nx, at / nx % ny, at / (nx * ny)]
}

/// The entry of the opposite lag or frequency.
pub(super) fn opposite(at: usize, size: [usize; 3]) -> usize {
    let [x, y, z] = place(at, size);
    let back = |index: usize, n: usize| if index == 0 { 0 } else { n - index };
    let [nx, ny, nz] = size;
    back(x, nx) + nx * (back(y, ny) + ny * back(z, nz))
}

/// The lag or frequency of an index, in `(-n/2, n/2]`.
pub(super) fn signed(index: usize, n: usize) -> i64 {
    if 2 * index > n { index as i64 - n as i64 } else { index as i64 }
}

/// Transposes a matrix whose rows have `columns` entries.
fn transpose(matrix: &[Complex64], transposed: &mut [Complex64], columns: usize) {
    let rows = matrix.len() / columns;
    for row in (0..rows).step_by(TILE) {
        for column in (0..columns).step_by(TILE) {
            for r in row..rows.min(row + TILE) {
                for c in column..columns.min(column + TILE) {
                    transposed[c * rows + r] = matrix[r * columns + c];
                }
            }
        }
    }
}
