//! ORCA: optimal reciprocal collision avoidance.
