//! A tape has the bits of its values, in all numbers and registers.

use symplectic::simd::{F64x2, F64x4, F64x8, F64x16, MAX_LANES};
use symplectic_core::inside::{Avx2, Avx512, Widest, in_eight_lanes_of};

use super::rows::Rows;
use super::*;
use crate::assembly::{Assembly, join_products};
use crate::operation::{Code, apply as apply_once};
use crate::tape::Parameters;
use crate::unroll::{Number, Value};

/// Pseudo-random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn number(&mut self) -> f64 {
        self.below(2000) as f64 / 512.0 - 1.5
    }
}

const CODES: [Code; 24] = [
    Code::Add,
    Code::Subtract,
    Code::Multiply,
    Code::Divide,
    Code::MultiplyAdd,
    Code::MultiplySubtract,
    Code::SubtractProduct,
    Code::Negative,
    Code::Reciprocal,
    Code::Root,
    Code::Absolute,
    Code::OrZero,
    Code::Exp,
    Code::Ln,
    Code::Sin,
    Code::Cos,
    Code::Tan,
    Code::Asin,
    Code::Acos,
    Code::Atan,
    Code::Sinh,
    Code::Cosh,
    Code::Tanh,
    Code::Atan2,
];

/// The dimension of q and of p.
const DIMENSION: usize = 19;

/// Values and results. Operations come in lists of up to `longest` of one kind, on operands that follow each other, are the same, or are
/// anywhere. Results are any values, inputs too.
fn formula(random: &mut Random, lists: usize, longest: usize) -> (Vec<Value>, Vec<Number>) {
    let mut list: Vec<Value> = (0..DIMENSION).map(Value::Position).collect();
    list.extend((0..DIMENSION).map(Value::Momentum));
    list.extend([Value::Time, Value::Parameter(0), Value::Parameter(1)]);
    list.extend([0.0_f64, 1.0, -2.5].map(|x| Value::Constant(x.to_bits())));
    for _ in 0..lists {
        let (code, count) = (CODES[random.below(24)], 1 + random.below(longest));
        let known = list.len();
        let firsts = [(); 3].map(|()| (random.below(known), random.below(3)));
        for k in 0..count {
            let operands = firsts.map(|(first, kind)| match kind {
                0 => first,
                1 => (first + k) % known,
                _ => random.below(known),
            });
            list.push(Value::Step(code, operands.map(|operand| operand as Number)));
        }
    }
    let from = random.below(list.len());
    let last = from..list.len().min(from + 40);
    let any = (0..10).map(|_| random.below(list.len()));
    let results = any.collect::<Vec<_>>().into_iter().chain(last);
    let results = results.map(|result| result as Number).collect();
    (list, results)
}

fn assembled((list, results): &(Vec<Value>, Vec<Number>)) -> Tape {
    let mut list = list.clone();
    let uses = join_products(&mut list, results);
    let tape = Assembly::of(&list, uses, results).tape();
    tape.expect("few operations")
}

/// A point, with its time.
#[derive(Clone, Copy)]
struct Point {
    time: f64,
    q: [f64; DIMENSION],
    p: [f64; DIMENSION],
}

impl Point {
    fn any(random: &mut Random) -> Self {
        Point {
            time: random.number(),
            q: [(); DIMENSION].map(|()| random.number()),
            p: [(); DIMENSION].map(|()| random.number()),
        }
    }

    fn at<'a>(&'a self, parameters: &'a Parameters) -> At<'a, f64> {
        At {
            parameters,
            time: self.time,
            q: &self.q,
            p: &self.p,
        }
    }
}

const PARAMETERS: [f64; 2] = [0.75, -1.25];

/// The results without a tape: value by value.
fn expected((list, results): &(Vec<Value>, Vec<Number>), point: &Point) -> Vec<u64> {
    let mut known: Vec<f64> = Vec::new();
    for value in list {
        known.push(match *value {
            Value::Constant(bits) => f64::from_bits(bits),
            Value::Time => point.time,
            Value::Position(k) => point.q[k],
            Value::Momentum(k) => point.p[k],
            Value::Parameter(k) => PARAMETERS[k],
            Value::Step(code, operands) => {
                apply_once(code, operands.map(|operand| known[operand as usize]))
            }
        });
    }
    results.iter().map(|k| bits(known[*k as usize])).collect()
}

/// NaN has many bit patterns.
fn bits(value: f64) -> u64 {
    if value.is_nan() {
        u64::MAX
    } else {
        value.to_bits()
    }
}

/// Formulas of all sizes: in few and in many registers, with and without rows. Among them are results that are inputs only.
fn each_formula(mut check: impl FnMut(&(Vec<Value>, Vec<Number>), &mut Random)) {
    let mut random = Random(7);
    for (lists, longest) in [
        (0, 1),
        (1, 3),
        (4, 3),
        (12, 1),
        (12, 3),
        (30, 2),
        (5, 20),
        (30, 30),
    ] {
        for _ in 0..12 {
            let formula = formula(&mut random, lists, longest);
            check(&formula, &mut random);
        }
    }
}

#[test]
fn a_tape_has_the_bits_of_its_values() {
    let parameters = Parameters::from(&PARAMETERS[..]);
    let (mut wide, mut narrow) = (0, 0);
    each_formula(|formula, random| {
        let tape = assembled(formula);
        *(if tape.in_rows > 0 {
            &mut wide
        } else {
            &mut narrow
        }) += 1;
        let point = Point::any(random);
        let mut found = vec![0; formula.1.len()];
        tape.run(point.at(&parameters), |to, values: &[f64]| {
            for (place, value) in found[to..].iter_mut().zip(values) {
                *place = bits(*value);
            }
        });
        assert_eq!(found, expected(formula, &point));
    });
    assert!(wide > 10 && narrow > 10, "{wide}, {narrow}");
}

