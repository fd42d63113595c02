//! The structure of a formula: whether H is separable, how the kinetic energy depends on the momenta, what is conserved.
//!
//! All of it is decided on the graph, so a property that is found is proved. A property that is not found may still hold, if it
//! is not visible in the form of the formula.

use num_traits::{One, Zero};

use super::degree::degree;
use super::derivative::{Scatter, directional, gradient};
use super::elaborate::STRETCH;
use super::graph::{Base, Coordinate, Graph, Half, Id, Index, LoopId, LoopRange, Node, Number};
use super::hessian::MomentumHessian;
use super::syntax::Length;
use super::system::{Layout, System};

/// The structure found for a system.
#[derive(Debug, Clone)]
pub struct Structure {
    /// The two parts of a separable H, or a term with positions and momenta.
    pub split: Result<Split, Id>,
    /// How the kinetic energy of a separable system depends on the momenta.
    pub kinetic: Kinetic,
    /// Whether H depends on the time.
    pub time_dependent: bool,
    /// The named coordinates that are not in H: their momenta are conserved.
    pub cyclic: Vec<usize>,
    /// The components in which all positions can be translated together: the sum of the momenta is conserved.
    pub translations: Vec<usize>,
    /// The planes in which all positions and momenta can be rotated together: the angular momentum there is conserved.
    pub rotations: Vec<[usize; 2]>,
    /// The potentials of a chain, if H is one.
    pub chain: Option<ChainParts>,
    /// What is known about `∂²H/∂p²`.
    pub hessian: MomentumHessian,
    /// The degree of H in positions and momenta, if it is a polynomial.
    pub degree: Option<usize>,
}

/// `H = T(t, p) + U(t, q)`
#[derive(Debug, Clone, Copy)]
pub struct Split {
    /// T
    pub kinetic: Id,
    /// U
    pub potential: Id,
}

/// How a kinetic energy depends on the momenta.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kinetic {
    /// `|p|²/2`
    Unit,
    /// `Σ p_i²/(2m_i)` with constant masses, and perhaps terms that are linear in p.
    Diagonal,
    /// Quadratic with a constant matrix.
    Quadratic,
    /// Anything else.
    General,
}

/// A chain of particles of mass one.
#[derive(Debug, Clone, Copy)]
pub struct ChainParts {
    /// The potential of a bond, a function of [`STRETCH`].
    pub bond: Id,
    /// The potential of a particle, a function of the position with the index of this loop.
    pub on_site: Option<(Id, LoopId)>,
}

impl Structure {
    /// Analyses a system.
    pub fn of(system: &mut System) -> Self {
        let energy = system.energy;
        let split = split(&mut system.graph, energy);
        let kinetic = match split {
            Ok(split) => kinetic(system, split.kinetic),
            Err(_) => Kinetic::General,
        };
        let chain = match split {
            Ok(split) if kinetic == Kinetic::Unit && system.is_free() => {
                chain(system, split.potential)
            }
            _ => None,
        };
        let mut symmetries = Symmetries::of(system);
        if system.without_hamiltonian().is_some() {
            // Velocities are not rotated with the positions.
            symmetries.rotations.clear();
        }
        Structure {
            split,
            kinetic,
            time_dependent: system.graph.depends(energy).time
                || (system.applied.iter()).any(|part| system.graph.depends(part.value).time),
            cyclic: symmetries.cyclic,
            translations: symmetries.translations,
            rotations: symmetries.rotations,
            chain,
            hessian: MomentumHessian::of(system),
            degree: degree(system),
        }
    }
}

/// Translations and rotations that leave H and the constraints invariant.
struct Symmetries {
    cyclic: Vec<usize>,
    translations: Vec<usize>,
    rotations: Vec<[usize; 2]>,
}

