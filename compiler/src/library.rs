//! Other libraries: how each of them steps the numbers of a table.

use crate::error::{Error, ErrorKind};
use crate::expression::shown;

/// A library whose tables are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Library {
    /// OrdinaryDiffEq.jl of SciML, its symplectic methods.
    Sciml,
    /// ARKODE of SUNDIALS: SPRKStep and Butcher tables.
    Sundials,
    /// TS of PETSc: TSBASICSYMPLECTIC and TSIRK.
    Petsc,
    /// TSBASICSYMPLECTIC of PETSc before version 3.19.4, when it began with the kick.
    PetscKickFirst,
    /// RungeKutta.jl.
    RungeKuttaJl,
    /// Boost.Numeric.Odeint.
    Odeint,
    /// nodepy.
    Nodepy,
    /// NDSolve of Mathematica.
    Mathematica,
    /// Principia.
    Principia,
    /// REBOUND.
    Rebound,
    /// pyHamSys, its methods for any splitting and those whose `chi` is `exp(hX_B) exp(hX_A)`.
    Pyhamsys,
    /// pyHamSys, its methods whose `chi` is `exp(hX_A) exp(hX_B)`: PEFRL, RKN6a, ABA104, ABA864, ABA1064.
    PyhamsysDriftFirst,
}

/// How a library steps a splitting: for each stage `i` a drift `q += drift_i h ∂T/∂p(p)` and a kick `p −= kick_i h ∂U/∂q(q)`, in
/// this order or the reverse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stepping {
    /// The library's name for the drifts.
    pub drift: &'static str,
    /// The library's name for the kicks.
    pub kick: &'static str,
    /// Whether a stage drifts before it kicks.
    pub drifts_first: bool,
    /// Whether the lists are the first half of a step that is the same from both ends.
    pub mirrored: bool,
    /// Where the library documents this.
    pub evidence: &'static str,
}

/// The language that tables are written in, as far as it makes a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// `//` begins a comment, lines do not end a statement, and lists are numbered from 0.
    C,
    /// `1//2` is a fraction, and lists are numbered from 1; Matlab and Fortran too.
    Julia,
    /// Lists are numbered from 0.
    Python,
    /// `f[x]` is a call, `(* *)` a comment.
    Mathematica,
}

impl Library {
    /// All of them.
    pub const ALL: [Library; 12] = [
        Library::Sciml,
        Library::Sundials,
        Library::Petsc,
        Library::PetscKickFirst,
        Library::RungeKuttaJl,
        Library::Odeint,
        Library::Nodepy,
        Library::Mathematica,
        Library::Principia,
        Library::Rebound,
        Library::Pyhamsys,
        Library::PyhamsysDriftFirst,
    ];

    /// The name on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Library::Sciml => "sciml",
            Library::Sundials => "sundials",
            Library::Petsc => "petsc",
            Library::PetscKickFirst => "petsc-kick-first",
            Library::RungeKuttaJl => "rungekutta.jl",
            Library::Odeint => "odeint",
            Library::Nodepy => "nodepy",
            Library::Mathematica => "mathematica",
            Library::Principia => "principia",
            Library::Rebound => "rebound",
            Library::Pyhamsys => "pyhamsys",
            Library::PyhamsysDriftFirst => "pyhamsys-drift-first",
        }
    }

    /// The library of this name.
    ///
    /// # Errors
    /// [`ErrorKind::Unknown`], which lists all names.
    ///
    /// ```
    /// use symplectic_compiler::Library;
    ///
    /// assert_eq!(Library::find("sundials")?, Library::Sundials);
    /// let error = Library::find("gsl").unwrap_err();
    /// assert!(error.to_string().starts_with("unknown library `gsl`; known here: sciml, sundials, petsc, "));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn find(name: &str) -> Result<Library, Error> {
        let found = Library::ALL.into_iter().find(|known| known.name() == name);
        found.ok_or_else(|| {
            let kind = ErrorKind::Unknown {
                what: "library",
                name: shown(name),
                known: Library::ALL.map(Library::name).join(", "),
            };
            kind.into()
        })
    }

    /// How the library steps a splitting; `None` if it has none.
    ///
    /// ```
    /// use symplectic_compiler::Library;
    ///
    /// let sundials = Library::Sundials.stepping().expect("SPRKStep");
    /// assert_eq!((sundials.kick, sundials.drift, sundials.drifts_first), ("ahat", "a", false));
    /// assert!(Library::Nodepy.stepping().is_none());
    /// ```
    pub const fn stepping(self) -> Option<Stepping> {
        // The letters for drifts and for kicks, and whether the drift of a stage comes first.
        let (drift, kick, drifts_first, evidence) = match self {
            Library::Sciml => (
                "b",
                "a",
                true,
                "perform_step! of the generic symplectic cache: u += dt b[i] f2(du), then du += dt a[i] f1(u)",
            ),
            Library::Sundials => (
                "a",
                "ahat",
                false,
                "sprkStep_TakeStep: f1, the force, with ahat[i], then f2, the velocity, with a[i]",
            ),
            Library::Petsc => (
                "c",
                "d",
                true,
                "TSStep_BasicSymplectic: update position q with c[i], then velocity p with d[i]",
            ),
            Library::PetscKickFirst => (
                "d",
                "c",
                false,
                "TSStep_BasicSymplectic: update velocity p with c[i], then position q with d[i]",
            ),
            Library::Odeint => (
                "a",
                "b",
                true,
                "symplectic_nystroem_stepper_base::do_step_impl: the coordinate with coef_a[l], then the momentum with coef_b[l]",
            ),
            Library::Mathematica => (
                "B",
                "b",
                false,
                "NDSolve tutorial on SymplecticPartitionedRungeKutta, algorithm 1: P_i = P_(i-1) + h b_i F(Q_i), then Q_(i+1) = Q_i + h B_i G(P_i)",
            ),
            Library::Principia => (
                "a",
                "b",
                false,
                "SymplecticRungeKuttaNyströmIntegrator: exp(b_i h B), the velocities, then exp(a_i h A), the positions",
            ),
            Library::Rebound => (
                "c",
                "d",
                true,
                "reb_integrator_saba_step, and so the steps of leapfrog, JANUS and EOS: drift by c[i], then interaction by d[i], and back with the same numbers",
            ),
            Library::Pyhamsys => (
                "a",
                "b",
                false,
                "SymplecticIntegrator._integrate_onestep: chi* and chi in turn by alpha_1, alpha_2, …, and back (version 0.88); with two parts, chi*(x) chi(y) is b, a, b",
            ),
            Library::PyhamsysDriftFirst => (
                "b",
                "a",
                true,
                "README: chi is exp(h X_A) exp(h X_B) for these methods, with H = A(p) + B(q); SymplecticIntegrator._integrate_onestep begins with chi* (version 0.88)",
            ),
            Library::RungeKuttaJl | Library::Nodepy => return None,
        };
        Some(Stepping {
            drift,
            kick,
            drifts_first,
            mirrored: matches!(self, Library::Rebound),
            evidence,
        })
    }

    /// The language of its tables.
    pub const fn notation(self) -> Notation {
        match self {
            Library::Sundials
            | Library::Petsc
            | Library::PetscKickFirst
            | Library::Odeint
            | Library::Principia
            | Library::Rebound => Notation::C,
            Library::Sciml | Library::RungeKuttaJl => Notation::Julia,
            Library::Nodepy | Library::Pyhamsys | Library::PyhamsysDriftFirst => Notation::Python,
            Library::Mathematica => Notation::Mathematica,
        }
    }
}
