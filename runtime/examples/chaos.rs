//! The section x = 0 of Hénon and Heiles, each orbit in the colour of its MEGNO: blue where it is near 2, red where it grows.
//! `cargo run --release --features parallel --example chaos > chaos.svg`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::fmt::Write as _;
use std::ops::ControlFlow;

use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::tangent::{Megno, Tangent};
use symplectic::{Event, State};

symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }

symplectic::hamiltonian! {
    HenonHeiles
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3
}

const ENERGY: f64 = 0.125;
const END: f64 = 1000.0;
const ORBITS: u32 = 48;

/// A start on the section, if the energy reaches there.
fn start(y: f64, py: f64) -> Option<State<Vector2<f64>>> {
    let kinetic = ENERGY - (y * y + py * py) / 2.0 + y * y * y / 3.0;
    (kinetic > 0.0).then(|| State::from_arrays(0.0, [0.0, y], [(2.0 * kinetic).sqrt(), py]))
}

/// From blue, where MEGNO is 2 or less, to red, where it is 16 or more.
fn colour(megno: f64) -> String {
    let red = (megno / 2.0).max(1.0).log2().min(3.0) / 3.0;
    let mix = |from: f64, to: f64| (from + red * (to - from)).round();
    format!(
        "rgb({},{},{})",
        mix(20.0, 220.0),
        mix(90.0, 50.0),
        mix(190.0, 20.0)
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let system = Tangent::new(HenonHeiles);
    // Starts along both axes of the section.
    let along = (0..ORBITS).map(|k| f64::from(k) / f64::from(ORBITS));
    let starts = along.clone().map(|part| (part - 0.4, 0.0));
    let starts = starts.chain(along.map(|part| (0.0, part - 0.5)));
    let starts = starts.filter_map(|(y, py)| start(y, py)).map(|begin| {
        let displacement = (&Vector2::new(0.6, 0.3), &Vector2::new(-0.2, 0.7));
        system.start(&begin, displacement)
    });
    let starts: Vec<State<SVector<f64, 4>>> = starts.collect::<Result<_, _>>()?;

    let indicators: Vec<Megno> = starts.iter().map(Megno::new).collect::<Result<_, _>>()?;
    let ensemble = Ensemble::new(ForestRuth, system, starts, 0.05)?;
    let section = Event::rising(|state: &State<SVector<f64, 4>>| state.q[0]);
    println!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-480 -520 1180 1040" width="708" height="624">"#
    );
    println!(r#"<rect x="-480" y="-520" width="1180" height="1040" fill="white"/>"#);
    ensemble.each(
        |trajectory| (indicators[trajectory], Vec::new()),
        |(megno, points), integrator| {
            integrator.integrate_with_events(END, &section, |state| {
                megno.see(state);
                points.push((state.q[1], state.p[1]));
                ControlFlow::<()>::Continue(())
            })?;
            Ok(())
        },
        |row| {
            // An orbit whose displacement overflows has failed, and has its indicator.
            let (megno, points) = row.output;
            let mut path = String::new();
            for (y, py) in points {
                // To write to a string does not fail.
                let _ = write!(path, "M{:.0} {:.0}h0", 1000.0 * y, -1000.0 * py);
            }
            let colour = colour(megno.mean());
            println!(
                r#"<path d="{path}" stroke="{colour}" stroke-width="3" stroke-linecap="round"/>"#
            );
            ControlFlow::Continue(())
        },
    );
    println!("</svg>");
    Ok(())
}
