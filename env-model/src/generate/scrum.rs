//! `scrum`: a dense cluster round the middle of the straight line, the rest scattered.
//!
//! The cluster's places are drawn as c + ρ v |v|^½ with v uniform in the unit disc,
//! denser towards its middle; ρ is such that inflated robots would cover about 60 %
//! of it, so some gaps let a robot through and others do not.

use super::ROBOT_RADIUS;
use super::crowd::Crowd;
use super::draw::Draw;
use crate::{Scene, Vector};

/// Share of the cluster's disc that inflated robots would cover, overlaps counted twice.
const COVERED: f64 = 0.6;

pub(super) fn draw(draw: &mut Draw, count: usize) -> Option<Scene> {
    let mut crowd = Crowd::new(draw, count);
    let fighting = (2 * count).div_ceil(3);
    let middle = nalgebra::center(&crowd.start, &crowd.goal);
    let mut radius = 2.0 * ROBOT_RADIUS * (fighting as f64 / COVERED).sqrt();
    let aside = Vector::new(0.0, draw.between(-0.4, 0.4) * radius);
    while crowd.len() < fighting {
        let v = draw.in_unit_disc();
        let place = middle + aside + v * (v.norm().sqrt() * radius);
        if !crowd.try_add(place, ROBOT_RADIUS) {
            // A full cluster slowly gives way rather than loops for ever.
            radius *= 1.0 + 0.05 / fighting as f64;
            if radius > crowd.half().x {
                return None;
            }
        }
    }
    crowd.scatter(draw, count)?;
    Some(crowd.into_scene())
}
