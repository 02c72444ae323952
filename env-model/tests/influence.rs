//! The influence partition against the definition: the level of a point is the
//! number of defenders nearer to it than q.

use env_model::influence::level;
use env_model::{Aabb, Partition, Point};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn pitch() -> Aabb {
    Aabb { min: Point::new(-52.5, -34.0), max: Point::new(52.5, 34.0) }
}

fn random_point(rng: &mut ChaCha8Rng, pitch: &Aabb) -> Point {
    let along = |low: f64, high: f64, u: f64| low + (high - low) * u;
    Point::new(
        along(pitch.min.x, pitch.max.x, rng.random::<f64>()),
        along(pitch.min.y, pitch.max.y, rng.random::<f64>()),
    )
}

/// Distance of `p` to the bisector of `q` and `f`, straight from the definition;
/// +∞ where there is none.
fn to_bisector(p: Point, q: Point, f: Point) -> f64 {
    let apart = (f - q).norm();
    if apart == 0.0 { f64::INFINITY } else { ((p - q).norm_squared() - (p - f).norm_squared()).abs() / (2.0 * apart) }
}

/// What holds for every partition; returns how many of `points` random points were compared.
fn check(pitch: &Aabb, q: Point, defenders: &[Point], points: usize, rng: &mut ChaCha8Rng) -> usize {
    let partition = Partition::new(pitch, q, defenders);
    let n = defenders.len();
    let regions: Vec<_> = partition.regions().collect();
    assert!(!regions.is_empty() && regions.len() <= 1 + n + n * n.saturating_sub(1) / 2, "{} regions", regions.len());

    // Each area is a sum of products of coordinates differing by less than the
    // pitch's sides, rounded at 1e-16; 1e-12 allows for thousands of them.
    let area = pitch.size().x * pitch.size().y;
    let sum: f64 = regions.iter().map(env_model::Region::area).sum();
    assert!((sum - area).abs() <= 1e-12 * area, "areas sum to {sum}, not {area}");
    assert!(regions.iter().all(|r| r.corners.len() >= 3 && r.corners.len() == r.sides.len() && r.area() > 0.0));

    // Inside every region the level is the definition's.
    for region in &regions {
        let middle = region.corners.iter().map(|p| p.coords).sum::<env_model::Vector>() / region.corners.len() as f64;
        let near = defenders.iter().map(|f| to_bisector(middle.into(), q, *f)).fold(f64::INFINITY, f64::min);
        if near > 1e-8 * pitch.diagonal() {
            assert_eq!(region.level, level(q, defenders, middle.into()));
        }
    }

    // The sides on a bisector tile its way through the pitch, once from either side.
    for border in partition.borders() {
        let ends = [border.from, border.to];
        for p in ends {
            assert!(to_bisector(p, q, defenders[border.defender]) <= 1e-8 * pitch.diagonal());
            assert!((border.a * p.x + border.b * p.y + border.c).abs() <= 1e-8 * pitch.diagonal());
            assert!(pitch.depth_of(p).abs() <= 1e-9 * pitch.diagonal(), "ends on the border of the pitch");
        }
        let f = defenders[border.defender];
        assert!(border.a * f.x + border.b * f.y + border.c > 0.0, "positive on the defender's side");
        assert!(env_model::geometry::cross(ends[1] - ends[0], f - ends[0]) > 0.0, "the defender is on the left");
    }

    let mut compared = 0;
    for _ in 0..points {
        let p = random_point(rng, pitch);
        // Corners this near to a bisector may have been moved onto it.
        if defenders.iter().any(|f| to_bisector(p, q, *f) < 1e-8 * pitch.diagonal()) {
            continue;
        }
        let mut inside = regions.iter().filter(|r| r.contains(p));
        let region = inside.next().unwrap_or_else(|| panic!("{p} is in no region"));
        assert_eq!(region.level, level(q, defenders, p), "at {p}");
        assert!(inside.next().is_none(), "{p} is in two regions");
        compared += 1;
    }
    compared
}

#[test]
fn levels_are_counts_of_nearer_defenders() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let pitch = pitch();
    let mut compared = 0;
    for round in 0..120 {
        let q = random_point(&mut rng, &pitch);
        let defenders: Vec<Point> = (0..round % 12).map(|_| random_point(&mut rng, &pitch)).collect();
        compared += check(&pitch, q, &defenders, 1000, &mut rng);
    }
    assert!(compared >= 100_000, "only {compared} points compared");
}

