//! The tree of fronts: what is eliminated where, and what it touches.

use super::BlockPlace;
use super::ordering::{Graph, dissect};
use super::pattern::Pattern;
use std::ops::Range;

/// One step of the elimination: its own unknowns, and the later ones that they touch.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Into [`Tree::unknowns`]: its own, then the boundary.
    pub own: Range<usize>,
    pub boundary: Range<usize>,
    /// Into [`Tree::entries`].
    pub entries: Range<usize>,
    /// Fronts right before this one that hand their remainder to it.
    pub children: usize,
    pub is_root: bool,
}

/// The fronts, children before their parents. A matrix of several independent parts has several roots.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub unknowns: Vec<u32>,
    /// Row and number of the entries of the matrix that enter at each front.
    pub entries: Vec<(u32, u32)>,
    /// Numbers in the factors, if no pivot is delayed.
    pub fill: usize,
    /// Rows of all fronts together, likewise.
    pub rows: usize,
    /// Most numbers that wait at a time, likewise.
    pub stack: usize,
}

impl Tree {
    /// Orders the unknowns of a matrix.
    pub fn new(pattern: &Pattern, blocks: &[BlockPlace]) -> Self {
        let block_of = block_of(pattern.size(), blocks);
        let graph = graph(pattern, blocks, &block_of);
        let groups = dissect(&graph);
        let mut group_of = vec![0; blocks.len()];
        let mut rank = vec![0; blocks.len()];
        for (k, &i) in groups.iter().flatten().enumerate() {
            rank[i as usize] = k as u32;
        }
        for (g, group) in groups.iter().enumerate() {
            for &i in group {
                group_of[i as usize] = g;
            }
        }

        let (boundaries, children) = boundaries(&graph, &groups, &group_of, &rank);
        let is_root: Vec<bool> = boundaries.iter().map(Vec::is_empty).collect();
        let order = postorder(&children, &is_root);
        let mut tree = Self::default();
        let mut place = vec![0; groups.len()];
        let (mut waiting, mut height) = (Vec::new(), 0);
        for (k, &g) in order.iter().enumerate() {
            place[g] = k;
            let start = tree.unknowns.len();
            tree.extend(&groups[g], blocks);
            let middle = tree.unknowns.len();
            tree.extend(&boundaries[g], blocks);
            tree.nodes.push(Node {
                own: start..middle,
                boundary: middle..tree.unknowns.len(),
                entries: 0..0,
                children: children[g].len(),
                is_root: is_root[g],
            });
            let (own, rest) = (middle - start, tree.unknowns.len() - middle);
            tree.fill += own * (own + 2 * rest);
            tree.rows += own + rest;
            height -= waiting.drain(waiting.len() - children[g].len()..).sum::<usize>();
            if !is_root[g] {
                waiting.push(rest * rest);
                height += rest * rest;
            }
            tree.stack = tree.stack.max(height);
        }
        // An entry enters where the first of its two unknowns is eliminated.
        let node_of = |unknown: usize| place[group_of[block_of[unknown] as usize]];
        tree.enter(pattern, &node_of);
        tree
    }

    fn extend(&mut self, group: &[u32], blocks: &[BlockPlace]) {
        for &i in group {
            let block = &blocks[i as usize];
            self.unknowns.extend(block.first as u32..(block.first + block.count) as u32);
        }
    }

