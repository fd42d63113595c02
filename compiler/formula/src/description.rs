//! A system in words: L, H, the equations of motion, and what was found.

use num_traits::One;

use serde_json::{Value, json};

use super::derivative::gradient;
use super::display::{Notation, number_text};
use super::graph::{Base, Coordinate, Half, Id, Index, Number};
use super::hessian::MomentumHessian;
use super::lagrangian_form;
use super::structure::{Kinetic, Structure};
use super::syntax::Length;
use super::system::{Layout, Legendre, Shape, System};

/// Most second derivatives that are shown.
const MAX_LINES: usize = 2_000;
/// Longest page.
const MAX_CHARACTERS: usize = 8_000;

/// Longest display on a page.
const MAX_KATEX: usize = 2_000;

impl System {
    /// The Lagrangian that H was derived from.
    pub fn lagrangian_formula(&self, notation: Notation) -> Option<String> {
        let lagrangian = self.lagrangian.as_ref()?;
        Some(self.formula(lagrangian.formula, notation))
    }

    /// The momenta `p = ∂L/∂v` of a Lagrangian, a line for each part.
    pub fn momentum_equations(&self, notation: Notation) -> Vec<String> {
        let Some(lagrangian) = &self.lagrangian else {
            return Vec::new();
        };
        let mut copy = self.clone();
        let parts = gradient(
            &mut copy.graph,
            lagrangian.formula,
            &[],
            Number::one(),
            Half::V,
        );
        let parts = copy.completed(parts);
        let values = parts.iter().map(|part| copy.formula(part.value, notation));
        copy.lines(&parts, values, notation, |target| {
            copy.coordinate_name(&target.of(Half::P), notation)
        })
    }

    /// The applied forces, a line for each.
    pub fn applied_forces(&self, notation: Notation) -> Vec<String> {
        let values = (self.applied.iter()).map(|part| self.formula(part.value, notation));
        self.lines(&self.applied, values, notation, |target| {
            let target = self.coordinate_name(target, notation);
            match notation {
                Notation::Text => format!("force on {target}"),
                Notation::Latex => format!("f_{{{target}}}"),
            }
        })
    }

    /// The second derivatives of H, a line for each part of one that is not zero; then the parts in common.
    pub fn second_derivatives(&self, notation: Notation) -> Vec<String> {
        let mut copy = self.clone();
        let (mut parts, mut is_cut_off) = (Vec::new(), false);
        let halves = [(Half::P, Half::P), (Half::P, Half::Q), (Half::Q, Half::Q)];
        'all: for (row, column) in halves {
            for first in gradient(&mut copy.graph, self.energy, &[], Number::one(), row) {
                let (value, loops) = (first.value, &first.loops);
                for second in gradient(&mut copy.graph, value, loops, Number::one(), column) {
                    is_cut_off = parts.len() == MAX_LINES;
                    if is_cut_off {
                        break 'all;
                    }
                    parts.push((first.target.clone(), second));
                }
            }
        }
        let values: Vec<Id> = parts.iter().map(|(_, second)| second.value).collect();
        let (values, common) = copy.formulas(&values, 'u', notation);
        let lines = parts.iter().zip(values).map(|((row, second), value)| {
            let [row, column] = [row, &second.target].map(|target| copy.coordinate_name(target, notation));
            let ranges = copy.ranges(&second.loops, notation);
            match notation {
                Notation::Text => format!("∂²H/∂{row}∂{column} += {value}{ranges}"),
                Notation::Latex => format!(
                    "\\frac{{\\partial^2 H}}{{\\partial {row}\\,\\partial {column}}} \\mathrel{{+}}= {value}{ranges}"
                ),
            }
        });
        let mut lines: Vec<String> = lines.collect();
        lines.extend(is_cut_off.then(|| "…".to_owned()));
        lines.extend(common);
        lines
    }
}

/// Whether no force takes energy out or puts it in.
fn is_conservative(system: &System) -> bool {
    system.friction.is_empty() && system.applied.is_empty()
}

/// Whether the exact flow conserves H, and there is one.
pub fn conserves_energy(system: &System, structure: &Structure) -> bool {
    !structure.time_dependent && is_conservative(system) && system.without_hamiltonian().is_none()
}

