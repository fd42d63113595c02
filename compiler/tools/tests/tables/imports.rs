//! Tables of other libraries, read with the order in which each library steps its numbers.

use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{
    Coefficients, Definition, Error, Library, Limits, Property, Tableau, catalogue,
};
use symplectic_tools::{Language, Stepper, import};

fn read(library: Library, text: &str) -> Result<Tableau, Error> {
    import(library, "table", text, &Limits { stages: 64 })
}

fn orders(tableau: &Tableau) -> [usize; 3] {
    let report = tableau.orders();
    HamiltonianClass::ALL.map(|class| report.class(class).order)
}

/// The hexadecimal constants of a text of C.
fn constants(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| c.is_whitespace() || c == ',');
    let constants = words.filter_map(|word| {
        let digits = word.trim_start_matches('-').strip_prefix("0x")?;
        let (mantissa, exponent) = digits.split_once('p')?;
        let places = mantissa
            .split_once('.')
            .map_or(0, |(_, places)| places.len());
        let whole = u64::from_str_radix(&mantissa.replace('.', ""), 16).ok()?;
        let exponent: i32 = exponent.parse().ok()?;
        let value = whole as f64 * 2f64.powi(exponent - 4 * i32::try_from(places).ok()?);
        Some(if word.starts_with('-') { -value } else { value })
    });
    constants.collect()
}

/// Weights and coefficients, rounded.
fn doubles(tableau: &Tableau) -> Vec<f64> {
    let Coefficients {
        a,
        a_tilde,
        b,
        b_tilde,
        ..
    } = tableau.to_f64();
    [b, b_tilde, a.concat(), a_tilde.concat()].concat()
}

/// A table with gradient kicks is not read as one without them.
#[test]
fn tables_with_gradient_kicks_are_refused() {
    let tableau = catalogue::find("chin-1997-c").expect("known").derive();
    let tableau = tableau.expect("derived").named("chin");
    for (language, library) in [
        (Language::C, Library::Sundials),
        (Language::Fortran, Library::Sundials),
        (Language::Julia, Library::RungeKuttaJl),
        (Language::Python, Library::Nodepy),
    ] {
        let text = language.write(&tableau, 20).expect("written");
        assert!(text.contains("gradient"), "{text}");
        let error = read(library, &text)
            .expect_err("gradient kicks")
            .to_string();
        assert!(
            error.contains("gradient kicks, which are not imported"),
            "{error}"
        );
    }
    for language in [
        Language::Sundials,
        Language::Petsc,
        Language::Nodepy,
        Language::Tsv,
        Language::Coq,
    ] {
        let error = language
            .write(&tableau, 20)
            .expect_err("gradient kicks")
            .to_string();
        assert!(error.ends_with("it has gradient kicks"), "{error}");
    }
    let error = Stepper::C
        .write(&tableau, None)
        .expect_err("gradient kicks")
        .to_string();
    assert!(error.contains("it has gradient kicks"), "{error}");
}

/// What is exported to a library and read from there is the same method, for the catalogue: the same orders, symmetry and evidence, and the same
/// doubles, except that coefficients which the conditions leave free are those of the doubles, so that all may move by a unit
/// in the last place.
#[test]
#[ignore = "thorough"]
fn exports_are_read_back() {
    let (mut same, mut near, mut worst) = (0, 0, 0.0_f64);
    for entry in catalogue::entries().filter(|entry| entry.stages <= 10) {
        let tableau = entry.derive().expect("derived");
        for (language, library) in [
            (Language::Sundials, Library::Sundials),
            (Language::Petsc, Library::Petsc),
            (Language::Nodepy, Library::Nodepy),
            (Language::Julia, Library::RungeKuttaJl),
            (Language::Tsv, Library::RungeKuttaJl),
            (Language::C, Library::Sundials),
            (Language::C, Library::Petsc),
            (Language::Fortran, Library::Sundials),
            (Language::Python, Library::Nodepy),
        ] {
            let Ok(text) = language.write(&tableau, 40) else {
                continue;
            };
            // These have Butcher tables only. Decimals of others than these are refined by their equations, if they are short.
            let families = ["gauss-", "lobatto-", "radau-"];
            let butcher = !matches!(
                language,
                Language::Sundials | Language::Petsc | Language::Nodepy | Language::Tsv
            );
            if butcher && !families.iter().any(|name| entry.name.starts_with(name)) {
                continue;
            }
            let name = format!("{} for {}", entry.name, library.name());
            let read = read(library, &text).unwrap_or_else(|error| panic!("{name}: {error}"));
            let [x, y] = [&read, &tableau].map(|tableau| match language {
                Language::Sundials | Language::Petsc => {
                    constants(&language.write(tableau, 40).expect("written"))
                }
                _ => doubles(tableau),
            });
            assert_eq!(x.len(), y.len(), "{name}");
            let distances = x
                .iter()
                .zip(&y)
                .map(|(x, y)| (x - y).abs() / y.abs().max(1.0));
            let distance = distances.fold(0.0, f64::max) / f64::EPSILON;
            worst = worst.max(distance);
            if x == y {
                same += 1;
            } else {
                near += 1;
            }
            assert!(distance <= 1.0, "{name}: {distance}");
            assert_eq!(orders(&read)[1..], orders(&tableau)[1..], "{name}");
            let [read, original] = [&read, &tableau].map(Tableau::separable_properties);
            for (read, original) in [
                (read.symmetric, original.symmetric),
                (read.symplectic, original.symplectic),
            ] {
                let of = |property: &Property| (property.holds, property.evidence);
                assert_eq!(of(&read), of(&original), "{name}");
            }
        }
    }
    assert!(same > 100 && near < 60, "{same} {near} {worst}");
}

