//! The numbers of an accessor of a glTF file. Everything that it says is checked: a damaged file is
//! an error.

use gltf::accessor::{Accessor, DataType, Dimensions};
use gltf::buffer::View;

/// The buffers of a file.
pub(super) struct Buffers(pub(super) Vec<Vec<u8>>);

impl Buffers {
    /// The bytes of a view.
    pub(super) fn view(&self, view: &View<'_>) -> Result<&[u8], String> {
        let end = view.offset().checked_add(view.length());
        let range = end.and_then(|end| self.0[view.buffer().index()].get(view.offset()..end));
        range.ok_or_else(|| {
            format!(
                "buffer view {} ends after its buffer, which has {} bytes",
                view.index(),
                self.0[view.buffer().index()].len()
            )
        })
    }

    /// The elements of an accessor, each of `N` numbers; normalised integers are in [-1, 1].
    pub(super) fn numbers<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
    ) -> Result<Vec<[f64; N]>, String> {
        let count = accessor.count();
        if components(accessor.dimensions()) != N {
            let found = components(accessor.dimensions());
            let number = accessor.index();
            return Err(format!(
                "accessor {number} has {found} numbers per element, not {N}"
            ));
        }
        let kind = accessor.data_type();
        let mut elements = match accessor.view() {
            Some(view) => {
                let bytes = self.view(&view)?;
                let stride = view.stride().unwrap_or(N * size_of_number(kind));
                read(bytes, accessor.offset(), stride, count, kind)
                    .ok_or_else(|| past_the_end(accessor))?
            }
            // Sparse accessors without a view change zeros.
            None if count <= MAX_ZEROS => vec![[0.0; N]; count],
            None => return Err(past_the_end(accessor)),
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, values) = (sparse.indices(), sparse.values());
            let index_kind = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let index_bytes = self.view(&indices.view())?;
            let size = size_of_number(index_kind);
            let at: Option<Vec<[f64; 1]>> = read(
                index_bytes,
                indices.offset(),
                size,
                sparse.count(),
                index_kind,
            );
            let value_bytes = self.view(&values.view())?;
            let size = N * size_of_number(kind);
            let new: Option<Vec<[f64; N]>> =
                read(value_bytes, values.offset(), size, sparse.count(), kind);
            let (Some(at), Some(new)) = (at, new) else {
                return Err(past_the_end(accessor));
            };
            for ([index], value) in at.into_iter().zip(new) {
                let element = elements.get_mut(index as usize);
                *element.ok_or_else(|| past_the_end(accessor))? = value;
            }
        }
        if accessor.normalized() {
            let largest = match kind {
                DataType::U8 => 255.0,
                DataType::I8 => 127.0,
                DataType::U16 => 65535.0,
                DataType::I16 => 32767.0,
                DataType::U32 | DataType::F32 => 1.0,
            };
            for number in elements.iter_mut().flatten() {
                *number = (*number / largest).max(-1.0);
            }
        }
        Ok(elements)
    }
}

/// The most elements of an accessor that no bytes stand for.
const MAX_ZEROS: usize = 1 << 24;

fn past_the_end(accessor: &Accessor<'_>) -> String {
    let (number, count) = (accessor.index(), accessor.count());
    format!("accessor {number} has {count} elements, more than its bytes")
}

/// `count` elements of `N` numbers; `None` if the bytes end before.
fn read<const N: usize>(
    bytes: &[u8],
    offset: usize,
    stride: usize,
    count: usize,
    kind: DataType,
) -> Option<Vec<[f64; N]>> {
    if count == 0 {
        return Some(Vec::new());
    }
    let size = size_of_number(kind);
    let last = stride.checked_mul(count.checked_sub(1)?)?;
    let end = offset.checked_add(last)?.checked_add(N * size)?;
    let bytes = bytes.get(offset..end)?;
    let number = |start: usize| {
        let b = &bytes[start..start + size];
        match kind {
            DataType::U8 => f64::from(b[0]),
            DataType::I8 => f64::from(b[0] as i8),
            DataType::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            DataType::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            DataType::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            DataType::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        }
    };
    let element = |i: usize| std::array::from_fn(|k| number(i * stride + k * size));
    Some((0..count).map(element).collect())
}

fn size_of_number(kind: DataType) -> usize {
    match kind {
        DataType::U8 | DataType::I8 => 1,
        DataType::U16 | DataType::I16 => 2,
        DataType::U32 | DataType::F32 => 4,
    }
}

fn components(dimensions: Dimensions) -> usize {
    match dimensions {
        Dimensions::Scalar => 1,
        Dimensions::Vec2 => 2,
        Dimensions::Vec3 => 3,
        Dimensions::Vec4 | Dimensions::Mat2 => 4,
        Dimensions::Mat3 => 9,
        Dimensions::Mat4 => 16,
    }
}
