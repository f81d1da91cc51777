//! Numbers of a glTF accessor, whatever their type: floats, or whole numbers that stand for themselves or for shares of the
//! largest (`KHR_mesh_quantization` allows those for every attribute).

use crate::render::scene_file::limits::MOST_TRIANGLES;
use gltf::accessor::DataType;
use gltf::accessor::sparse::IndexType;
use gltf::buffer;

/// Elements of an accessor, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Numbers {
    /// Numbers of an element.
    width: usize,
    values: Vec<f64>,
}

impl Numbers {
    /// Returns the number of elements.
    pub(super) fn len(&self) -> usize {
        self.values.len().checked_div(self.width).unwrap_or(0)
    }

    /// Returns an element.
    pub(super) fn get(&self, at: usize) -> Option<&[f64]> {
        self.values.get(at * self.width..(at + 1) * self.width)
    }

    /// Returns all elements.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.width.max(1))
    }
}

/// Reads all elements of an accessor for `what`, which has so many numbers as one of `widths` says.
///
/// # Errors
///
/// What is wrong with it: another width, more elements than its buffer view holds, or too many.
pub(super) fn read(
    accessor: &gltf::Accessor<'_>,
    buffers: &[buffer::Data],
    what: &str,
    widths: &[usize],
) -> Result<Numbers, String> {
    let (index, count) = (accessor.index(), accessor.count());
    let width = accessor.dimensions().multiplicity();
    if !widths.contains(&width) {
        return Err(format!(
            "accessor {index} is of the wrong type for {what}: it has {width} numbers an element"
        ));
    }
    if count as u64 > 3 * MOST_TRIANGLES {
        return Err(format!("accessor {index} has {count} elements, too many"));
    }
    let short = || format!("accessor {index} has {count} elements, more than its buffer view holds");
    let (kind, normalized) = (accessor.data_type(), accessor.normalized());
    let each = width * kind.size();
    let put = |bytes: &[u8], into: &mut [f64]| {
        for (number, bytes) in into.iter_mut().zip(bytes.chunks_exact(kind.size())) {
            *number = number_of(bytes, kind, normalized);
        }
    };
    let mut values = vec![0.0; count * width];
    if let Some(view) = accessor.view() {
        let stride = view.stride().unwrap_or(each);
        for (at, element) in values.chunks_exact_mut(width).enumerate() {
            put(bytes(&view, buffers, accessor.offset(), stride, at, each).ok_or_else(short)?, element);
        }
    }
    if let Some(sparse) = accessor.sparse() {
        let short = || format!("the sparse part of {}", short());
        let (indices, replaced) = (sparse.indices(), sparse.values());
        let kind = match indices.index_type() {
            IndexType::U8 => DataType::U8,
            IndexType::U16 => DataType::U16,
            IndexType::U32 => DataType::U32,
        };
        for entry in 0..sparse.count() {
            let place = bytes(&indices.view(), buffers, indices.offset(), kind.size(), entry, kind.size());
            let place = number_of(place.ok_or_else(short)?, kind, false) as usize;
            let element = values.chunks_exact_mut(width).nth(place);
            let element = element.ok_or_else(|| {
                format!("accessor {index} replaces element {place} of {count}, which is not there")
            })?;
            put(
                bytes(&replaced.view(), buffers, replaced.offset(), each, entry, each).ok_or_else(short)?,
                element,
            );
        }
    }
    Ok(Numbers { width, values })
}

/// The bytes of one element of a view; `None` if it ends before them.
fn bytes<'b>(
    view: &buffer::View<'_>,
    buffers: &'b [buffer::Data],
    offset: usize,
    stride: usize,
    at: usize,
    size: usize,
) -> Option<&'b [u8]> {
    let all = view_bytes(view, buffers)?;
    let first = at.checked_mul(stride)?.checked_add(offset)?;
    all.get(first..first.checked_add(size)?)
}

/// The bytes of a view; `None` if its buffer ends before them.
pub(super) fn view_bytes<'b>(view: &buffer::View<'_>, buffers: &'b [buffer::Data]) -> Option<&'b [u8]> {
    let buffer = buffers.get(view.buffer().index())?;
    buffer.get(view.offset()..view.offset().checked_add(view.length())?)
}

/// A number of so many bytes; a share in [-1, 1] if it is normalized.
fn number_of(bytes: &[u8], kind: DataType, normalized: bool) -> f64 {
    let word = bytes.iter().rev().fold(0_u32, |word, &byte| word << 8 | u32::from(byte));
    let (number, largest) = match kind {
        DataType::I8 => (f64::from(word as u8 as i8), f64::from(i8::MAX)),
        DataType::U8 => (f64::from(word), f64::from(u8::MAX)),
        DataType::I16 => (f64::from(word as u16 as i16), f64::from(i16::MAX)),
        DataType::U16 => (f64::from(word), f64::from(u16::MAX)),
        DataType::U32 => (f64::from(word), f64::from(u32::MAX)),
        DataType::F32 => return f64::from(f32::from_bits(word)),
    };
    // The least number of a signed type lies beyond -1.
    if normalized { (number / largest).max(-1.0) } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_of_number_is_read_as_the_standard_says() {
        for (bytes, kind, plain, share) in [
            (&[0x80][..], DataType::I8, -128.0, -1.0),
            (&[0x7f], DataType::I8, 127.0, 1.0),
            (&[0x33], DataType::U8, 51.0, 0.2),
            (&[0x00, 0x80], DataType::I16, -32_768.0, -1.0),
            (&[0x33, 0x33], DataType::U16, 13_107.0, 0.2),
            (&[1, 0, 1, 0], DataType::U32, 65_537.0, 65_537.0 / 4_294_967_295.0),
            (&[0, 0, 0x20, 0x40], DataType::F32, 2.5, 2.5),
        ] {
            assert_eq!([false, true].map(|n| number_of(bytes, kind, n)), [plain, share], "{kind:?}");
        }
    }
}
