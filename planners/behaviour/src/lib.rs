//! Behaviour control (Fang 2009, chapter 5) and the genetic algorithm that tunes it.
