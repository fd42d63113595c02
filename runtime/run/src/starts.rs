//! The starts of the trajectories.

use std::collections::HashMap;
use std::mem;
use std::ops::Range;

use symplectic::State;
use symplectic::nalgebra::DVector;
use symplectic_compiler::Error;
use symplectic_formula::graph::Half;
use symplectic_formula::syntax::Length;
use symplectic_formula::{Layout, System};
use toml::{Spanned, Value};

use crate::counted;
use crate::derived::{Derived, Given};
use crate::keys::advice;
use crate::memory;
use crate::parameters::{self, Varied};
use crate::random;
use crate::setup::{self, File, Grid, MAX_COUNT, Setup, Starts};
use crate::spec::Spec;

/// The names of all components of the position and the momentum, and of the parameters that vary between trajectories.
#[derive(Debug, Clone)]
pub(super) struct Coordinates {
    pub(super) halves: [Vec<String>; 2],
    pub(super) parameters: Vec<String>,
}

impl Coordinates {
    /// The coordinates of a number of bodies.
    pub(super) fn new(system: &System, bodies: usize, parameters: Vec<String>) -> Self {
        let names = |half| {
            let of = |body| {
                let name = system.layout.name(half, body);
                match system.layout {
                    Layout::Numbered(_, Some(components)) => {
                        (0..components).map(|k| format!("{name}[{k}]")).collect()
                    }
                    _ => vec![name],
                }
            };
            (0..bodies).flat_map(of).collect()
        };
        Coordinates {
            halves: [names(Half::Q), names(Half::P)],
            parameters,
        }
    }

    /// The dimension of the position.
    pub(super) fn dimension(&self) -> usize {
        self.halves[0].len()
    }

    /// The names of the coordinates, positions first.
    pub(super) fn all(&self) -> impl Iterator<Item = &String> {
        self.halves.iter().flatten()
    }

    /// The names of the numbers that a start consists of: coordinates, then parameters.
    pub(super) fn with_parameters(&self) -> impl Iterator<Item = &String> {
        self.all().chain(&self.parameters)
    }

    /// The list of names, truncated if there are many.
    pub(super) fn listed(&self) -> String {
        listed(self.all())
    }
}

/// A list of names, truncated if there are many.
pub(super) fn listed<'n>(names: impl IntoIterator<Item = &'n String>) -> String {
    let mut names = names.into_iter().map(String::as_str);
    let first: Vec<&str> = names.by_ref().take(20).collect();
    let rest = if names.next().is_some() { ", …" } else { "" };
    first.join(", ") + rest
}

/// The start of a trajectory, with any number of bodies.
#[derive(Debug, Clone)]
pub(super) struct Start {
    pub(super) state: State<DVector<f64>>,
    /// The values of the parameters that vary.
    pub(super) parameters: Vec<f64>,
}

/// The index of a coordinate with its values, its name, and its place in the file.
type Axis = (usize, Spec, String, Range<usize>);

/// Reads the starts of a system, whose number of bodies is not yet known.
pub(super) struct Reader<'a> {
    pub(super) file: &'a File<'a>,
    pub(super) system: &'a System,
    pub(super) setup: &'a Setup,
}