#[test]
fn sides_on_a_bisector_tile_it_twice() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let pitch = pitch();
    for _ in 0..50 {
        let q = random_point(&mut rng, &pitch);
        let defenders: Vec<Point> = (0..7).map(|_| random_point(&mut rng, &pitch)).collect();
        let partition = Partition::new(&pitch, q, &defenders);
        for border in partition.borders() {
            let mut length = 0.0;
            for region in partition.regions() {
                for (i, side) in region.sides.iter().enumerate() {
                    if *side == Some(border.defender) {
                        length += (region.corners[(i + 1) % region.corners.len()] - region.corners[i]).norm();
                    }
                }
            }
            let through = (border.to - border.from).norm();
            // A few dozen rounded lengths, none above the diagonal.
            assert!((length - 2.0 * through).abs() <= 1e-12 * pitch.diagonal(), "{length} {through}");
        }
    }
}

#[test]
fn two_defenders_worked_by_hand() {
    // q in the middle of a 4 × 4 pitch; bisectors x = 1 (defender right of q) and y = 1.
    let pitch = Aabb { min: Point::new(-2.0, -2.0), max: Point::new(2.0, 2.0) };
    let partition = Partition::new(&pitch, Point::origin(), &[Point::new(0.0, 2.0), Point::new(2.0, 0.0)]);
    let mut found: Vec<(usize, f64)> = partition.regions().map(|r| (r.level, r.area())).collect();
    found.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(found, [(0, 9.0), (1, 3.0), (1, 3.0), (2, 1.0)]);
    let [horizontal, vertical] = partition.borders() else { panic!("two borders") };
    assert_eq!((horizontal.a, horizontal.b, horizontal.c, horizontal.defender), (0.0, 1.0, -1.0, 0));
    assert_eq!((horizontal.from, horizontal.to), (Point::new(-2.0, 1.0), Point::new(2.0, 1.0)));
    assert_eq!((vertical.a, vertical.b, vertical.c, vertical.defender), (1.0, 0.0, -1.0, 1));
    assert_eq!((vertical.from, vertical.to), (Point::new(1.0, 2.0), Point::new(1.0, -2.0)));
}

#[test]
fn degenerate_defenders() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let pitch = pitch();
    let q = Point::new(1.0, 2.0);
    let p = Point::new;
    let cases: [(&str, Vec<Point>, usize); 8] = [
        ("nobody", vec![], 1),
        ("coinciding defenders", vec![p(11.0, 2.0); 3], 2),
        ("a defender at q", vec![q, p(11.0, 2.0), q], 2),
        ("collinear with q", vec![p(11.0, 2.0), p(21.0, 2.0), p(-9.0, 2.0), p(31.0, 2.0)], 5),
        // |f − q| = 2 · 51.5, so that the bisector is the right border x = 52.5; beyond it, no cut.
        ("a bisector along a border", vec![p(104.0, 2.0), p(150.0, 2.0)], 1),
        // f on the other side of the left border is nearer to nothing on the pitch.
        ("a bisector along the other border", vec![p(-106.0, 2.0)], 1),
        // Mirror images of q in lines through the pitch's middle: three bisectors through one point.
        ("concurrent bisectors", vec![p(-1.0, -2.0), p(2.0, 1.0), p(-1.0, 2.0)], 6),
        ("far outside", vec![p(1e6, 2.0), p(1.0, -1e6)], 1),
    ];
    for (name, defenders, regions) in cases {
        assert_eq!(Partition::new(&pitch, q, &defenders).regions().count(), regions, "{name}");
        check(&pitch, q, &defenders, 500, &mut rng);
    }
    // q outside: the whole pitch is nearer to the defender, without a border.
    let outside = Partition::new(&pitch, p(200.0, 0.0), &[p(0.0, 0.0)]);
    assert_eq!(outside.regions().map(|r| r.level).collect::<Vec<_>>(), [1]);
    assert!(outside.borders().is_empty());
}

#[test]
fn any_scale_and_place() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for (scale, offset) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e5)] {
        let move_ = |v: Point| Point::from(v.coords * scale + env_model::Vector::new(offset, -offset));
        let pitch = Aabb { min: move_(pitch().min), max: move_(pitch().max) };
        for _ in 0..10 {
            let q = random_point(&mut rng, &pitch);
            let defenders: Vec<Point> = (0..8).map(|_| random_point(&mut rng, &pitch)).collect();
            let partition = Partition::new(&pitch, q, &defenders);
            for _ in 0..200 {
                let p = random_point(&mut rng, &pitch);
                if defenders.iter().all(|f| to_bisector(p, q, *f) > 1e-7 * pitch.diagonal()) {
                    let levels: Vec<_> = partition.regions().filter(|r| r.contains(p)).map(|r| r.level).collect();
                    assert_eq!(levels, [level(q, &defenders, p)]);
                }
            }
        }
    }
}