impl Symmetries {
    fn of(system: &mut System) -> Self {
        let mut found = Self::of_energy(system);
        if !system.friction.is_empty()
            || !system.applied.is_empty()
            || !system.nonholonomic.is_empty()
        {
            // The momenta change.
            found.keep(&Symmetries {
                cyclic: Vec::new(),
                translations: Vec::new(),
                rotations: Vec::new(),
            });
        }
        if let Some(square) = system.constraint_square() {
            let energy = std::mem::replace(&mut system.energy, square);
            found.keep(&Self::of_energy(system));
            system.energy = energy;
        }
        found
    }

    /// The symmetries of the formula in the place of H.
    fn of_energy(system: &mut System) -> Self {
        Symmetries {
            cyclic: cyclic(system),
            translations: translations(system),
            rotations: rotations(system),
        }
    }

    /// Keeps the symmetries that `others` has too.
    fn keep(&mut self, others: &Self) {
        self.cyclic.retain(|x| others.cyclic.contains(x));
        self.translations
            .retain(|x| others.translations.contains(x));
        self.rotations.retain(|x| others.rotations.contains(x));
    }
}

/// The largest number of terms into which a formula is split.
const MAX_TERMS: usize = 100_000;

/// The surroundings of a term.
#[derive(Clone)]
enum Around {
    Loop(LoopId),
    Factors(Vec<(Id, Number)>),
}

/// The terms of a node that `whole` does not keep intact, each with the node that it came from; `None` if there are too many.
pub(super) fn terms(
    graph: &mut Graph,
    root: Id,
    whole: impl Fn(&Graph, Id) -> bool,
) -> Option<Vec<(Id, Id)>> {
    let mut found = Vec::new();
    let mut open = vec![(root, Number::one(), Vec::<Around>::new())];
    let mut steps = 0;
    while let Some((id, factor, around)) = open.pop() {
        steps += 1;
        if steps > MAX_TERMS {
            return None;
        }
        let node = graph.node(id).clone();
        if !whole(graph, id) {
            match node {
                Node::Sum(parts, constant) => {
                    if !constant.is_zero() {
                        let one = graph.integer(1);
                        open.push((one, &factor * constant, around.clone()));
                    }
                    for (inner, x) in parts.into_iter().rev() {
                        open.push((x, &factor * inner, around.clone()));
                    }
                    continue;
                }
                Node::Total(over, body) => {
                    let mut around = around;
                    around.push(Around::Loop(over));
                    open.push((body, factor, around));
                    continue;
                }
                Node::Product(factors) => {
                    let free: Vec<usize> = (0..factors.len())
                        .filter(|&k| !graph.depends(factors[k].0).is_fixed())
                        .collect();
                    if let [k] = free.as_slice()
                        && factors[*k].1.is_one()
                        && matches!(graph.node(factors[*k].0), Node::Sum(..) | Node::Total(..))
                    {
                        let mut others = factors.clone();
                        let (sum, _) = others.remove(*k);
                        let mut around = around;
                        around.push(Around::Factors(others));
                        open.push((sum, factor, around));
                        continue;
                    }
                }
                _ => {}
            }
        }
        let mut term = graph.scale(factor, id);
        for around in around.iter().rev() {
            term = match around {
                Around::Loop(over) => graph.total(*over, term),
                Around::Factors(factors) => {
                    let all = factors.iter().cloned().chain([(term, Number::one())]);
                    graph.product(Number::one(), all)
                }
            };
        }
        found.push((term, id));
    }
    Some(found)
}

/// T and U, or a part that depends on positions and momenta and is not a sum.
fn split(graph: &mut Graph, energy: Id) -> Result<Split, Id> {
    let pure = |graph: &Graph, id: Id| {
        let depends = graph.depends(id);
        !(depends.q && depends.p)
    };
    let (mut kinetic, mut potential) = (Vec::new(), Vec::new());
    for (term, part) in terms(graph, energy, pure).ok_or(energy)? {
        let depends = graph.depends(term);
        match (depends.q, depends.p) {
            (true, true) => return Err(part),
            (false, true) => kinetic.push((Number::one(), term)),
            (_, false) => potential.push((Number::one(), term)),
        }
    }
    Ok(Split {
        kinetic: graph.sum(kinetic),
        potential: graph.sum(potential),
    })
}

