//! flexura.
