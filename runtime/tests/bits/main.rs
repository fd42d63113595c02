//! The same bits on every path: in lanes of any width, in blocks of steps, along a chain.

#[path = "../common/mod.rs"]
mod common;

mod blocks;
mod chain;
mod elementary;
mod lanes;
mod not_a_number;
mod plain_steps;
mod registers;
mod slopes;
