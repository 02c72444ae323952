//! Artificial potential field (Khatib 1986): the robot slides down a potential
//! that is low at the goal and high beside obstacles.
//!
//! With lengths in units of the reach ρ0 of the obstacles, d the distance to the
//! goal and ρ the clearance to an obstacle (the field's border counts as four),
//!
//! - Uₐ = ½ ξ d² for d ≤ d\*, ξ (d\* d − ½ d\*²) beyond: a pull ξ·min(d, d\*),
//! - Uᵣ = ½ η (1/ρ − 1)² for ρ ≤ 1, else 0, for every obstacle (FIRAS),
//!
//! and a step of fixed length follows F = −∇(Uₐ + Σ Uᵣ). It is the
//! textbook's method with its textbook faults, which this crate shows rather
//! than hides:
//!
//! - **Local minima.** In a U of obstacles, or head-on before a single one, the
//!   forces cancel away from the goal. The status is `NotFound`, the path empty,
//!   and [`Plan::terms`](planner_api::Plan::terms) say where: `stuck_x`, `stuck_y`.
//! - **Goals beside obstacles** (GNRON, "goals non-reachable with obstacles
//!   nearby"). Within ρ0 of an obstacle the repulsion moves the minimum off the
//!   goal. Ge & Cui's potential mends this and no more: [`Repulsion::GeCui`].
//! - **Oscillation** in narrow passages, where a step overshoots the valley.
//!
//! Among obstacles that move it is another field: [`moving`].
//!
//! Sources: O. Khatib, *Real-time obstacle avoidance for manipulators and mobile
//! robots*, IJRR 5(1):90–98, 1986, DOI 10.1177/027836498600500106 (FIRAS potential);
//! J.-C. Latombe, *Robot Motion Planning*, 1991, ch. 7 (steps of fixed length; the
//! conic well, which stands for Khatib's limit on the commanded velocity);
//! S. S. Ge & Y. J. Cui, *New potential functions for mobile robot path planning*,
//! IEEE Trans. Robotics and Automation 16(5):615–620, 2000, DOI 10.1109/70.880813.

mod clearance;
mod descent;
mod field;
pub mod moving;
mod settings;

pub use clearance::{Clearance, clearance};
pub use descent::PotentialField;
pub use field::Field;
pub use moving::{MovingPotentialField, MovingPotentialFieldSettings};
pub use settings::{PotentialFieldSettings, Repulsion};
