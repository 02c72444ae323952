//! Integration tests of the whole project live in `suite/`; reference scenes in `reference/`.
