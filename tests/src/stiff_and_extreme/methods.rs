//! The methods of the table: at least one of each kind in the catalogue.

use symplectic::Method;
use symplectic_report::Verdict;

use super::Run;
use crate::methods::{
    BlanesMoanS6, BlanesMoanS10, BlanesMoanSrkn11b, BlanesMoanSrkn14a, BlanesPerturbed,
    ClenshawCurtis4, ForestRuth, GalerkinGauss3, Gauss2, Gauss4, Gauss8, GaussTripleJump, KahanLi8,
    Lobatto3, McLachlanAtela4, Midpoint, RadauRight3, Ruth3, SofroniouSpaletta10, StoermerVerlet,
    SymplecticEuler, TrigonometricGauss4, TripleJump8, Yoshida8,
};

/// A method of the table.
#[derive(Clone, Copy, Debug)]
pub struct Entrant {
    /// Name in the table.
    pub name: &'static str,
    /// Name in the catalogue, if it is there.
    pub catalogue: Option<&'static str>,
    /// Its definition.
    pub definition: &'static str,
    /// How its stages are solved.
    pub stages: Stages,
    run: fn(&Run) -> Option<Verdict>,
}

/// How stages are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stages {
    /// Explicitly.
    Explicit,
    /// By fixed-point iteration, which converges for small step sizes only.
    FixedPoint,
    /// By Newton's iteration.
    Newton,
}

impl Entrant {
    const fn new<M: Method + Copy>(
        _method: M,
        name: &'static str,
        catalogue: Option<&'static str>,
        stages: Stages,
        run: fn(&Run) -> Option<Verdict>,
    ) -> Self {
        Self {
            name,
            catalogue,
            definition: M::DEFINITION,
            stages,
            run,
        }
    }

    /// The verdict on a run with this method; `None` for the longest run with Newton's iteration.
    pub fn verdict(&self, run: &Run) -> Option<Verdict> {
        (self.run)(run)
    }
}

/// Makes the table of entrants of `kind Type "name in the report" "name in the catalogue"`.
macro_rules! entrants {
    ($($stages:ident $method:ident $name:literal $($catalogue:literal)?;)+) => {
        /// The methods of the table, in the order of its columns.
        pub const ENTRANTS: &[Entrant] = &[$(Entrant::new(
            $method,
            $name,
            entrants!(@catalogue $($catalogue)?),
            Stages::$stages,
            entrants!(@run $stages $method),
        )),+];
    };
    (@catalogue) => { None };
    (@catalogue $name:literal) => { Some($name) };
    (@run Newton $method:ident) => { |run| run.by_newton($method) };
    (@run $stages:ident $method:ident) => { |run| Some(run.by($method)) };
}

entrants! {
    Explicit SymplecticEuler "Symplectic Euler" "symplectic-euler";
    Explicit StoermerVerlet "Störmer–Verlet" "stormer-verlet";
    Explicit Ruth3 "Ruth 3" "ruth-1983";
    Explicit McLachlanAtela4 "McLachlan–Atela 4" "mclachlan-atela-1992-order-4-optimal";
    Explicit ForestRuth "Forest–Ruth" "forest-ruth-1990";
    Explicit BlanesMoanS6 "Blanes–Moan S6" "blanes-moan-2002-s6";
    Explicit BlanesMoanS10 "Blanes–Moan S10" "blanes-moan-2002-s10";
    Explicit BlanesMoanSrkn11b "Blanes–Moan SRKN 11b" "blanes-moan-2002-srkn11b";
    Explicit BlanesMoanSrkn14a "Blanes–Moan SRKN 14a" "blanes-moan-2002-srkn14a";
    Explicit BlanesPerturbed "Blanes ABA (10, 6, 4)" "blanes-2013-aba-10-6-4";
    Explicit Yoshida8 "Yoshida 8" "yoshida-1990-order-8-d";
    Explicit KahanLi8 "Kahan–Li 8" "kahan-li-1997-s17odr8-a";
    Explicit SofroniouSpaletta10 "Sofroniou–Spaletta 10" "sofroniou-spaletta-2005-s35odr10";
    Explicit TripleJump8 "Triple jump 8" "triple-jump-8";
    FixedPoint Lobatto3 "Lobatto 3" "lobatto-3";
    FixedPoint Gauss2 "Gauss 2" "gauss-2";
    FixedPoint Gauss4 "Gauss 4" "gauss-4";
    FixedPoint Gauss8 "Gauss 8" "gauss-8";
    Newton Midpoint "Midpoint, Newton" "gauss-1";
    Newton Gauss4 "Gauss 4, Newton" "gauss-4";
    Newton Lobatto3 "Lobatto 3, Newton" "lobatto-3";
    Newton RadauRight3 "Radau 3, Newton" "radau-right-3";
    Newton ClenshawCurtis4 "Clenshaw–Curtis 4, Newton" "clenshaw-curtis-4";
    Newton GalerkinGauss3 "Galerkin 2, Gauss 3, Newton" "galerkin-2-gauss-3";
    Newton TrigonometricGauss4 "Trigonometric Gauss 4, Newton" "trigonometric-gauss-4";
    Newton GaussTripleJump "Triple jump of Gauss 2, Newton";
}
