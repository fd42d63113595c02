//! Newton's iteration on chains of the runtime.

use crate::common::methods::Gauss3;
use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::DVector;
use symplectic::solver::{ByNewton, Derivatives, Differences};
use symplectic::system::Jacobian;
use symplectic::{Error, Integrator, Scalar, State, System};

fn start() -> State<DVector<f64>> {
    let q = DVector::from_fn(24, |i, _| (0.3 * i as f64).sin());
    State::new(0.0, q, DVector::zeros(24))
}

/// V(d) = kd²/2 + d⁴/4 and W(q) = q⁴/4, and whether the second derivatives are known.
#[derive(Clone, Copy)]
struct Springs {
    stiffness: f64,
    known: bool,
}

impl Bonds for Springs {
    fn tension<T: Scalar>(&self, _time: T, d: T) -> T {
        T::from_f64(self.stiffness) * d + d * d * d
    }

    fn outer_force<T: Scalar>(&self, _time: T, position: T) -> Option<T> {
        Some(-position * position * position)
    }

    fn stiffness<T: Scalar>(&self, _time: T, d: T) -> Option<T> {
        self.known
            .then(|| T::from_f64(self.stiffness) + T::from_f64(3.0) * d * d)
    }

    fn outer_stiffness<T: Scalar>(&self, _time: T, position: T) -> Option<T> {
        self.known.then(|| T::from_f64(3.0) * position * position)
    }
}

#[test]
fn chains_know_their_band_and_their_derivatives() -> Result<(), Error> {
    for ends in [Chain::between_walls, Chain::with_free_ends, Chain::ring] {
        let chain = |known| {
            ends(Springs {
                stiffness: 1e6,
                known,
            })
        };
        let State { q, p, .. } = start();
        let band = System::<DVector<f64>>::half_bandwidth(&chain(true));
        let [mut exact, mut nearly] = [0, 1].map(|_| Jacobian::new(24, band));
        assert!(chain(true).second_derivatives(0.0, &q, &p, &mut exact));
        assert!(!chain(false).second_derivatives(0.0, &q, &p, &mut nearly));
        let mut memory = <Differences as Derivatives<_, Chain<Springs>>>::memory(&q);
        nearly.clear();
        Differences::evaluate(&mut memory, &chain(true), 0.0, &q, &p, &mut nearly);
        for (i, j) in (0..24).flat_map(|i| (0..24).map(move |j| (i, j))) {
            let [exact, nearly] =
                [&exact, &nearly].map(|jacobian| jacobian.force_by_position.get(i, j));
            assert!((exact - nearly).abs() < 1e-2, "{i} {j}: {exact} {nearly}");
        }
        let run = |known| {
            let integrator = Integrator::new(Gauss3, chain(known), start(), 0.1)?;
            Ok::<_, Error>(integrator.by_newton().integrate_to(2.0)?.q.clone())
        };
        let (q, other) = (run(true)?, run(false)?);
        assert!((&q - &other).norm() < 1e-12 * q.norm());
    }
    Ok(())
}