impl Reader<'_> {
    /// The coordinates and the starts.
    pub(super) fn read(&self) -> Result<(Coordinates, Vec<Given>), Error> {
        match self.setup.starts.get_ref() {
            Starts::File(name) => {
                self.refuse_needless_random(false)?;
                if let Some(varied) = parameters::varied(self.setup).first() {
                    let rest = match varied.name.contains('[') {
                        true => {
                            ", whose columns are coordinates and parameters that are numbers, not entries of arrays: give it one value, or \
                             give the starts in this file"
                        }
                        false => ": write its values into a column of that file",
                    };
                    let message = format!(
                        "`{}` varies, but the starts are in a file{rest}",
                        varied.name
                    );
                    return Err(self.file.error(varied.span.clone(), message));
                }
                let table = self.of_table(&self.file.beside(name));
                let (coordinates, rows, has_velocities) =
                    table.map_err(|error| self.file.placed(self.setup.starts.span(), error))?;
                let given = Given {
                    rows,
                    derived: Vec::new(),
                    has_velocities,
                };
                Ok((coordinates, vec![given]))
            }
            Starts::Grids(grids) => self.of_grids(grids),
        }
    }

    fn refuse_needless_random(&self, any: bool) -> Result<(), Error> {
        let span = self.setup.starts.span();
        match (any, &self.setup.random) {
            (true, None) => Err(self.file.error(
                span,
                "these starts are random: give their number and a seed, `random = { seed = 1, count = 1000 }`",
            )),
            (false, Some(_)) => Err(self.file.error(
                span,
                "`random` is given, but no start is random: write `{ uniform = [low, high] }` or `{ normal = [mean, deviation] }` for a coordinate",
            )),
            (true, Some(random)) if random.get_ref().count == 0 => Err(self.file.error(
                random.span(),
                "the count is 0, so there are no starts: write a number of at least 1, the random starts at each point of the grid",
            )),
            _ => Ok(()),
        }
    }

    /// The number of bodies, if the layout does not say it: that of a list.
    pub(super) fn bodies(&self, listed: Option<usize>) -> Result<usize, Error> {
        let bodies = match self.system.layout.length() {
            Length::Fixed(n) => n,
            _ => listed.ok_or_else(|| {
                self.file.error(
                    self.setup.starts.span(),
                    "the formula leaves the number of coordinates open: give the starts as lists `q = [...]` and `p = [...]`, which determine it",
                )
            })?,
        };
        if bodies < self.system.least.max(1) {
            let message = format!(
                "the formula needs at least {} coordinates, but the starts have {bodies}",
                self.system.least.max(1)
            );
            return Err(self.file.error(self.setup.starts.span(), message));
        }
        Ok(bodies)
    }

    fn of_grids(&self, grids: &[Grid]) -> Result<(Coordinates, Vec<Given>), Error> {
        if grids.is_empty() {
            let message = "the list of starts is empty: give at least one table with a value for each coordinate";
            return Err(self.file.error(self.setup.starts.span(), message));
        }
        let first = grids.first().and_then(|grid| grid.get("q"));
        let listed = first
            .and_then(|list| list.get_ref().as_array())
            .map(Vec::len);
        let varied = parameters::varied(self.setup);
        let names = varied.iter().map(|varied| varied.name.clone()).collect();
        let coordinates = Coordinates::new(self.system, self.bodies(listed)?, names);
        let coordinate_count = coordinates.all().count();
        let mut parameter_axes = Vec::new();
        for (k, Varied { name, value, span }) in varied.iter().enumerate() {
            let spec = Spec::read(value, name)
                .map_err(|message| self.file.error(span.clone(), message))?;
            parameter_axes.push((coordinate_count + k, spec));
        }
        let (mut all, mut count_before, mut draws) = (Vec::new(), 0, 0);
        let mut any_random = false;
        for grid in grids {
            let (own, has_velocities) = self.axes(grid, &coordinates)?;
            let mut axes = parameter_axes.clone();
            let mut derived = Vec::new();
            for (place, spec, name, span) in own {
                match spec {
                    Spec::Derived(rule) => {
                        derived.push(Derived {
                            place,
                            name,
                            rule,
                            span,
                        });
                    }
                    spec => axes.push((place, spec)),
                }
            }
            let is_random = axes.iter().any(|(_, spec)| spec.is_random());
            any_random |= is_random;
            let count = match &self.setup.random {
                Some(random) if is_random => random.get_ref().count,
                _ => 1,
            };
            let width = axes.len() + derived.len();
            let rows = self.product(&axes, width, count, &mut draws, count_before)?;
            count_before += rows.len();
            all.push(Given {
                rows,
                derived,
                has_velocities,
            });
        }
        self.refuse_needless_random(any_random)?;
        Ok((coordinates, all))
    }

    /// The indices of all coordinates with their start values, in the order of the file, and whether these are velocities.
    fn axes(&self, grid: &Grid, coordinates: &Coordinates) -> Result<(Vec<Axis>, bool), Error> {
        let mut entries: Vec<(&String, &Spanned<Value>)> = grid.iter().collect();
        entries.sort_by_key(|(_, value)| value.span().start);
        let place = |(place, name)| (String::as_str(name), place);
        let mut named: HashMap<&str, usize> = coordinates.all().enumerate().map(place).collect();
        let velocities = self.velocities(coordinates);
        let half = coordinates.dimension();
        named.extend((half..).zip(&velocities).map(place));
        let mut is_given = vec![false; 2 * half];
        let mut kinds = [false; 2];
        let mut axes = Vec::new();
        for (name, value) in entries {
            let is_velocity = name == "v" || velocities.contains(name);
            let own = |&place| Ok(vec![(place, name.clone(), value.get_ref())]);
            let leaves = match (named.get(name.as_str()), self.half(name)) {
                (Some(place), _) => own(place),
                (None, Some(half)) => self.leaves(name, half, value.get_ref(), coordinates),
                (None, None) => {
                    let message = format!(
                        "there is no coordinate `{name}`; the coordinates are {}{}",
                        coordinates.listed(),
                        advice(name, named.keys().copied())
                    );
                    return Err(self.file.error_at_key(value.span(), message));
                }
            };
            let leaves = leaves.map_err(|message| self.file.error(value.span(), message))?;
            for (place, name, leaf) in leaves {
                let spec = Spec::of_coordinate(leaf, &name)
                    .map_err(|message| self.file.error(value.span(), message))?;
                if place >= half {
                    kinds[usize::from(is_velocity)] = true;
                }
                if kinds == [true, true] {
                    let message = format!(
                        "`{name}`: there are momenta and velocities: give either all momenta or all velocities"
                    );
                    return Err(self.file.error(value.span(), message));
                }
                if mem::replace(&mut is_given[place], true) {
                    let message = format!("`{name}` is given twice: leave out one of the two");
                    return Err(self.file.error(value.span(), message));
                }
                axes.push((place, spec, name, value.span()));
            }
        }
        let mut missing = coordinates.all().zip(&is_given);
        if let Some((name, _)) = missing.find(|(_, is_given)| !**is_given) {
            let message = format!(
                "the starts give no value for `{name}`; the coordinates are {}",
                coordinates.listed()
            );
            return Err(self.file.error(self.setup.starts.span(), message));
        }
        Ok((axes, kinds[1]))
    }

    /// The names of the velocities of a Lagrangian.
    pub(super) fn velocities(&self, coordinates: &Coordinates) -> Vec<String> {
        let of_list = |name: &String| name.replacen('p', "v", 1);
        match (&self.system.lagrangian, &self.system.layout) {
            (None, _) => Vec::new(),
            (Some(_), Layout::Named(_)) => self.system.velocities.clone(),
            (Some(_), Layout::Numbered(..)) => coordinates.halves[1].iter().map(of_list).collect(),
        }
    }

    /// The half of which a key is the whole list.
    fn half(&self, key: &str) -> Option<Half> {
        match (key, &self.system.layout) {
            ("q", Layout::Numbered(..)) => Some(Half::Q),
            ("p", Layout::Numbered(..)) => Some(Half::P),
            ("v", Layout::Numbered(..)) if self.system.lagrangian.is_some() => Some(Half::V),
            _ => None,
        }
    }

    /// The coordinates in the lists `q` and `p`, with their values.
    fn leaves<'v>(
        &self,
        key: &str,
        list_of: Half,
        value: &'v Value,
        coordinates: &Coordinates,
    ) -> Result<Vec<(usize, String, &'v Value)>, String> {
        let half = coordinates.dimension();
        let offset = match list_of {
            Half::P | Half::V => half,
            Half::Q => 0,
        };
        let mut found = Vec::new();
        let nested = matches!(self.system.layout, Layout::Numbered(_, Some(_)));
        let Some(list) = value.as_array() else {
            return Err(format!(
                "`{key}`: found {}, expected a list with a value for each coordinate",
                setup::found(value)
            ));
        };
        let components = self.system.layout.components();
        for entry in list {
            match (nested, entry.as_array()) {
                (true, Some(own)) if own.len() == components => found.extend(own),
                (true, _) => {
                    return Err(format!(
                        "`{key}`: expected a list of lists of {components} numbers, one for each body"
                    ));
                }
                (false, _) => found.push(entry),
            }
        }
        if found.len() != half {
            return Err(format!(
                "`{key}` has {}; it needs {half}: the coordinates are {}",
                counted(found.len(), "number", "numbers"),
                coordinates.listed()
            ));
        }
        let names = coordinates.all().skip(offset).cloned();
        let leaves = found.into_iter().zip(names).enumerate();
        Ok(leaves
            .map(|(k, (value, name))| (offset + k, name, value))
            .collect())
    }

    /// All combinations, the last coordinate fastest, with `count` draws of each; rows have `width` numbers, and there are others before.
    fn product(
        &self,
        axes: &[(usize, Spec)],
        width: usize,
        count: usize,
        draws: &mut u64,
        before: usize,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let lengths = axes.iter().map(|(_, spec)| match spec {
            Spec::Values(values) => values.len(),
            Spec::Uniform(_) | Spec::Normal(_) | Spec::Derived(_) => 1,
        });
        let lengths: Vec<usize> = lengths.collect();
        let total = lengths
            .iter()
            .try_fold(count, |total: usize, length| total.checked_mul(*length))
            .and_then(|total| total.checked_add(before));
        let fault = match total.filter(|total| *total <= MAX_COUNT) {
            Some(total) => memory::fault_of_starts(total, width),
            None => Some(format!(
                "more than {MAX_COUNT} starts: split the run into several files"
            )),
        };
        if let Some(fault) = fault {
            return Err(self.file.error(self.setup.starts.span(), fault));
        }
        let random = self.setup.random.as_ref();
        let seed = random.map_or(0, |random| random.get_ref().seed);
        let points = lengths.iter().product::<usize>();
        let mut rows = Vec::with_capacity(points * count);
        for point in 0..points {
            for _ in 0..count {
                let mut row = vec![0.0; width];
                let mut rest = point;
                for ((place, spec), length) in axes.iter().zip(&lengths).rev() {
                    let choice = rest % length;
                    rest /= length;
                    // A separate draw for every start and coordinate, independent of the order of the keys and of other coordinates.
                    let draw = (*draws << 32) + *place as u64;
                    row[*place] = match spec {
                        Spec::Values(values) => values[choice],
                        Spec::Uniform([low, high]) => {
                            low + (high - low) * random::uniform(seed, draw)
                        }
                        Spec::Normal([mean, deviation]) => {
                            mean + deviation * random::normal(seed, draw)
                        }
                        // Follows later.
                        Spec::Derived(_) => f64::NAN,
                    };
                }
                *draws += 1;
                rows.push(row);
            }
        }
        Ok(rows)
    }
}
