//! Results that cannot be written, and files that must not be overwritten.

use std::fs;

use crate::{PENDULUM, call, folder};

#[test]
fn a_part_does_not_overwrite_the_starts() {
    let folder = folder("part-of-starts");
    let starts = "a,pa\n1,0\n0.5,0\n";
    fs::write(folder.join("pts.0-of-2.csv"), starts).expect("a file");
    let setup = &PENDULUM[..PENDULUM.find("[starts]").expect("a table")];
    let setup = format!("starts = 'pts.0-of-2.csv'\noutput.file = 'pts.csv'\n{setup}");
    let output = call(&folder, &setup, &["--shard", "0/2"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("would overwrite the file of the starts"));
    let kept = fs::read_to_string(folder.join("pts.0-of-2.csv")).expect("the starts");
    assert_eq!(kept, starts);
    // The other part has another name.
    assert!(call(&folder, &setup, &["--shard", "1/2"]).status.success());
}

#[test]
fn an_output_that_is_not_the_name_of_a_file_is_refused_before_the_run() {
    let folder = folder("slash");
    for name in ["o.csv/", "o.csv/."] {
        let output = call(&folder, &PENDULUM.replace("out.csv", name), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.contains("names a folder; nothing was computed"),
            "{error}"
        );
    }
}

/// A limit on the size of files stands for a full disk: complete rows of a table in CSV remain.
#[cfg(unix)]
#[test]
fn complete_rows_remain_if_the_disk_is_full() {
    let folder = folder("full");
    let whole = PENDULUM.replace("count = 11", "count = 999");
    let limited = |setup: &str| {
        fs::write(folder.join("setup.toml"), setup).expect("a file");
        std::process::Command::new("sh")
            .args([
                "-c",
                "trap '' XFSZ; ulimit -f 20; exec \"$0\" \"$1\" --save-every 1000000",
            ])
            .arg(env!("CARGO_BIN_EXE_symplectic-run"))
            .arg(folder.join("setup.toml"))
            .output()
            .expect("a shell")
    };
    let output = limited(&whole);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(!folder.join("out.csv").exists());
    let parts = || {
        fs::read_dir(&folder)
            .expect("a folder")
            .map(|entry| entry.expect("a file").path())
            .filter(|path| path.extension().is_some_and(|e| e == "part"))
            .collect::<Vec<_>>()
    };
    let [part] = &parts()[..] else {
        panic!("{:?}: {error}", parts());
    };
    let kept = fs::read_to_string(part).expect("the part");
    let rows = kept.lines().count() - 1;
    assert!(kept.len() > 5000 && rows > 50 && rows < 999, "{rows}");
    let said = format!("the first {rows} rows are in `{}`", part.display());
    assert!(error.contains(&said), "{said}: {error}");
    let output = call(&folder, &whole, &[]);
    assert!(output.status.success());
    let table = fs::read_to_string(folder.join("out.csv")).expect("the output");
    assert!(table.starts_with(&kept) && kept.ends_with('\n'));
    fs::remove_file(part).expect("a part");
    // Part of an archive cannot be read.
    let output = limited(&whole.replace("out.csv", "out.npz"));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && error.contains("are lost"));
    assert_eq!(parts().len(), 0, "{error}");
}
