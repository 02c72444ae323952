//! Writes a report whose planners are made up, one for each kind of own picture, to look at the
//! drawing without running planners: `cargo run -p eval --example pictures_demo -- DIR`.

use std::path::Path;

use env_model::scene::Field;
use env_model::{Aabb, CellGrid, Columns, Obstacle, Point, Scene, Vector, World, path_length};
use eval::report::{Language, html};
use eval::results::{Manifest, Optimum, PlannerInfo, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject};
use eval::snapshot::{Ruler, Snapshot, state};
use planner_api::seed::splitmix64;
use planner_api::{Candidates, CellState, CellsView, ForcesView, Frame, PopulationView, SwarmView, TreeView, View};

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        (splitmix64(&mut self.0) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn pitch() -> Scene {
    let mut random = Random(5);
    let obstacles = (0..11)
        .map(|_| Obstacle::disc(Point::new(70.0 * random.next() - 30.0, 56.0 * random.next() - 28.0), 1.2))
        .filter(|o| {
            World::new(&Scene { obstacles: vec![o.clone()], ..bare() })
                .is_ok_and(|w| w.path_free(&[bare().start(), bare().goal()]))
        })
        .collect();
    Scene { obstacles, ..bare() }
}

fn bare() -> Scene {
    Scene {
        name: "pitch".into(),
        unit: "m".into(),
        robot_radius: 0.5,
        start: [-30.0, -5.0],
        goal: [50.0, 0.0],
        field: Some(Field { min: [-57.5, -39.0], max: [57.5, 39.0] }),
        obstacles: Vec::new(),
    }
}

struct Demo<'a> {
    scene: &'a Scene,
    world: World,
    ruler: Ruler,
    results: Results,
}

impl Demo<'_> {
    /// A planner with one run along `path`, and its snapshot of `view`.
    fn add(&mut self, label: &str, path: &[Point], terms: &[(&str, f64)], view: Option<View<'_>>, generations: usize) {
        let valid = !path.is_empty() && self.world.path_free(path);
        let length = path_length(path);
        self.results.planners.push(PlannerInfo::plain(label, "demo", ""));
        self.results.runs.push(RunRecord {
            scene: self.scene.name.clone(),
            planner: label.into(),
            repeat: 0,
            seed: 7,
            status: if valid { RunStatus::Solved } else { RunStatus::NotFound },
            valid,
            length: Some(length).filter(|l| *l > 0.0),
            gap: None,
            clearance_min: None,
            turning: None,
            iterations: 100,
            evaluations: 2000,
            collision_checks: 1,
            time_us: 100.0,
            cpu_us: 100.0,
            error: None,
            cost: None,
            terms: terms.iter().map(|(n, v)| ((*n).to_owned(), *v)).collect(),
            path: path.to_vec(),
            progress: Vec::new(),
            overhead_us: None,
            moving: None,
            tuning: None,
        });
        let Some(view) = view else { return };
        let frame = Frame { stage: "demo", iteration: 100, evaluations: 2000, best_cost: 1.0, view };
        let Some(state) = state(&frame, &self.ruler) else { return };
        let text = serde_json::to_string(&state).map_or(0, |s| s.len());
        println!("{label}: snapshot {:.0} kB", text as f64 / 1e3);
        self.results.snapshots.push(Snapshot {
            scene: self.scene.name.clone(),
            planner: label.into(),
            repeat: 0,
            seed: 7,
            stage: "demo".into(),
            iteration: 100,
            evaluations: 2000,
            faithful: true,
            ruler: self.ruler,
            state,
            generations: (0..generations as u64)
                .map(|k| (k, 0.02 - 0.01 / (1.0 + 0.1 * k as f64), 0.012 - 0.008 / (1.0 + 0.05 * k as f64)))
                .collect(),
        });
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "pictures-demo".to_owned());
    let scene = pitch();
    let world = World::new(&scene)?;
    let (a, b) = (scene.start(), scene.goal());
    let path = vec![a, Point::new(-20.0, -14.0), Point::new(-5.0, -12.0), Point::new(20.0, -6.0), b];
    let results = Results {
        name: "pictures".into(),
        seed: 1,
        repeats: 1,
        subject: Subject::Paths,
        protocol: String::new(),
        planners: Vec::new(),
        scenes: vec![SceneResult {
            scene: scene.clone(),
            optimum: Optimum { length: None, path: Vec::new(), reason: Some("made up".into()) },
            set: SceneSet::Test,
            simulation: None,
        }],
        runs: Vec::new(),
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest: Manifest::default(),
    };
    let mut demo = Demo { scene: &scene, world: World::new(&scene)?, ruler: Ruler::new(&scene), results };
    let mut random = Random(9);
    cells(&mut demo, &world, &path);
    trees(&mut demo, &path, &mut random);
    swarm_and_population(&mut demo, &path, &mut random);
    forces(&mut demo, &world);
    for k in 0..=10 {
        let s = f64::from(k) / 10.0;
        let (length, risk) = (120.0 - 38.0 * s.sqrt(), 300.0 + 2200.0 * s * s);
        let terms = [("length", length.round()), ("risk", if k == 5 { 1400.0 } else { risk })];
        demo.add(&format!("a = {s:.1}"), &path, &terms, None, 0);
    }
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    for (file, language) in [("pictures.html", Language::English), ("pictures-zh.html", Language::Chinese)] {
        let page = html(&demo.results, language);
        std::fs::write(folder.join(file), &page)?;
        println!("{file}: {:.2} MB", page.len() as f64 / 1e6);
    }
    Ok(())
}