/// Rational tables are read back exactly from Julia and Python. From doubles in C and Fortran an entry that the order conditions leave
/// free may move by a unit in the last place.
#[test]
fn rational_exports_are_read_back_exactly() {
    for name in ["ruth-1983", "lobatto-3", "stormer-verlet", "newton-cotes-4"] {
        let tableau = catalogue::find(name)
            .expect("known")
            .derive()
            .expect("derived");
        for (language, library) in [
            (Language::Julia, Library::RungeKuttaJl),
            (Language::Python, Library::Nodepy),
            (Language::C, Library::Sundials),
            (Language::Fortran, Library::Petsc),
        ] {
            let text = language.write(&tableau, 40).expect("written");
            let read =
                read(library, &text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
            let [x, y] = [&read, &tableau].map(doubles);
            assert_eq!(x.len(), y.len(), "{name}");
            let near = x.iter().zip(&y).all(|(x, y)| (x - y).abs() <= f64::EPSILON);
            assert!(near, "{name}, {}", library.name());
            if matches!(language, Language::Julia | Language::Python) {
                assert_eq!(read.exact_forms(), tableau.exact_forms(), "{name}");
            }
        }
    }
}

/// The notations of the libraries' own sources, each in a small file.
#[test]
fn notations_of_sources_are_read() {
    let splitting = |text: &str| {
        let definition = Definition::parse(text).expect("parsed");
        definition.derive(&Limits::default()).expect("derived")
    };
    let kicks_first = splitting("kick: [1/4, 3/4], drift: [1/3, 2/3]");
    let drifts_first = splitting("kick: [1/4, 3/4], drift: [1/3, 2/3], first: drift");
    let runge = splitting("a: [[0, 0], [1/2, 0]], b: [0, 1]");
    // The numbers of a double are those of its decimal.
    for (library, text, expected) in [
        // Lines are rows in Julia.
        (
            Library::RungeKuttaJl,
            "a = @big [[ 0    0 ]\n          [ 1//2 0 ]]\nb = @big [ 0, 1 ]\nc = @big [ 0, 1//2 ]\n",
            &runge,
        ),
        (
            Library::RungeKuttaJl,
            "a = [[0 0];\n [1//2 0]]\nb = [0; 1]\n",
            &runge,
        ),
        // Constructors of odeint.
        (
            Library::Odeint,
            "template< class Value > struct coef_a_type : public boost::array< Value , 2 > {\n coef_a_type( void ) {\n\
             (*this)[0] = static_cast< Value >( 1 ) / static_cast< Value >( 3 );\n\
             (*this)[1] = static_cast<Value>(1) - (*this)[0];\n } };\n\
             template< class Value > struct coef_b_type : public boost::array< Value , 2 > {\n coef_b_type( void ) {\n\
             (*this)[0] = static_cast< Value >( 0.25 );\n (*this)[1] = static_cast<Value>(3)*(*this)[0];\n } };\n",
            &drifts_first,
        ),
        (
            Library::Odeint,
            "struct m_coefficients_a1 : boost::array<Value, 1> { m_coefficients_a1() { (*this)[0] = static_cast<Value>(1)/static_cast<Value>(2); } };\n\
             struct m_coefficients_b : boost::array<Value, 2> { m_coefficients_b() { (*this)[0] = static_cast<Value>(0); (*this)[1] = static_cast<Value>(1); } };\n\
             struct m_coefficients_c : boost::array<Value, 2> { m_coefficients_c() { (*this)[0] = static_cast<Value>(0); (*this)[1] = static_cast<Value>(0.5); } };\n",
            &runge,
        ),
        // Braces of C++.
        (
            Library::Sundials,
            "constexpr std::array<double, 2> a{1.0/3, 2.0/3};\nstatic const double ahat[2]{0.25, 0.75};",
            &kicks_first,
        ),
        (
            Library::Principia,
            "struct b : public c { int x; };\nstd::vector<double> a{{1.0/3, 2.0/3}}, b{0.25, 0.75};",
            &kicks_first,
        ),
        // Fortran without `::`.
        (
            Library::Principia,
            "a(1) = 1.0d0/3\na(2) = 2.0d0/3.0d0\nb(1) = 0.25d0\nb(2) = 3*b(1)\n",
            &kicks_first,
        ),
        (
            Library::Sciml,
            "a(1) = 0.25d0\na(2) = 3*a(1)\nb(1) = 1.0d0/3\nb(2) = 2.0d0/3.0d0\n",
            &drifts_first,
        ),
        (
            Library::Sundials,
            "c     Drifts and kicks\n      DOUBLE PRECISION A(2), AHAT(2), THIRD\n      PARAMETER (THIRD = 1.0D0/3)\n      A(1) = THIRD\n\
             c     on two lines\n      A(2) = THIRD\n     &  + THIRD\n      DATA AHAT /2.5D-1, 0.75D0/\n",
            &kicks_first,
        ),
        (
            Library::Principia,
            "      parameter (a1 = 1.0d0/3, b1 = 0.25d0)\n      parameter (a2 = 2*a1, b2 = 3*b1)\n",
            &kicks_first,
        ),
        (
            Library::Principia,
            "real(8) :: x(1:2) = [0.25d0, 0.75d0]\na(1) = 1.0d0/3\na(2) = 2*a(1)\nb(1) = x(1)\nb(2) = x(2)\n",
            &kicks_first,
        ),
        (
            Library::Principia,
            "data b /0.25d0, 0.75d0/, t(1) /3*1.0d0/\na = (/ 1.0d0/3, 2.0d0/3 /)\n",
            &kicks_first,
        ),
        (
            Library::Sundials,
            "real :: a(2, 2) = reshape((/ 0.0, 0.5, 0.0, 0.0 /), (/ 2, 2 /))\ndata b /0.0, 1*1.0/\n",
            &runge,
        ),
    ] {
        let read = read(library, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), expected.exact_forms(), "{text}");
    }
    // Repeated values, and the place of the first thing that is not a number.
    for (library, text, message) in [
        (
            Library::RungeKuttaJl,
            "a = @big [[ 0 0 ]\n          [ x 0 ]]\nb = [0, 1]",
            "line 2, column 13: found `x`, which has no value here",
        ),
        (
            Library::Odeint,
            "struct coef_a_type { coef_a_type() {\n (*this)[0] = one; } };\nstruct coef_b_type { coef_b_type() { (*this)[0] = 1; } };",
            "line 2, column 15: found `one`, which has no value here",
        ),
        (
            Library::Odeint,
            "struct x_a1 { x_a1() {\n (*this)[0] = 1.0; (*this)[1] = 1.0; } };\nstruct x_b { x_b() { (*this)[0] = 1.0; (*this)[1] = 0; } };",
            "line 2, column 2: the rows of `a` have [2] entries; 2 weights need rows of 1, 2",
        ),
        (
            Library::Sundials,
            "std::array<double, 2> a{1.0,\n two}; double ahat[]{1, 0};",
            "line 2, column 2: found `two`, which has no value here",
        ),
        (
            Library::Principia,
            "a(1) = 1.0d0\nb(1) = one",
            "line 2, column 8: found `one`, which has no value here",
        ),
        (
            Library::Principia,
            "data a /1.0d0, 0.0d0/\ndata b /1.0d0, x/",
            "line 2, column 16: found `x`, which has no value here",
        ),
        // Elements of lists with bounds.
        (
            Library::Principia,
            "real(8), parameter :: x(0:1) = [0.25d0, 0.75d0]\na(1) = x(1)\nb(1) = 1.0d0",
            "line 2, column 8: `x` has a lower bound of its own; write the list from 1",
        ),
        (
            Library::Principia,
            "real(8), dimension(-1:0) :: x\ndata x /0.25d0, 0.75d0/\na(1) = x(1)\nb(1) = 1.0d0",
            "line 3, column 8: `x` has a lower bound of its own; write the list from 1",
        ),
        (
            Library::Principia,
            "data a /9223372036854775808*0.5/\nb(1) = 1.0d0",
            "the matrix `A` or `a`",
        ),
        // A list for several names.
        (
            Library::Principia,
            "data a, b /1.0d0, 1.0d0/",
            "the matrix `A` or `a`",
        ),
        (
            Library::Sundials,
            "real :: a(1, 1) = reshape([0.5], [1, 1], order=[1, 2]), b(1) = [1.0]",
            "column 42: this order of the axes is not read",
        ),
        (
            Library::Sundials,
            "real :: a(1, 1) = reshape([0.5], [2, 1]), b(1) = [1.0]",
            "column 19: the shape does not fit the list",
        ),
        (
            Library::Sundials,
            "real :: a(1) = real(z'3F000000', real32), b(1) = [1.0]",
            "column 21: found `z`, expected the bits of a `real64`",
        ),
    ] {
        let found = match read(library, text) {
            Ok(tableau) => panic!("{text}: {:?}", tableau.exact_forms()),
            Err(error) => error.to_string(),
        };
        assert!(found.contains(message), "{text}:\n{found}\n{message}");
    }
}

