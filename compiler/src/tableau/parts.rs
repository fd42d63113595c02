//! The methods, steps and functions from which a method is built, for its code.

use super::Tableau;
use crate::derive::{Problem, Step};
use crate::error::ErrorKind;
use crate::symbolic::Constant;

/// A step `Φ_{γh}` of a composition.
#[derive(Debug, Clone)]
pub(crate) struct Substep {
    /// The fraction γ of the whole step.
    pub fraction: Constant,
    /// The index of its method in the list of distinct methods.
    pub method: usize,
}

/// The methods, steps and functions from which a method is built.
#[derive(Debug, Clone)]
pub(crate) struct Parts {
    /// The distinct methods of a composition that is not a splitting; empty for other definitions.
    pub methods: Vec<Tableau>,
    /// Its steps in order, none for other definitions; nested compositions are expanded too.
    pub substeps: Vec<Substep>,
    /// The number of functions of the basis, if the quadrature formula has more nodes.
    pub functions: Option<usize>,
}

impl Parts {
    /// The parts of a method.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] if a fraction of a fraction would be too long.
    pub(crate) fn of(problem: &Problem) -> Result<Self, ErrorKind> {
        let mut methods: Vec<Tableau> = Vec::new();
        let mut substeps = Vec::new();
        for Step { fraction, method } in problem.steps()?.unwrap_or_default() {
            let definition = method.definition();
            let same = |known: &Tableau| {
                known.provenance.definition == definition && known.may_be(&method)
            };
            let number = match methods.iter().position(same) {
                Some(number) => number,
                None => {
                    methods.push(Tableau::derived(method)?);
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
            functions: problem.functions(),
        })
    }
}