#[test]
fn several_points_have_the_bits_of_each_point() {
    let parameters = Parameters::from(&PARAMETERS[..]);
    each_formula(|formula, random| {
        let tape = assembled(formula);
        for count in (1..=9).chain([17]) {
            let points: Vec<Point> = (0..count).map(|_| Point::any(random)).collect();
            let mut found = vec![DVector::zeros(formula.1.len()); count];
            tape.fill(|k| points[k].at(&parameters), &mut found);
            for (found, point) in found.iter().zip(&points) {
                let found: Vec<u64> = found.iter().map(|value| bits(*value)).collect();
                assert_eq!(found, expected(formula, point), "{count}");
            }
        }
    });
}

fn compare_in_lanes<L: Lanes>() {
    // Each lane has its own parameters, which are the same here.
    let own = Parameters::from(&PARAMETERS[..]);
    let parameters = Parameters::join((0..MAX_LANES).map(|_| &own)).expect("as many lanes");
    each_formula(|formula, random| {
        let tape = assembled(formula);
        let points: Vec<Point> = (0..L::WIDTH).map(|_| Point::any(random)).collect();
        let half = |of: fn(&Point) -> &[f64; DIMENSION]| -> Vec<L> {
            let lanes = |k: usize| L::from_fn(|lane| of(&points[lane])[k]);
            (0..DIMENSION).map(lanes).collect()
        };
        let (q, p) = (half(|point| &point.q), half(|point| &point.p));
        let at = At {
            parameters: &parameters,
            time: L::from_fn(|lane| points[lane].time),
            q: &q,
            p: &p,
        };
        let mut found = vec![L::from_f64(f64::NAN); formula.1.len()];
        tape.run(at, |to, values: &[L]| copy_to(&mut found, to, values));
        for (lane, point) in points.iter().enumerate() {
            let found: Vec<u64> = found.iter().map(|value| bits(value.get(lane))).collect();
            assert_eq!(found, expected(formula, point), "{lane} of {}", L::WIDTH);
        }
    });
}

#[test]
fn lanes_of_all_widths_have_the_bits_of_doubles() {
    compare_in_lanes::<F64x2>();
    compare_in_lanes::<F64x4>();
    compare_in_lanes::<F64x8>();
    compare_in_lanes::<F64x16>();
}

#[test]
fn all_registers_of_the_processor_give_the_same_bits() {
    let mut all = vec![Widest::Build];
    all.extend(Avx2::detect().map(Widest::Avx2));
    all.extend(Avx512::detect().map(Widest::Avx512));
    let parameters = Parameters::from(&PARAMETERS[..]);
    each_formula(|formula, random| {
        let tape = assembled(formula);
        let point = Point::any(random);
        let expected = expected(formula, &point);
        for widest in &all {
            // By rows, and at eight points.
            let mut registers = vec![0.0; tape.registers];
            tape.load(point.at(&parameters), &mut registers);
            let mut eights = vec![[0.0; CHUNK]; tape.registers];
            tape.load_points(|_| point.at(&parameters), 3, &mut eights);
            let rows = Rows {
                tape: &tape,
                registers: &mut registers,
            };
            in_eight_lanes_of(*widest, rows);
            let points = AtEight {
                tape: &tape,
                registers: &mut eights[..],
            };
            in_eight_lanes_of(*widest, points);
            if tape.steps.is_empty() {
                continue;
            }
            for row in &tape.writes {
                for k in 0..row.count {
                    let place = row.from as usize + k;
                    let expected = expected[row.to + k];
                    assert_eq!(bits(registers[place]), expected, "{widest:?}");
                    assert!(eights[place].iter().all(|value| bits(*value) == expected));
                }
            }
        }
    });
}

#[test]
fn every_lane_has_its_own_parameters() {
    let own: Vec<_> = (0..8)
        .map(|lane| Parameters::from(&[lane as f64, 3.0][..]))
        .collect();
    let joined = Parameters::join(own.iter()).expect("eight lanes");
    let list = vec![
        Value::Parameter(0),
        Value::Parameter(1),
        Value::Step(Code::Multiply, [0, 1, 0]),
    ];
    let at = At {
        parameters: &joined,
        time: F64x8::from_f64(0.0),
        q: &[],
        p: &[],
    };
    let mut found = None;
    assembled(&(list, vec![2])).run(at, |_, values| found = Some(values[0].to_array()));
    assert_eq!(found, Some([0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0]));
    assert!(Parameters::join([joined.clone()].iter()).is_none());
}

#[test]
fn inputs_that_a_point_does_not_have_are_nan() {
    let list: Vec<Value> = (0..6).map(Value::Position).collect();
    let tape = assembled(&(list, (0..6).collect()));
    let parameters = Parameters::none();
    let at = At {
        parameters: &parameters,
        time: 0.0,
        q: &[1.0, 2.0],
        p: &[],
    };
    let mut found = [0.0; 6];
    tape.run(at, |to, values| copy_to(&mut found, to, values));
    assert_eq!(found[..2], [1.0, 2.0]);
    assert!(found[2..].iter().all(|value: &f64| value.is_nan()));
}
