//! RRT-Connect, RRT*, Informed RRT*.
