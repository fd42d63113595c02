//! Final states, states at given times, moments, histograms and files, against closed forms.

use std::ops::ControlFlow;

use symplectic::ensemble::{Ensemble, EnsembleError, Histogram, Moments};
use symplectic::nalgebra::Vector1;
use symplectic::{Error, State};

use crate::common::methods::Yoshida6;

symplectic::hamiltonian! {
    Oscillator { omega }
    q: [x], p: [px];
    H = px^2/2 + (omega x)^2/2
}

#[test]
fn oscillators_of_an_ensemble_have_their_closed_form() {
    let family = |k: u32| {
        let omega = 1.0 + 0.1 * f64::from(k);
        let starts = (1..=5).map(|a| State::from_arrays(0.0, [f64::from(a)], [0.0]));
        (Oscillator { omega }, starts.collect())
    };
    let ensemble = Ensemble::of_families(Yoshida6, (0..3).map(family), 0.02).expect("starts");
    let times = [0.5, 1.0, 2.75];
    let see = |seen: &mut Vec<_>, state: &State<Vector1<f64>>| seen.push((state.time, state.q[0]));
    let mut shown = 0;
    ensemble.integrate_at(
        &times,
        |_| Vec::new(),
        see,
        |row| {
            let (k, a) = (row.trajectory / 5, row.trajectory % 5 + 1);
            let omega = 1.0 + 0.1 * k as f64;
            assert_eq!(row.output.len(), times.len());
            for ((time, q), expected) in row.output.into_iter().zip(times) {
                assert_eq!(time, expected);
                // A cubic between steps of 0.02: (h/2)⁴/4!·ω⁴ a < 5e-9 a.
                assert!((q - a as f64 * (omega * time).cos()).abs() < 1e-8 * a as f64);
            }
            shown += 1;
            ControlFlow::Continue(())
        },
    );
    assert_eq!(shown, 15);
}

/// Two passes in whole numbers of sixteenths, exact: an independent formula.
#[test]
fn moments_agree_with_exact_sums() {
    let numbers: Vec<f64> = (0..100).map(|k| f64::from((k * 37) % 64) / 16.0).collect();
    let mut moments = Moments::new(2);
    for x in &numbers {
        // Far from zero sums of squares would lose the variance.
        moments.add(&[*x, 1e9 + *x]).expect("two components");
    }
    let mean = numbers.iter().sum::<f64>() / 100.0;
    let variance = numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 99.0;
    assert!((moments.mean()[0] - mean).abs() < 1e-14);
    assert!((moments.variance()[0] - variance).abs() < 1e-13);
    // Roundings of 1e9, one each: 100 · 1e9 · 2⁻⁵³ in the mean.
    assert!((moments.mean()[1] - 1e9 - mean).abs() < 1.2e-5);
    assert!((moments.variance()[1] - variance).abs() < 1e-4);
    let error = moments.add(&[1.0]).expect_err("one component");
    assert!(matches!(
        error,
        Error::Length {
            expected: 2,
            found: 1
        }
    ));
    assert_eq!(moments.count(), 100);
    // Of three parts, one of them empty.
    let mut merged = Moments::new(2);
    for part in [0..0, 0..13, 13..100] {
        let mut moments = Moments::new(2);
        for x in &numbers[part] {
            moments.add(&[*x, 1e9 + *x]).expect("two components");
        }
        merged.merge(&moments).expect("two components");
    }
    merged.merge(&Moments::new(2)).expect("two components");
    assert_eq!(merged.count(), 100);
    assert!((merged.mean()[0] - mean).abs() < 1e-14);
    assert!((merged.variance()[0] - variance).abs() < 1e-13);
    assert!((merged.variance()[1] - variance).abs() < 1e-4);
    assert!(merged.merge(&Moments::new(1)).is_err());
    assert!(Moments::new(1).variance()[0].is_nan());
}