/// The documentation of the type of a system.
pub fn page(system: &System, structure: &Structure) -> String {
    if let Some(page) = lagrangian_form::page(system) {
        return page;
    }
    let energy = system.formula(system.energy, Notation::Text);
    let equations = system.equations_of_motion(Notation::Text).join("\n");
    let mut text = format!("H = {energy}\n\n{equations}");
    if let Some(lagrangian) = system.lagrangian_formula(Notation::Text) {
        let momenta = system.momentum_equations(Notation::Text).join("\n");
        text = format!("L = {lagrangian}\n\n{momenta}\n\n{text}");
    }
    if system.is_constrained() {
        let constraints = system.constraint_equations(Notation::Text).join("\n");
        text = format!("{text}\n\n{constraints}");
    }
    if text.len() > MAX_CHARACTERS {
        text = "The formula is too long to be shown.".to_owned();
    }
    let facts = facts(system, structure).join("; ");
    let display = katex(system);
    format!("\n\n```text\n{text}\n```\n\n{display}Found in the formula: {facts}.\n")
}

/// H and the equations of motion for KaTeX in Markdown; nothing if they are long.
fn katex(system: &System) -> String {
    let energy = system.formula(system.energy, Notation::Latex);
    let mut lines = vec![format!("H = {energy}")];
    lines.extend(system.equations_of_motion(Notation::Latex));
    lines.extend(system.constraint_equations(Notation::Latex));
    displays(&lines)
}

/// Lines for KaTeX in Markdown; nothing if they are long.
pub(super) fn displays(lines: &[String]) -> String {
    let mut display = String::new();
    for line in lines {
        display.push_str("$$");
        for letter in line.chars() {
            // What Markdown would take for its own.
            if "\\_*'<>[]".contains(letter) {
                display.push('\\');
            }
            display.push(letter);
        }
        display.push_str("$$\n");
    }
    match display.len() <= MAX_KATEX {
        true => display + "\n",
        false => String::new(),
    }
}

/// Everything about a system, for people.
pub fn text(system: &System, structure: &Structure) -> String {
    let mut text = format!("{}\n", system.name);
    let mut section = |title: &str, lines: &[String]| {
        text.push_str(&format!("\n{title}\n"));
        for line in lines {
            text.push_str(&format!("  {line}\n"));
        }
    };
    let parameters: Vec<String> = system
        .parameters
        .iter()
        .map(|parameter| match parameter_value(&parameter.shape) {
            Some(value) => format!("{} = {value}", parameter.name),
            None => parameter.name.clone(),
        })
        .collect();
    if !parameters.is_empty() {
        section("parameters", &parameters);
    }
    if let Some(lagrangian) = system.lagrangian_formula(Notation::Text) {
        section("Lagrangian", &[format!("L = {lagrangian}")]);
        section("momenta", &system.momentum_equations(Notation::Text));
    }
    if let Some(lines) = lagrangian_form::equations(system, Notation::Text) {
        section("equations of motion", &lines);
        section("found in the formula", &[lagrangian_form::FACT.to_owned()]);
        return text;
    }
    section(
        "Hamiltonian",
        &[format!(
            "H = {}",
            system.formula(system.energy, Notation::Text)
        )],
    );
    section(
        "equations of motion",
        &system.equations_of_motion(Notation::Text),
    );
    if system.is_constrained() {
        section("constraints", &system.constraint_equations(Notation::Text));
    }
    section(
        "second derivatives",
        &system.second_derivatives(Notation::Text),
    );
    section("found in the formula", &facts(system, structure));
    text
}

/// The equations of a system for LaTeX: an `aligned` environment.
pub fn latex(system: &System, structure: &Structure) -> String {
    let mut lines = Vec::new();
    if let Some(lagrangian) = system.lagrangian_formula(Notation::Latex) {
        lines.push(format!("L = {lagrangian}"));
        lines.extend(system.momentum_equations(Notation::Latex));
    }
    match lagrangian_form::equations(system, Notation::Latex) {
        Some(equations) => lines.extend(equations),
        None => {
            let energy = system.formula(system.energy, Notation::Latex);
            lines.push(format!("H = {energy}"));
            lines.extend(system.equations_of_motion(Notation::Latex));
            lines.extend(system.constraint_equations(Notation::Latex));
            lines.extend(system.second_derivatives(Notation::Latex));
            let conserved = conserved_momenta(system, structure, Notation::Latex);
            let conserved = conserved.into_iter();
            lines.extend(conserved.map(|(.., formula)| format!("{formula} = \\mathrm{{const}}")));
        }
    }
    let lines: Vec<String> = lines
        .iter()
        .map(|line| match line.find(['=']) {
            Some(place) => {
                let (left, right) = line.split_at(place);
                match left.strip_suffix("\\mathrel{+}") {
                    Some(left) => format!("  {left}&\\mathrel{{+}}{right}"),
                    None => format!("  {left}&{right}"),
                }
            }
            None => format!("  {line}"),
        })
        .collect();
    format!(
        "\\begin{{aligned}}\n{}\n\\end{{aligned}}\n",
        lines.join(" \\\\\n")
    )
}

