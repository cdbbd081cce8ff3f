//! Structs that the host shares with shaders, laid out as their WGSL twins, padding included.
//!
//! A Rust struct has the fields of its WGSL twin and nothing else. Their offsets follow from the types
//! by WGSL's rules for storage buffers (WGSL, section "Memory Layout"); arrays in uniform buffers need elements
//! of a multiple of 16 bytes, which theirs have; `tests/source/shaders.rs` compares them with
//! the twin's layout from a WGSL compiler.

use std::ops::{Deref, DerefMut};

/// A value that WGSL can store in a buffer.
pub trait HostShared: Copy {
    /// The type's alignment in bytes.
    const ALIGN: usize;
    /// The type's size in bytes; for structs a multiple of the alignment.
    const SIZE: usize;

    /// Writes the value at the start of `bytes`, which holds at least [`Self::SIZE`]; skips padding.
    fn write(&self, bytes: &mut [u8]);

    /// Reads a value from the start of `bytes`, which holds at least [`Self::SIZE`].
    fn read(bytes: &[u8]) -> Self;

    /// The value's bytes, with zeros for padding.
    fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = vec![0; Self::SIZE];
        self.write(&mut bytes);
        bytes
    }
}

/// The bytes of `items`, each at a multiple of its stride.
pub fn bytes_of_all<T: HostShared>(items: &[T]) -> Vec<u8> {
    let stride = T::SIZE.next_multiple_of(T::ALIGN);
    let mut bytes = vec![0; stride * items.len()];
    for (item, bytes) in items.iter().zip(bytes.chunks_exact_mut(stride)) {
        item.write(bytes);
    }
    bytes
}

macro_rules! scalars {
    ($($scalar:ty),*) => {
        $(
            impl HostShared for $scalar {
                const ALIGN: usize = 4;
                const SIZE: usize = 4;

                fn write(&self, bytes: &mut [u8]) {
                    bytes[..4].copy_from_slice(&self.to_le_bytes());
                }

                fn read(bytes: &[u8]) -> Self {
                    <$scalar>::from_le_bytes(std::array::from_fn(|i| bytes[i]))
                }
            }
        )*
    };
}

scalars!(f32, u32, i32);

macro_rules! vectors {
    ($($scalar:ty, $width:literal, $align:literal;)*) => {
        $(
            impl HostShared for [$scalar; $width] {
                const ALIGN: usize = $align;
                const SIZE: usize = 4 * $width;

                fn write(&self, bytes: &mut [u8]) {
                    for (part, bytes) in self.iter().zip(bytes.chunks_exact_mut(4)) {
                        part.write(bytes);
                    }
                }

                fn read(bytes: &[u8]) -> Self {
                    std::array::from_fn(|i| <$scalar>::read(&bytes[4 * i..]))
                }
            }
        )*
    };
}

// The vec2, vec3 and vec4 in use; others take a line here.
vectors! {
    f32, 2, 8;
    u32, 2, 8;
    f32, 3, 16;
    f32, 4, 16;
}

/// WGSL's `array<T, N>`; Rust arrays of two to four numbers are vectors instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array<T, const N: usize>(pub [T; N]);

impl<T: Copy + Default, const N: usize> Default for Array<T, N> {
    fn default() -> Self {
        Self([T::default(); N])
    }
}

impl<T, const N: usize> Deref for Array<T, N> {
    type Target = [T; N];

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<T, const N: usize> DerefMut for Array<T, N> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

impl<T: HostShared, const N: usize> HostShared for Array<T, N> {
    const ALIGN: usize = T::ALIGN;
    const SIZE: usize = N * T::SIZE.next_multiple_of(T::ALIGN);

    fn write(&self, bytes: &mut [u8]) {
        for (item, bytes) in self.iter().zip(bytes.chunks_exact_mut(Self::SIZE / N)) {
            item.write(bytes);
        }
    }