    fn enter(&mut self, pattern: &Pattern, node_of: &impl Fn(usize) -> usize) {
        let mut counts = vec![0; self.nodes.len()];
        for i in 0..pattern.size() {
            let row = node_of(i);
            for &j in pattern.row(i).0 {
                counts[row.min(node_of(j as usize))] += 1;
            }
        }
        let mut total = 0;
        for (node, count) in self.nodes.iter_mut().zip(&counts) {
            node.entries = total..total;
            total += count;
        }
        self.entries.resize(total, (0, 0));
        for i in 0..pattern.size() {
            let row = node_of(i);
            for (k, &j) in pattern.row(i).0.iter().enumerate() {
                let end = &mut self.nodes[row.min(node_of(j as usize))].entries.end;
                self.entries[*end] = (i as u32, (pattern.start(i) + k) as u32);
                *end += 1;
            }
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        super::bytes(&self.nodes) + super::bytes(&self.unknowns) + super::bytes(&self.entries)
    }
}

fn block_of(n: usize, blocks: &[BlockPlace]) -> Vec<u32> {
    let mut result = vec![0; n];
    for (i, block) in blocks.iter().enumerate() {
        result[block.first..block.first + block.count].fill(i as u32);
    }
    result
}

/// Which blocks touch which, by entries on either side of the diagonal.
fn graph(pattern: &Pattern, blocks: &[BlockPlace], block_of: &[u32]) -> Graph {
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    let mut seen = vec![u32::MAX; blocks.len()];
    for (i, block) in blocks.iter().enumerate() {
        let i = i as u32;
        seen[i as usize] = i;
        for row in block.first..block.first + block.count {
            for &column in pattern.row(row).0 {
                let j = block_of[column as usize];
                if seen[j as usize] != i {
                    seen[j as usize] = i;
                    pairs.push((i, j));
                }
            }
        }
    }
    let mut starts = vec![0; blocks.len() + 1];
    for &(i, j) in &pairs {
        starts[i as usize + 1] += 1;
        starts[j as usize + 1] += 1;
    }
    for i in 0..blocks.len() {
        starts[i + 1] += starts[i];
    }
    let mut next = starts.clone();
    let mut both = vec![0; 2 * pairs.len()];
    for (i, j) in pairs {
        for (from, to) in [(i, j), (j, i)] {
            both[next[from as usize]] = to;
            next[from as usize] += 1;
        }
    }
    let mut graph = Graph {
        weights: blocks.iter().map(|block| block.count as u32).collect(),
        places: blocks.iter().map(|block| block.place).collect(),
        ..Graph::default()
    };
    graph.starts.push(0);
    for i in 0..blocks.len() {
        let list = &mut both[starts[i]..starts[i + 1]];
        list.sort_unstable();
        let first = graph.neighbours.len();
        for &j in list.iter() {
            if graph.neighbours.len() == first || graph.neighbours.last() != Some(&j) {
                graph.neighbours.push(j);
            }
        }
        graph.starts.push(graph.neighbours.len());
    }
    graph
}

/// What the front of each group touches once the fronts before it are gone, in order of elimination, and which
/// fronts hand their remainder to it: those whose boundary begins there.
fn boundaries(
    graph: &Graph,
    groups: &[Vec<u32>],
    group_of: &[usize],
    rank: &[u32],
) -> (Vec<Vec<u32>>, Vec<Vec<usize>>) {
    let mut boundaries: Vec<Vec<u32>> = Vec::with_capacity(groups.len());
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); groups.len()];
    let mut seen = vec![usize::MAX; rank.len()];
    for (g, group) in groups.iter().enumerate() {
        let mut boundary = Vec::new();
        let mut touch = |i: u32| {
            if group_of[i as usize] > g && seen[i as usize] != g {
                seen[i as usize] = g;
                boundary.push(i);
            }
        };
        for &i in group {
            graph.neighbours(i).iter().for_each(|&j| touch(j));
        }
        for &child in &children[g] {
            boundaries[child].iter().for_each(|&j| touch(j));
        }
        boundary.sort_unstable_by_key(|&i| rank[i as usize]);
        if let Some(&first) = boundary.first() {
            children[group_of[first as usize]].push(g);
        }
        boundaries.push(boundary);
    }
    (boundaries, children)
}

/// Children before parents, each tree and each branch in one piece.
fn postorder(children: &[Vec<usize>], is_root: &[bool]) -> Vec<usize> {
    // Parents first, then turned round.
    let mut order = Vec::with_capacity(children.len());
    let mut waiting: Vec<usize> = (0..children.len()).filter(|&g| is_root[g]).collect();
    while let Some(g) = waiting.pop() {
        order.push(g);
        waiting.extend(&children[g]);
    }
    order.reverse();
    order
}
