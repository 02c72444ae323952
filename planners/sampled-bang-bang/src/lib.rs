//! Sampled bang-bang trajectories, checked in time.