#[test]
fn numbers_are_in_their_bins() {
    let mut histogram = Histogram::new(-1.0, 2.0, 7).expect("bins");
    for k in 0..7000 {
        histogram.add(-1.0 + 3.0 * (f64::from(k) + 0.5) / 7000.0);
    }
    assert_eq!(histogram.counts(), [1000; 7]);
    // The lower edge of a bin is in it, up to rounding; the number next below 2 is in the last bin.
    let mut edges = Histogram::new(-1.0, 2.0, 7).expect("bins");
    edges.add(-1.0);
    edges.add(2.0_f64.next_down());
    edges.add(2.0);
    edges.add((-1.0_f64).next_down());
    assert_eq!((edges.counts()[0], edges.counts()[6]), (1, 1));
    assert_eq!((edges.below(), edges.above(), edges.nan()), (1, 1, 0));
    assert_eq!((edges.edge(0), edges.edge(7)), (-1.0, 2.0));
    edges.merge(&histogram).expect("the same bins");
    assert_eq!((edges.counts()[0], edges.counts()[1]), (1001, 1000));
    assert_eq!((edges.below(), edges.above()), (1, 1));
    let others = Histogram::new(-1.0, 2.0, 8).expect("bins");
    assert_eq!(edges.merge(&others), Err(EnsembleError::OtherBins));
    for (low, high, bins) in [
        (0.0, 1.0, 0),
        (1.0, 1.0, 3),
        (0.0, f64::NAN, 3),
        (0.0, f64::INFINITY, 3),
    ] {
        assert!(Histogram::new(low, high, bins).is_err());
    }
}

/// A gas without collisions: oscillators of one frequency from random starts have at time t the means x̄ cos ωt + p̄ sin ωt/ω, and
/// such a variance.
#[test]
fn the_moments_of_an_ensemble_turn_as_a_state_does() {
    let omega = 2.0;
    let mut number = 1_u64;
    let mut random = || {
        number = number
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (number >> 11) as f64 / (1_u64 << 53) as f64 - 0.3
    };
    let starts: Vec<_> = (0..500)
        .map(|_| State::from_arrays(0.0, [random()], [random()]))
        .collect();
    let mut before = Moments::new(2);
    let (mut products, count) = (0.0, starts.len() as f64);
    for start in &starts {
        before
            .add(&[start.q[0], start.p[0]])
            .expect("two components");
        products += start.q[0] * start.p[0];
    }
    let ensemble = Ensemble::new(Yoshida6, Oscillator { omega }, starts, 0.02).expect("starts");
    let mut after = Moments::new(1);
    ensemble.integrate_to(1.3, |row| {
        after.add(row.state.q.as_slice()).expect("one component");
        ControlFlow::Continue(())
    });
    let (sine, cosine) = (omega * 1.3_f64).sin_cos();
    let (c, s) = (cosine, sine / omega);
    let [x, p] = [before.mean()[0], before.mean()[1]];
    let (variance, covariance) = (
        before.variance(),
        (products - count * x * p) / (count - 1.0),
    );
    let expected = c * c * variance[0] + s * s * variance[1] + 2.0 * c * s * covariance;
    assert!((after.mean()[0] - (c * x + s * p)).abs() < 1e-8);
    assert!((after.variance()[0] - expected).abs() < 1e-8);
}

/// The files of an archive: names and contents, by its directory.
#[cfg(feature = "npz")]
fn files(archive: &[u8]) -> Vec<(String, Vec<u8>)> {
    let number = |at: usize, bytes: usize| {
        let little = archive[at..at + bytes].iter().rev();
        little.fold(0_usize, |sum, byte| sum << 8 | usize::from(*byte))
    };
    let end = archive.len() - 22;
    assert_eq!(&archive[end..end + 4], b"PK\x05\x06");
    let mut at = number(end + 16, 4);
    assert_eq!(at + number(end + 12, 4), end);
    let mut found = Vec::new();
    for _ in 0..number(end + 10, 2) {
        assert_eq!(&archive[at..at + 4], b"PK\x01\x02");
        let (size, letters, local) = (number(at + 20, 4), number(at + 28, 2), number(at + 42, 4));
        let name = String::from_utf8(archive[at + 46..at + 46 + letters].to_vec());
        assert_eq!(&archive[local..local + 4], b"PK\x03\x04");
        assert_eq!(archive[at + 16..at + 20], archive[local + 14..local + 18]);
        let data = local + 30 + number(local + 26, 2);
        found.push((name.expect("a name"), archive[data..data + size].to_vec()));
        at += 46 + letters;
    }
    found
}