/// Everything about a system, for programs.
pub fn json(system: &System, structure: &Structure) -> Value {
    let parameters: Vec<Value> = system.parameters.iter().map(|parameter| {
        json!({ "name": parameter.name, "value": parameter_value(&parameter.shape) })
    }).collect();
    if system.without_hamiltonian().is_some() {
        let both = |lines: &dyn Fn(Notation) -> Value| json!({ "text": lines(Notation::Text), "latex": lines(Notation::Latex) });
        return json!({
            "name": system.name,
            "parameters": parameters,
            "lagrangian": both(&|notation| json!(system.lagrangian_formula(notation))),
            "momenta": both(&|notation| json!(system.momentum_equations(notation))),
            "equations_of_motion": both(&|notation| json!(lagrangian_form::equations(system, notation))),
            "hamiltonian": null,
        });
    }
    let kinetic = match (&structure.split, structure.kinetic) {
        (Err(_), _) => None,
        (Ok(_), Kinetic::Unit) => Some("unit"),
        (Ok(_), Kinetic::Diagonal) => Some("diagonal"),
        (Ok(_), Kinetic::Quadratic) => Some("quadratic"),
        (Ok(_), Kinetic::General) => Some("general"),
    };
    let cyclic: Vec<String> = structure
        .cyclic
        .iter()
        .map(|&k| system.layout.name(Half::Q, k))
        .collect();
    let conserved: Vec<&str> = momenta(system, structure)
        .iter()
        .map(|(name, _)| *name)
        .collect();
    let both = |lines: fn(&System, Notation) -> Vec<String>| json!({ "text": lines(system, Notation::Text), "latex": lines(system, Notation::Latex) });
    let mut all = json!({
        "name": system.name,
        "parameters": parameters,
        "hamiltonian": {
            "text": system.formula(system.energy, Notation::Text),
            "latex": system.formula(system.energy, Notation::Latex),
        },
        "equations_of_motion": both(System::equations_of_motion),
        "second_derivatives": both(System::second_derivatives),
        "separable": structure.split.is_ok(),
        "kinetic_energy": kinetic,
        "time_dependent": structure.time_dependent,
        "chain": structure.chain.is_some(),
        "polynomial_degree": structure.degree,
        "momentum_hessian": match structure.hessian {
            MomentumHessian::Zero => Some("zero"),
            MomentumHessian::Singular { .. } => Some("singular"),
            MomentumHessian::Regular => Some("regular"),
            MomentumHessian::Unknown => None,
        },
        "cyclic": cyclic,
        "conserved": conserved,
        "conserved_momenta": conserved_momenta(system, structure, Notation::Text)
            .into_iter()
            .zip(conserved_momenta(system, structure, Notation::Latex))
            .map(|((name, component, text), (.., latex))| {
                json!({ "name": name, "component": component, "text": text, "latex": latex })
            })
            .collect::<Vec<_>>(),
    });
    if system.is_constrained() {
        all["constraints"] = both(System::constraint_equations);
    }
    if !system.applied.is_empty() {
        all["applied_force"] = both(System::applied_forces);
    }
    if !system.friction.is_empty() {
        all["friction"] = json!({
            "text": system.rates(Notation::Text),
            "latex": system.rates(Notation::Latex),
        });
    }
    if let Some(lagrangian) = &system.lagrangian {
        all["lagrangian"] = json!({
            "text": system.lagrangian_formula(Notation::Text),
            "latex": system.lagrangian_formula(Notation::Latex),
        });
        all["momenta"] = both(System::momentum_equations);
        all["regular_mass_matrix"] = json!(match lagrangian.legendre {
            Legendre::Regular => Some("proved"),
            Legendre::RegularAtRandomPoints => Some("at random points"),
            Legendre::None => None,
        });
    }
    all
}

