//! Space-time A* over safe intervals (SIPP).