#[cfg(feature = "npz")]
#[test]
fn an_npz_file_holds_the_rows_and_facts() {
    use symplectic::ensemble::{Npz, WriteEnsemble};

    let starts = (0..3).map(|k| State::from_arrays(0.0, [f64::from(k)], [-0.5]));
    let ensemble = Ensemble::new(Yoshida6, Oscillator { omega: 1.0 }, starts.collect(), 0.5);
    let ensemble = ensemble.expect("starts");
    let mut rows = Vec::new();
    ensemble.take_steps(0, |row| {
        rows.push(row);
        ControlFlow::Continue(())
    });
    let mut file = Npz::new(Vec::new());
    file.facts(&ensemble).expect("room");
    file.rows(&rows).expect("room");
    file.text("ω", "ω").expect("room");
    // Shapes of other numbers, names that are taken, and rows of two dimensions.
    let no_shape = file.doubles("wrong", &[2, 2], &[1.0]);
    let too_many = file.doubles("wrong", &[1 << 63, 2], &[]);
    let twice = file.rows(&rows);
    for wrong in [no_shape, too_many, twice] {
        let error = wrong.expect_err("it is refused");
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput, "{error}");
    }
    let archive = file.finish().expect("room");
    // By hand: python3 -m zipfile -t, numpy.load.
    if let Some(path) = std::env::var_os("SYMPLECTIC_NPZ") {
        std::fs::write(path, &archive).expect("a file");
    }

    let files = files(&archive);
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let expected = "method definition orders step_size sums solver tolerance version trajectory time q p steps failed error ω";
    let expected: Vec<String> = expected
        .split(' ')
        .map(|name| format!("{name}.npy"))
        .collect();
    assert_eq!(names, expected);
    let array = |name: &str| {
        let (_, file) = files.iter().find(|(found, _)| found == name).expect("it");
        assert_eq!(&file[..8], b"\x93NUMPY\x01\0");
        let header = usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!((10 + header) % 64, 0);
        let text = String::from_utf8(file[10..10 + header].to_vec()).expect("text");
        (text.trim_end().to_string(), file[10 + header..].to_vec())
    };
    let doubles: Vec<u8> = [0.0, 1.0, 2.0_f64]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 1, ), }";
    assert_eq!(array("q.npy"), (header.to_string(), doubles));
    let header = "{'descr': '<U1', 'fortran_order': False, 'shape': (), }";
    assert_eq!(
        array("ω.npy"),
        (header.to_string(), 0x3c9_u32.to_le_bytes().to_vec())
    );
    let orders: Vec<u8> = [6_u64; 3].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(array("orders.npy").1, orders);
}

