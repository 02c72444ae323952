//! Ant colony on a cell grid.
