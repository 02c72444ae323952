//! A*, Dijkstra and Theta* on a cell grid.
