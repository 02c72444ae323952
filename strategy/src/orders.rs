//! What a robot has been told to do, and from when on.

use env_model::Vector;
use env_model::motion::Trajectory;

/// Trajectories in the order of the times at which they take effect. Each overtakes those before it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Orders {
    queue: Vec<(f64, Trajectory)>,
}

impl Orders {
    /// An order given at `now` that takes effect at `then`.
    pub(crate) fn give(&mut self, now: f64, then: f64, trajectory: &Trajectory) {
        // What was overtaken is reused.
        let overtaken = self.queue.get(1).is_some_and(|(since, _)| *since <= now);
        let mut order = if overtaken { self.queue.remove(0).1 } else { Trajectory::default() };
        order.copy_from(trajectory);
        self.queue.push((then, order));
    }

    /// What is in force between `from` and `until`: each trajectory, from which of its own times on, and for how long.
    pub(crate) fn between(&self, from: f64, until: f64) -> impl Iterator<Item = (&Trajectory, f64, f64)> + '_ {
        let ends = self.queue.iter().skip(1).map(|(since, _)| *since).chain([f64::INFINITY]);
        self.queue.iter().zip(ends).filter_map(move |((since, order), end)| {
            let (begin, end) = (since.max(from), end.min(until));
            (end > begin).then(|| (order, begin - since, end - begin))
        })
    }

    /// What is in force at `time`, and which of its own times that is.
    pub(crate) fn at(&self, time: f64) -> Option<(&Trajectory, f64)> {
        self.queue.iter().rev().find(|(since, _)| *since <= time).map(|(since, order)| (order, time - since))
    }

    /// How position and velocity change between `from` and `until`.
    pub(crate) fn change(&self, from: f64, until: f64) -> (Vector, Vector) {
        self.between(from, until).fold((Vector::zeros(), Vector::zeros()), |(way, change), (order, begin, duration)| {
            let [a, b] = [order.state(begin), order.state(begin + duration)];
            (way + (b.position - a.position), change + (b.velocity - a.velocity))
        })
    }
}

#[cfg(test)]
mod tests {
    use env_model::Point;
    use env_model::motion::State;

    use super::*;

    #[test]
    fn later_orders_overtake_at_their_time() {
        let to_the_right =
            |speed| Trajectory::new(State { position: Point::origin(), velocity: Vector::new(speed, 0.0) });
        let mut orders = Orders::default();
        orders.give(0.0, 0.5, &to_the_right(1.0));
        orders.give(0.25, 0.75, &to_the_right(2.0));
        orders.give(0.5, 1.0, &to_the_right(4.0));
        let parts: Vec<_> =
            orders.between(0.25, 2.0).map(|(order, begin, time)| (order.start().velocity.x, begin, time)).collect();
        assert_eq!(parts, [(1.0, 0.0, 0.25), (2.0, 0.0, 0.25), (4.0, 0.0, 1.0)]);
        assert_eq!(orders.change(0.6, 1.5).0.x, 1.0 * 0.15 + 2.0 * 0.25 + 4.0 * 0.5);
        orders.give(0.8, 1.5, &to_the_right(8.0));
        assert_eq!(orders.queue.len(), 3, "the first one's buffer is the last one's");
    }
}
