//! The catalogue in the book is the output of `symplectic list --facts`.

use std::fs;
use std::path::PathBuf;

use crate::run::stdout;

#[test]
fn the_catalogue_of_the_book_is_what_the_tool_lists() {
    let page = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/src/reference/catalogue.md");
    let text = fs::read_to_string(&page).expect("the page");
    let start = text.find("| method |").expect("a table");
    let listed = stdout(&["list", "--facts"]);
    if std::env::var_os("UPDATE_EXPECT").is_some_and(|value| value == "1") {
        fs::write(&page, format!("{}{listed}", &text[..start]))
            .expect("a page that can be written");
        return;
    }
    assert!(
        text[start..] == listed,
        "the table is stale: write it anew with `UPDATE_EXPECT=1`"
    );
}
