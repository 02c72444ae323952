//! The list of planners.

use planner_ant_colony::AntColony;
use planner_api::{Planner, SettingError};

use planner_baseline::{RandomSearch, StraightLine, StraightLineSettings};
use planner_genetic::{GridGa, VertexGa};
use planner_grid_search::GridSearch;
use planner_influence_astar::InfluenceAstar;
use planner_neural::Neural;
use planner_potential_field::PotentialField;
use planner_pso::Pso;
use planner_qp::{Classes, Qp};
use planner_quantum_ga::QuantumGa;
use planner_rrt::{RrtConnect, RrtStar};
use planner_tangent::Tangent;
use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Table;

use crate::Refined;
use crate::build::{BuildError, Settings, build_str};

/// One kind of planner.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name in comparisons.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Whether it claims real time with default settings: in a game of 11 against 11
    /// 999 of 1000 calls overshoot a deadline of 1 ms by less than 0.1 ms of their own
    /// work, and once its buffers have grown it allocates nothing. `cargo bench --bench
    /// deadlines` measures both, a test the second as well. It says nothing of the path.
    pub real_time: bool,
    pub(crate) make: Make,
}

/// Builds a planner from its settings; returns every setting in force as well.
type Make = fn(Settings<'_>) -> Result<(Box<dyn Planner>, Table), BuildError>;

impl Kind {
    /// Every setting at its default; what a bare `[planner.NAME]` builds.
    pub fn defaults(&self) -> Table {
        build_str(self.name, "").expect("defaults are valid").settings
    }
}

/// All kinds, in the order of the documentation.
pub fn kinds() -> &'static [Kind] {
    const KINDS: &[Kind] = &[
        Kind {
            name: "straight-line",
            summary: "The straight segment from start to goal, whatever stands between",
            source: "baseline",
            real_time: true,
            make: |settings| {
                let settings: StraightLineSettings = settings.parse()?;
                Ok((Box::new(StraightLine), table(&settings)))
            },
        },
        Kind {
            name: "random-search",
            summary: "The best of uniform random polylines on the columns of the 2012 paper",
            source: "baseline",
            real_time: false,
            make: |settings| plain(settings, RandomSearch::new),
        },
        Kind {
            name: "pso",
            summary: "Particle swarm on perpendicular columns with a collision penalty (rule = \"inertia\", the paper's, \
                      \"constriction\", \"quantum\", \"spso-2011\" or \"comprehensive\")",
            source: "Lu & Sun 2012, Computer Technology and Development 22(7), 124-127",
            real_time: true,
            make: |settings| {
                let settings = settings.parse::<planner_pso::Settings>()?.filled();
                let planner = Pso::new(settings.clone())?;
                Ok((Box::new(planner), table(&settings)))
            },
        },
        Kind {
            name: "pso-qp",
            summary: "The swarm, then convex refinement of the side classes it has visited (all keys of pso; \
                      classes = \"swarm\" or \"final\"; qp = { other keys of the refinement })",
            source: "Lu & Sun 2012; refinement: Touchline, a convex programme",
            real_time: false,
            make: pso_qp,
        },
        Kind {
            name: "tangent",
            summary: "The exact shortest path round discs, capsules and polygons",
            source: "tangent visibility graph, after arXiv:1103.3911",
            real_time: true,
            make: |settings| plain(settings, Tangent::new),
        },
        Kind {
            name: "astar",
            summary: "A* on a grid of cells with eight moves and no corner cutting",
            source: "Hart, Nilsson & Raphael 1968, IEEE Trans. Systems Science and Cybernetics 4(2), 100-107",
            real_time: true,
            make: |settings| plain(settings, GridSearch::astar),
        },
        Kind {
            name: "dijkstra",
            summary: "Dijkstra's algorithm on the grid of astar",
            source: "Dijkstra 1959, Numerische Mathematik 1, 269-271",
            real_time: false,
            make: |settings| plain(settings, GridSearch::dijkstra),
        },
        Kind {
            name: "theta-star",
            summary: "Basic Theta*: A* on the grid whose path may take any angle",
            source: "Nash, Daniel, Koenig & Felner 2007, AAAI-07, 1177-1183",
            real_time: true,
            make: |settings| plain(settings, GridSearch::theta_star),
        },
        Kind {
            name: "potential-field",
            summary: "Descent in an artificial potential field; sticks in local minima and says where",
            source: "Khatib 1986, IJRR 5(1), 90-98; Ge & Cui 2000, IEEE T-RA 16(5), 615-620",
            real_time: false,
            make: |settings| plain(settings, PotentialField::new),
        },
        Kind {
            name: "neural",
            summary: "Steepest ascent on the activity of a shunting neural network on a cell grid",
            source: "Glasius, Komoda & Gielen 1995, Neural Networks 8(1), 125-133; \
                     Yang & Meng 2001, IEEE T-SMC B 31(3), 302-318",
            real_time: false,
            make: |settings| plain(settings, Neural::new),
        },
        Kind {
            name: "rrt-connect",
            summary: "Two random trees from start and goal that grow towards each other; the first path",
            source: "Kuffner & LaValle 2000, ICRA, 995-1001",
            real_time: true,
            make: |settings| plain(settings, RrtConnect::new),
        },
        Kind {
            name: "rrt-star",
            summary: "A random tree, rewired towards the shortest ways from the start",
            source: "Karaman & Frazzoli 2011, International Journal of Robotics Research 30(7), 846-894",
            real_time: true,
            make: |settings| plain(settings, RrtStar::new),
        },
        Kind {
            name: "informed-rrt-star",
            summary: "RRT* that samples the ellipse in which a path may be shorter than the best one",
            source: "Gammell, Srinivasa & Barfoot 2014, IROS, 2997-3004",
            real_time: true,
            make: |settings| plain(settings, RrtStar::informed),
        },
        Kind {
            name: "grid-ga",
            summary: "Genetic algorithm on lists of numbered cells, with insertion, deletion and smoothing",
            source: "Fang 2009, master's thesis, section 4.5",
            real_time: false,
            make: |settings| plain(settings, GridGa::new),
        },
        Kind {
            name: "vertex-ga",
            summary: "Genetic algorithm on sequences of the obstacles' vertices",
            source: "Fang 2009, master's thesis, section 4.4",
            real_time: false,
            make: |settings| plain(settings, VertexGa::new),
        },
        Kind {
            name: "quantum-ga",
            summary: "Quantum-inspired evolution of the bits of heights on the columns of the 2012 paper",
            source: "Han & Kim 2002, IEEE Trans. Evolutionary Computation 6(6), 580-593",
            real_time: false,
            make: |settings| plain(settings, QuantumGa::new),
        },
        Kind {
            name: "influence-astar",
            summary: "A* on cells that weighs length against the risk of the defenders' influence regions",
            source: "Wang & Zhu 2018, Computer Systems & Applications 27(1), 189-194",
            real_time: false,
            make: |settings| plain(settings, InfluenceAstar::new),
        },
        Kind {
            name: "ant-colony",
            summary: "Ant System on a grid of cells, loops cut out of tours",
            source: "Dorigo, Maniezzo & Colorni 1996, IEEE Trans. Systems, Man, and Cybernetics B 26(1), 29-41",
            real_time: false,
            make: |settings| plain(settings, AntColony::new),
        },
    ];
    KINDS
}