/// The notations of the languages stand for the same exact numbers.
#[test]
fn notations_are_exact() {
    let fraction = Definition::parse("kick: [1/4, 3/4], drift: [1/3, 2/3]").expect("parsed");
    let fraction = fraction.derive(&Limits::default()).expect("derived");
    for (library, text) in [
        (
            Library::Sundials,
            "double a[2] = {1.0/3.0, 2./3}; double ahat[2] = {0x1p-2, 0.75L}; // 1/2",
        ),
        (
            Library::Sundials,
            "t->a[0] = SUN_RCONST(1.0) / SUN_RCONST(3.0); t->a[1] = t->a[0] * 2; /* x */ t->ahat[0] = 2.5e-1; t->ahat[1] = 3*t->ahat[0];",
        ),
        // Lists of Fortran, Matlab and Mathematica, with the letters of other libraries.
        (
            Library::Principia,
            "real(real64), parameter :: a(2) = [ &\n 1.0d0/3, &\n 0.2d1/3.0_real64 &\n ]\nreal :: b(2) = [0.25_real64, 7.5d-1]",
        ),
        (
            Library::Mathematica,
            "b = {1/4, 0.75`20}; (* kicks *) B = {1/3, N[2/3, 30]};",
        ),
        (
            Library::Pyhamsys,
            "a = [Fraction(1, 3), Fraction('2/3')]  # drifts\nb = np.array([mpf('0.25'), 3 / 4], dtype=object)",
        ),
    ] {
        let read = read(library, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), fraction.exact_forms(), "{text}");
    }
    // SciML drifts first, by b.
    let exchanged = "kick: [1/3, 2/3], drift: [1/4, 3/4], first: drift";
    let exchanged = Definition::parse(exchanged)
        .expect("parsed")
        .derive(&Limits::default())
        .expect("derived");
    for text in [
        "a = [1//3, 2//3]\nb = [big\"0.25\", BigFloat(\"0.75\")]",
        "a1 = convert(T, 1 // 3)\na2 = 2a1\nb1 = 0.25 # b\nb2 = 1 - b1",
        "a = [1/3 2/3]; b = [0.25; 0.75];",
        "a = Rational{BigInt}[1//3, 2//3]\nb = T[1/4, 3/4]",
    ] {
        let read = read(Library::Sciml, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), exchanged.exact_forms(), "{text}");
    }
    // Roots are exact, in matrices too.
    let gauss = catalogue::find("gauss-2")
        .expect("known")
        .derive()
        .expect("derived");
    for (library, text) in [
        (
            Library::Nodepy,
            "A = numpy.array([[1/4, 1/4 - sympy.sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]])\nb = [1/2, 1/2]",
        ),
        (
            Library::RungeKuttaJl,
            "a = [1/4 1/4-√3/6\n 1/4+√3/6 1/4]\nb = [1/2, 1/2]",
        ),
        (
            Library::Mathematica,
            "a = {{1/4, 1/4 - Sqrt[3]/6}, {1/4 + 3^(1/2)/6, 1/4}}; b = {1/2, 1/2}; c = {1/2 - Sqrt[3]/6, 1/2 + Sqrt[3]/6};",
        ),
    ] {
        let read = read(library, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), gauss.exact_forms(), "{text}");
    }
}

