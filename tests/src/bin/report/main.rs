//! The report of all methods on all scenes, error against run time:
//! `cargo run --release -p symplectic-tests --bin report`; with `--no-default-features` only the scenes of the README, which build sooner.
//!
//! Writes a page, plots, CSV, JSON and the table of the book to a folder.

#![allow(clippy::print_stdout, reason = "a report prints its table")]

mod facts;
#[cfg(feature = "all-scenes")]
mod more;
mod peers;
mod scenes;
mod sets;

use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use symplectic_report::{Fact, Measurements, Repetitions, Settings, Study};
use symplectic_tests::stiff_and_extreme;

use crate::scenes::{Scene, scenes};

/// The name of the stiff and extreme cases among the scenes.
const STIFF: &str = "stiff-and-extreme";

/// Whether this build has more scenes than those of the README.
const HAS_ALL_SCENES: bool = cfg!(feature = "all-scenes");

/// The report of all methods on all scenes, error against run time.
#[derive(Debug, Parser)]
struct Arguments {
    /// Only scenes whose names contain this text; can be repeated.
    #[arg(long)]
    scene: Vec<String>,
    /// Only methods whose names contain this text; can be repeated.
    #[arg(long)]
    method: Vec<String>,
    /// Target errors instead of 1e-3, 1e-6, 1e-9, 1e-12; can be repeated.
    #[arg(long)]
    target: Vec<f64>,
    /// Shorter runs and fewer repetitions, within a minute.
    #[arg(long)]
    quick: bool,
    /// The output folder.
    #[arg(long, default_value = "target/report")]
    out: PathBuf,
    /// Draws the measurements of this JSON file, without measuring.
    #[arg(long)]
    from: Option<PathBuf>,
    /// Lists the names of the scenes, without measuring.
    #[arg(long)]
    list: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.list {
        names().for_each(|name| println!("{name}"));
        return Ok(());
    }
    let measurements = match &arguments.from {
        Some(path) => Measurements::from_json(&fs::read_to_string(path)?)?,
        None => measure(&arguments)?,
    };
    let page = measurements.write(&arguments.out)?;
    println!("{}\n{}", measurements.table(), page.display());
    Ok(())
}

/// The names of the scenes.
fn names() -> impl Iterator<Item = &'static str> {
    let stiff = HAS_ALL_SCENES.then_some(STIFF);
    scenes().map(|(name, _)| *name).chain(stiff)
}

/// Checks that every text is in the name of a scene.
fn check_scenes(texts: &[String]) -> Result<(), String> {
    let is_in_none = |text: &&String| !names().any(|name| contains_any(name, &[(*text).clone()]));
    let Some(text) = texts.iter().find(is_in_none) else {
        return Ok(());
    };
    let hint = match HAS_ALL_SCENES {
        true => "",
        false => "; a build without `--no-default-features` has more scenes",
    };
    Err(format!(
        "no scene has `{text}` in its name: `--list` prints the names{hint}"
    ))
}

fn measure(arguments: &Arguments) -> Result<Measurements, Box<dyn Error>> {
    check_scenes(&arguments.scene)?;
    let chosen = |(name, _): &&Scene| contains_any(name, &arguments.scene);
    let bar = ProgressBar::new(1000);
    bar.set_style(ProgressStyle::with_template("{bar:30} {elapsed}  {msg}")?);
    let mut study = Study::new("Error against run time");
    for (name, add) in scenes().filter(chosen) {
        bar.set_message(format!("{name}: reference"));
        study = add(study)?;
    }
    study.retain_methods(|name| contains_any(name, &arguments.method));
    let mut measurements = study.run(&settings(arguments), |advance| {
        bar.set_position((1000.0 * advance.fraction) as u64);
        let method = advance.method.unwrap_or("times, in turn");
        bar.set_message(format!("{}: {method}", advance.problem));
    });
    if HAS_ALL_SCENES && contains_any(STIFF, &arguments.scene) {
        let keep = |name: &str| contains_any(name, &arguments.method);
        let steps = if arguments.quick { 10_000 } else { 10_000_000 };
        let table = stiff_and_extreme::verdicts(steps, keep, |problem, part| {
            bar.set_position((1000.0 * part) as u64);
            bar.set_message(format!("{STIFF}: {problem}"));
        })?;
        measurements.verdicts.push(table);
        bar.set_message("limits of stability");
        measurements.limits = stiff_and_extreme::limits(keep)?;
    }
    bar.set_message("facts about the methods");
    measurements.add_facts(facts::facts);
    bar.finish_and_clear();
    let elapsed = bar.elapsed().as_secs();
    measurements.circumstances = circumstances(arguments.quick, elapsed);
    Ok(measurements)
}

/// Whether a name contains one of these texts, or there are none.
fn contains_any(name: &str, texts: &[String]) -> bool {
    let name = plain(name);
    texts.is_empty() || texts.iter().any(|text| name.contains(&plain(text)))
}

/// Lower case, with some non-ASCII letters replaced.
fn plain(text: &str) -> String {
    let letter = |c| match c {
        'ö' => 'o',
        'é' => 'e',
        '–' => '-',
        other => other,
    };
    text.to_lowercase().chars().map(letter).collect()
}

fn settings(arguments: &Arguments) -> Settings {
    let mut settings = if arguments.quick {
        Settings {
            budget: Duration::from_millis(15),
            repetitions: Repetitions {
                least: 2,
                most: 3,
                enough: Duration::from_millis(4),
            },
            ..Settings::default()
        }
    } else {
        Settings {
            budget: Duration::from_millis(100),
            ..Settings::default()
        }
    };
    if !arguments.target.is_empty() {
        settings.targets = arguments.target.clone();
        settings.targets.sort_by(|a, b| b.total_cmp(a));
    }
    settings
}

/// The registers that integrators find.
fn registers() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") {
            return ", AVX-512";
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            return ", AVX2";
        }
    }
    ""
}

/// The circumstances of the measurement.
fn circumstances(quick: bool, seconds: u64) -> Vec<Fact> {
    let vectors = registers();
    let kind = if quick { "quick" } else { "full" };
    vec![
        Fact::new("Machine", format!("{}{vectors}", processor())),
        Fact::new(
            "Measured",
            format!("the {kind} report, in {seconds} s, one thread"),
        ),
    ]
}

/// The name of the processor if the system provides it, otherwise the architecture.
fn processor() -> String {
    let architecture = std::env::consts::ARCH.to_owned();
    let Ok(text) = fs::read_to_string("/proc/cpuinfo") else {
        return architecture;
    };
    let name = text.lines().find(|line| line.starts_with("model name"));
    let name = name.and_then(|line| line.split_once(": "));
    name.map_or(architecture, |(_, name)| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_in_the_name_of_no_scene_is_an_error() {
        assert_eq!(
            check_scenes(&["henon".to_owned(), "fput-chain".to_owned()]),
            Ok(())
        );
        let error = check_scenes(&["kepler".to_owned(), "keplr".to_owned()]);
        assert!(error.is_err_and(|error| error.contains("`keplr`")));
    }

    #[test]
    fn names_are_found_as_anyone_types_them() {
        let found = |name, text: &str| contains_any(name, &[text.to_owned()]);
        assert!(found("Störmer–Verlet", "stormer-verlet"));
        assert!(found("Störmer–Verlet", "Störmer"));
        assert!(!found("Störmer–Verlet", "gauss"));
        assert!(contains_any("Gauss 4", &[]));
    }
}
