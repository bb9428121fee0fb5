//! Starts of parallel loops: methods of slices, vectors and ranges.

use std::ops::Range;

use super::sources::{Chunks, ChunksMut};
use super::steps::{IntoParallelIterator, NoStep, Parallel};

macro_rules! start_ranges {
    ($($number:ty),*) => {$(
        impl IntoParallelIterator for Range<$number> {
            type Source = Self;
            type Step = NoStep;
            fn into_par_iter(self) -> Parallel<Self, NoStep> {
                Parallel::new(self)
            }
        }
    )*};
}

start_ranges!(usize, u32, u64, u8);

impl<T: Send> IntoParallelIterator for Vec<T> {
    type Source = Self;
    type Step = NoStep;
    fn into_par_iter(self) -> Parallel<Self, NoStep> {
        Parallel::new(self)
    }
}

impl<'a, T: Sync> IntoParallelIterator for &'a [T] {
    type Source = Self;
    type Step = NoStep;
    fn into_par_iter(self) -> Parallel<&'a [T], NoStep> {
        Parallel::new(self)
    }
}

impl<'a, T: Sync> IntoParallelIterator for &'a Vec<T> {
    type Source = &'a [T];
    type Step = NoStep;
    fn into_par_iter(self) -> Parallel<&'a [T], NoStep> {
        Parallel::new(self.as_slice())
    }
}

impl<'a, T: Send> IntoParallelIterator for &'a mut [T] {
    type Source = Self;
    type Step = NoStep;
    fn into_par_iter(self) -> Parallel<&'a mut [T], NoStep> {
        Parallel::new(self)
    }
}

impl<'a, T: Send> IntoParallelIterator for &'a mut Vec<T> {
    type Source = &'a mut [T];
    type Step = NoStep;
    fn into_par_iter(self) -> Parallel<&'a mut [T], NoStep> {
        Parallel::new(self.as_mut_slice())
    }
}

/// Parallel loops over the items of a slice.
pub(crate) trait ParallelSlice<T> {
    fn par_iter(&self) -> Parallel<&[T], NoStep>;
    /// Chunks of `size` items; the last may be shorter.
    fn par_chunks(&self, size: usize) -> Parallel<Chunks<'_, T>, NoStep>;
    /// Chunks of consecutive items for which `same` holds.
    fn par_chunk_by(&self, same: impl FnMut(&T, &T) -> bool) -> Parallel<Vec<&[T]>, NoStep>;
}

impl<T: Sync> ParallelSlice<T> for [T] {
    fn par_iter(&self) -> Parallel<&[T], NoStep> {
        Parallel::new(self)
    }
    fn par_chunks(&self, size: usize) -> Parallel<Chunks<'_, T>, NoStep> {
        Parallel::new(Chunks { items: self, size })
    }
    fn par_chunk_by(&self, same: impl FnMut(&T, &T) -> bool) -> Parallel<Vec<&[T]>, NoStep> {
        Parallel::new(self.chunk_by(same).collect())
    }
}

/// Parallel loops over mutable items of a slice.
pub(crate) trait ParallelSliceMut<T> {
    fn par_iter_mut(&mut self) -> Parallel<&mut [T], NoStep>;
    /// Chunks of `size` items; the last may be shorter.
    fn par_chunks_mut(&mut self, size: usize) -> Parallel<ChunksMut<'_, T>, NoStep>;
}

impl<T: Send> ParallelSliceMut<T> for [T] {
    fn par_iter_mut(&mut self) -> Parallel<&mut [T], NoStep> {
        Parallel::new(self)
    }
    fn par_chunks_mut(&mut self, size: usize) -> Parallel<ChunksMut<'_, T>, NoStep> {
        Parallel::new(ChunksMut { items: self, size })
    }
}
