//! The smooth objective, on vertices in the plane.

use env_model::{Point, path_length};

use crate::settings::{Objective, Settings};

/// J = `w_length`·‖D₁p‖²/Δ + `w_smooth`·‖D₂p‖² + `w_reference`·‖p − p₀‖², Δ = |goal − start|/segments.
///
/// On equidistant columns D₁p has the constant part Δ along start → goal and
/// D₂p none, so there J is that of the heights plus `w_length`·|goal − start|.
/// The form is that of Apollo's `FEM_POS_DEVIATION` smoother.
pub(crate) fn smooth_cost(path: &[Point], reference: &[Point], settings: &Settings) -> f64 {
    let spacing = mean_spacing(path);
    let first: f64 = path.windows(2).map(|w| (w[1] - w[0]).norm_squared()).sum();
    let second: f64 = path.windows(3).map(|w| ((w[2] - w[1]) - (w[1] - w[0])).norm_squared()).sum();
    let away: f64 = path.iter().zip(reference).map(|(p, q)| (p - q).norm_squared()).sum();
    settings.w_length / spacing * first + settings.w_smooth * second + settings.w_reference * away
}

/// Δ = |goal − start|/segments.
pub(crate) fn mean_spacing(path: &[Point]) -> f64 {
    (path[path.len() - 1] - path[0]).norm() / (path.len() - 1) as f64
}

/// The cost of a free path by the objective of `settings`.
pub(crate) fn cost(path: &[Point], reference: &[Point], settings: &Settings) -> f64 {
    match settings.objective {
        Objective::Shorten => path_length(path),
        Objective::Smooth => smooth_cost(path, reference, settings),
    }
}