/// Classes that a swarm hands to the refinement: more than 20 particles visit
/// in the scenes of the papers, and bounded in a crowd.
const SIDE_CLASSES: usize = 256;

fn pso_qp(mut settings: Settings<'_>) -> Result<(Box<dyn Planner>, Table), BuildError> {
    let classes = settings.take_parsed("classes")?.unwrap_or(Classes::Swarm);
    let mut qp: planner_qp::Settings = settings.take_parsed("qp")?.unwrap_or_default();
    qp.classes = classes;
    let remembers = settings.has("side_classes");
    let mut pso = settings.parse::<planner_pso::Settings>()?.filled();
    if !remembers && classes == Classes::Swarm {
        pso.side_classes = SIDE_CLASSES;
    }
    let swarm = Pso::new(pso.clone())?;
    let refiner = Qp::new(qp.clone()).map_err(|error| BuildError::from(error).within("qp"))?;
    let (mut resolved, mut qp) = (table(&pso), table(&qp));
    if let Some(classes) = qp.remove("classes") {
        resolved.insert("classes".into(), classes);
    }
    resolved.insert("qp".into(), qp.into());
    Ok((Box::new(Refined::new(Box::new(swarm), vec![Box::new(refiner)])), resolved))
}

/// The planner that `new` makes of validated settings, and those settings.
fn plain<S: DeserializeOwned + Serialize + Clone, P: Planner + 'static>(
    settings: Settings<'_>,
    new: impl FnOnce(S) -> Result<P, SettingError>,
) -> Result<(Box<dyn Planner>, Table), BuildError> {
    let settings: S = settings.parse()?;
    let planner = new(settings.clone())?;
    Ok((Box::new(planner), table(&settings)))
}

/// Validated settings as TOML.
pub(crate) fn table<T: Serialize>(settings: &T) -> Table {
    Table::try_from(settings).expect("settings are plain data")
}
