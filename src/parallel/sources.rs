//! Sources of parallel loops: slices, chunks of slices, vectors and ranges, and pairs of sources.

use std::ops::Range;
use std::{slice, vec};

/// Sequence that can be split in two.
pub(crate) trait Split: Sized + Send {
    type Item;
    type Iter: Iterator<Item = Self::Item>;
    /// Number of items.
    fn length(&self) -> usize;
    /// The first `at` items, and those after them; `at` is at most the length.
    fn cut_at(self, at: usize) -> (Self, Self);
    fn items(self) -> Self::Iter;
}

/// Shared items of a slice.
impl<'a, T: Sync> Split for &'a [T] {
    type Item = &'a T;
    type Iter = slice::Iter<'a, T>;
    fn length(&self) -> usize {
        <[T]>::len(self)
    }
    fn cut_at(self, at: usize) -> (Self, Self) {
        <[T]>::split_at(self, at)
    }
    fn items(self) -> Self::Iter {
        self.iter()
    }
}

/// Mutable items of a slice.
impl<'a, T: Send> Split for &'a mut [T] {
    type Item = &'a mut T;
    type Iter = slice::IterMut<'a, T>;
    fn length(&self) -> usize {
        <[T]>::len(self)
    }
    fn cut_at(self, at: usize) -> (Self, Self) {
        self.split_at_mut(at)
    }
    fn items(self) -> Self::Iter {
        self.iter_mut()
    }
}

impl<T: Send> Split for Vec<T> {
    type Item = T;
    type Iter = vec::IntoIter<T>;
    fn length(&self) -> usize {
        self.len()
    }
    fn cut_at(mut self, at: usize) -> (Self, Self) {
        let after = self.split_off(at);
        (self, after)
    }
    fn items(self) -> Self::Iter {
        IntoIterator::into_iter(self)
    }
}

/// Chunks of `size` items of a slice; the last may be shorter.
#[derive(Clone)]
pub(crate) struct Chunks<'a, T> {
    pub(crate) items: &'a [T],
    pub(crate) size: usize,
}

impl<'a, T: Sync> Split for Chunks<'a, T> {
    type Item = &'a [T];
    type Iter = slice::Chunks<'a, T>;
    fn length(&self) -> usize {
        self.items.len().div_ceil(self.size)
    }
    fn cut_at(self, at: usize) -> (Self, Self) {
        let (before, after) = self.items.split_at((at * self.size).min(self.items.len()));
        (Self { items: before, ..self }, Self { items: after, ..self })
    }
    fn items(self) -> Self::Iter {
        self.items.chunks(self.size)
    }
}

/// Mutable chunks of `size` items of a slice; the last may be shorter.
pub(crate) struct ChunksMut<'a, T> {
    pub(crate) items: &'a mut [T],
    pub(crate) size: usize,
}

impl<'a, T: Send> Split for ChunksMut<'a, T> {
    type Item = &'a mut [T];
    type Iter = slice::ChunksMut<'a, T>;
    fn length(&self) -> usize {
        self.items.len().div_ceil(self.size)
    }
    fn cut_at(self, at: usize) -> (Self, Self) {
        let Self { items, size } = self;
        let end = (at * size).min(items.len());
        let (before, after) = items.split_at_mut(end);
        (Self { items: before, size }, Self { items: after, size })
    }
    fn items(self) -> Self::Iter {
        self.items.chunks_mut(self.size)
    }
}

macro_rules! split_ranges {
    ($($number:ty),*) => {$(
        impl Split for Range<$number> {
            type Item = $number;
            type Iter = Self;
            fn length(&self) -> usize {
                self.end.saturating_sub(self.start) as usize
            }
            fn cut_at(self, at: usize) -> (Self, Self) {
                let middle = self.start + at as $number;
                (self.start..middle, middle..self.end)
            }
            fn items(self) -> Self::Iter {
                self
            }
        }
    )*};
}

split_ranges!(usize, u32, u64, u8);

/// Two sources of equal length that run together.
#[derive(Clone)]
pub(crate) struct SourcePair<A, B>(pub A, pub B);

impl<A: Split, B: Split> Split for SourcePair<A, B> {
    type Item = (A::Item, B::Item);
    type Iter = std::iter::Zip<A::Iter, B::Iter>;
    fn length(&self) -> usize {
        self.0.length()
    }
    fn cut_at(self, at: usize) -> (Self, Self) {
        let ((a, a_after), (b, b_after)) = (self.0.cut_at(at), self.1.cut_at(at));
        (Self(a, b), Self(a_after, b_after))
    }
    fn items(self) -> Self::Iter {
        self.0.items().zip(self.1.items())
    }
}
