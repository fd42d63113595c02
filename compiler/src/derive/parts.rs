//! The methods, steps and functions from which a method is built, for its code.

use super::composition::Step;
use super::problem::{Construction, Problem};
use super::read_again;
use crate::definition::Definition;
use crate::error::ErrorKind;
use crate::symbolic::Constant;
use crate::tableau::Tableau;

/// A step `Φ_{γh}` of a composition.
pub(crate) struct Substep {
    /// The fraction γ of the whole step.
    pub fraction: Constant,
    /// The index of its method in the list of distinct methods.
    pub method: usize,
}

/// The methods, steps and functions from which a method is built.
pub(crate) struct Parts {
    /// The distinct methods of a composition that is not a splitting; empty for other definitions.
    pub methods: Vec<Tableau>,
    /// Its steps in order, none for other definitions; nested compositions are expanded too.
    pub substeps: Vec<Substep>,
    /// The number of functions of the basis, if the quadrature formula has more nodes.
    pub functions: Option<usize>,
}

/// The parts of a method. For printed coefficients this takes as long as deriving it.
///
/// # Errors
/// [`ErrorKind::ExpressionSize`] if a fraction of a fraction would be too long, and the errors of reading the definition.
pub(crate) fn parts(definition: &Definition) -> Result<Parts, ErrorKind> {
    let problem = read_again(definition)?;
    let steps = problem.steps()?.unwrap_or_default();
    let functions = match &problem.construction {
        Construction::Galerkin { basis, nodes, .. }
            if basis.len() < nodes.len() && !problem.exchange =>
        {
            Some(basis.len())
        }
        _ => None,
    };
    let mut definitions: Vec<Definition> = Vec::new();
    let mut methods = Vec::new();
    let mut substeps = Vec::new();
    for Step { fraction, method } in steps {
        let definition = method.definition();
        let known = definitions.iter().position(|known| *known == definition);
        let number = match known {
            Some(number) => number,
            None => {
                methods.push(method.derive()?);
                definitions.push(definition);
                methods.len() - 1
            }
        };
        substeps.push(Substep {
            fraction,
            method: number,
        });
    }
    Ok(Parts {
        methods,
        substeps,
        functions,
    })
}

impl Problem {
    /// The steps of a composition that is not a splitting, expanded down to methods that are not compositions.
    fn steps(&self) -> Result<Option<Vec<Step>>, ErrorKind> {
        if self.sequence().is_some() {
            return Ok(None);
        }
        let outer = match &self.construction {
            Construction::Composition { steps } => Some(steps.clone()),
            Construction::Based(based) => based.steps(),
            _ => None,
        };
        let Some(outer) = outer else {
            return Ok(None);
        };
        let mut steps = Vec::new();
        for Step { fraction, method } in outer {
            match method.steps()? {
                Some(inner) => {
                    for step in inner {
                        steps.push(Step {
                            fraction: fraction.multiply(&step.fraction)?,
                            ..step
                        });
                    }
                }
                None => steps.push(Step { fraction, method }),
            }
        }
        if self.exchange {
            steps
                .iter_mut()
                .for_each(|step| step.method.exchange ^= true);
        }
        if self.adjoint {
            steps
                .iter_mut()
                .for_each(|step| step.method.adjoint ^= true);
            steps.reverse();
        }
        Ok(Some(steps))
    }
}