/// The first thing that is not a number is named at its place, and so is what does not fit.
#[test]
fn import_refuses_text_that_is_not_a_table_at_the_place() {
    let deep = format!("a = {}1; b = [1]", "(".repeat(200));
    let doubled: String = (1..20)
        .map(|i| format!("x{i} = x{0} + x{0}\n", i + 1))
        .collect();
    let doubled = format!("a = [x1]\nb = [1]\n{doubled}x20 = 1\n");
    let long = format!("a = [{}]; b = [1]", "1, ".repeat(20_000));
    for (library, text, message) in [
        (
            Library::Sciml,
            "a = [1,\n  1//x]\nb = [1, 0]",
            "table, line 2, column 6: found `x`, which has no value here, expected a number",
        ),
        (
            Library::Sciml,
            "a = [1, 1.2.3]\nb = [1, 0]",
            "table, column 9: found `1.2.3`, expected a number",
        ),
        (
            Library::Sundials,
            "a[2] = {1.0, nan}; ahat[2] = {1, 0};",
            "table, column 14: found `nan`, which has no value here",
        ),
        (
            Library::Sundials,
            "a[2] = {1.0, 0.5 0.5}; ahat[2] = {1, 0};",
            "table, column 18: found `0.5`, expected an operator, `,` or `}`",
        ),
        (
            Library::Sundials,
            "a[2] = {1.0, f(2)}; ahat[2] = {1, 0};",
            "table, column 14: unknown function `f`",
        ),
        (
            Library::Sundials,
            "a[2] = {1.0, 1/0.0}; ahat[2] = {1, 0};",
            "table, column 15: division by zero",
        ),
        (
            Library::Sciml,
            "a = [1, 0]\nb = [1]",
            "table, column 1: 1 drifts `b` and 2 kicks `a`",
        ),
        (
            Library::Sciml,
            "a1 = 1\na3 = 0\nb = [1, 0]",
            "table, line 2, column 1: `a` 2 is missing before `a` 3",
        ),
        (
            Library::Sciml,
            "a = [1]\na = [1]\nb = [1]",
            "table, line 2, column 1: `a` has a value already; a file holds one table",
        ),
        (
            Library::Sciml,
            "a = [b1]\nb1 = a[1]",
            "this is too large: its depth",
        ),
        (
            Library::Petsc,
            "c = {1};",
            "table, column 1: a table of `petsc` has the drifts `c` and the kicks `d` of a splitting, or the matrix",
        ),
        (
            Library::Nodepy,
            "A = [[1, 2], [3]]\nb = [1, 0]",
            "table, column 1: 3 entries of a matrix for 2 weights",
        ),
        (
            Library::Nodepy,
            "A = [[1/2]]\nb = [1]\nc = [1/3]",
            "table, line 3, column 1: c_1 is 1/3, and row 1 sums to 1/2",
        ),
        (
            Library::Nodepy,
            "",
            "table, column 1: a table of `nodepy` has the matrix",
        ),
        (
            Library::Sciml,
            &doubled,
            "this is too large: the number of values",
        ),
        (Library::Sciml, &deep, "this is too large: its depth"),
        (
            Library::Sciml,
            &long,
            "this is too large: the length of a list",
        ),
        (
            Library::Sciml,
            "a = [1e99999]; b = [1]",
            "table, column 6: found `1e99999`, expected a number",
        ),
    ] {
        let found = read(library, text).expect_err(text).to_string();
        assert!(found.contains(message), "{text}:\n{found}\n{message}");
    }
}

