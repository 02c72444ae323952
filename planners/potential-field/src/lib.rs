//! Artificial potential field (Khatib 1986).
