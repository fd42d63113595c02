//! Formulas on a tape have the bits of the same formulas in compiled Rust.

use std::sync::Arc;

use symplectic::at_run_time::RunTimeTableau;
use symplectic::nalgebra::{DVector, SMatrix};
use symplectic::simd::{F64x2, F64x4, F64x8, Lanes};
use symplectic::system::Conservative;
use symplectic::{
    Compensated, General, Integrator, Method, Plain, ProvedFor, Separable, State, Summation,
    System, Vector,
};
use symplectic_formula::{Form, Structure, System as Parsed};
use symplectic_tape::{Entry, Formula, Parameters, Tapes, Values};

/// A system in compiled Rust, and its text.
macro_rules! formulas {
    ($($name:ident $text:ident { $($formula:tt)* })*) => {
        $(
            symplectic::hamiltonian! { $name $($formula)* }
            const $text: &str = concat!(stringify!($name), " ", stringify!($($formula)*));
        )*
    };
}

formulas! {
    Kepler KEPLER { q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
    HenonHeiles HENON_HEILES { q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3 }
    DoublePendulum DOUBLE_PENDULUM {
        q: [a, b], p: [pa, pb];
        let d = a - b;
        H = (pa^2 + 2 pb^2 - 2 pa pb cos(d))/(2 (1 + sin(d)^2)) - 9.8 (2 cos(a) + cos(b))
    }
    Chain CHAIN { q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4) }
    Functions FUNCTIONS {
        q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + atan2(y, x)^2 + (x + 2)^(1/3) + 2^x + |x|^3 + sinh(x) tanh(y) + asin(x/9) acos(y/9)
            + atan(x) + tan(y) + ln(3 + cosh(x)) exp(sin(y)) cos(x t)
    }
    Free FREE { q: [x, y], p: [px, py]; H = px - 3 py + x/4 }
    Turning TURNING { q: [3], p: [3]; H = |p|^2 (1 + |q|^2)/2 + q[0] p[1] - q[1] p[0] }
}

symplectic::hamiltonian! {
    Planets<N> { m: [N], G: 2.95912208286e-4 }
    q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
}
const PLANETS: &str = "Planets<N> { m: [N], G: 2.95912208286e-4 } q: [N; 3], p: [N; 3]; \
                       H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)";

symplectic::tableau! {
    BlanesMoanS10 { base: blanes-moan-2002-s10 }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    Gauss8 { basis: polynomial(8), nodes: gauss(8) }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
}

/// The formula on a tape; parameters are columns of numbers.
fn formula<C>(text: &str, bodies: usize, parameters: &[&[f64]]) -> Formula<C> {
    let mut system = Parsed::read_as(Form::Hamiltonian, "the formula", text).expect("a formula");
    let structure = Structure::of(&mut system);
    let column = |numbers: &&[f64]| numbers.iter().map(|x| vec![Entry::Number(*x)]).collect();
    let values = Values {
        parameters: parameters.iter().map(column).collect(),
        pairs: vec![Vec::new(); parameters.len()],
        ..Values::of_bodies(bodies)
    };
    let tapes = Tapes::new(&mut system, &structure, &values, 0.0).expect("tapes");
    Formula::new(Arc::new(tapes), Parameters::none())
}

/// Pseudo-random numbers between −1 and 1.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Velocity, force, slopes and energy of both systems at a random point, over the numbers of these vectors.
fn compare_at_points<S, F, V, W>(
    (system, tape): (&S, &F),
    (like, dynamic): (&V, &W),
    mut number: impl FnMut() -> V::Scalar,
    doubles: impl Fn(&[V::Scalar]) -> Vec<f64>,
) where
    S: System<V>,
    F: System<W>,
    V: Vector,
    W: Vector<Scalar = V::Scalar>,
{
    for _ in 0..20 {
        let (mut q, mut p, mut time) = (like.clone(), like.clone(), number());
        for component in q.as_mut_slice().iter_mut().chain(p.as_mut_slice()) {
            *component = number();
            std::mem::swap(component, &mut time);
        }
        let (mut of_q, mut of_p) = (dynamic.clone(), dynamic.clone());
        of_q.as_mut_slice().copy_from_slice(q.as_slice());
        of_p.as_mut_slice().copy_from_slice(p.as_slice());
        let (mut expected, mut found) = (
            [like.clone(), like.clone()],
            [dynamic.clone(), dynamic.clone()],
        );
        let [velocity, force] = &mut expected;
        let [of_velocity, of_force] = &mut found;
        let same = |expected: &V, found: &W| {
            let (expected, found) = (doubles(expected.as_slice()), doubles(found.as_slice()));
            let name = std::any::type_name::<S>();
            assert_eq!(bits(&expected), bits(&found), "{name}");
        };
        system.velocity(time, &q, &p, velocity);
        tape.velocity(time, &of_q, &of_p, of_velocity);
        same(velocity, of_velocity);
        system.force(time, &q, &p, force);
        tape.force(time, &of_q, &of_p, of_force);
        same(force, of_force);
        system.slopes(time, &q, &p, (velocity, force));
        tape.slopes(time, &of_q, &of_p, (of_velocity, of_force));
        same(velocity, of_velocity);
        same(force, of_force);
        // A chain sums its energy in another order.
        let name = std::any::type_name::<S>();
        if !name.ends_with("Chain") {
            let energy = system.energy(time, &q, &p).expect("H is known");
            let of_tape = tape.energy(time, &of_q, &of_p).expect("H is known");
            assert_eq!(
                bits(&doubles(&[energy])),
                bits(&doubles(&[of_tape])),
                "{name}"
            );
        }
    }
}

