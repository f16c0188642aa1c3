//! Where the numbers of a sparse matrix stand, and their assembly.

/// One call of [`Pattern::add`] and the slot that it goes to.
#[derive(Clone, Copy, Debug)]
struct Call {
    row: u32,
    column: u32,
    slot: u32,
}

/// The entries of a square matrix by rows, columns ascending, and the sequence of calls that filled them.
///
/// An assembly repeats the calls of the one before, so the k-th call finds its slot in a list. Where it differs
/// the rest of the list is forgotten and learnt anew by searching; an entry that is nowhere to be found waits
/// behind the others until [`Pattern::settle`].
#[derive(Debug, Default)]
pub(super) struct Pattern {
    n: usize,
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    calls: Vec<Call>,
    cursor: usize,
    /// Row and column of the values behind `columns.len()`; may repeat.
    waiting: Vec<(u32, u32)>,
}

impl Clone for Pattern {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, from: &Self) {
        self.n = from.n;
        self.cursor = from.cursor;
        self.starts.clone_from(&from.starts);
        self.columns.clone_from(&from.columns);
        self.values.clone_from(&from.values);
        self.calls.clone_from(&from.calls);
        self.waiting.clone_from(&from.waiting);
    }
}

impl Pattern {
    /// Forgets everything.
    pub fn arrange(&mut self, n: usize) {
        self.n = n;
        self.starts.clear();
        self.starts.resize(n + 1, 0);
        self.columns.clear();
        self.values.clear();
        self.calls.clear();
        self.waiting.clear();
        self.cursor = 0;
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.n
    }

    /// Sets all values to zero and starts an assembly.
    pub fn reset(&mut self) {
        self.values.fill(0.0);
        self.cursor = 0;
    }

    /// Adds to one entry.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if let Some(call) = self.calls.get(self.cursor)
            && (call.row as usize, call.column as usize) == (row, column)
        {
            self.values[call.slot as usize] += value;
        } else {
            self.learn(row, column, value);
        }
        self.cursor += 1;
    }

    /// [`Pattern::add`] off the beaten track.
    #[inline(never)]
    fn learn(&mut self, row: usize, column: usize, value: f64) {
        assert!(row < self.n && column < self.n, "entry ({row}, {column}) of {} unknowns", self.n);
        self.calls.truncate(self.cursor);
        let (start, end) = (self.starts[row], self.starts[row + 1]);
        let slot = match self.columns[start..end].binary_search(&(column as u32)) {
            Ok(k) => {
                self.values[start + k] += value;
                start + k
            }
            Err(_) => {
                self.waiting.push((row as u32, column as u32));
                self.values.push(value);
                self.values.len() - 1
            }
        };
        self.calls.push(Call { row: row as u32, column: column as u32, slot: slot as u32 });
    }

    /// Merges the entries that wait. True if there were any.
    pub fn settle(&mut self) -> bool {
        if self.waiting.is_empty() {
            return false;
        }
        let mut places: Vec<(u32, u32)> = Vec::with_capacity(self.values.len());
        for i in 0..self.n {
            places.extend(self.row(i).0.iter().map(|&j| (i as u32, j)));
        }
        places.append(&mut self.waiting);
        let by_column = sorted(self.n, &places, &(0..places.len() as u32).collect::<Vec<_>>(), |p| p.1);
        let by_row = sorted(self.n, &places, &by_column, |p| p.0);

        let mut slot_of = vec![0; places.len()];
        let mut values: Vec<f64> = Vec::with_capacity(places.len());
        self.columns.clear();
        self.starts.fill(0);
        let mut last = None;
        for &old in &by_row {
            let place = places[old as usize];
            if last != Some(place) {
                last = Some(place);
                values.push(0.0);
                self.columns.push(place.1);
                self.starts[place.0 as usize + 1] += 1;
            }
            let slot = values.len() - 1;
            values[slot] += self.values[old as usize];
            slot_of[old as usize] = slot as u32;
        }
        for i in 0..self.n {
            self.starts[i + 1] += self.starts[i];
        }
        self.values = values;
        for call in &mut self.calls {
            call.slot = slot_of[call.slot as usize];
        }
        self.calls.shrink_to_fit();
        true
    }

    /// Columns and values of row `i`, of the entries that are settled.
    pub fn row(&self, i: usize) -> (&[u32], &[f64]) {
        let (start, end) = (self.starts[i], self.starts[i + 1]);
        (&self.columns[start..end], &self.values[start..end])
    }

    /// Number of the first entry of row `i`.
    pub fn start(&self, i: usize) -> usize {
        self.starts[i]
    }

    /// Column and value of entry number `slot`.
    pub fn entry(&self, slot: usize) -> (usize, f64) {
        (self.columns[slot] as usize, self.values[slot])
    }

    /// Calls `f(row, column, value)` for every entry. What waits may come in several pieces.
    pub fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        for i in 0..self.n {
            let (columns, values) = self.row(i);
            for (&j, &value) in columns.iter().zip(values) {
                f(i, j as usize, value);
            }
        }
        for (&(i, j), &value) in self.waiting.iter().zip(&self.values[self.columns.len()..]) {
            f(i as usize, j as usize, value);
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        super::bytes(&self.starts)
            + super::bytes(&self.columns)
            + super::bytes(&self.values)
            + super::bytes(&self.calls)
            + super::bytes(&self.waiting)
    }
}

/// The numbers `order` sorted by a key below `n`, equals in their order.
fn sorted(n: usize, places: &[(u32, u32)], order: &[u32], key: impl Fn(&(u32, u32)) -> u32) -> Vec<u32> {
    let mut next = vec![0_usize; n + 1];
    for place in places {
        next[key(place) as usize + 1] += 1;
    }
    for i in 0..n {
        next[i + 1] += next[i];
    }
    let mut result = vec![0; order.len()];
    for &k in order {
        let at = &mut next[key(&places[k as usize]) as usize];
        result[*at] = k;
        *at += 1;
    }
    result
}
