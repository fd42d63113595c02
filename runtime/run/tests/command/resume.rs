//! Runs that are killed continue with the same bits.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::{call, folder};

const SETUP: &str = r#"
    system = "Cubic { c } q: [x], p: [px]; H = px^2/2 + x^2/2 - c x^3/3"
    method = "forest-ruth-1990"
    step_size = 0.01
    times = { from = 0, to = 5, count = 6 }
    parameters.c = { values = [0.9, 1] }
    random = { seed = 3, count = 100 }
    starts = { x = { uniform = [0, 1.2] }, px = 0.0 }
    output.file = "out.csv"
"#;

/// Pendulums on rods.
const RODS: &str = r#"
    system = "Rod { c } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + c y constraints: { rod = x^2 + y^2 - 1 }"
    method = "lobatto-3"
    step_size = 0.01
    times = { from = 0, to = 0.5, count = 6 }
    parameters.c = { values = [0.9, 1] }
    random = { seed = 3, count = 100 }
    starts = { x = { uniform = [-0.9, 0.9] }, y = "-sqrt(1 - x^2)", px = 0, py = 0 }
    output.file = "out.csv"
"#;

/// Starts a run and kills it once the file of its trajectories has this length; false if the run ends before.
fn kill_at(folder: &Path, setup: &str, length: u64) -> bool {
    let file = folder.join("setup.toml");
    fs::write(&file, setup).expect("a file");
    let mut run = Command::new(env!("CARGO_BIN_EXE_symplectic-run"))
        .arg(&file)
        .args(["--resume", "--save-every", "0", "--threads", "2"])
        .stdout(Stdio::null())
        .spawn()
        .expect("a run");
    loop {
        if run.try_wait().expect("a run").is_some() {
            return false;
        }
        if fs::metadata(resume_of(folder)).is_ok_and(|about| about.len() >= length) {
            run.kill().expect("a run");
            run.wait().expect("a run");
            return true;
        }
        sleep(Duration::from_millis(1));
    }
}

fn resume_of(folder: &Path) -> PathBuf {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut paths = entries.map(|entry| entry.expect("a file").path());
    let found = paths.find(|path| path.extension().is_some_and(|e| e == "resume"));
    found.unwrap_or_default()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("a file").file_name());
    let mut names: Vec<String> = names
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_killed_run_continues_with_the_same_bits() {
    let section = SETUP.replace(
        "times = { from = 0, to = 5, count = 6 }",
        "end = 5.0\n    section.of = 'px'",
    );
    let end = SETUP.replace("times = { from = 0, to = 5, count = 6 }", "end = 5.0");
    for (name, setup, output) in [
        ("killed-times", SETUP, "out.csv"),
        ("killed-section", &section, "out.csv"),
        ("killed-rods", RODS, "out.csv"),
        ("killed-end", &end.replace("out.csv", "out.npz"), "out.npz"),
    ] {
        let folder = folder(name);
        assert!(call(&folder, setup, &[]).status.success());
        let expected = fs::read(folder.join(output)).expect("the output");
        fs::remove_file(folder.join(output)).expect("the output");
        // Places that no boundary of records knows.
        let mut seed = 7_u64;
        let mut length = 0;
        let mut killed = 0;
        for _ in 0..3 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            length += seed >> 51;
            killed += usize::from(kill_at(&folder, setup, length));
        }
        assert!(killed > 0, "no run was killed");
        let output_of_run = call(&folder, setup, &["--resume"]);
        let said = String::from_utf8_lossy(&output_of_run.stdout);
        assert!(output_of_run.status.success(), "{output_of_run:?}");
        assert!(said.starts_with("200 trajectories, "), "{said}");
        let found = fs::read(folder.join(output)).expect("the output");
        assert!(found == expected, "{name}");
        assert_eq!(names(&folder), [output, "setup.toml"]);
    }
}