/// Each bit of a file that is changed is noticed, and so is each byte that is missing.
#[cfg(feature = "npz")]
#[test]
fn arrays_are_read_as_they_were_written_or_not_at_all() {
    use symplectic::ensemble::{Npz, NpzArray, NpzValues};

    let mut file = Npz::new(Vec::new());
    let doubles = [f64::NAN, -0.0, 5e-324, f64::INFINITY, 1.0, 1e9];
    file.doubles("x", &[3, 1, 2], &doubles).expect("room");
    file.integers("n", &[1], &[u64::MAX]).expect("room");
    file.texts("ω", &["", "a longer one", "ω"]).expect("room");
    file.text("one", "").expect("room");
    file.doubles("none", &[0, 4], &[]).expect("room");
    let file = file.finish().expect("room");
    let arrays = NpzArray::read_all(&file).expect("arrays");
    let found = |index: usize| (arrays[index].name.as_str(), arrays[index].shape.as_slice());
    assert_eq!(
        (0..5).map(found).collect::<Vec<_>>(),
        [
            ("x", &[3, 1, 2][..]),
            ("n", &[1]),
            ("ω", &[3]),
            ("one", &[]),
            ("none", &[0, 4]),
        ]
    );
    let NpzValues::Doubles(read) = &arrays[0].values else {
        panic!("{:?}", arrays[0]);
    };
    assert!(
        read.iter()
            .map(|x| x.to_bits())
            .eq(doubles.map(f64::to_bits))
    );
    assert_eq!(arrays[1].values, NpzValues::Integers(vec![u64::MAX]));
    let texts = ["", "a longer one", "ω"].map(str::to_owned);
    assert_eq!(arrays[2].values, NpzValues::Texts(texts.to_vec()));

    let mut again = Npz::new(Vec::new());
    for array in &arrays {
        again.array(array).expect("room");
    }
    assert!(again.finish().expect("room") == file);

    for length in 0..file.len() {
        let error = NpzArray::read_all(&file[..length]).expect_err("it is cut off");
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidData, "{error}");
    }
    let changed = (0..8 * file.len()).filter(|bit| {
        let mut changed = file.clone();
        changed[bit / 8] ^= 1 << (bit % 8);
        // Not what is of no consequence: versions, times, attributes of the entries.
        let read = NpzArray::read_all(&changed);
        read.is_ok_and(|read| format!("{read:?}") != format!("{arrays:?}"))
    });
    assert_eq!(changed.collect::<Vec<_>>(), [0_usize; 0]);
}

