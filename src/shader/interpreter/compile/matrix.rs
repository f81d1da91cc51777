//! Matrices, column by column.

use super::super::error::Unsupported;
use super::super::op::Register;
use super::{Compiler, Value};
use naga::TypeInner;

type Result<T> = core::result::Result<T, Unsupported>;

/// Columns and rows of a matrix.
fn dimensions(ty: &TypeInner) -> Option<(usize, usize)> {
    match *ty {
        TypeInner::Matrix { columns, rows, .. } => Some((columns as usize, rows as usize)),
        _ => None,
    }
}

impl Compiler<'_> {
    /// The product of a matrix with a matrix, a vector or a scalar on either side; sums run from left to right.
    pub(super) fn matrix_product(
        &mut self,
        types: [&TypeInner; 2],
        left: &[Register],
        right: &[Register],
    ) -> Result<Value> {
        if left.len() == 1 || right.len() == 1 {
            return self.each_2(left, right, Self::multiply);
        }
        match types.map(dimensions) {
            [Some((_, rows)), _] => {
                let inner = left.len() / rows;
                let mut product = Vec::new();
                for column in right.chunks(inner) {
                    for row in 0..rows {
                        let row: Value = left.iter().skip(row).step_by(rows).copied().collect();
                        product.push(self.dot(&row, column)?);
                    }
                }
                Ok(product)
            }
            [None, Some((_, rows))] => right.chunks(rows).map(|column| self.dot(left, column)).collect(),
            [None, None] => Err(Unsupported::new("a product without a matrix")),
        }
    }

    pub(super) fn transpose(&self, ty: &TypeInner, matrix: &[Register]) -> Result<Value> {
        let (_, rows) = dimensions(ty).ok_or_else(no_matrix)?;
        Ok((0..rows).flat_map(|row| matrix.iter().skip(row).step_by(rows).copied()).collect())
    }

    pub(super) fn outer(&mut self, column: &[Register], row: &[Register]) -> Result<Value> {
        let mut product = Vec::new();
        for &factor in row {
            product.extend(self.each_2(column, &[factor], Self::multiply)?);
        }
        Ok(product)
    }

    /// Expands along the first column.
    pub(super) fn determinant(&mut self, matrix: &[Register]) -> Result<Register> {
        let size = side(matrix)?;
        if size == 1 {
            return Ok(matrix[0]);
        }
        let mut sum = None;
        for row in 0..size {
            let minor = self.determinant(&minor(matrix, size, 0, row))?;
            let term = self.multiply(matrix[row], minor)?;
            sum = Some(match sum {
                None => term,
                Some(sum) if row % 2 == 1 => self.subtract(sum, term)?,
                Some(sum) => self.add(sum, term)?,
            });
        }
        sum.ok_or_else(no_matrix)
    }

    /// The adjugate over the determinant.
    pub(super) fn inverse(&mut self, matrix: &[Register]) -> Result<Value> {
        let size = side(matrix)?;
        let determinant = self.determinant(matrix)?;
        let mut inverse = Vec::new();
        for column in 0..size {
            for row in 0..size {
                let mut cofactor = self.determinant(&minor(matrix, size, row, column))?;
                if (row + column) % 2 == 1 {
                    cofactor = self.negate(cofactor)?;
                }
                inverse.push(self.divide(cofactor, determinant)?);
            }
        }
        Ok(inverse)
    }
}

/// A square matrix without one column and one row.
fn minor(matrix: &[Register], size: usize, without_column: usize, without_row: usize) -> Value {
    let keeps = |index: &usize| index / size != without_column && index % size != without_row;
    (0..matrix.len()).filter(keeps).map(|index| matrix[index]).collect()
}

fn side(matrix: &[Register]) -> Result<usize> {
    (1..=4).find(|side| side * side == matrix.len()).ok_or_else(no_matrix)
}

fn no_matrix() -> Unsupported {
    Unsupported::new("a square matrix is wanted here")
}