fn cells(demo: &mut Demo<'_>, world: &World, path: &[Point]) {
    let extent: Aabb = world.extent();
    let (a, b) = (path[0], path[path.len() - 1]);
    let foes: Vec<Point> = world.obstacles().iter().map(|o| o.aabb().centre()).collect();
    for (label, columns, rows) in [("influence-astar", 61, 36), ("fine-risk", 128, 128)] {
        let grid = CellGrid::covering(&extent, columns, rows);
        let mut blocked = Vec::new();
        grid.occupy(world, &mut blocked);
        let centre = |c: usize| grid.centre(c);
        let risk = |c: usize| {
            let p = centre(c);
            let level = foes.iter().filter(|f| (p - **f).norm() < (p - a).norm()).count() as f64;
            let near = foes.iter().map(|f| (p - f).norm() / grid.size()).fold(f64::INFINITY, f64::min);
            5.0 * level
                + if near < 0.7 {
                    100.0
                } else if near < 1.7 {
                    60.0
                } else if near < 2.7 {
                    30.0
                } else {
                    0.0
                }
        };
        let values: Vec<f64> = (0..grid.len()).map(risk).collect();
        let reach = |c: usize| (centre(c) - a).norm() + 1.5 * (centre(c) - b).norm();
        let limit = 1.32 * (b - a).norm();
        let states: Vec<CellState> = (0..grid.len())
            .map(|c| match reach(c) / limit {
                _ if blocked[c] => CellState::Untouched,
                r if r < 1.1 => CellState::Closed,
                r if r < 1.15 => CellState::Open,
                _ => CellState::Untouched,
            })
            .collect();
        let borders: Vec<(Point, Point)> = foes
            .iter()
            .filter_map(|f| {
                let (middle, d) = (a + 0.5 * (f - a), f - a);
                let along = Vector::new(-d.y, d.x) / d.norm();
                // Cut to the field by sampling: good enough to look at.
                let inside = |s: &f64| extent.depth_of(middle + *s * along) >= 0.0;
                let steps: Vec<f64> = (-400..=400).map(|k| 0.5 * f64::from(k)).filter(inside).collect();
                Some((middle + *steps.first()? * along, middle + *steps.last()? * along))
            })
            .collect();
        let view = CellsView {
            grid: &grid,
            blocked: &blocked,
            states: &states,
            values: &values,
            quantity: "risk",
            borders: &borders,
            path,
        };
        demo.add(label, path, &[("length", 90.0), ("risk", 2600.0)], Some(View::Cells(view)), 0);
    }
    let grid = CellGrid::along_longer_side(&extent, 64);
    let mut blocked = Vec::new();
    grid.occupy(world, &mut blocked);
    let activity: Vec<f64> = (0..grid.len())
        .map(|c| if blocked[c] { -0.9 } else { libm::exp(-0.9 * (grid.centre(c) - b).norm()) })
        .collect();
    let states: Vec<CellState> = (0..grid.len())
        .map(|c| match (grid.centre(c) - a).norm() {
            _ if blocked[c] => CellState::Untouched,
            d if d < 30.0 => CellState::Closed,
            d if d < 32.0 => CellState::Open,
            _ => CellState::Untouched,
        })
        .collect();
    let base = CellsView {
        grid: &grid,
        blocked: &blocked,
        states: &[],
        values: &activity,
        quantity: "activity",
        borders: &[],
        path,
    };
    demo.add("neural", path, &[], Some(View::Cells(base)), 0);
    let astar = CellsView { states: &states, values: &[], quantity: "", ..base };
    demo.add("astar", path, &[], Some(View::Cells(astar)), 0);
    let distance: Vec<f64> = (0..grid.len())
        .map(|c| if states[c] == CellState::Untouched { f64::INFINITY } else { (grid.centre(c) - a).norm() })
        .collect();
    let dijkstra = CellsView { states: &states, values: &distance, quantity: "distance", ..base };
    demo.add("dijkstra", path, &[], Some(View::Cells(dijkstra)), 0);
}

