"""Time of one trajectory, and of 10⁴ in an ensemble, beside a compiled program of Rust with the same system, method and step.

    pip install ./runtime/python
    python runtime/python/benchmarks/beside_rust.py

The script writes the program, builds it with cargo in its default build, and runs both in turn. Times are medians of whole runs on one
thread; the ends must have the same bits.
"""

from __future__ import annotations

import statistics
import struct
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import symplectica as sy

ROOT = Path(__file__).resolve().parents[3]
ROUNDS = 9
MASSES = "[1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449, 7.692307692307692e-9]"
PLANETS = [0, 0, 0, -3.5023653, -3.8169847, -1.5507963, 9.0755314, -3.0458353, -1.6483708, 8.310142, -16.2901086, -7.2521278,
           11.4707666, -25.7294829, -10.8169456, -15.5387357, -25.2225594, -3.1902382]
MOMENTA = [0, 0, 0, 5.4e-6, -3.9e-6, -1.8e-6, 4.8e-7, 1.38e-6, 5.5e-7, 1.55e-7, 6.0e-8, 2.4e-8, 1.5e-7, 5.9e-8, 2.1e-8, 2.1e-11, -1.3e-11, -1.05e-11]
BOTH = ("gauss-8", "blanes-moan-2002-s10", "sofroniou-spaletta-2005-s35odr10")

# Name, formula, parameters, start, end, step of each method.
SCENES = [
    ("Kepler", "q: [2], p: [2]; H = |p|^2/2 - 1/|q|", None, [0.4, 0], [0, 2], 1000.0, dict(zip(BOTH, (0.2, 0.05, 0.1), strict=True))),
    ("HenonHeiles", "q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3", None, [0, 0.1], [0.3, 0.35], 3000.0,
     dict(zip(BOTH, (0.5, 0.2, 0.5), strict=True))),
    ("Planets", "{ m: [6], G: 2.95912208286e-4 } q: [6; 3], p: [6; 3]; H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)", MASSES,
     PLANETS, MOMENTA, 500_000.0, dict(zip(BOTH, (400, 150, 300), strict=True))),
    ("DoublePendulum", "q: [a, b], p: [pa, pb]; let d = a - b; H = (pa^2 + 2 pb^2 - 2 pa pb cos(d))/(2 (1 + sin(d)^2)) - 9.8 (2 cos(a) + cos(b))", None,
     [0.6, 0.4], [0, 0.1], 200.0, {"gauss-8": 0.1}),
    ("Springs", "q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4)", None,
     [round(0.5 * np.sin(np.pi * (k + 1) / 33), 6) for k in range(32)], [0.0] * 32, 1000.0, dict(zip(BOTH, (0.5, 0.25, 0.5), strict=True))),
]
ENSEMBLES = [("Kepler", "gauss-8", 50.0, 0.2), ("Kepler", "blanes-moan-2002-s10", 50.0, 0.05), ("HenonHeiles", "gauss-8", 50.0, 0.5), ("HenonHeiles", "blanes-moan-2002-s10", 50.0, 0.2)]
TYPES = {"gauss-8": "Gauss8", "blanes-moan-2002-s10": "S10", "sofroniou-spaletta-2005-s35odr10": "S35"}


def numbers(values: list) -> str:
    return ", ".join(repr(float(value)) for value in values)


