//! Genetic planners: paths of cells, sequences of vertices (Fang 2009, ch. 4).
