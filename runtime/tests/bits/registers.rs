//! Steps of a formula in registers that the program detects have the bits of steps in those for which it is compiled.

use std::fmt::Debug;

use crate::common::methods::{
    Gauss2, Gauss3, Gauss5, Gauss8, Gauss10, Gauss18, Lobatto4, Radau3, Tang,
};
use symplectic::nalgebra::DVector;
use symplectic::system::Masses;
use symplectic::{
    Error, General, Hamiltonian, Integrator, Method, ProvedFor, Scalar, Separable, State,
    Summation, System, Vector,
};

symplectic::hamiltonian! {
    /// In one register whatever the vector holds: square roots.
    Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q|
}

symplectic::hamiltonian! {
    /// Masses other than one, on the heap, with exponential functions.
    Toda { m: [..] }
    q: [..], p: [..];
    H = sum(i: p[i]^2/(2 m[i])) + exp(q[0] - q[1]) + exp(q[1] - q[2]) + exp(q[2] - q[0]) + q[0] sin(t)/10
}

symplectic::hamiltonian! {
    /// A kinetic energy that is not quadratic: velocities and forces in turn.
    Relativistic q: [x], p: [px]; H = sqrt(1 + px^2) + x^2/2
}

symplectic::hamiltonian! {
    /// Not separable, with sines.
    DoublePendulum
    q: [a, b], p: [pa, pb];
    let d = a - b;
    H = (pa^2 + 2 pb^2 - 2 pa pb cos(d)) / (2 (1 + sin(d)^2)) - 10 (2 cos(a) + cos(b))
}

symplectic::hamiltonian! {
    /// Not separable, with logarithms.
    PointVortex q: [x], p: [y]; H = -ln(x^2 + 2 y^2 + x y/3 + 1)
}

/// The same system, without the promise that all of it is inlined.
#[derive(Clone)]
struct Narrow<H>(H);

impl<H: Hamiltonian> Hamiltonian for Narrow<H> {
    type Class = H::Class;
    type Vector<T: Scalar> = H::Vector<T>;

    const MASSES: Masses = H::MASSES;

    fn velocity<T: Scalar>(
        &self,
        time: T,
        q: &H::Vector<T>,
        p: &H::Vector<T>,
        velocity: &mut H::Vector<T>,
    ) {
        self.0.velocity(time, q, p, velocity);
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &H::Vector<T>,
        p: &H::Vector<T>,
        force: &mut H::Vector<T>,
    ) {
        self.0.force(time, q, p, force);
    }

    fn slopes<T: Scalar>(
        &self,
        time: T,
        q: &H::Vector<T>,
        p: &H::Vector<T>,
        slopes: (&mut H::Vector<T>, &mut H::Vector<T>),
    ) {
        self.0.slopes(time, q, p, slopes);
    }
}

/// Both ways, in both sums.
fn compare<M, H, V>(method: M, system: &H, start: &State<V>, h: f64) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<<H as Hamiltonian>::Class>,
    V: Vector<Scalar = f64> + Debug,
    H: Hamiltonian<Vector<f64> = V> + Clone,
{
    assert!(<H as Hamiltonian>::INLINED && !<Narrow<H> as Hamiltonian>::INLINED);
    let narrow = || Narrow(system.clone());
    same(
        Integrator::new(method, system.clone(), start.clone(), h)?,
        Integrator::new(method, narrow(), start.clone(), h)?,
    )?;
    same(
        Integrator::plain(method, system.clone(), start.clone(), h)?,
        Integrator::plain(method, narrow(), start.clone(), h)?,
    )
}

/// 100 steps and what is inside them, then a step that is too long, with the same error.
fn same<M, A, B, V, R>(
    mut wide: Integrator<M, A, V, R>,
    mut narrow: Integrator<M, B, V, R>,
) -> Result<(), Error>
where
    M: Method + ProvedFor<A::Class>,
    A: System<V>,
    B: System<V, Class = A::Class>,
    V: Vector<Scalar = f64> + Debug,
    R: Summation,
{
    let name = M::NAME;
    for step in 0..100 {
        // As text, which has the signs of zeros.
        let [a, b] = [wide.step()?, narrow.step()?].map(|state| format!("{state:?}"));
        assert_eq!(a, b, "{name} step {step}");
        let [a, b] = [wide.remainder(), narrow.remainder()].map(|low| format!("{low:?}"));
        assert_eq!(a, b, "{name} step {step}");
    }
    assert_eq!(wide.iterations(), narrow.iterations(), "{name}");
    let inside = wide.state().time - 0.3 * wide.step_size();
    let [a, b] = [wide.dense()?.state(inside)?, narrow.dense()?.state(inside)?];
    assert_eq!(a, b, "{name}");
    wide.set_step_size(1e3)?;
    narrow.set_step_size(1e3)?;
    let [a, b] = [wide.step().cloned(), narrow.step().cloned()];
    assert_eq!(format!("{a:?}"), format!("{b:?}"), "{name}");
    Ok(())
}

fn separable<M: Method + Copy + ProvedFor<Separable>>(method: M) -> Result<(), Error> {
    let orbit = State::from_arrays(0.0, [0.5, 0.0], [0.0, 1.6]);
    compare(method, &Kepler, &orbit, 0.05)?;
    let at = |values: [f64; 3]| DVector::from_row_slice(&values);
    let start = State::new(0.3, at([0.1, -0.4, 0.2]), at([0.3, 0.0, -0.5]));
    compare(method, &Toda::new(vec![1.0, 2.0, 0.5]), &start, -0.1)?;
    let fast = State::from_arrays(0.0, [0.0], [3.0]);
    compare(method, &Relativistic, &fast, 0.1)
}

fn general<M: Method + Copy + ProvedFor<General>>(method: M) -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0, 2.0], [0.1, -0.3]);
    compare(method, &DoublePendulum, &start, 0.02)?;
    let vortex = State::from_arrays(0.0, [1.0], [0.5]);
    compare(method, &PointVortex, &vortex, -0.1)
}

macro_rules! methods {
    ($($test:ident: $method:ident;)*) => {
        $(#[test]
        fn $test() -> Result<(), Error> {
            separable($method)?;
            general($method)
        })*
    };
}

methods! {
    two_lanes: Gauss2;
    four_lanes_of_three_stages: Gauss3;
    four_lanes_of_lobatto: Lobatto4;
    four_lanes_of_radau: Radau3;
    more_nodes_than_functions: Tang;
    eight_lanes_of_five_stages: Gauss5;
    eight_lanes: Gauss8;
    two_groups: Gauss10;
    three_groups: Gauss18;
}
