//! Statistics on plain numbers, in which a failure is +∞ and takes part.
//!
//! Every function takes values without NaN and then answers without NaN: what is not defined (no values, too few
//! values) is `None`. ±∞ are ordinary values, larger or smaller than all others and tied with themselves.

pub mod bootstrap;
mod distributions;
pub mod effect_size;
pub mod friedman;
pub mod holm;
pub mod median_interval;
pub mod nemenyi;
pub mod outliers;
mod quantile;
mod ranks;
pub mod spearman;
pub mod wilcoxon;
mod wilson;

pub use quantile::{median, quantile};
pub use wilson::wilson;
