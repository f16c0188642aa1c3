//! Tables whose columns line up.

use crate::screen::{BOLD, shortened, styled};
use flexura::model::visible;

/// Characters of the longest name: one that is longer would push its row off the screen.
const LONGEST: usize = 60;

/// A table with a heading over each column; the first column names the rows.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(headings: &[&str]) -> Self {
        Self { rows: vec![headings.iter().map(|heading| shortened(&visible(heading), LONGEST)).collect()] }
    }

    pub fn row(&mut self, mut cells: Vec<String>) {
        if let Some(name) = cells.first_mut() {
            *name = shortened(name, LONGEST);
        }
        self.rows.push(cells.iter().map(|cell| visible(cell).into_owned()).collect());
    }

    pub fn is_empty(&self) -> bool {
        self.rows.len() == 1
    }

    /// Keeps the first `most` rows and says how many more there are; a network would fill the screen.
    pub fn shortened(mut self, most: usize) -> Self {
        let more = (self.rows.len() - 1).saturating_sub(most);
        if more > 0 {
            self.rows.truncate(1 + most);
            self.rows.push(vec![format!("... and {more} more")]);
        }
        self
    }

    /// The text, headings in bold, rows indented by two.
    pub fn render(&self) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let cells = self.rows.iter().enumerate();
            cells
                .filter_map(|(i, row)| row.get(column).map(|cell| indent(i, column) + cell.chars().count()))
                .max()
                .unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut text = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            let mut line = String::new();
            for (column, cell) in row.iter().enumerate() {
                let used = indent(i, column) + cell.chars().count();
                line.extend(std::iter::repeat_n(' ', indent(i, column)));
                line.push_str(cell);
                line.extend(std::iter::repeat_n(' ', widths[column] - used + 2));
            }
            let line = line.trim_end();
            if i == 0 {
                text += &styled(BOLD, line)
            } else {
                text += line
            }
            text.push('\n');
        }
        text
    }
}

fn indent(row: usize, column: usize) -> usize {
    if row > 0 && column == 0 { 2 } else { 0 }
}
