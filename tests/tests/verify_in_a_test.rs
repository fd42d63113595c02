//! How a program verifies its method: the code that the README and the book show.

use symplectic::Method;
use symplectic_compiler::{Definition, Limits};

symplectic::tableau! { Lobatto3 { basis: polynomial(3), nodes: lobatto(3) } }

#[test]
fn lobatto_3_is_what_i_think_it_is() -> Result<(), symplectic_compiler::Error> {
    let exact = Definition::parse(Lobatto3::DEFINITION)?.derive(&Limits::default())?;
    let properties = exact.properties();
    assert!(properties.symplectic.holds && properties.symmetric.holds);
    let witness = properties.explicit.witness.as_deref();
    assert_eq!(witness, Some("these stages need one another: Q2 → P1 → Q2"));
    assert_eq!(exact.exact_forms().a[1][2].as_deref(), Some("-1/24"));
    assert_eq!(exact.to_f64().a, Lobatto3::A.map(|row| row.to_vec()));
    symplectic_compiler::assert_order!(Lobatto3, general == 4);
    Ok(())
}

#[test]
fn the_order_of_lobatto_3_is_4() -> Result<(), symplectic_compiler::Error> {
    let exact = Definition::parse(Lobatto3::DEFINITION)?.derive(&Limits::default())?;
    assert!(exact.properties().symplectic.holds);
    assert_eq!(exact.to_f64().a, Lobatto3::A.map(|row| row.to_vec()));
    symplectic_compiler::assert_order!(Lobatto3, general == 4);
    Ok(())
}

#[test]
fn the_readme_and_the_book_show_this_code() {
    let here = include_str!("verify_in_a_test.rs");
    let (book, rest) = here
        .split_once("\n#[test]\nfn the_order")
        .expect("two tests");
    let book = &book[book.find("use symplectic::Method").expect("the code")..];
    let readme = rest.split("\n}\n").next().expect("the end of a test");
    assert!(include_str!("../../docs/src/guide/methods.md").contains(book));
    assert!(readme.contains("assert_order!"));
    assert!(include_str!("../../README.md").contains(readme));
}
