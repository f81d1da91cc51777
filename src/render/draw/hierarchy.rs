//! A hierarchy of boxes: which of many things a ray may meet, without a look at each of them.
//!
//! Whether a ray meets a box grows with the box, bit for bit: rounding keeps the order of the distances to two sides. So a
//! ray that meets the box of a thing meets every box around that, and a search finds what a look at every thing would find.

use super::extent::{Extent, Ray};

/// Boxes within boxes, each innermost around one thing.
#[derive(Clone, Debug, Default)]
pub(in crate::render) struct Hierarchy {
    /// A box stands before the boxes within it.
    nodes: Vec<Node>,
}

/// A box.
#[derive(Clone, Copy, Debug)]
struct Node {
    extent: Extent,
    /// The first node that is not within it.
    after: u32,
    /// The thing in it; that of an inner box is of no meaning.
    item: u32,
}

/// A thing that is still to be sorted in.
#[derive(Clone, Copy, Debug)]
struct Item {
    extent: Extent,
    index: u32,
}

/// Places at which a box may be parted: those of an even grid over the middles of what it holds.
const CUTS: usize = 15;

/// Things from which on two threads share the work.
const SHARED: usize = 4096;

impl Hierarchy {
    /// Sorts things by their boxes; a thing without a box is never found. The order does not depend on the number of threads.
    pub(in crate::render) fn new(extents: impl Iterator<Item = Option<Extent>>) -> Self {
        let with_index = (0..).zip(extents);
        let mut items: Vec<Item> =
            with_index.filter_map(|(index, extent)| Some(Item { extent: extent?, index })).collect();
        // Every box with something within has two: as many as there are things, and one less.
        let empty = Node { extent: Extent::EMPTY, after: 0, item: 0 };
        let mut nodes = vec![empty; (2 * items.len()).saturating_sub(1)];
        if !items.is_empty() {
            sort(&mut items, &mut nodes, 0);
        }
        Self { nodes }
    }

    /// Returns whether `is_met` holds for any thing whose box a ray meets; asks no more once it does.
    pub(in crate::render) fn any(&self, ray: &Ray, mut is_met: impl FnMut(u32) -> bool) -> bool {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let inside = at + 1;
            if !ray.meets(&node.extent) {
                at = node.after as usize;
            } else if node.after as usize == inside && is_met(node.item) {
                return true;
            } else {
                at = inside;
            }
        }
        false
    }
}

/// Puts things into the nodes of their hierarchy, of which the first has the number `first`.
fn sort(items: &mut [Item], nodes: &mut [Node], first: u32) {
    let extent = items.iter().fold(Extent::EMPTY, |all, item| all.with(&item.extent));
    let after = first + nodes.len() as u32;
    let Some((node, within)) = nodes.split_first_mut() else { return };
    *node = Node { extent, after, item: items[0].index };
    if items.len() == 1 {
        return;
    }
    let (left, right) = part(items);
    let (of_left, of_right) = within.split_at_mut(2 * left.len() - 1);
    let (first_left, first_right) = (first + 1, first + 1 + of_left.len() as u32);
    if left.len().min(right.len()) < SHARED {
        sort(left, of_left, first_left);
        sort(right, of_right, first_right);
    } else {
        rayon::join(|| sort(left, of_left, first_left), || sort(right, of_right, first_right));
    }
}

/// Parts two things or more where their boxes lie, where that makes the least surface to be met; neither part is empty.
fn part(items: &mut [Item]) -> (&mut [Item], &mut [Item]) {
    let middles = items.iter().fold(Extent::EMPTY, |all, item| all.with_point(item.extent.middle()));
    let sides = middles.sides();
    let axis = sides.max_position();
    let scale = (CUTS + 1) as f64 / sides[axis];
    // A number that is none, as where all middles are one, is cell 0.
    let cell = |item: &Item| ((item.extent.middle()[axis] - middles.low[axis]) * scale) as usize;
    let mut cells = [(0_usize, Extent::EMPTY); CUTS + 1];
    for item in items.iter() {
        let (count, extent) = &mut cells[cell(item).min(CUTS)];
        *count += 1;
        *extent = extent.with(&item.extent);
    }
    // The rays that meet a box are as its surface; each looks at what is within.
    let price = |cells: &[(usize, Extent)]| {
        let (count, extent) =
            cells.iter().fold((0, Extent::EMPTY), |sum, cell| (sum.0 + cell.0, sum.1.with(&cell.1)));
        (count > 0).then(|| count as f64 * extent.surface())
    };
    let prices = (1..=CUTS).filter_map(|cut| Some((cut, price(&cells[..cut])? + price(&cells[cut..])?)));
    let Some((cut, _)) = prices.min_by(|(_, a), (_, b)| a.total_cmp(b)) else {
        // They lie in one place.
        return items.split_at_mut(items.len() / 2);
    };
    items.sort_by_key(|item| cell(item) >= cut);
    items.split_at_mut(cells[..cut].iter().map(|(count, _)| count).sum())
}
