//! The Gauss methods whose steps are compiled into this module: they are fast, and have the bits of a compiled program with the macros. Other
//! methods with coupled stages are interpreted; splittings have the same bits and about the same speed either way.

use symplectic::at_run_time::RunTimeTableau;
use symplectic::{Method, ProvedFor};

/// What is done with a method that is known when this module is compiled.
pub(crate) trait OfMethod {
    type Output;

    fn run<M: Method + Copy + Send + Sync + ForEverySystem>(self, method: M) -> Self::Output;
}

/// A method that is proved for every conservative system.
pub(crate) trait ForEverySystem:
    ProvedFor<symplectic::General> + ProvedFor<symplectic::Separable>
{
}

impl<M: ProvedFor<symplectic::General> + ProvedFor<symplectic::Separable>> ForEverySystem for M {}

/// Lists the methods: each with its number of stages.
macro_rules! methods {
    ($($name:ident = $stages:literal,)*) => {
        symplectic::tableau! { $($name { basis: polynomial($stages), nodes: gauss($stages) })* }

        /// A method that is compiled into this module.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Emitted {
            $($name,)*
        }

        impl Emitted {
            /// The method of a derived tableau, if it is one of these. A method with s stages that has order 2s is the Gauss method.
            pub(crate) fn of(tableau: &RunTimeTableau) -> Option<Self> {
                let stages = tableau.stages();
                let is_gauss = tableau.orders().general as usize == 2 * stages;
                let is_sorted = tableau.coefficients().c.is_sorted();
                match stages {
                    _ if !is_gauss || !is_sorted => None,
                    $($stages => Some(Emitted::$name),)*
                    _ => None,
                }
            }

            /// Does work with the type of the method.
            pub(crate) fn with<W: OfMethod>(self, work: W) -> W::Output {
                match self {
                    $(Emitted::$name => work.run($name),)*
                }
            }
        }
    };
}

methods! {
    Gauss1 = 1,
    Gauss2 = 2,
    Gauss3 = 3,
    Gauss4 = 4,
    Gauss6 = 6,
    Gauss8 = 8,
}
