//! What every controller of moving robots has round it: [`Replan`] makes one of any planner, and a [`Guard`] answers
//! safely whatever the controller does.

mod escape;
mod foresight;
mod guard;
mod replan;
mod stop;

pub use escape::nearest_free;
pub use foresight::Foresight;
pub use guard::{Answer, Guard, Safety};
pub use replan::Replan;
pub use stop::{stop_after, stop_in_time};