/// The file of an interrupted run, cut anywhere, gives the same results.
#[test]
fn an_incomplete_record_is_computed_again() {
    let folder = folder("cut");
    assert!(call(&folder, SETUP, &[]).status.success());
    let expected = fs::read(folder.join("out.csv")).expect("the output");
    assert!(kill_at(&folder, SETUP, 1500));
    let path = resume_of(&folder);
    let whole = fs::read(&path).expect("records");
    let lines = whole.split_inclusive(|byte| *byte == b'\n');
    let head: usize = lines.take(2).map(<[u8]>::len).sum();
    // Killed in the first lines, too.
    let ends = [0, 7, head - 1, head, head + 1, head + 300];
    for length in ends.into_iter().chain([whole.len() - 1, whole.len()]) {
        fs::write(&path, &whole[..length]).expect("a file");
        let output = call(&folder, SETUP, &["--resume"]);
        assert!(output.status.success(), "{output:?}");
        let found = fs::read(folder.join("out.csv")).expect("the output");
        assert!(found == expected, "{length} of {}", whole.len());
    }
}

#[test]
fn a_resume_file_of_another_run_is_refused() {
    let folder = folder("other-run");
    let (first, second) = ("x,px,c\n0.1,0,1\n", "x,px,c\n0.2,0,1\n");
    let setup = SETUP
        .replace("parameters.c = { values = [0.9, 1] }", "")
        .replace("random = { seed = 3, count = 100 }", "")
        .replace("{ x = { uniform = [0, 1.2] }, px = 0.0 }", "'starts.csv'");
    let many = format!("{first}{}", "0.3,0,1\n".repeat(200));
    fs::write(folder.join("starts.csv"), &many).expect("a file");
    // With 3000 bytes the file has finished trajectories; one that was killed earlier may have none.
    assert!(kill_at(&folder, &setup, 3000));
    let path = resume_of(&folder);
    let written = fs::read(&path).expect("records");
    let text = String::from_utf8_lossy(&written).into_owned();
    let version = format!("\"version\":\"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(text.contains(&version));
    let of_version = |version: &str| {
        let head = &written[..text.find(version).expect("a version")];
        let rest = &written[head.len() + version.len()..];
        [head, b"\"version\":\"0.0.9\"", rest].concat()
    };
    let damaged = |from: &[u8]| [b"symplectic run: format 0\n", from].concat();
    let resume = &["--resume"][..];
    let other_system = setup.replace("x^3/3", "x^3/4");
    let other_file = setup.replace("0.01", "0.02");
    for (setup, starts, file, options, told) in [
        (
            &setup,
            &many[..],
            written.clone(),
            &[][..],
            "continue it with `--resume`, or delete the file",
        ),
        (
            &other_system,
            &many,
            written.clone(),
            resume,
            "belongs to another system",
        ),
        (
            &other_file,
            &many,
            written.clone(),
            resume,
            "belongs to another run file",
        ),
        (
            &setup,
            second,
            written.clone(),
            resume,
            "belongs to other starts",
        ),
        (
            &setup,
            &many,
            of_version(&version),
            resume,
            "was written by version 0.0.9 of `symplectic`, and this is version",
        ),
        (
            &setup,
            &many,
            damaged(&written),
            resume,
            "was written by another version",
        ),
    ] {
        fs::write(folder.join("starts.csv"), starts).expect("a file");
        fs::write(&path, &file).expect("a file");
        let output = call(&folder, setup, options);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}: {error}");
        assert!(
            error.contains(told)
                && error.contains("out.csv.resume")
                && error.contains("nothing was computed"),
            "{told}: {error}"
        );
        // It is unchanged.
        assert!(fs::read(&path).expect("records") == file, "{told}");
    }
    // That of the whole run is not that of a part.
    fs::write(folder.join("starts.csv"), &many).expect("a file");
    fs::write(folder.join("out.0-of-2.csv.resume"), &written).expect("a file");
    let output = call(&folder, &setup, &["--resume", "--shard", "0/2"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(
        error.contains("belongs to the whole run, and this is the part 0/2"),
        "{error}"
    );
}