/// What is not certain is refused, with its place and the reason.
#[test]
fn import_refuses_ambiguous_notation() {
    use Library::{Mathematica, Nodepy, Sciml, Sundials};
    let chain = format!("a = [{}w]\nb = [1]", "a.".repeat(300_000));
    let arrows = format!("a[] = {{{}w}}; ahat[] = {{1}};", "a->".repeat(100_000));
    for (library, text, message) in [
        (Sciml, chain.as_str(), "found `w`, which has no value here"),
        (
            Sundials,
            arrows.as_str(),
            "found `w`, which has no value here",
        ),
        // Continued lines and comments.
        (Sciml, "a = [1 & 2]; b = [1]", "column 8: found `&`"),
        (
            Sundials,
            "a[0] = 1 & 2; ahat[0] = 1;",
            "column 10: found `&`",
        ),
        (
            Sundials,
            "a[0] = 0.5; if (!x) a[1] = 0.5; ahat[0] = 1;",
            "1 kicks `ahat`",
        ),
        (Sciml, "a = [5 % 3, 1]\nb = [1, 0]", "column 8: found `%`"),
        (
            Sciml,
            "a = [1, 0]\nb = [0 1]\nif x != 0; a = [3, 4]; end",
            "`a` has a value already",
        ),
        (
            Sciml,
            "#= a = [1, 0]\nb = [1, 0]",
            "column 1: `#=` has no `=#` behind it",
        ),
        (
            Sundials,
            "a[0] = 1; ahat[0] = 1; /*",
            "column 24: `/*` has no `*/` behind it",
        ),
        (
            Mathematica,
            "(* (* b = {1} *) B = {1}",
            "column 1: `(*` has no `*)` behind it",
        ),
        (
            Nodepy,
            "A = [[0]]\nb = [1]\n\"\"\"",
            "line 3, column 1: `\"\"\"` has no",
        ),
        (
            Nodepy,
            "A = [[1/2]]\nb = ['1]",
            "line 2, column 6: `'` has no `'` in this line",
        ),
        (
            Nodepy,
            "\"\"\"\nA = [[1/2]]\n\"\"\"\nb = [1]",
            "the matrix `A` or `a`",
        ),
        (Sciml, "a = [1 0]'\nb = [1, 0]", "column 10: found `'`"),
        // Names without a value.
        (
            Sciml,
            "a = [w[1], w[2]]\nb = [1, 0]",
            "column 6: found `w`, which has no value here",
        ),
        // Arguments that are left out.
        (Nodepy, "A = [[0,0],[1,0]]\nb = [s(2, 3), 1]", "`s`"),
        (
            Nodepy,
            "A = [[0,0],[1,0]]\nb = [t(3, 1, 4), 1]",
            "3 arguments",
        ),
        (Sciml, "a = [convert(T, 1, 2)]\nb = [1]", "2 arguments"),
        (Sciml, "a = SMatrix(1, 2, 3, 4)\nb = [1, 1]", "4 arguments"),
        (
            Sundials,
            "a[0] = static_cast<int>(0.5); ahat[0] = 1;",
            "cut to an integer",
        ),
        (Nodepy, "A = [[Integer(1/2)]]\nb = [1]", "an integer"),
        // Digits and suffixes.
        (
            Sciml,
            "a = [0.123_456, 1]\nb = [1, 0]",
            "column 6: found `0.123_456`, expected a number",
        ),
        (
            Nodepy,
            "A = [[1_0]]\nb = [1]",
            "column 7: found `1_0`, expected a number",
        ),
        (
            Sundials,
            "a[0] = 1'000; ahat[0] = 1;",
            "column 8: found `1`, expected a number",
        ),
        (
            Sundials,
            "a[] = {010}; ahat[] = {1};",
            "column 8: found `010`, expected a number",
        ),
        (
            Sciml,
            "a = [2d1]\nb = [1]",
            "column 7: found `d1`, which has no value here",
        ),
        (
            Sciml,
            "a = [2f]\nb = [1]",
            "column 7: found `f`, which has no value here",
        ),
        (
            Mathematica,
            "b = {2d1}; B = {1};",
            "column 6: found `2d1`, expected a number",
        ),
        (
            Mathematica,
            "b = {2e3}; B = {1};",
            "column 6: found `2e3`, expected a number",
        ),
        (
            Nodepy,
            "A = [[1j]]\nb = [1]",
            "column 7: found `1j`, expected a number",
        ),
        (
            Sundials,
            "a[0] = 1.0d0; ahat[0] = 1;",
            "column 8: found `1.0d0`, expected a number",
        ),
        // What follows a value.
        (
            Mathematica,
            "b = 1/2 Sqrt[2]; B = {1};",
            "found `Sqrt`, expected an operator",
        ),
        (
            Mathematica,
            "b = {N[2 Sqrt[3], 20]}; B = {1};",
            "found `Sqrt`, expected an operator",
        ),
        (
            Mathematica,
            "w = 1/2 Sqrt[2]\nb = {w}\nB = {1}",
            "found `Sqrt`, expected an operator",
        ),
        (Mathematica, "x = {1}; b = {x.x}; B = {1};", "found `.`"),
        (
            Nodepy,
            "A = [[w]]\nb = [1]\nw = 0.5 if x else 0.25",
            "line 3, column 9: found `if`",
        ),
        (
            Nodepy,
            "A = [[0.5 if x else 1]]\nb = [1]",
            "column 11: found `if`",
        ),
        (Nodepy, "A = [[1 2]]\nb = [1]", "column 9: found `2`"),
        // Divisions that cut.
        (
            Nodepy,
            "A = [[7//2]]\nb = [1]",
            "column 8: `//` is not a division with all digits",
        ),
        (
            Sundials,
            "a[] = {1/2, 1/2}; ahat[] = {1, 0};",
            "column 9: an integer divided by an integer",
        ),
        (
            Sundials,
            "a[0] = pow(2.0, 1/3); ahat[0] = 1;",
            "an integer divided by an integer",
        ),
        (
            Sundials,
            "int n = 2; a[0] = 1/(n + 1); ahat[0] = 1;",
            "an integer divided by an integer",
        ),
        // Changes.
        (
            Sundials,
            "double a[2]={0}; a[0]=.5; ahat[0]=1;",
            "column 18: `a` is changed later",
        ),
        (
            Nodepy,
            "A = [[0,0],[1,0]]\nb = [.5,.5]\nb[0] = 1",
            "line 3, column 1: `b` is changed later",
        ),
        (
            Sciml,
            "a = [1, 0]\nb = [1, 0]\na .*= 2",
            "line 3, column 1: `a` is changed later",
        ),
        (
            Sciml,
            "a = [1, 0]\nb = [1, 0]\na[1] += 3",
            "line 3, column 1: `a` is changed later",
        ),
        (
            Sciml,
            "a = [1, 0]\nb = [1, 0]\nreverse!(a)",
            "line 3, column 10: `a` is changed later",
        ),
        (
            Sundials,
            "a[0] = 1; ahat[0] = 1; a[0]++;",
            "column 24: `a` is changed later",
        ),
        (
            Nodepy,
            "A = [[0]]\nb[i] = 1",
            "line 2, column 1: `b` has an index that is not one number",
        ),
        (
            Sundials,
            "A[1][0] = 1.0; A[2][0] = 0.5; b[0] = 1;",
            "column 1: `A` has an index that",
        ),
        (Nodepy, "A[0] = [0.5]\nb = [1]", "`A` has an index that"),
        (
            Sundials,
            "a[1] = 0.5; a[2] = 0.5; ahat[0] = 1; ahat[1] = 0;",
            "`a` 0 is missing before `a` 1",
        ),
        // Tuples, and lists beside one another.
        (
            Nodepy,
            "A = [[0,0],[1,0]]\nb = 1, 0",
            "line 2, column 6: several values without brackets",
        ),
        (Nodepy, "A = [[0]]\nb, x = 1, 0", "`b`"),
        (
            Nodepy,
            "A = [[0]]\nx, b = y",
            "line 2, column 4: `b` gets its value together",
        ),
        (
            Sciml,
            "a, b = [1], [1]",
            "table, column 4: `b` gets its value together",
        ),
        (
            Sciml,
            "A = [[1, 2] [3, 4]]\nb = [1, 1]",
            "lists beside one another are columns",
        ),
        (
            Sundials,
            "a[0] = (1, 2); ahat[0] = 1;",
            "column 8: expected one number in these brackets",
        ),
        (
            Sciml,
            "a1 = 1\na01 = 2\nb = [1]",
            "two of the numbered `a` have the same number",
        ),
        // Lengths.
        (
            Sciml,
            "A = [1 2; 3 4]\nb = [1, 1]\nc = [3]",
            "line 3, column 1: 1 nodes `c` for 2 weights",
        ),
        (
            Sciml,
            "A = [1 2; 3 4]\nb = [1, 1]\nc = [3, 7, 9]",
            "3 nodes `c` for 2 weights",
        ),
    ] {
        let found = match read(library, text) {
            Ok(tableau) => panic!("{text}: {:?}", tableau.exact_forms()),
            Err(error) => error.to_string(),
        };
        let start: String = text.chars().take(200).collect();
        assert!(found.contains(message), "{start}:\n{found}\n{message}");
    }
}