def program() -> str:
    """The program: for each run a line with its median time in seconds and the bits of its end."""
    lines = ["use std::time::Instant;", "use symplectic::nalgebra::*;", "use symplectic::{Integrator, State};", "use symplectic::ensemble::Ensemble;"]
    lines += [f"symplectic::tableau! {{ {name} {{ base: {method} }} }}" for method, name in TYPES.items()]
    lines += [f"symplectic::hamiltonian! {{ {name} {formula} }}" for name, formula, *_ in SCENES]
    lines += ["fn show(mut times: Vec<f64>, q: &[f64], p: &[f64]) {", "    times.sort_by(f64::total_cmp);", '    print!("{:e}", times[times.len() / 2]);',
              '    q.iter().chain(p).for_each(|x| print!(" {:016x}", x.to_bits()));', "    println!();", "}", "fn main() {"]
    systems = {}
    for name, formula, parameters, q, p, end, steps in SCENES:
        systems[name] = f"{name}::new({parameters})" if parameters else name
        make = {"Planets": "Matrix3x6::from_column_slice", "Springs": "DVector::from_column_slice"}.get(name, "Vector2::from_column_slice")
        for method, step in steps.items():
            lines += [
                "    { let mut times = Vec::new(); let mut last = None;",
                f"    for _ in 0..{ROUNDS} {{",
                f"        let start = State::new(0.0, {make}(&[{numbers(q)}]), {make}(&[{numbers(p)}]));",
                "        let began = Instant::now();",
                f"        let mut run = Integrator::new({TYPES[method]}, {systems[name]}, start, {float(step)!r}).expect(\"a run\");",
                f"        run.integrate_to({end!r}).expect(\"an end\");",
                "        times.push(began.elapsed().as_secs_f64()); last = Some(run.state().clone()); }",
                "    let last = last.expect(\"an end\"); show(times, last.q.as_slice(), last.p.as_slice()); }",
            ]
    for name, method, end, step in ENSEMBLES:
        q, p = next((q, p) for known, _, _, q, p, *_ in SCENES if known == name)
        lines += [
            f"    {{ let starts = (0..10_000).map(|k| State::from_arrays(0.0, [{numbers(q)}], [{float(p[0])!r}, {float(p[1])!r} * (1.0 - 1e-5 * f64::from(k))])).collect::<Vec<_>>();",
            "    let mut times = Vec::new(); let mut sums = [0.0_f64; 2];",
            "    for _ in 0..3 {",
            "        let began = Instant::now(); sums = [0.0; 2];",
            f"        let many = Ensemble::new({TYPES[method]}, {systems[name]}, starts.clone(), {float(step)!r}).expect(\"starts\");",
            f"        many.integrate_to({end!r}, |row| {{ sums[0] += row.state.q[0]; sums[1] += row.state.p[0]; std::ops::ControlFlow::Continue(()) }});",
            "        times.push(began.elapsed().as_secs_f64()); }",
            "    show(times, &sums[..1], &sums[1..]); }",
        ]
    return "\n".join([*lines, "}", ""])


def compiled(folder: Path) -> list[tuple[float, list[str]]]:
    """Builds and runs the program."""
    (folder / "src").mkdir()
    (folder / "src" / "main.rs").write_text(program(), encoding="utf-8")
    dependency = f'symplectic = {{ path = "{ROOT / "runtime"}", features = ["ensembles"] }}'
    (folder / "Cargo.toml").write_text(f'[package]\nname = "beside_python"\nversion = "0.1.0"\nedition = "2024"\n\n[dependencies]\n{dependency}\n\n[workspace]\n', encoding="utf-8")
    done = subprocess.run(["cargo", "run", "--quiet", "--release"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    rows = [line.split() for line in done.stdout.splitlines()]
    return [(float(row[0]), row[1:]) for row in rows]


def bits(*halves: np.ndarray) -> list[str]:
    return [struct.pack(">d", value).hex() for half in halves for value in np.ravel(half).tolist()]


def main() -> None:
    systems = {}
    found = []
    for name, formula, parameters, q, p, end, steps in SCENES:
        systems[name] = sy.system(formula, parameters={"m": eval(parameters)} if parameters else None), q, p
        for method, step in steps.items():
            times = []
            run = None
            for _ in range(ROUNDS + 1):
                before = time.perf_counter()
                run = systems[name][0].integrate(q, p, t=end, step=step, method=method, output=0)
                times.append(time.perf_counter() - before)
            assert run is not None
            found.append((f"{name}, {method}, h = {step:g}", statistics.median(times[1:]), bits(run.state[1], run.state[2])))
    for name, method, end, step in ENSEMBLES:
        system, q, p = systems[name]
        scale = 1.0 - 1e-5 * np.arange(10_000)
        starts = np.tile(np.array(q, float), (10_000, 1)), np.stack([np.full(10_000, float(p[0])), p[1] * scale], axis=1)
        times = []
        for _ in range(4):
            before = time.perf_counter()
            many = system.ensemble(*starts, t=end, step=step, method=method, threads=1)
            times.append(time.perf_counter() - before)
        sums = [0.0, 0.0]
        for x, y in zip(many.q[:, 0].tolist(), many.p[:, 0].tolist(), strict=True):
            sums = [sums[0] + x, sums[1] + y]
        found.append((f"10⁴ × {name}, {method}, h = {step:g}", statistics.median(times[1:]), bits(np.array(sums))))
    with tempfile.TemporaryDirectory() as folder:
        others = compiled(Path(folder))
    print("| run | compiled | symplectica | ratio | bits |\n|---|---:|---:|---:|---|")
    for (label, ours, own), (theirs, end) in zip(found, others, strict=True):
        print(f"| {label} | {theirs * 1e3:.3g} ms | {ours * 1e3:.3g} ms | {ours / theirs:.1f} | {'the same' if own == end else 'different'} |")


if __name__ == "__main__":
    main()