/// Whether a loop goes over all coordinates.
pub fn goes_over_all(system: &System, id: LoopId) -> bool {
    let LoopRange::Between(start, end) = &system.graph.get_loop(id).range else {
        return false;
    };
    let all = match system.layout.length() {
        Length::Fixed(n) => Index::number(n as i64),
        length => Index::of(Base::End(length)),
    };
    *start == Index::number(0) && *end == all
}

/// Whether parts of a derivative set each coordinate once: in a loop over all of them, or individually.
pub fn each_once(system: &System, parts: &[Scatter]) -> bool {
    let components = system.layout.components();
    let distinct = |parts: &[Scatter]| {
        let mut targets: Vec<_> = parts.iter().map(|part| &part.target).collect();
        targets.sort();
        targets.windows(2).all(|pair| pair[0] != pair[1])
    };
    let own = |part: &Scatter| match part.loops.as_slice() {
        [id] => goes_over_all(system, *id) && part.target.index == Index::of(Base::Loop(*id)),
        _ => false,
    };
    let single = |part: &Scatter| part.loops.is_empty() && part.target.index.base == Base::Start;
    distinct(parts)
        && match system.layout.length() {
            Length::Fixed(n) if parts.iter().all(single) => parts.len() == n * components,
            _ => parts.iter().all(own) && parts.len() == components,
        }
}

fn kinetic(system: &mut System, kinetic: Id) -> Kinetic {
    let first = gradient(&mut system.graph, kinetic, &[], Number::one(), Half::P);
    let mut diagonal = true;
    let mut unit = each_once(system, &first);
    for part in &first {
        let momentum = system.graph.coordinate(part.target.clone());
        unit &= part.value == momentum;
        let second = gradient(
            &mut system.graph,
            part.value,
            &part.loops,
            Number::one(),
            Half::P,
        );
        if second
            .iter()
            .any(|part| !system.graph.depends(part.value).is_fixed())
        {
            return Kinetic::General;
        }
        diagonal &= second.iter().all(|other| other.target == part.target);
    }
    match (unit, diagonal) {
        (true, _) => Kinetic::Unit,
        (false, true) => Kinetic::Diagonal,
        (false, false) => Kinetic::Quadratic,
    }
}

fn coordinates(graph: &Graph, root: Id, half: Half) -> Vec<Coordinate> {
    let nodes = graph.below([root]);
    let found = nodes.into_iter().filter_map(|id| match graph.node(id) {
        Node::Coordinate(coordinate) if coordinate.half == half => Some(coordinate.clone()),
        _ => None,
    });
    found.collect()
}

fn cyclic(system: &System) -> Vec<usize> {
    let Layout::Named([names, _]) = &system.layout else {
        return Vec::new();
    };
    let found = coordinates(&system.graph, system.energy, Half::Q);
    let absent = |k: &usize| {
        !found
            .iter()
            .any(|found| found.index == Index::number(*k as i64))
    };
    (0..names.len()).filter(absent).collect()
}

fn translations(system: &mut System) -> Vec<usize> {
    let Layout::Numbered(_, components) = system.layout else {
        return Vec::new();
    };
    let energy = system.energy;
    let moved = |component: usize, graph: &mut Graph| {
        directional(graph, energy, None, |graph, coordinate| {
            let moves = coordinate.half == Half::Q && coordinate.component == component;
            graph.integer(i64::from(moves))
        })
    };
    let graph = &mut system.graph;
    (0..components.unwrap_or(1))
        .filter(|&k| {
            let speed = moved(k, graph);
            graph.is_zero(speed)
        })
        .collect()
}