/// What was refused or read otherwise once, beside what is refused now.
#[test]
fn import_reads_unambiguous_notation() {
    let two = |first: &str, second: &str| {
        let text = format!("kick: [{first}], drift: [{second}]");
        let definition = Definition::parse(&text).expect("parsed");
        definition.derive(&Limits::default()).expect("derived")
    };
    let halves = two("1/2, 1/4, 1/4", "1/2, 1/4, 1/4");
    let list = (0..1000).map(|_| "1").collect::<Vec<_>>().join(", ");
    let indices = (1..=1000).map(|i| format!("w[{i}] - w[1]"));
    let indices = indices.collect::<Vec<_>>().join(", ");
    let long = format!(
        "w = [{list}]\nx = [{indices}]\na = [1/2, 1/4 + x[7], 1/4]\nb = [1/2, 1/4, 1/4 + x[1000]]"
    );
    for (library, text) in [
        (
            Library::Principia,
            "real :: a(3) = [0.5d0, & ! one\n  & 0.25_dp, 0.25d0]\nreal :: b(3) = [0.5, 0.25, &\n 0.25] ! b = 3",
        ),
        (
            Library::Principia,
            "/* a = 1 \n */ double a[3] = {.5f, 1.0/4, 0.25L}; // b = 2\n double b[3] = {0.5,0.25,0.25};",
        ),
        (
            Library::Pyhamsys,
            "\"\"\"\na = [1, 2]\n\"\"\"\na = [1 -2*w, 1/4, 1/4]\nw = 0.25\nb = np.array([.5, 1/4, 1/4])",
        ),
        (
            Library::Mathematica,
            "(* (* b = {1}; *) B = 2 *)\nb = {1/2, 1/4, 2.5`20*1/10};\nB = {1/2, 1/4, 1/4}",
        ),
    ] {
        let read = read(library, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), halves.exact_forms(), "{text}");
    }
    let exchanged =
        Definition::parse("kick: [1/2, 1/4, 1/4], drift: [1/2, 1/4, 1/4], first: drift");
    let exchanged = exchanged.expect("parsed").derive(&Limits::default());
    let exchanged = exchanged.expect("derived").exact_forms();
    for text in [
        long.as_str(),
        "a = SVector(1//2, 1//4, 1//4) #= b = 1 #= =# =#\nb = SA[1//2, 1//4, 0.25f0]",
        "a = [3/2//3 - 4, 1/4, 1/4]\nb = [0.5 0.25 0.25]",
        "% a = 1\na = [0.5, ... % first\n0.25, 1/4];\nb = [0.5 ...\n 1/4 .25];",
    ] {
        let read = read(Library::Sciml, text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.exact_forms(), exchanged, "{text}");
    }
}

