//! How types are laid out: as their scalars in order.

use super::super::columns::Kind;
use super::super::error::Unsupported;
use super::{Compiler, kind};
use naga::{ArraySize, Handle, ScalarKind, Type, TypeInner};

impl Compiler<'_> {
    /// The kinds of all scalars of a type.
    pub(super) fn kinds(&self, ty: &TypeInner) -> Result<Vec<Kind>, Unsupported> {
        match *ty {
            TypeInner::Scalar(scalar) => Ok(vec![kind(scalar)?]),
            TypeInner::Vector { size, scalar } => Ok(vec![kind(scalar)?; size as usize]),
            TypeInner::Matrix { columns, rows, scalar } => {
                Ok(vec![kind(scalar)?; columns as usize * rows as usize])
            }
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                let element = self.kinds(&self.module.types[base].inner)?;
                let count = count.get() as usize;
                self.check_size(element.len().saturating_mul(count))?;
                Ok(element.repeat(count))
            }
            TypeInner::Array { .. } => {
                Err(Unsupported::new("an array needs a size that does not depend on the pipeline"))
            }
            TypeInner::Struct { ref members, .. } => {
                let mut kinds = Vec::new();
                for member in members {
                    kinds.extend(self.kinds(&self.module.types[member.ty].inner)?);
                    self.check_size(kinds.len())?;
                }
                Ok(kinds)
            }
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => {
                Err(Unsupported::new("a pointer is no value here"))
            }
            TypeInner::Atomic(_) => Err(Unsupported::new("atomics are not interpreted")),
            TypeInner::Image { .. } | TypeInner::Sampler { .. } => {
                Err(Unsupported::new("textures and samplers are not interpreted"))
            }
            _ => Err(Unsupported::new("a type of this kind is not interpreted")),
        }
    }

    /// The number of scalars of a type.
    pub(super) fn size(&self, ty: &TypeInner) -> Result<usize, Unsupported> {
        self.kinds(ty).map(|kinds| kinds.len())
    }

    /// The number of scalars of a type of the module.
    pub(super) fn size_of(&self, ty: Handle<Type>) -> Result<usize, Unsupported> {
        self.size(&self.module.types[ty].inner)
    }

    /// What a pointer points to; the type itself where it is none.
    pub(super) fn pointee(&self, ty: &TypeInner) -> TypeInner {
        match *ty {
            TypeInner::Pointer { base, .. } => self.module.types[base].inner.clone(),
            TypeInner::ValuePointer { size: Some(size), scalar, .. } => TypeInner::Vector { size, scalar },
            TypeInner::ValuePointer { size: None, scalar, .. } => TypeInner::Scalar(scalar),
            ref value => value.clone(),
        }
    }

    /// How many elements a composite has, and how many scalars each.
    pub(super) fn elements(&self, ty: &TypeInner) -> Result<(u32, usize), Unsupported> {
        match *ty {
            TypeInner::Vector { size, .. } => Ok((size as u32, 1)),
            TypeInner::Matrix { columns, rows, .. } => Ok((columns as u32, rows as usize)),
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                Ok((count.get(), self.size_of(base)?))
            }
            _ => Err(Unsupported::new("only vectors, matrices and arrays of a known size can be indexed")),
        }
    }

    /// The place of a member or element among the scalars of a composite, and its own number of scalars.
    pub(super) fn member(&self, ty: &TypeInner, index: u32) -> Result<(usize, usize), Unsupported> {
        if let TypeInner::Struct { members, .. } = ty {
            let mut start = 0;
            for member in members.iter().take(index as usize) {
                start += self.size_of(member.ty)?;
            }
            let member = members.get(index as usize).ok_or_else(|| Unsupported::new("no such member"))?;
            return Ok((start, self.size_of(member.ty)?));
        }
        let (count, size) = self.elements(ty)?;
        if index < count {
            Ok((index as usize * size, size))
        } else {
            Err(Unsupported::new("an index is out of range"))
        }
    }
}

/// The kind of the scalars of a scalar, vector or matrix.
pub(super) fn scalar_kind(ty: &TypeInner) -> Result<ScalarKind, Unsupported> {
    match *ty {
        TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } | TypeInner::Matrix { scalar, .. } => {
            kind(scalar)?;
            Ok(scalar.kind)
        }
        _ => Err(Unsupported::new("only scalars, vectors and matrices can be computed with")),
    }
}