fn rotations(system: &mut System) -> Vec<[usize; 2]> {
    // The coordinates are bodies in space, or the components of one.
    let (dimension, bodies) = match &system.layout {
        Layout::Numbered(_, Some(components)) => (*components, true),
        Layout::Numbered(Length::Fixed(n), None) => (*n, false),
        Layout::Named([names, _]) => (names.len(), false),
        Layout::Numbered(..) => return Vec::new(),
    };
    if !(2..=3).contains(&dimension) {
        return Vec::new();
    }
    let energy = system.energy;
    // In a loop, the component is not known.
    let indexed = [Half::Q, Half::P].into_iter().any(|half| {
        let found = coordinates(&system.graph, energy, half);
        found.iter().any(|found| found.index.base != Base::Start)
    });
    if !bodies && indexed {
        return Vec::new();
    }
    let mut found = Vec::new();
    for a in 0..dimension {
        for b in a + 1..dimension {
            let graph = &mut system.graph;
            let speed = directional(graph, energy, None, |graph, coordinate| {
                let place = match bodies {
                    true => Some(coordinate.component),
                    false => usize::try_from(coordinate.index.offset).ok(),
                };
                let (other, sign) = match place {
                    Some(k) if k == a => (b, -1),
                    Some(k) if k == b => (a, 1),
                    _ => return graph.integer(0),
                };
                let mut turned = coordinate.clone();
                match bodies {
                    true => turned.component = other,
                    false => turned.index = Index::number(other as i64),
                }
                let turned = graph.coordinate(turned);
                graph.scale(super::graph::integer(sign), turned)
            });
            if system.graph.is_zero(speed) {
                found.push([a, b]);
            }
        }
    }
    found
}

/// The parts of a chain, if the potential consists of sums over bonds and over all particles.
fn chain(system: &mut System, potential: Id) -> Option<ChainParts> {
    let bonds = system.bonds.clone();
    if bonds.is_empty() || !matches!(system.layout, Layout::Numbered(_, None)) {
        return None;
    }
    let wholes: Vec<(Number, Id)> = bonds
        .iter()
        .map(|bonds| system.graph.scaled(bonds.whole))
        .collect();
    let whole = |graph: &Graph, id: Id| {
        wholes.iter().any(|(_, known)| *known == id) || matches!(graph.node(id), Node::Total(..))
    };
    let (mut bond, mut on_site) = (Vec::new(), Vec::new());
    let mut over = None;
    for (term, _) in terms(&mut system.graph, potential, whole)? {
        let (factor, id) = system.graph.scaled(term);
        if let Some(k) = wholes.iter().position(|(_, known)| *known == id) {
            bond.push((factor / &wholes[k].0, bonds[k].potential));
            continue;
        }
        let Node::Total(id, body) = *system.graph.node(id) else {
            return None;
        };
        let own = Index::of(Base::Loop(id));
        let local = coordinates(&system.graph, body, Half::Q)
            .iter()
            .all(|q| q.index == own);
        if !goes_over_all(system, id) || !local || over.is_some_and(|known| known != id) {
            return None;
        }
        over = Some(id);
        on_site.push((factor, body));
    }
    let bond = system.graph.sum(bond);
    let on_site = over.map(|id| (system.graph.sum(on_site), id));
    // The potential must be the same for every bond and every particle.
    let roots = [Some(bond), on_site.map(|(id, _)| id)];
    let nodes = system.graph.below(roots.into_iter().flatten());
    let uniform = nodes.iter().all(|&id| match system.graph.node(id) {
        Node::Parameter(_, indices) => indices.iter().all(|index| index.loop_id().is_none()),
        Node::Total(..) => false,
        Node::Coordinate(q) => q.index == STRETCH || q.index.loop_id().is_some(),
        _ => true,
    });
    uniform.then_some(ChainParts { bond, on_site })
}
