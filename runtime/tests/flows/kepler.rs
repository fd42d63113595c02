//! Kepler orbits against the closed forms of each kind.

use symplectic::State;
use symplectic::flow::kepler::KeplerDrift;
use symplectic::flow::{Error, Flow, FlowError, FlowSteps, Span};
use symplectic::nalgebra::{DVector, Rotation3, Vector3};
use symplectic::simd::{F64x2, F64x4, F64x8, F64x16, Lanes};

/// μ of the centre, and the mass of the body.
const MU: f64 = 1.7;
const MASS: f64 = 0.3;

type Point = (Vector3<f64>, Vector3<f64>);

/// An orbit in a plane that is no plane of coordinates, and its point at any time.
#[derive(Clone, Copy, Debug)]
enum Orbit {
    /// Semi-major axis and eccentricity; the eccentricity 1 is a line.
    Ellipse(f64, f64),
    Hyperbola(f64, f64),
    /// Distance of the pericentre.
    Parabola(f64),
    /// A fall with the velocity of escape.
    Line,
}

/// The zero of a function that grows, by halving beyond the last bit.
fn zero(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..120 {
        let middle = low + (high - low) / 2.0;
        if value(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// `x − sin x` without cancellation, to 10 digits and more where x is small.
fn minus_sine(x: f64) -> f64 {
    if x.abs() < 0.3 {
        let y = x * x;
        x * y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0 * (1.0 - y / 72.0 * (1.0 - y / 110.0))))
    } else {
        x - x.sin()
    }
}

impl Orbit {
    /// Position and velocity at a time after the pericentre.
    fn at(self, time: f64) -> Point {
        let (q, v) = match self {
            Self::Ellipse(a, e) => {
                let rate = (MU / a.powi(3)).sqrt();
                let mean = rate * time;
                let turns = (mean / std::f64::consts::TAU).round();
                let mean = mean - turns * std::f64::consts::TAU;
                let equation = |x: f64| (1.0 - e) * x.sin() + minus_sine(x) - mean;
                let x = zero(equation, -4.0, 4.0);
                let b = a * (1.0 - e * e).sqrt();
                let near = 2.0 * (x / 2.0).sin().powi(2);
                let speed = rate / (1.0 - e + e * near);
                (
                    [a * (1.0 - e - near), b * x.sin()],
                    [-a * x.sin() * speed, b * x.cos() * speed],
                )
            }
            Self::Hyperbola(a, e) => {
                let rate = (MU / a.powi(3)).sqrt();
                let equation = |x: f64| e * x.sinh() - x - rate * time;
                let x = zero(equation, -800.0, 800.0);
                let b = a * (e * e - 1.0).sqrt();
                let speed = rate / (e * x.cosh() - 1.0);
                (
                    [a * (e - x.cosh()), b * x.sinh()],
                    [-a * x.sinh() * speed, b * x.cosh() * speed],
                )
            }
            Self::Parabola(q) => {
                // Barker's equation.
                let unit = (2.0 * q.powi(3) / MU).sqrt();
                let d = zero(|d| d + d.powi(3) / 3.0 - time / unit, -1e9, 1e9);
                let speed = 1.0 / (unit * (1.0 + d * d));
                (
                    [q * (1.0 - d * d), 2.0 * q * d],
                    [-2.0 * q * d * speed, 2.0 * q * speed],
                )
            }
            Self::Line => {
                let r = (4.5 * MU * time * time).cbrt();
                ([r, 0.0], [2.0 * r / (3.0 * time), 0.0])
            }
        };
        let plane = Rotation3::from_euler_angles(0.4, -1.1, 2.3);
        let in_space = |[x, y]: [f64; 2]| plane * Vector3::new(x, y, 0.0);
        (in_space(q), in_space(v))
    }
}

fn drifted((q, v): Point, size: f64) -> Result<Point, FlowError> {
    let mut drift = KeplerDrift::new(&[MASS], &[MU]).expect("a drift");
    let (mut q, mut p) = (q, v * MASS);
    drift.flow(Span { time: 0.0, size }, &mut q, &mut p)?;
    Ok((q, p / MASS))
}

/// The largest relative differences in position and velocity.
fn difference(a: Point, b: Point) -> f64 {
    let position = (a.0 - b.0).norm() / b.0.norm();
    position.max((a.1 - b.1).norm() / b.1.norm())
}

/// How much relative changes of the start and of the time are amplified: at least 1, and not more than 10⁸.
fn condition(start: Point, size: f64) -> f64 {
    const CHANGE: f64 = 1e-6;
    let end = drifted(start, size).expect("an orbit");
    let changed = (0..7).map(|k| {
        let (mut q, mut v, mut size) = (start.0, start.1, size);
        match k {
            0..3 => q[k] += CHANGE * q.norm(),
            3..6 => v[k - 3] += CHANGE * v.norm(),
            _ => size += CHANGE * size,
        }
        difference(drifted((q, v), size).expect("an orbit"), end) / CHANGE
    });
    let sum: f64 = changed.sum();
    assert!(sum < 1e8, "{sum}");
    sum.max(1.0)
}

/// The error of the flow from one time to another, relative to what rounding of the start makes.
fn error(orbit: Orbit, from: f64, to: f64) -> f64 {
    let (start, size) = (orbit.at(from), to - from);
    let found = drifted(start, size).expect("an orbit");
    difference(found, orbit.at(to)) / condition(start, size) / f64::EPSILON
}

/// Orbits of every kind.
fn orbits() -> Vec<Orbit> {
    let ellipses = [0.0, 1e-3, 0.05, 0.3, 0.7, 0.95, 0.999, 1.0].map(|e| Orbit::Ellipse(1.3, e));
    let hyperbolas = [1.001, 1.1, 2.0, 30.0].map(|e| Orbit::Hyperbola(0.8, e));
    let limits = [Orbit::Parabola(0.7), Orbit::Parabola(1e-4), Orbit::Line];
    [&ellipses[..], &hyperbolas, &limits].concat()
}

#[test]
fn orbits_of_every_kind_end_where_the_closed_forms_say() {
    let times = [-9.3, -2.0, -0.4, -0.05, 0.011, 0.3, 1.7, 6.1, 40.0];
    for orbit in orbits() {
        for (from, to) in times
            .iter()
            .flat_map(|&from| times.map(|to| (from, to)))
            .filter(|(from, to)| from != to)
        {
            // The closed forms cancel too, most of all for hyperbolas near a parabola.
            let error = error(orbit, from, to);
            assert!(error < 64.0, "{orbit:?} from {from} to {to}: {error}");
        }
    }
}

/// The phase has the error of the period for each period.
#[test]
fn the_phase_error_of_a_drift_grows_linearly_with_the_periods() {
    let orbit = Orbit::Ellipse(1.3, 0.3);
    let period = std::f64::consts::TAU * (1.3_f64.powi(3) / MU).sqrt();
    for periods in [1.0, 1e3, 1e6] {
        let time = periods * period + 0.2;
        let found = drifted(orbit.at(0.1), time).expect("an orbit");
        let error = difference(found, orbit.at(0.3)) / (periods * f64::EPSILON);
        assert!(error < 100.0, "{periods}: {error}");
    }
    let too_many = drifted(orbit.at(0.1), 1e8 * period);
    assert!(
        matches!(too_many, Err(FlowError::Periods { body: 0, periods }) if (periods - 1e8).abs() < 1.0)
    );
}

/// Any number of bodies of all kinds, in lanes of every width, against each of them alone.
#[test]
fn lanes_of_every_width_give_the_same_bits() {
    fn ends<L: Lanes>(points: &[Point], size: f64) -> Vec<Point> {
        let count = points.len();
        let mut drift = KeplerDrift::new(&vec![MASS; count], &vec![MU; count])
            .expect("a drift")
            .in_lanes::<L>();
        let list = |of: fn(&Point) -> Vector3<f64>| {
            let numbers = points.iter().flat_map(|point| of(point).data.0[0]);
            DVector::from_vec(numbers.collect())
        };
        let (mut q, mut p) = (list(|point| point.0), list(|point| point.1 * MASS));
        let span = Span { time: 0.0, size };
        drift.flow(span, &mut q, &mut p).expect("orbits");
        let of = |list: &DVector<f64>, i: usize| list.fixed_rows::<3>(3 * i).into_owned();
        (0..count).map(|i| (of(&q, i), of(&p, i))).collect()
    }
    let points: Vec<Point> = orbits().iter().map(|orbit| orbit.at(-0.4)).collect();
    for size in [0.01, 0.3, -0.3, 0.9, 2.0, 31.0] {
        let alone = points
            .iter()
            .flat_map(|&point| ends::<F64x2>(&[point], size));
        let alone: Vec<Point> = alone.collect();
        for count in 1..=points.len() {
            let (points, alone) = (&points[..count], &alone[..count]);
            assert_eq!(alone, ends::<F64x2>(points, size), "{count}, {size}");
            assert_eq!(alone, ends::<F64x4>(points, size), "{count}, {size}");
            assert_eq!(alone, ends::<F64x8>(points, size), "{count}, {size}");
            assert_eq!(alone, ends::<F64x16>(points, size), "{count}, {size}");
        }
    }
}

/// Rounding moves the energy by about ε in a step, in either direction: the mean is smaller. With 1/6 rounded to a double it is −0.08 ε.
#[test]
#[ignore = "thorough"]
fn errors_of_many_steps_have_no_common_sign() {
    const COUNT: usize = 64;
    const STEPS: u32 = 4000;
    let points: Vec<Point> = (0..COUNT)
        .map(|k| Orbit::Ellipse(1.0 + 1e-3 * k as f64, 0.1 * (k % 4) as f64).at(0.1 * k as f64))
        .collect();
    let mut drift = KeplerDrift::new(&[1.0; COUNT], &[MU; COUNT]).expect("a drift");
    let list = |of: fn(&Point) -> Vector3<f64>| {
        let numbers = points.iter().flat_map(|point| of(point).data.0[0]);
        DVector::from_vec(numbers.collect())
    };
    let energies = |q: &DVector<f64>, p: &DVector<f64>| -> Vec<f64> {
        let energy = |k: usize| {
            let (q, p) = (q.fixed_rows::<3>(3 * k), p.fixed_rows::<3>(3 * k));
            p.norm_squared() / 2.0 - MU / q.norm()
        };
        (0..COUNT).map(energy).collect()
    };
    let (mut q, mut p) = (list(|point| point.0), list(|point| point.1));
    // A quarter of a period, and less than a seventh.
    for (size, bound) in [(1.15, 0.04), (0.65, 0.01)] {
        let before = energies(&q, &p);
        for _ in 0..STEPS {
            let span = Span { time: 0.0, size };
            drift.flow(span, &mut q, &mut p).expect("orbits");
        }
        let after = energies(&q, &p);
        let changes = before.iter().zip(after).map(|(a, b)| (b - a) / a);
        let mean = changes.sum::<f64>() / COUNT as f64 / f64::from(STEPS) / f64::EPSILON;
        assert!(mean.abs() < bound, "{size}: {mean}");
    }
}

/// A flow of long steps changes areas by less than its rounding errors. If `m·(1/m)` were rounded, each step would change the angular
/// momentum by up to ε/2 in the same direction.
#[test]
#[ignore = "thorough"]
fn angular_momentum_has_no_drift_for_any_mass() {
    const STEPS: u32 = 4000;
    // The masses between 1 and 2 whose rounded reciprocals are the most wrong, on either side.
    let error = |mass: &f64| mass.mul_add(mass.recip(), -1.0);
    let candidates: Vec<f64> = (0..512).map(|k| 1.0 + f64::from(k) / 511.0).collect();
    let order = |a: &&f64, b: &&f64| error(a).total_cmp(&error(b));
    let worst = [
        candidates.iter().min_by(order),
        candidates.iter().max_by(order),
    ];
    for mass in worst.map(|mass| *mass.expect("a mass")) {
        assert!(error(&mass).abs() > 0.2 * f64::EPSILON);
        let mut drift = KeplerDrift::new(&[mass; 64], &[MU; 64]).expect("a drift");
        let start = |k: usize| {
            Orbit::Ellipse(1.0 + 1e-3 * k as f64, 0.1 * (k % 4) as f64).at(0.1 * k as f64)
        };
        let mut q = DVector::from_fn(192, |i, _| start(i / 3).0[i % 3]);
        let mut p = DVector::from_fn(192, |i, _| start(i / 3).1[i % 3] * mass);
        let momentum = |q: &DVector<f64>, p: &DVector<f64>, k: usize| {
            let of = |list: &DVector<f64>| list.fixed_rows::<3>(3 * k).into_owned();
            of(q).cross(&of(p)).norm()
        };
        let before: Vec<f64> = (0..64).map(|k| momentum(&q, &p, k)).collect();
        let span = Span {
            time: 0.0,
            size: 0.65,
        };
        for _ in 0..STEPS {
            drift.flow(span, &mut q, &mut p).expect("orbits");
        }
        let changes = (0..64).map(|k| momentum(&q, &p, k) / before[k] - 1.0);
        let mean = changes.sum::<f64>() / 64.0 / f64::from(STEPS) / f64::EPSILON;
        assert!(mean.abs() < 0.01, "{mass}: {mean}");
    }
}

/// A line through the centre is the limit of thin ellipses: it turns back.
#[test]
fn a_radial_fall_turns_back_at_the_centre() {
    let line = |time| Orbit::Ellipse(1.3, 1.0).at(time);
    let found = drifted(line(-0.7), 1.4).expect("an orbit");
    assert!(difference(found, line(0.7)) < 1e-13);
    let thin = Orbit::Ellipse(1.3, 1.0 - 1e-12);
    let found = drifted(thin.at(-0.7), 1.4).expect("an orbit");
    assert!(difference(found, line(0.7)) < 1e-5);
}

/// Where the first guess of the universal anomaly is so far that one of Stumpff's functions overflows before the others.
#[test]
fn long_hyperbolic_drifts_end_at_their_closed_form() {
    let orbit = Orbit::Hyperbola(0.8, 2.0);
    for from in [-0.9, -0.3] {
        let start = orbit.at(from);
        for exponent in 7000..7200 {
            let size = f64::from(exponent) / 10.0 * start.0.norm() * (0.8 / MU).sqrt();
            let found = drifted(start, size).expect("an orbit");
            assert!(difference(found, orbit.at(from + size)) < 1e-12);
        }
    }
}

/// Passing the centre, a fall turns back; the direction has the error of that of the start times `|q| v²/μ`: 10⁴, or 10¹⁰.
#[test]
fn a_flow_that_loses_half_of_the_digits_is_an_error() {
    let direction = Vector3::new(1.0, 1.0, 0.3).normalize();
    let start = |speed: f64| (direction * 0.07, direction * -speed);
    let energy = |(q, v): Point| v.norm_squared() / 2.0 - MU / q.norm();
    for speed in [40.0, 1e3] {
        let end = drifted(start(speed), 1000.0).expect("an orbit");
        assert!((energy(end) / energy(start(speed)) - 1.0).abs() < 1e-10);
    }
    assert_eq!(
        drifted(start(1e6), 1000.0),
        Err(FlowError::NoOrbit { body: 0 })
    );
}

#[test]
fn a_drift_without_an_end_is_refused_and_leaves_the_state() {
    let mut drift = KeplerDrift::new(&[1.0; 2], &[1.0; 2]).expect("a drift");
    let start = |q: f64, p: f64| {
        State::<DVector<f64>>::from_slices(
            0.0,
            &[1.0, 0.0, 0.0, q, 0.0, 0.0],
            &[0.0, 1.0, 0.0, p, 0.0, 0.0],
        )
        .expect("a state")
    };
    let mut failure = |q: f64, p: f64, size: f64| {
        let State { mut q, mut p, .. } = start(q, p);
        let before = (q.clone(), p.clone());
        let failure = drift.flow(Span { time: 0.0, size }, &mut q, &mut p);
        assert_eq!(before, (q, p));
        failure.expect_err("no end")
    };
    assert_eq!(failure(0.0, 1.0, 0.1), FlowError::AtCentre { body: 1 });
    assert_eq!(failure(1e200, 1.0, 1.0), FlowError::NoOrbit { body: 1 });
    assert_eq!(failure(1.0, 1e200, 1.0), FlowError::NoOrbit { body: 1 });
    // The square of this distance has seven digits.
    assert_eq!(
        failure(1e-158, 1e79, 1e-237),
        FlowError::NoOrbit { body: 1 }
    );
    assert!(matches!(
        failure(1e-7, 0.0, 1e3),
        FlowError::Periods { body: 1, .. }
    ));
    let drift = KeplerDrift::new(&[1.0], &[1.0]).expect("a drift");
    let mut run = FlowSteps::run(drift, start(1.0, 0.0), 0.1).expect("a run");
    let before = run.state().clone();
    let expected = FlowError::Dimension {
        expected: 3,
        found: 6,
    };
    let failure = run.step().expect_err("another number of bodies");
    assert!(matches!(failure, Error::Flow { step: 1, failure, .. } if failure == expected));
    assert_eq!(run.state(), &before);
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (masses, mus) in [([1.0, value], [1.0; 2]), ([1.0; 2], [1.0, value])] {
            let failure = KeplerDrift::new(&masses, &mus).expect_err("out of range");
            assert!(
                matches!(failure, Error::FlowParameter { index: 1, .. }),
                "{failure}"
            );
        }
    }
}
