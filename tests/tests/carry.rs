//! What a step leaves for the next one is what the next one would compute.

use symplectic::nalgebra::Vector1;
use symplectic::{Error, Integrator, Method, State, separable};
use symplectic_tests::methods::{Lobatto3, Lobatto4, StoermerVerlet, SymplecticEuler};

symplectic::tableau! {
    /// b = (1/2, −1/2, 1/2, 1/2) and a_ij = μ_ij b_j with rows (0 0 0 0), (1 1 0 0), (1 1 1 1), (1 1 1 1) of μ: the
    /// velocities of the first two stages cancel, so that both of these stages start the step, and both of the others
    /// end it.
    TwoAtEachEnd {
        basis: [347/4 - 52085/16*t + 10744775/288*t^2 - 58609625/288*t^3 + 355821875/576*t^4 - 106028125/96*t^5 + 13890625/12*t^6 - 94765625/144*t^7 + 30078125/192*t^8,
            -667/4 + 299935/48*t - 20764775/288*t^2 + 114727625/288*t^3 - 706859375/576*t^4 + 213728125/96*t^5 - 18921875/8*t^6 + 196015625/144*t^7 - 62890625/192*t^8,
            467/4 - 221935/48*t + 16333475/288*t^2 - 32023375/96*t^3 + 627165625/576*t^4 - 66471875/32*t^5 + 331515625/144*t^6 - 21953125/16*t^7 + 65234375/192*t^8,
            607/4 - 289495/48*t + 21399275/288*t^2 - 42176375/96*t^3 + 830978125/576*t^4 - 88646875/32*t^5 + 445046875/144*t^6 - 88984375/48*t^7 + 88671875/192*t^8],
        nodes: [1/5, 2/5, 3/5, 4/5],
        require: [symplectic, explicit]
    }
}

/// Runs a few steps in a row, and the same steps each begun anew from the state so far; they may differ by as many units
/// of rounding. With plain sums, for a state that is put in leaves nothing out.
fn compare<M: Method + Copy>(method: M, units: f64) -> Result<(), Error> {
    let system = || {
        separable::<Vector1<f64>, _, _>(
            |_, p, velocity| velocity[0] = p[0] + p[0].powi(3) / 7.0,
            |_, q, force| force[0] = -q[0].sin(),
        )
    };
    let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.25));
    let mut in_a_row = Integrator::plain(method, system(), start.clone(), 0.125)?;
    let mut anew = Integrator::plain(method, system(), start, 0.125)?;
    for _ in 0..5 {
        let state = in_a_row.step()?.clone();
        let other = anew.step()?;
        let [q, p] = [other.q - state.q, other.p - state.p].map(|difference| difference[0].abs());
        assert!(q.max(p) <= units * f64::EPSILON, "{}: {q:e} {p:e}", M::NAME);
        assert_eq!(other.time, state.time);
        // A state that is put in carries nothing over.
        anew.set_state(state)?;
    }
    Ok(())
}

#[test]
fn consecutive_steps_agree_with_restarted_ones() -> Result<(), Error> {
    compare(TwoAtEachEnd, 0.0)?;
    compare(StoermerVerlet, 0.0)?;
    compare(SymplecticEuler, 0.0)?;
    // Where stages are solved for, they start from those of the step before, or from the state.
    compare(Lobatto3, 2.0)?;
    compare(Lobatto4, 2.0)
}
