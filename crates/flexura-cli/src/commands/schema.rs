//! `flexura schema`

use crate::failure::Failure;
use crate::screen;

pub fn run() -> Result<(), Failure> {
    screen::print_table(&format!("{}\n", flexura::modelfile::schema().trim_end()))
}
