//! The same bits for any number of ranks.

use std::fs;

use symplectic::ensemble::{NpzArray, NpzValues};

use crate::launch::{folder, run, summary};
use crate::program::{BLOCKS, plain};

#[test]
fn one_two_and_four_ranks_write_the_file_of_one_process() {
    let expected = plain();
    // What has to be joined is there: errors of other lengths, and other numbers of wide angles.
    let arrays = NpzArray::read_all(&expected).expect("a file");
    let find = |name: &str| arrays.iter().find(|array| array.name == name);
    let errors = &find("error").expect("errors").values;
    assert!(
        matches!(errors, NpzValues::Texts(errors) if errors.len() == 2 && errors[0].len() != errors[1].len()),
        "{errors:?}"
    );
    assert!(find("wide").expect("angles").shape[0] > 50_000);
    for ranks in [1, 2, 4] {
        let Some(folder) = folder(&format!("bits-{ranks}")) else {
            return;
        };
        assert_eq!(summary(&run(&folder, ranks, "")), [0, 0, BLOCKS]);
        let merged = fs::read(folder.join("merged.npz")).expect("a file");
        assert!(merged == expected, "{ranks} ranks");
        fs::remove_dir_all(&folder).expect("a folder");
    }
}

/// Rank 1 does not go on before the others have taken all other blocks: with blocks dealt out before the run it would wait for ever.
#[test]
fn ranks_take_the_work_of_a_slow_one() {
    for ranks in [2, 3] {
        let Some(folder) = folder(&format!("steal-{ranks}")) else {
            return;
        };
        let outcomes = run(&folder, ranks, "steal");
        assert_eq!(summary(&outcomes), [0, 0, BLOCKS]);
        assert_eq!(outcomes[1], "0 0 1");
        fs::remove_dir_all(&folder).expect("a folder");
    }
}