/// [`compare_at_points`] with doubles and in lanes of all widths of the build.
macro_rules! compare_evaluations {
    ($system:expr, $tape:expr, $start:expr) => {{
        let (system, tape, like) = (&$system, &$tape, &$start.q);
        let dynamic = DVector::<f64>::zeros(like.as_slice().len());
        let mut random = Random(3);
        let both = (system, tape);
        compare_at_points(both, (like, &dynamic), || random.number(), <[f64]>::to_vec);
        compare_evaluations!(both, like, dynamic, random, F64x2 F64x4 F64x8);
    }};
    ($both:expr, $like:expr, $dynamic:expr, $random:expr, $($lanes:ident)*) => {
        $(
            let number = || $lanes::from_fn(|_| $random.number());
            let doubles = |numbers: &[$lanes]| -> Vec<f64> {
                numbers.iter().flat_map(|lanes| lanes.to_array()).collect()
            };
            let like = ($like.zeros_with::<$lanes>(), $dynamic.zeros_with::<$lanes>());
            compare_at_points($both, (&like.0, &like.1), number, doubles);
        )*
    };
}

fn end<M, S, V, R>(method: M, system: S, start: State<V>, size: f64) -> Vec<u64>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V, Class: Conservative>,
    V: Vector<Scalar = f64>,
    R: Summation,
{
    let run = Integrator::<M, S, V, R>::with_summation(method, system, start, size);
    let mut run = run.expect("an integrator");
    let state = run.take_steps(25).expect("25 steps");
    bits(&[state.q.as_slice(), state.p.as_slice()].concat())
}

/// The ends of runs of both systems, by the emitted method and by the same tableau at run time.
fn compare_runs<M, S, F, V>(method: M, (system, tape): (&S, &F), start: &State<V>, size: f64)
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V, Class: Conservative> + Clone,
    F: System<DVector<f64>, Class = S::Class> + Clone,
    V: Vector<Scalar = f64>,
{
    let dynamic = |half: &V| DVector::from_column_slice(half.as_slice());
    let dynamic = State::new(0.0, dynamic(&start.q), dynamic(&start.p));
    let tableau = RunTimeTableau::new(M::NAME, &M::COEFFICIENTS.into(), M::ORDERS);
    let tableau = tableau.expect("symplectic").accept_lower_order();
    macro_rules! compare {
        ($method:expr, $sums:ty) => {
            assert_eq!(
                end::<_, _, _, $sums>($method, system.clone(), start.clone(), size),
                end::<_, _, _, $sums>($method, tape.clone(), dynamic.clone(), size),
                "{}",
                M::NAME
            );
        };
    }
    compare!(method, Plain);
    compare!(method, Compensated);
    compare!(tableau.clone(), Plain);
    compare!(tableau.clone(), Compensated);
}

#[test]
fn separable_formulas_have_the_bits_of_compiled_rust() {
    macro_rules! compare {
        ($system:expr, $tape:expr, $start:expr, $size:expr) => {{
            let (system, tape, start) = ($system, $tape, $start);
            compare_evaluations!(system, tape, start);
            compare_runs(BlanesMoanS10, (&system, &tape), &start, $size);
            compare_runs(Gauss4, (&system, &tape), &start, $size);
            compare_runs(Gauss8, (&system, &tape), &start, $size);
            compare_runs(Lobatto3, (&system, &tape), &start, $size);
        }};
    }
    let start = State::from_arrays(0.0, [0.4, 0.1], [0.2, 0.9]);
    compare!(
        Kepler,
        formula::<Separable>(KEPLER, 2, &[]),
        start.clone(),
        0.05
    );
    compare!(
        HenonHeiles,
        formula::<Separable>(HENON_HEILES, 2, &[]),
        start.clone(),
        0.1
    );
    compare!(
        Functions,
        formula::<Separable>(FUNCTIONS, 2, &[]),
        start.clone(),
        0.01
    );
    compare!(Free, formula::<Separable>(FREE, 2, &[]), start, 0.1);
    // With and without rows, and with rows of more than one chunk.
    let mut random = Random(5);
    for count in [1, 2, 5, 9, 40] {
        let mut half = || DVector::from_fn(count, |_, _| random.number());
        let start = State::new(0.0, half(), half());
        compare!(Chain, formula::<Separable>(CHAIN, count, &[]), start, 0.1);
    }
    let masses = [1.0, 0.3, 0.2, 0.7, 0.4];
    let mut half = |size: f64| SMatrix::<f64, 3, 5>::from_fn(|_, _| size * random.number());
    let start = State::new(0.0, half(3.0), half(0.05));
    let tape = formula::<Separable>(PLANETS, 5, &[&masses, &[2.95912208286e-4]]);
    compare!(Planets::new(masses), tape, start, 0.5);
}

#[test]
fn general_formulas_have_the_bits_of_compiled_rust() {
    macro_rules! compare {
        ($system:expr, $text:expr, $start:expr) => {{
            let (system, start) = ($system, $start);
            let tape = formula::<General>($text, start.q.len(), &[]);
            compare_evaluations!(system, tape, start);
            compare_runs(Gauss4, (&system, &tape), &start, 0.02);
            compare_runs(Gauss8, (&system, &tape), &start, 0.02);
            compare_runs(Lobatto3, (&system, &tape), &start, 0.02);
        }};
    }
    let start = State::from_arrays(0.0, [1.2, 0.7], [0.1, 0.3]);
    compare!(DoublePendulum, DOUBLE_PENDULUM, start);
    let start = State::from_arrays(0.0, [0.4, 0.1, -0.3], [0.2, 0.5, 0.1]);
    compare!(Turning, TURNING, start);
}