/// The value of a parameter, or the shape that it has.
fn parameter_value(shape: &Shape) -> Option<String> {
    let length = |length: &Length| match length {
        Length::Fixed(n) => n.to_string(),
        Length::Generic(name) | Length::PairsOf(name) => name.clone(),
        Length::Runtime => "..".to_owned(),
    };
    match shape {
        Shape::Number(value) => value.as_ref().map(number_text),
        Shape::Pairs => Some("pairs".to_owned()),
        Shape::Array(lengths) => {
            let lengths: Vec<String> = lengths.iter().map(length).collect();
            Some(format!("[{}]", lengths.join(", ")))
        }
    }
}

/// What was found, in words.
pub fn facts(system: &System, structure: &Structure) -> Vec<String> {
    let mut facts = Vec::new();
    facts.push(match (&structure.split, structure.kinetic) {
        (Err(_), _) => "not separable".to_owned(),
        (Ok(_), Kinetic::Unit) => "separable, with the kinetic energy |p|²/2".to_owned(),
        (Ok(_), Kinetic::Diagonal) => {
            "separable, with a kinetic energy of constant masses".to_owned()
        }
        (Ok(_), Kinetic::Quadratic) => {
            "separable, with a kinetic energy of a constant mass matrix".to_owned()
        }
        (Ok(_), Kinetic::General) => "separable".to_owned(),
    });
    facts.push(match structure.time_dependent {
        true => "dependent on time".to_owned(),
        false if is_conservative(system) => "independent of time, so H is conserved".to_owned(),
        false => "independent of time".to_owned(),
    });
    if !system.applied.is_empty() {
        facts.push(match system.force_of_momenta() {
            Some(_) => "with an applied force that depends on momenta, so steps are those for general systems".to_owned(),
            None => "with an applied force".to_owned(),
        });
    }
    if !system.friction.is_empty() {
        facts.push(format!(
            "the friction −γp with γ = {} is added to the force",
            system.rates(Notation::Text)
        ));
    }
    if !system.constraints.is_empty() {
        facts.push(
            "the force −Gᵀλ of the constraints, with G = ∂φ/∂q, is added to the force".to_owned(),
        );
    }
    if !system.nonholonomic.is_empty() {
        facts.push(
            "the force −wᵀλ of the non-holonomic constraints w·v = 0 is added to the force"
                .to_owned(),
        );
    }
    match system.lagrangian.as_ref().map(|known| known.legendre) {
        Some(Legendre::Regular) => {
            facts.push("the mass matrix is proved regular".to_owned());
        }
        Some(Legendre::RegularAtRandomPoints) => {
            facts.push("the mass matrix is regular at random points".to_owned());
        }
        Some(Legendre::None) | None => {}
    }
    match structure.hessian {
        MomentumHessian::Zero => {
            facts.push("degenerate: linear in the momenta, so ∂²H/∂p² is zero".to_owned());
        }
        MomentumHessian::Singular { rank, size } => facts.push(match system.layout.length() {
            Length::Fixed(_) => format!(
                "degenerate: ∂²H/∂p² is singular, of rank {rank} for {size} momenta, at random points"
            ),
            _ => "degenerate: ∂²H/∂p² is singular at random points".to_owned(),
        }),
        MomentumHessian::Regular | MomentumHessian::Unknown => {}
    }
    if let Some(degree) = structure.degree {
        facts.push(format!(
            "a polynomial of degree {degree} in positions and momenta"
        ));
    }
    if structure.chain.is_some() {
        facts.push("a chain of neighbours".to_owned());
    }
    for &k in &structure.cyclic {
        facts.push(format!(
            "`{}` is cyclic, so `{}` is conserved",
            system.layout.name(Half::Q, k),
            system.layout.name(Half::P, k)
        ));
    }
    for (name, momentum) in momenta(system, structure) {
        let components = momentum.in_words(system);
        facts.push(format!("`{name}`{components} is conserved"));
    }
    facts
}

/// A conserved momentum that was found.
#[derive(Debug, Clone)]
pub enum Momentum {
    /// `Σ p_i` in these components.
    Linear(Vec<usize>),
    /// `Σ q_a p_b − q_b p_a` in these planes.
    Angular(Vec<[usize; 2]>),
}

/// The conserved momenta that were found.
pub fn momenta(system: &System, structure: &Structure) -> Vec<(&'static str, Momentum)> {
    let mut found = Vec::new();
    let single = matches!(system.layout, Layout::Named(_));
    if !structure.translations.is_empty() && !single {
        found.push((
            "total_momentum",
            Momentum::Linear(structure.translations.clone()),
        ));
    }
    match structure.rotations.as_slice() {
        [] => {}
        // As (x, y, z).
        [_, _, _] => found.push((
            "angular_momentum",
            Momentum::Angular(vec![[1, 2], [2, 0], [0, 1]]),
        )),
        planes => found.push(("angular_momentum", Momentum::Angular(planes.to_vec()))),
    }
    found
}

