//! Steps in Lagrangian form, against the same methods for Hamiltonians.

use symplectic::nalgebra::{SVector, Vector2};
use symplectic::variational::{
    LagrangianIntegrator, generating_function, momentum_of_velocity, velocity_of_momentum,
};
use symplectic::{
    Error, General, Integrator, Lagrangian, Method, ProvedFor, Scalar, State, System,
};

symplectic::tableau! {
    Gauss1 { basis: polynomial(1), nodes: gauss(1) }
    Gauss2 { basis: polynomial(2), nodes: gauss(2) }
    Gauss3 { basis: polynomial(3), nodes: gauss(3) }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    Gauss6 { basis: polynomial(6), nodes: gauss(6) }
    Lobatto2 { basis: polynomial(2), nodes: lobatto(2) }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
    Lobatto4 { basis: polynomial(4), nodes: lobatto(4) }
    Cosine { basis: [1, cos(pi*t)], nodes: [0, 1] }
}

type V2<T> = SVector<T, 2>;

/// A relativistic particle in Kepler's potential with friction: L = −√(1 − |v|²) + 1/|q|, f = −friction v.
#[derive(Clone, Copy)]
struct Particle {
    friction: f64,
}

impl Lagrangian for Particle {
    type Vector<T: Scalar> = V2<T>;
    const FORCED: bool = true;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        q.dot(q).sqrt().recip() - (T::one() - v.dot(v)).sqrt()
    }

    fn force<T: Scalar>(&self, _: T, _: &V2<T>, v: &V2<T>, force: &mut V2<T>) {
        *force = v * T::from_f64(-self.friction);
    }
}

symplectic::hamiltonian! {
    /// The same by its Hamiltonian.
    pub Relativistic { friction: 0 }
    q: [x, y], p: [px, py];
    let energy = sqrt(1 + px^2 + py^2);
    H = energy - 1/sqrt(x^2 + y^2)
    force: { x = -friction px/energy, y = -friction py/energy }
}

/// A pendulum whose length depends on time: L = l(t)² v²/2 + l(t) cos q, l = 1 + sin(3t)/4.
#[derive(Clone, Copy)]
struct Swing;

impl Lagrangian for Swing {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, time: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        let length = T::one() + (time * T::from_f64(3.0)).sin() * T::from_f64(0.25);
        let speed = length * v[0];
        speed * speed * T::from_f64(0.5) + length * q[0].cos()
    }
}

symplectic::hamiltonian! {
    pub SwingByHamiltonian
    q: [x], p: [px];
    let l = 1 + sin(3 t)/4;
    H = px^2/(2 l^2) - l cos(x)
}

fn near_perihelion() -> State<Vector2<f64>> {
    let (q, v) = (Vector2::new(4.0, 0.0), Vector2::new(0.1, 0.4));
    let p = momentum_of_velocity(&Particle { friction: 0.0 }, 0.0, &q, &v).expect("a momentum");
    State::new(0.0, q, p)
}

fn distance<const N: usize>(a: &State<SVector<f64, N>>, b: &State<SVector<f64, N>>) -> f64 {
    (a.q - b.q).amax().max((a.p - b.p).amax())
}

/// The distance of both forms after ten steps.
fn difference<M, L, S, const N: usize>(
    method: M,
    lagrangian: L,
    system: S,
    start: State<SVector<f64, N>>,
) -> f64
where
    M: Method + ProvedFor<General>,
    L: Lagrangian<Vector<f64> = SVector<f64, N>>,
    S: System<SVector<f64, N>, Class = General>,
{
    let mut one = LagrangianIntegrator::new(method, lagrangian, start.clone(), 0.25).expect("a start");
    let mut other = Integrator::new(method, system, start, 0.25).expect("a start");
    for _ in 0..10 {
        one.step().expect("a step");
        other.step().expect("a step");
    }
    distance(one.state(), other.state())
}

#[test]
fn the_steps_are_those_of_the_hamiltonian() {
    macro_rules! each {
        ($($method:ident)*) => {$(
            let (particle, system) = (Particle { friction: 0.1 }, Relativistic { friction: 0.1 });
            let far = difference($method, particle, system, near_perihelion());
            assert!(far < 2e-14, "{}: {far:e}", $method::NAME);
        )*};
    }
    each!(Gauss1 Gauss2 Gauss3 Gauss4 Gauss6 Lobatto2 Lobatto3 Lobatto4 Cosine);
}
