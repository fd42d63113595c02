//! Triple jumps and Suzuki's fractals of Störmer–Verlet, level by level: one field for each, where the field of all has too high a degree.

use super::numbers::{DIGITS, coefficients, text};
use symplectic_compiler::inside::Fact;
use symplectic_compiler::inside::Scheme;
use symplectic_compiler::{Definition, Key};
use symplectic_exact::elementary::root;
use symplectic_exact::interval::Interval;
use symplectic_exact::polynomial::Polynomial;
use symplectic_exact::rational::ratio;
use symplectic_exact::rounding::Decimal;

use Fact::{List, Table};

/// The splittings that are Störmer–Verlet themselves.
const BASES: [&str; 2] = ["velocity-verlet", "position-verlet"];

/// The binary places of the root.
const BITS: u32 = 256;

/// The levels of a composition of this definition; `None` if it is another method.
pub(super) fn of(definition: &Definition) -> Option<Fact> {
    let known = |(key, _)| matches!(key, Key::Base | Key::Weights);
    let base = definition.get(Key::Base)?;
    if !definition.parts().all(known) || !BASES.contains(&base) {
        return None;
    }
    let (scheme, order) = Scheme::parse(definition.get(Key::Weights)?)?;
    let levels = (2..order).step_by(2).map(|from| level(scheme, from + 1));
    let levels: Option<Vec<Fact>> = levels.collect();
    Some(Table(vec![
        ("kind", text("levels")),
        ("levels", List(levels?)),
    ]))
}

/// The fractions with `θ = 2^{1/n}`.
fn level(scheme: Scheme, n: u32) -> Option<Fact> {
    let modulus = &Polynomial::monomial(n as usize) - &Polynomial::from_integers(&[2]);
    let (power, outers) = match scheme {
        Scheme::TripleJump => (1, 1),
        Scheme::Suzuki => (2, 2),
    };
    let power = Polynomial::monomial(power);
    let outer = &Polynomial::from_integers(&[2 * outers]) - &power;
    let outer = outer.inverse_modulo(&modulus).ok()?;
    let inner = (-&(&power * &outer)).remainder(&modulus);
    let outers = std::iter::repeat_n(&outer, outers as usize);
    let weights = outers.clone().chain([&inner]).chain(outers);
    let theta = root(&Interval::enclosing(&ratio(2, 1), BITS), n)?;
    Some(Table(vec![
        ("polynomial", coefficients(&modulus)),
        ("root", text(Decimal::round(&theta.middle(), DIGITS))),
        ("weights", List(weights.map(coefficients).collect())),
    ]))
}