    fn read(bytes: &[u8]) -> Self {
        Self(std::array::from_fn(|i| T::read(&bytes[i * Self::SIZE / N..])))
    }
}

/// One field of a host-shared struct: name, byte offset, size in bytes.
pub type FieldLayout = (&'static str, usize, usize);

/// Declares host-shared structs, and a list of their names, sizes and fields.
macro_rules! host_shared {
    ($(#[$list_doc:meta])* $list:ident; $($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub struct $name { $($(#[$field_doc])* pub $field: $kind,)* }

            impl $name {
                /// Every field in order, for comparison with the WGSL struct.
                pub const LAYOUT: &[$crate::gpu::host_shared::FieldLayout] = {
                    use $crate::gpu::host_shared::HostShared;
                    const COUNT: usize = [$(stringify!($field)),*].len();
                    const FIELDS: [(&str, usize, usize); COUNT] =
                        [$((stringify!($field), <$kind as HostShared>::ALIGN, <$kind as HostShared>::SIZE)),*];
                    &$crate::gpu::host_shared::placed(FIELDS)
                };
            }

            impl $crate::gpu::host_shared::HostShared for $name {
                const ALIGN: usize = {
                    let mut most = 4;
                    $(if <$kind as $crate::gpu::host_shared::HostShared>::ALIGN > most {
                        most = <$kind as $crate::gpu::host_shared::HostShared>::ALIGN;
                    })*
                    most
                };
                const SIZE: usize = {
                    let (_, offset, size) = Self::LAYOUT[Self::LAYOUT.len() - 1];
                    (offset + size).next_multiple_of(<Self as $crate::gpu::host_shared::HostShared>::ALIGN)
                };

                fn write(&self, bytes: &mut [u8]) {
                    let mut offsets = Self::LAYOUT.iter().map(|(_, offset, _)| *offset);
                    $(
                        // `offsets` has one offset per field.
                        let offset = offsets.next().unwrap_or_default();
                        $crate::gpu::host_shared::HostShared::write(&self.$field, &mut bytes[offset..]);
                    )*
                }

                fn read(bytes: &[u8]) -> Self {
                    let mut offsets = Self::LAYOUT.iter().map(|(_, offset, _)| *offset);
                    Self {
                        $($field: $crate::gpu::host_shared::HostShared::read(
                            &bytes[offsets.next().unwrap_or_default()..],
                        ),)*
                    }
                }
            }
        )*

        $(#[$list_doc])*
        pub const $list: &[(&str, usize, &[$crate::gpu::host_shared::FieldLayout])] =
            &[$((stringify!($name), <$name as $crate::gpu::host_shared::HostShared>::SIZE, $name::LAYOUT),)*];
    };
}

pub(crate) use host_shared;

/// Fields with the offsets that WGSL gives them, from name, alignment and size.
pub const fn placed<const N: usize>(fields: [(&'static str, usize, usize); N]) -> [FieldLayout; N] {
    let mut placed = fields;
    let (mut i, mut end) = (0, 0_usize);
    while i < N {
        let (name, align, size) = fields[i];
        let offset = end.next_multiple_of(align);
        placed[i] = (name, offset, size);
        end = offset + size;
        i += 1;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    host_shared! {
        /// For the tests.
        LISTED;
        /// A scalar fits behind a vec3.
        Inner { vector: [f32; 3], scalar: u32, pair: [u32; 2], }
        /// A struct and an array of them.
        Outer { flag: u32, inner: Inner, many: Array<Inner, 2>, last: f32, }
    }

    #[test]
    fn fields_lie_where_wgsl_has_them() {
        assert_eq!(Inner::LAYOUT, [("vector", 0, 12), ("scalar", 12, 4), ("pair", 16, 8)]);
        assert_eq!((Inner::ALIGN, Inner::SIZE), (16, 32));
        let offsets: Vec<_> = Outer::LAYOUT.iter().map(|(_, offset, _)| *offset).collect();
        assert_eq!(offsets, [0, 16, 48, 112]);
        assert_eq!((Outer::SIZE, LISTED.len()), (128, 2));
    }

    #[test]
    fn values_are_read_as_they_were_written() {
        let inner = |x: f32| Inner { vector: [x, 2.0, 3.0], scalar: 4, pair: [5, 6] };
        let value =
            Outer { flag: 1, inner: inner(0.5), many: Array([inner(7.0), inner(8.0)]), last: 9.0 };
        let bytes = value.to_bytes();
        assert_eq!(bytes.len(), Outer::SIZE);
        assert_eq!(Outer::read(&bytes), value);
        assert_eq!(bytes[4..16], [0; 12], "padding is zero");
    }
}