/// The components of the conserved momenta: the name of the momentum, that of the component if there are others, and the formula.
fn conserved_momenta(
    system: &System,
    structure: &Structure,
    notation: Notation,
) -> Vec<(&'static str, Option<String>, String)> {
    let mut copy = system.clone();
    let mut all = Vec::new();
    for (name, momentum) in momenta(system, structure) {
        let components = momentum.components(system);
        for (k, part) in momentum.parts(&mut copy).into_iter().enumerate() {
            let component = components.get(k).cloned();
            all.push((name, component, copy.formula(part, notation)));
        }
    }
    all
}

impl Momentum {
    /// The names of its components: directions or axes. None if there can be only one component.
    fn components(&self, system: &System) -> Vec<String> {
        let axes: Vec<String> = match &system.layout {
            Layout::Named([names, _]) => names.clone(),
            layout => {
                let count = match (layout, layout.length()) {
                    (Layout::Numbered(_, Some(components)), _) => *components,
                    (_, Length::Fixed(n)) if matches!(self, Momentum::Angular(_)) => n,
                    _ => 1,
                };
                match count {
                    ..=3 => ["x", "y", "z"][..count]
                        .iter()
                        .map(|&axis| axis.to_owned())
                        .collect(),
                    _ => (0..count).map(|k| k.to_string()).collect(),
                }
            }
        };
        match self {
            Momentum::Linear(_) if axes.len() < 2 => Vec::new(),
            Momentum::Angular(_) if axes.len() < 3 => Vec::new(),
            Momentum::Linear(components) => components.iter().map(|&k| axes[k].clone()).collect(),
            // The axis that is not in the plane.
            Momentum::Angular(planes) => planes
                .iter()
                .map(|[a, b]| axes[3 - a - b].clone())
                .collect(),
        }
    }

    /// Its components in words, after a space: ` in x and y`, ` about z`.
    pub fn in_words(&self, system: &System) -> String {
        let names = self.components(system);
        let Some((last, others)) = names.split_last() else {
            return String::new();
        };
        let preposition = match self {
            Momentum::Linear(_) => "in",
            Momentum::Angular(_) => "about",
        };
        match others {
            [] => format!(" {preposition} {last}"),
            _ => format!(" {preposition} {} and {last}", others.join(", ")),
        }
    }

    /// Its components as formulas.
    pub fn parts(&self, system: &mut System) -> Vec<Id> {
        let over = system.over_all();
        let over = over.map(|id| (id, Index::of(Base::Loop(id))));
        let bodies = !matches!(system.layout, Layout::Named(_)) && (over.is_some());
        let vectors = matches!(system.layout, Layout::Numbered(_, Some(_)));
        let at = |system: &mut System, half: Half, component: usize| {
            let coordinate = match over {
                Some((_, ref index))
                    if vectors || bodies && matches!(self, Momentum::Linear(_)) =>
                {
                    Coordinate {
                        half,
                        index: index.clone(),
                        component,
                    }
                }
                _ => Coordinate {
                    half,
                    index: Index::number(component as i64),
                    component: 0,
                },
            };
            system.graph.coordinate(coordinate)
        };
        let mut parts = Vec::new();
        match self {
            Momentum::Linear(components) => {
                for &component in components {
                    let p = at(system, Half::P, component);
                    parts.push(match &over {
                        Some((id, _)) => system.graph.total(*id, p),
                        None => p,
                    });
                }
            }
            Momentum::Angular(planes) => {
                for &[a, b] in planes {
                    let (qa, pb) = (at(system, Half::Q, a), at(system, Half::P, b));
                    let (qb, pa) = (at(system, Half::Q, b), at(system, Half::P, a));
                    let (plus, minus) =
                        (system.graph.multiply(qa, pb), system.graph.multiply(qb, pa));
                    let whole = system
                        .graph
                        .sum([(Number::one(), plus), (-Number::one(), minus)]);
                    parts.push(match &over {
                        Some((id, _)) if vectors => system.graph.total(*id, whole),
                        _ => whole,
                    });
                }
            }
        }
        parts
    }
}
