//! `open`: robots scattered over the pitch, uniformly, as far as they do not overlap.

use super::crowd::Crowd;
use super::draw::Draw;
use crate::Scene;

pub(super) fn draw(draw: &mut Draw, count: usize) -> Option<Scene> {
    let mut crowd = Crowd::new(draw, count);
    crowd.scatter(draw, count)?;
    Some(crowd.into_scene())
}
