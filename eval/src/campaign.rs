//! A comparison made ready to run: worlds compiled, optima known, identity fixed.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use env_model::{Scene, SceneError, World};
use planner_api::{PlanError, Problem};

use crate::config::{BudgetSpec, Comparison, SceneEntry};
use crate::results::{Optimum, PlannerInfo, Results, SceneResult, SceneSet, Subject};
use crate::seeds::fnv1a_128;
use crate::store::Stored;
use crate::{machine, optimum};

/// A scene of a campaign.
pub struct Arena {
    /// The scene itself.
    pub scene: Scene,
    /// The scene compiled.
    pub world: World,
    /// How long that took, µs.
    pub compile_us: f64,
    /// What it is for.
    pub set: SceneSet,
    /// What moves in it, where something does.
    pub simulation: Option<strategy::Settings>,
}

impl Arena {
    /// Compiles a scene.
    pub fn new(scene: Scene) -> Result<Self, SceneError> {
        let began = Instant::now();
        let world = World::new(&scene)?;
        let compile_us = micros(began);
        scene.validate_ends(&world)?;
        Ok(Self { scene, world, compile_us, set: SceneSet::Test, simulation: None })
    }

    /// From the scene's start to its goal.
    pub fn problem(&self) -> Result<Problem<'_>, PlanError> {
        Problem::new(&self.world, self.scene.start(), self.scene.goal())
    }

    /// The scene and its exact optimum, or why that is not known.
    pub fn result(&self, subject: Subject) -> SceneResult {
        SceneResult {
            scene: self.scene.clone(),
            optimum: self.optimum(subject),
            set: self.set,
            simulation: self.simulation.clone(),
        }
    }

    fn optimum(&self, subject: Subject) -> Optimum {
        let none = |reason| Optimum { length: None, path: Vec::new(), reason: Some(reason) };
        if let Some(reason) = subject.no_optimum() {
            return none(reason.to_owned());
        }
        match self.problem() {
            Ok(problem) => optimum::of(&problem),
            Err(e) => none(e.to_string()),
        }
    }
}

/// Microseconds since `began`, to the nanosecond.
pub fn micros(began: Instant) -> f64 {
    began.elapsed().as_nanos() as f64 / 1000.0
}

/// A comparison ready to run.
pub struct Campaign {
    /// What is compared.
    pub comparison: Comparison,
    /// Its scenes, compiled, in its order.
    pub arenas: Vec<Arena>,
}

impl Campaign {
    /// Compiles every scene.
    pub fn new(comparison: Comparison) -> Result<Self, SceneError> {
        let arena = |entry: &SceneEntry| {
            let simulation = entry.simulation.clone();
            Ok(Arena { set: entry.set, simulation, ..Arena::new(entry.scene.clone())? })
        };
        let arenas = comparison.scenes.iter().map(arena).collect::<Result<_, SceneError>>()?;
        Ok(Self { comparison, arenas })
    }

    /// How many runs it makes, warm-ups aside.
    pub fn run_count(&self) -> usize {
        self.arenas.len() * self.comparison.planners.len() * self.comparison.repeats as usize
    }

    /// Identity: 128-bit FNV-1a hash of resolved comparison, scenes and program version, in hexadecimal.
    pub fn identity(&self) -> String {
        let mut text = format!("touchline {}\0{}", env!("CARGO_PKG_VERSION"), self.comparison.portable_toml());
        for scene in &self.comparison.scenes {
            text.push('\0');
            text.push_str(&scene.scene.to_toml());
        }
        format!("{:032x}", fnv1a_128(text.as_bytes()))
    }

    /// What one line says before the campaign begins.
    pub fn size(&self, jobs: usize) -> String {
        let Comparison { name, seed, repeats, planners, .. } = &self.comparison;
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        format!(
            "{name}: {} × {} × {} = {}, seed {seed}, {}",
            count(planners.len(), "planner"),
            count(self.arenas.len(), "scene"),
            count(*repeats as usize, "repeat"),
            count(self.run_count(), "run"),
            count(jobs, "job"),
        )
    }

    /// What a store keeps of it before the first run; `results` are [`Campaign::empty_results`].
    pub fn stored(&self, results: &Results) -> Stored {
        Stored {
            results: Results { runs: Vec::new(), snapshots: Vec::new(), traces: Vec::new(), ..results.clone() },
            comparison: self.comparison.to_toml(),
            scene_files: self.comparison.scene_files(),
            compile_us: self.arenas.iter().map(|arena| arena.compile_us).collect(),
        }
    }

    /// Which of its runs are among `keys`, as [`Store::keys`](crate::store::Store::keys) names them.
    pub fn done(&self, keys: &BTreeSet<(String, String, u32)>) -> BTreeSet<(usize, usize, u32)> {
        let place = |names: Vec<&str>| -> BTreeMap<String, usize> {
            names.iter().enumerate().map(|(i, name)| ((*name).to_owned(), i)).collect()
        };
        let scenes = place(self.arenas.iter().map(|arena| arena.scene.name.as_str()).collect());
        let planners = place(self.comparison.planners.iter().map(|entry| entry.label.as_str()).collect());
        let of = |(scene, planner, repeat): &(String, String, u32)| {
            Some((*scenes.get(scene)?, *planners.get(planner)?, *repeat))
        };
        keys.iter().filter_map(of).collect()
    }

    /// The results before the first run: everything but runs.
    pub fn empty_results(&self, jobs: usize) -> Results {
        let Comparison { name, seed, repeats, subject, protocol, planners, notes, .. } = &self.comparison;
        let mut manifest = machine::manifest(jobs);
        manifest.identity = self.identity();
        manifest.notes.clone_from(notes);
        Results {
            name: name.clone(),
            seed: *seed,
            repeats: *repeats,
            subject: *subject,
            protocol: protocol.as_ref().and_then(|p| toml::to_string(p).ok()).unwrap_or_default(),
            planners: planners
                .iter()
                .map(|p| {
                    let mut settings = p.settings_toml();
                    if p.budget != BudgetSpec::default() {
                        let budget = toml::Value::try_from(p.budget).map_or_else(|e| e.to_string(), |b| b.to_string());
                        // Before the settings, whose last lines may belong to a sub-table.
                        settings = format!("budget = {budget}\n{settings}");
                    }
                    PlannerInfo {
                        label: p.label.clone(),
                        kind: p.kind.clone(),
                        settings,
                        group: p.group.clone(),
                        varied: p.varied.clone(),
                        budget: p.budget,
                    }
                })
                .collect(),
            scenes: self.arenas.iter().map(|arena| arena.result(*subject)).collect(),
            runs: Vec::new(),
            snapshots: Vec::new(),
            traces: Vec::new(),
            manifest,
        }
    }
}