#[cfg(feature = "npz")]
#[test]
fn arrays_are_joined_along_their_first_index() {
    use symplectic::ensemble::{NpzArray, NpzValues};

    let array = |name: &str, shape: &[usize], values: &[f64]| NpzArray {
        name: name.into(),
        shape: shape.into(),
        values: NpzValues::Doubles(values.into()),
    };
    let mut all = array("q", &[1, 2], &[1.0, 2.0]);
    all.append(array("q", &[0, 2], &[])).expect("the same kind");
    all.append(array("q", &[2, 2], &[3.0, 4.0, 5.0, 6.0]))
        .expect("the same kind");
    assert_eq!(all, array("q", &[3, 2], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    let before = all.clone();
    let integers = NpzArray {
        values: NpzValues::Integers(vec![1, 2]),
        ..array("q", &[1, 2], &[])
    };
    for other in [
        array("p", &[1, 2], &[1.0, 2.0]),
        array("q", &[1, 3], &[1.0, 2.0, 3.0]),
        array("q", &[2], &[1.0, 2.0]),
        integers,
    ] {
        let error = all.append(other).expect_err("it does not go there");
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput, "{error}");
        assert_eq!(all, before);
    }
    let mut one = array("end", &[], &[1.0]);
    one.append(array("end", &[], &[1.0]))
        .expect_err("single values");
}

#[cfg(feature = "npz")]
#[test]
fn a_partly_written_array_ends_the_npz_file() {
    /// A disk with room for this number of bytes.
    struct Full(usize);

    impl std::io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            let taken = bytes.len().min(self.0);
            self.0 -= taken;
            match taken {
                0 => Err(std::io::ErrorKind::StorageFull.into()),
                _ => Ok(taken),
            }
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    let mut file = symplectic::ensemble::Npz::new(Full(500));
    file.doubles("first", &[1], &[1.0]).expect("room");
    let error = file.doubles("second", &[99], &[1.0; 99]);
    assert_eq!(
        error.expect_err("full").kind(),
        std::io::ErrorKind::StorageFull
    );
    file.doubles("third", &[0], &[])
        .expect_err("the second is there in part");
    assert!(file.finish().is_err());
}

/// Two groups with a trajectory that fails: what is read is what was written, with the facts.
#[cfg(feature = "parquet")]
#[test]
fn a_parquet_file_holds_the_rows_and_errors() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    use symplectic::ensemble::{Parquet, ParquetColumn, Row};

    let starts = [0.1, 1e200, 0.3].map(|x| State::from_arrays(0.0, [x], [-0.5]));
    let oscillator = Oscillator { omega: 1e150 };
    let ensemble = Ensemble::new(Yoshida6, oscillator, starts.to_vec(), 1e-152).expect("starts");
    let mut rows: Vec<Row<Vector1<f64>>> = Vec::new();
    ensemble.take_steps(3, |row| {
        rows.push(row);
        ControlFlow::Continue(())
    });
    assert!(rows[1].outcome.is_err() && rows[2].outcome.is_ok());
    let write = || {
        let mut file = Parquet::new(Vec::new());
        file.facts(&ensemble);
        file.note("ω", "1e150");
        file.rows(&rows[..2])?;
        // Columns of other names, kinds and lengths: the file goes on.
        let x = |values: &[f64]| ParquetColumn::Doubles(values.to_vec());
        for wrong in [
            &[][..],
            &[("x", x(&[1.0]))],
            &[("x", x(&[1.0])), ("x", x(&[2.0]))],
            &[("x", x(&[1.0])), ("y", x(&[]))],
        ] {
            let error = file.group(wrong).expect_err("it is refused");
            assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput, "{error}");
        }
        file.rows(&rows[2..])?;
        file.finish()
    };
    let bytes = write().expect("room");
    assert!(bytes == write().expect("room"));
    // By hand: duckdb, polars, pyarrow.
    if let Some(path) = std::env::var_os("SYMPLECTIC_PARQUET") {
        std::fs::write(path, &bytes).expect("a file");
    }

    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("a table");
    assert_eq!(reader.num_row_groups(), 2);
    let about = reader.metadata().file_metadata();
    let notes = about.key_value_metadata().expect("notes");
    let note = |name: &str| {
        let note = notes.iter().find(|note| note.key == name);
        note.and_then(|note| note.value.as_deref())
    };
    assert_eq!(note("orders"), Some("[6, 6, 6]"));
    assert_eq!(note("sums"), Some("compensated"));
    assert_eq!(note("tolerance"), Some("0.0"));
    assert!(note("solver").is_some_and(|name| !name.is_empty()));
    assert_eq!(note("step_size"), Some("1e-152"));
    assert_eq!(note("ω"), Some("1e150"));
    let names = about.schema().get_fields().iter();
    let names: Vec<&str> = names.map(|field| field.name()).collect();
    assert_eq!(
        names,
        ["trajectory", "time", "q[0]", "p[0]", "steps", "error"]
    );
    let mut count = 0;
    for (read, row) in reader.get_row_iter(None).expect("rows").zip(&rows) {
        let read = read.expect("a row");
        let integers = [read.get_ulong(0), read.get_ulong(4)].map(|x| x.expect("a number"));
        assert_eq!(
            integers,
            [row.trajectory as u64, row.statistics.steps],
            "{row:?}"
        );
        let doubles = [1, 2, 3].map(|k| read.get_double(k).expect("a number").to_bits());
        let expected = [row.state.time, row.state.q[0], row.state.p[0]].map(f64::to_bits);
        assert_eq!(doubles, expected);
        let error = row.outcome.as_ref().err().map(ToString::to_string);
        assert_eq!(read.get_string(5).ok(), error.as_ref());
        count += 1;
    }
    assert_eq!(count, 3);
}

#[cfg(feature = "parquet")]
#[test]
fn a_table_on_a_full_disk_is_an_error_of_the_disk() {
    use std::io::{self, ErrorKind, Write};
    use symplectic::ensemble::{Parquet, ParquetColumn};

    struct Full;
    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(ErrorKind::StorageFull.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut file = Parquet::new(Full);
    let column = || ParquetColumn::Doubles((0..100_000).map(f64::from).collect());
    let error = file.group(&[("x", column())]).expect_err("no room");
    assert_eq!(error.kind(), ErrorKind::StorageFull, "{error}");
    let again = file.group(&[("x", column())]).expect_err("a broken file");
    assert_eq!(again.kind(), ErrorKind::InvalidInput, "{again}");
    file.finish().map(drop).expect_err("a broken file");
    Parquet::new(Vec::new())
        .finish()
        .expect_err("no columns are no table");
}
