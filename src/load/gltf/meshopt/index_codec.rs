//! Index codecs: triangles that share edges with recent ones, and plain sequences.

use super::{ByteCursor, unzigzag};

/// Ring buffer of the last sixteen items, newest first.
#[derive(Debug)]
struct RecentRing<T> {
    slots: [T; 16],
    newest: usize,
}

impl<T: Copy> RecentRing<T> {
    fn new(filler: T) -> Self {
        Self { slots: [filler; 16], newest: 0 }
    }

    fn push(&mut self, thing: T) {
        self.newest = (self.newest + 1) % 16;
        self.slots[self.newest] = thing;
    }

    /// The item that was pushed `back` pushes before the newest.
    fn get(&self, back: u8) -> T {
        self.slots[(self.newest + 16 - usize::from(back % 16)) % 16]
    }
}

/// Decodes `count` triangle indices, a multiple of three.
pub(crate) fn triangles(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let mut data = ByteCursor(bytes);
    // Codes of version 1 use the last two positions of the recent vertices for neighbours of `last`.
    let recent_codes = match data.byte()? {
        0xe0 => 15,
        0xe1 => 13,
        _ => return None,
    };
    let table = data.tail(16)?;
    let codes = data.take(count / 3)?;
    let mut decoded = Vec::with_capacity(count * stride);
    let mut edges = RecentRing::new([u32::MAX; 2]);
    let mut vertices = RecentRing::new(u32::MAX);
    let (mut next, mut last) = (0_u32, 0_u32);
    let fresh = |next: &mut u32| {
        let index = *next;
        *next = next.wrapping_add(1);
        index
    };

    for &code in codes {
        let (high, low) = (code >> 4, code & 15);
        let triangle = if high < 15 {
            // The triangle shares a recent edge.
            let [a, b] = edges.get(high);
            let c = match low {
                0 => fresh(&mut next),
                _ if low < recent_codes => vertices.get(low),
                15 => data.moved(last)?,
                13 => last.wrapping_sub(1),
                _ => last.wrapping_add(1),
            };
            if low >= recent_codes {
                last = c;
            }
            if low == 0 || low >= recent_codes {
                vertices.push(c);
            }
            edges.push([c, b]);
            edges.push([a, c]);
            [a, b, c]
        } else {
            // The triangle shares no edge; its second and third corner are coded in one byte.
            let listed = low < 14;
            let pair = if listed { *table.get(usize::from(low))? } else { data.byte()? };
            let (second, third) = (pair >> 4, pair & 15);
            if !listed && pair == 0 {
                next = 0;
            }
            let explicit = |code: u8| !listed && code == 15;
            let mut a = if low == 15 { 0 } else { fresh(&mut next) };
            // Only vertices before this triangle count as recent.
            let recent = |code: u8| vertices.get(code.wrapping_sub(1));
            let mut b = if second == 0 { fresh(&mut next) } else { recent(second) };
            let mut c = if third == 0 { fresh(&mut next) } else { recent(third) };
            for (corner, given) in
                [(&mut a, low == 15), (&mut b, explicit(second)), (&mut c, explicit(third))]
            {
                if given {
                    last = data.moved(last)?;
                    *corner = last;
                }
            }
            vertices.push(a);
            if second == 0 || explicit(second) {
                vertices.push(b);
            }
            if third == 0 || explicit(third) {
                vertices.push(c);
            }
            edges.push([b, a]);
            edges.push([c, b]);
            edges.push([a, c]);
            [a, b, c]
        };
        triangle.into_iter().for_each(|index| write(&mut decoded, index, stride));
    }
    data.0.is_empty().then_some(decoded)
}

/// Decodes `count` indices in any order: differences from one of two running values.
pub(crate) fn sequence(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let mut data = ByteCursor(bytes);
    if !matches!(data.byte()?, 0xd0 | 0xd1) {
        return None;
    }
    data.tail(4)?;
    // Every index takes at least one byte.
    let mut decoded = Vec::with_capacity(count.min(data.0.len()) * stride);
    let mut last = [0_u32; 2];
    for _ in 0..count {
        let value = data.varint()?;
        let running = &mut last[usize::from(value & 1 == 1)];
        *running = running.wrapping_add(unzigzag(value >> 1));
        write(&mut decoded, *running, stride);
    }
    data.0.is_empty().then_some(decoded)
}

fn write(decoded: &mut Vec<u8>, index: u32, stride: usize) {
    if stride == 2 {
        decoded.extend((index as u16).to_le_bytes());
    } else {
        decoded.extend(index.to_le_bytes());
    }
}
