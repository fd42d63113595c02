//! Names of coordinates.

/// A system whose coordinates have names, such as for the columns of files. Systems from a formula have those of the
/// formula. For a system by hand an empty `impl` gives `q[0]`, `q[1]`, … and `p[0]`, `p[1]`, …:
///
/// ```
/// use symplectic::system::Named;
///
/// struct Pendulum;
///
/// impl Named for Pendulum {
///     const NAMES: [&'static [&'static str]; 2] = [&["angle"], &["momentum"]];
/// }
///
/// struct Chain;
///
/// impl Named for Chain {}
/// ```
#[diagnostic::on_unimplemented(
    message = "the coordinates of `{Self}` have no names",
    label = "write `impl symplectic::system::Named for {Self} {{}}`: the names are then `q[0]`, … and `p[0]`, …",
    note = "`files::Recording::from_start` takes the names as a list"
)]
pub trait Named {
    /// The names of the positions and of the momenta. Without names the coordinates are numbered.
    const NAMES: [&'static [&'static str]; 2] = [&[], &[]];

    /// The number of components, if each numbered position is a vector: `q[0][0]`, `q[0][1]`, ….
    const COMPONENTS: Option<usize> = None;
}

impl<S: Named + ?Sized> Named for &S {
    const NAMES: [&'static [&'static str]; 2] = S::NAMES;
    const COMPONENTS: Option<usize> = S::COMPONENTS;
}
