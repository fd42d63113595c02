//! Steps and runs: accuracy, solvers, errors, events, output, restart.

#[path = "../common/mod.rs"]
mod common;

mod accuracy;
mod allocation;
mod dense;
mod errors;
mod event_lists;
mod event_zeros;
mod events;
mod excursions;
mod generating_function;
mod gradient_kicks;
mod impacts;
mod newton;
mod newton_of_chains;
mod parameters;
mod processed;
mod proved;
mod recording;
mod restart;
mod run_time;
mod scalars;
mod stopping;
mod times;