fn trees(demo: &mut Demo<'_>, path: &[Point], random: &mut Random) {
    let mut grow = |root: Point, count: usize| {
        let (mut nodes, mut parents) = (vec![root], vec![0_u32]);
        while nodes.len() < count {
            let p = Point::new(115.0 * random.next() - 57.5, 78.0 * random.next() - 39.0);
            // A random subset of the nodes keeps this from being quadratic.
            let some = nodes.len().min(60);
            let near = (0..some)
                .map(|_| (random.next() * nodes.len() as f64) as usize)
                .min_by(|i, j| (nodes[*i] - p).norm().total_cmp(&(nodes[*j] - p).norm()))
                .unwrap_or(0);
            let d = p - nodes[near];
            let step = if d.norm() > 3.0 { d * (3.0 / d.norm()) } else { d };
            nodes.push(nodes[near] + step);
            parents.push(near as u32);
        }
        (nodes, parents)
    };
    let (a, b) = (path[0], path[path.len() - 1]);
    let pair = [grow(a, 120), grow(b, 90)];
    let views: Vec<TreeView<'_>> = pair.iter().map(|(nodes, parents)| TreeView { nodes, parents }).collect();
    demo.add("rrt-connect", path, &[], Some(View::Trees(&views)), 0);
    let (nodes, parents) = grow(a, 20_000);
    demo.add("rrt-star", path, &[], Some(View::Trees(&[TreeView { nodes: &nodes, parents: &parents }])), 0);
}

fn swarm_and_population(demo: &mut Demo<'_>, path: &[Point], random: &mut Random) {
    let columns = Columns::new(path[0], path[path.len() - 1], 20);
    let mut heights = |spread: f64| -> Vec<f64> {
        (0..20)
            .flat_map(|_| {
                let bow = spread * (random.next() - 0.5);
                (1..=20).map(move |i| bow * libm::sin(std::f64::consts::PI * f64::from(i) / 21.0)).collect::<Vec<_>>()
            })
            .collect()
    };
    let (positions, bests) = (heights(40.0), heights(12.0));
    let view = SwarmView {
        columns: &columns,
        positions: &positions,
        velocities: &positions,
        personal_bests: &bests,
        personal_costs: &[1.0; 20],
        global_best: &bests[..20],
        global_cost: 1.0,
    };
    demo.add("pso", path, &[], Some(View::Swarm(view)), 0);
    let grid = CellGrid::along_longer_side(&demo.world.extent(), 30);
    let mut paths = Candidates::default();
    for _ in 0..60 {
        let mut line = path.to_vec();
        let middle = line.len() - 1;
        for p in &mut line[1..middle] {
            *p =
                grid.centre(grid.cell_at(*p + Vector::new(14.0 * (random.next() - 0.5), 22.0 * (random.next() - 0.5))));
        }
        paths.push(line);
    }
    let view = PopulationView { paths: &paths, fitness: &[1.0; 60], grid: Some(&grid), best: path };
    demo.add("grid-ga", path, &[], Some(View::Population(view)), 120);
    demo.add("vertex-ga", path, &[], Some(View::Population(PopulationView { grid: None, ..view })), 60);
}

fn forces(demo: &mut Demo<'_>, world: &World) {
    let grid = CellGrid::along_longer_side(&world.extent(), 40);
    let (a, b) = (demo.scene.start(), demo.scene.goal());
    let force = |p: Point| {
        if world.nearest_obstacle(p).is_some_and(|(d, _)| d <= 0.0) {
            return Vector::zeros();
        }
        let mut f = (b - p) / (b - p).norm();
        for o in world.obstacles() {
            let away = p - o.aabb().centre();
            let rho = away.norm() - o.radius;
            if rho < 8.0 {
                f += away / away.norm() * (30.0 * (1.0 / rho - 1.0 / 8.0) / (rho * rho)).min(50.0);
            }
        }
        f
    };
    let forces: Vec<Vector> = (0..grid.len()).map(|c| force(grid.centre(c))).collect();
    let mut trail = vec![a];
    let mut p = a;
    for _ in 0..60 {
        let f = force(p);
        p += f / f.norm() * 0.8;
        trail.push(p);
    }
    let view = ForcesView { grid: &grid, forces: &forces, trail: &trail, stuck: Some(p) };
    demo.add("potential-field", &[], &[], Some(View::Forces(view)), 0);
}
