//! Prints the reference page of model files.

#![expect(clippy::print_stdout, reason = "printing is all it does")]

fn main() {
    print!("{}", flexura_modelfile::reference_markdown());
}