/// Any text has an answer, and an error stands at a part of it.
#[test]
fn any_text_has_an_answer() {
    let words = [
        "a", "b", "ahat", "=", "[", "]", "{", "}", "(", ")", ",", ";", "\n", "1", "0.5", "//",
        "1//2", "\"", "big\"", "0x1p", "é", "-", "^", "sqrt", ".",
    ];
    let mut state = 1_u64;
    for _ in 0..4000 {
        let mut text = String::new();
        for _ in 0..12 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            text.push_str(words[(state >> 33) as usize % words.len()]);
        }
        for library in [
            Library::Sciml,
            Library::Sundials,
            Library::Nodepy,
            Library::Mathematica,
        ] {
            if let Err(error) = read(library, &text)
                && let Some(place) = &error.place
            {
                assert!(
                    place.text.get(place.span.clone()).is_some(),
                    "{text:?}: {place:?}"
                );
            }
        }
    }
}

/// The tab-separated file of RungeKutta.jl: its doubles, bit for bit, where they are no method; long decimals are rounded numbers of
/// the type in the first line.
#[test]
fn tab_separated_tables_are_read() {
    let jl = |text: &str| read(Library::RungeKuttaJl, text);
    // No exact method is near: the numbers are those of the file.
    let text = "# 1 2 Float64\n# a comment\n0.6\t0.1 0.5 # 1/10\n\n-0.0078125\t1.0e-3\t-8.8125e-3\n0.0\t0.123456789012345\t-1.5\n";
    let table = jl(text).expect("read");
    let doubles = table.to_f64();
    assert_eq!(doubles.a, [[0.1, 0.5], [1e-3, -8.8125e-3]]);
    assert_eq!(doubles.b, [0.123456789012345, -1.5]);
    let written = Language::Tsv.write(&table, 17).expect("written");
    let again = jl(&written).expect("read again").to_f64();
    assert_eq!(again, doubles);
    // Of Gauss's method, 53 and 256 binary digits.
    let gauss = catalogue::find("gauss-2").expect("known");
    let gauss = gauss.derive().expect("derived");
    let third = "0.3333333333333333333333333333333333333333333333333333333333333333333333333333348";
    let radau = format!(
        "# 3 2 BigFloat\n0.0\t0.25\t-0.25\n0.{}7\t0.25\t0.41{}7\n0.0\t0.25\t0.75\n",
        "6".repeat(76),
        "6".repeat(75)
    );
    let read_gauss = jl(&Language::Tsv.write(&gauss, 17).expect("written")).expect("read");
    assert_eq!(read_gauss.exact_forms(), gauss.exact_forms());
    // Radau IA: 2/3 and 5/12.
    assert_eq!(jl(&radau).expect("read").orders().general.order, 3);
    // A comment of a source in Julia is no header.
    let source = "# 4 2\na = [1//4 1//4-√3/6; 1//4+√3/6 1//4]\nb = [1//2, 1//2]";
    for first in [
        "# 4 2\n",
        "# 4 2 stages\n",
        "# 2 4 Float64\n",
        "# 2 2 Float64 or more\n",
    ] {
        let source = source.replace("# 4 2\n", first);
        let read = jl(&source).unwrap_or_else(|error| panic!("{source}: {error}"));
        assert_eq!(read.exact_forms(), gauss.exact_forms(), "{source}");
    }
    // The last digits of a number of 256 binary digits are noise.
    let text = format!("# 2 1 BigFloat\n{third}\t{third}\n0.0\t1.0\n");
    assert_eq!(jl(&text).expect("read").to_f64().a, [[1.0 / 3.0]]);

    for (text, message) in [
        ("# 2 1\n0.5 x\n0 1", "table, line 2, column 5: "),
        ("0.5 NaN\n0 1", "table, column 5: "),
        ("0.5 Inf\n0 1", "table, column 5: "),
        (
            "# 2 2 Float64\n0.5 0.5\n0 1",
            "table, column 1: 2 stages need 3 rows of numbers, and the file has 2",
        ),
        (
            "0.5 0.5\n0 1 2",
            "table, line 2, column 1: row 2 has 3 numbers, and a file of 2 rows has as many columns",
        ),
        ("0.5 0.25\n0 1", "c_1 is 1/2, and row 1 sums to 1/4"),
        ("# 1 1 Float64\nx 0.5\n0 1", "table, line 2, column 1: "),
        ("0.5", "there is no table"),
        ("# 2 0 Float64", "there is no table"),
    ] {
        let error = jl(text).expect_err(text).to_string();
        assert!(error.contains(message), "{text}:\n{error}");
    }
}
