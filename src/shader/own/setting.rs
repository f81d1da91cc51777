//! Values that a user gives by name: `--set KEY=VALUE`.

use naga::{Expression, Handle, Literal, Module, Scalar, ScalarKind, Span, Type, TypeInner, VectorSize};

/// A number, a vector or a matrix that is the same in every fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// The components, repeated behind the last; of a matrix column by column.
    values: [Value; 16],
    size: usize,
    /// The rows of a matrix.
    rows: Option<VectorSize>,
}

impl From<Value> for Constant {
    fn from(value: Value) -> Self {
        Self { values: [value; 16], size: 1, rows: None }
    }
}

impl Constant {
    /// Returns the components: one of a number, two to four of a vector, up to 16 of a matrix, column by column.
    #[must_use]
    pub fn components(&self) -> &[Value] {
        &self.values[..self.size]
    }

    /// Appends it to the constant expressions of a module, of which it is one of type `ty`.
    pub(super) fn append(&self, ty: Handle<Type>, module: &mut Module) -> Handle<Expression> {
        let column = self.rows.map(|size| {
            let inner = TypeInner::Vector { size, scalar: Scalar::F32 };
            (size as usize, module.types.insert(Type { name: None, inner }, Span::UNDEFINED))
        });
        let mut append = |expression| module.global_expressions.append(expression, Span::UNDEFINED);
        let components: Vec<_> =
            self.components().iter().map(|value| append(Expression::Literal(value.literal()))).collect();
        match (column, &components[..]) {
            (_, &[only]) => only,
            (None, _) => append(Expression::Compose { ty, components }),
            (Some((rows, column)), _) => {
                let columns = components
                    .chunks(rows)
                    .map(|part| Expression::Compose { ty: column, components: part.to_vec() });
                let components = columns.map(&mut append).collect();
                append(Expression::Compose { ty, components })
            }
        }
    }

    /// Returns it as WGSL says it.
    #[must_use]
    pub fn wgsl(&self) -> String {
        let [first, ..] = self.values;
        if self.size == 1 {
            return first.wgsl();
        }
        let components: Vec<_> = self.components().iter().map(|value| value.wgsl()).collect();
        if let Some(rows) = self.rows {
            let (rows, columns) = (rows as usize, self.size / rows as usize);
            return format!("mat{columns}x{rows}<{}>({})", first.type_name(), components.join(", "));
        }
        format!("vec{}<{}>({})", self.size, first.type_name(), components.join(", "))
    }

    /// Says how a value of a type is written; nothing for a type that cannot be set.
    pub(super) fn form(inner: &TypeInner) -> Option<String> {
        let (size, scalar) = parts(inner)?;
        let is_settable = scalar.width == 4 || scalar.kind == ScalarKind::Bool;
        is_settable.then(|| match size {
            1 => "VALUE".to_owned(),
            2..=4 => ["X", "Y", "Z", "W"][..size].join(","),
            _ => (1..=size).map(|at| format!("M{at}")).collect::<Vec<_>>().join(","),
        })
    }

    /// Reads a value of a type from what a user wrote for `name`.
    ///
    /// # Errors
    ///
    /// Something else than a number, and another number of them than the type has; with the name and the type.
    pub(super) fn parse(name: &str, inner: &TypeInner, written: &str) -> Result<Self, String> {
        let unsettable = || {
            format!(
                "`{name}` is of a type that cannot be set: only numbers of 32 bits, bool, and vectors and matrices of them"
            )
        };
        let (form, (size, scalar)) = Self::form(inner).zip(parts(inner)).ok_or_else(unsettable)?;
        let parts: Vec<_> = if size == 1 { vec![written] } else { written.split(',').collect() };
        if parts.len() != size {
            let number = type_name(scalar);
            let shape =
                if size > 4 { format!("a matrix of {number}") } else { format!("vec{size}<{number}>") };
            return Err(format!(
                "`{name}` is {shape} and takes {size} values, --set {name}={form}, not {}",
                parts.len()
            ));
        }
        let mut values = Vec::new();
        for part in parts {
            values.push(Value::parse(scalar, part).map_err(|error| format!("`{name}`: {error}"))?);
        }
        let rows = match *inner {
            TypeInner::Matrix { rows, .. } => Some(rows),
            _ => None,
        };
        Ok(Self { values: core::array::from_fn(|at| values[at.min(size - 1)]), size, rows })
    }
}

/// The number of components of a number or a vector, and what they are.
fn parts(inner: &TypeInner) -> Option<(usize, Scalar)> {
    match *inner {
        TypeInner::Scalar(scalar) => Some((1, scalar)),
        TypeInner::Vector { size, scalar } => Some((size as usize, scalar)),
        TypeInner::Matrix { columns, rows, scalar } => Some((columns as usize * rows as usize, scalar)),
        _ => None,
    }
}

/// A value of a scalar type of WGSL.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A finite float.
    F32(f32),
    /// A signed integer.
    I32(i32),
    /// An unsigned integer.
    U32(u32),
    /// A truth value.
    Bool(bool),
}

impl Value {
    /// Reads a value of a type from what a user wrote; the error names the type.
    pub(super) fn parse(scalar: Scalar, written: &str) -> Result<Self, String> {
        let written = written.trim();
        let value = match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => {
                written.parse().ok().filter(|value: &f32| value.is_finite()).map(Self::F32)
            }
            (ScalarKind::Sint, 4) => written.parse().ok().map(Self::I32),
            (ScalarKind::Uint, 4) => written.parse().ok().map(Self::U32),
            (ScalarKind::Bool, _) => written.parse().ok().map(Self::Bool),
            _ => return Err("only f32, i32, u32 and bool can be given a value".to_owned()),
        };
        value.ok_or_else(|| format!("`{written}` is no {}", type_name(scalar)))
    }

    /// The value as naga writes it.
    pub(super) const fn literal(self) -> Literal {
        match self {
            Self::F32(value) => Literal::F32(value),
            Self::I32(value) => Literal::I32(value),
            Self::U32(value) => Literal::U32(value),
            Self::Bool(value) => Literal::Bool(value),
        }
    }

    /// The value as `f64`, which holds each of them exactly; 1 for true.
    pub(super) fn to_f64(self) -> f64 {
        match self {
            Self::F32(value) => f64::from(value),
            Self::I32(value) => f64::from(value),
            Self::U32(value) => f64::from(value),
            Self::Bool(value) => f64::from(u8::from(value)),
        }
    }

    fn wgsl(self) -> String {
        match self {
            Self::F32(value) => format!("{value:?}f"),
            Self::I32(value) => format!("i32({value})"),
            Self::U32(value) => format!("{value}u"),
            Self::Bool(value) => value.to_string(),
        }
    }

    const fn type_name(self) -> &'static str {
        match self {
            Self::F32(_) => "f32",
            Self::I32(_) => "i32",
            Self::U32(_) => "u32",
            Self::Bool(_) => "bool",
        }
    }
}

/// The name of a scalar type in messages.
pub(super) const fn type_name(scalar: Scalar) -> &'static str {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => "f32",
        (ScalarKind::Sint, 4) => "i32",
        (ScalarKind::Uint, 4) => "u32",
        (ScalarKind::Bool, _) => "bool",
        (ScalarKind::Float, 2) => "f16",
        (ScalarKind::Float, _) => "f64",
        _ => "a type of its own",
    }
}
