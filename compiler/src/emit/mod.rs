//! From an exact tableau to Rust code.
//!
//! The generated code names everything as `::symplectic::emitted::…`, or as `emitted::…` in a block that imports this module. It contains
//! the coefficients as constants, each rounded correctly to a double. It also contains them in the form that the runtime computes with: the
//! exact value rounded correctly to a double, the rest rounded to another, and the exact value rounded to a single. The single is infinite
//! for a coefficient beyond the largest single, because the method is sound in doubles. For each class of Hamiltonians, or for both, there
//! is a plan of the step. It contains every evaluation and every sum once: no product with zero, equal stages computed once, explicit
//! stages in order, and no evaluation that the previous step has made already.

mod constrained;
mod dense_output;
mod facts;
mod fitted;
mod literal;
mod nonholonomic;
mod nystrom;
mod plan;
mod predictor;
mod symplectic_rounding;

pub use self::constrained::{
    ConstrainedStep, ConstrainedSteps, ConstrainedTableau, constrained_steps,
};
pub use self::symplectic_rounding::Rounded;
pub use facts::Known;
pub use fitted::fitted_method;
pub use symplectic_exact::code::Header;
pub use symplectic_rounding::Relative;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::error::{ErrorKind, FormulaError};
use crate::partitioned::LowerTriangular;
use crate::schedule::Class;
use crate::tableau::{Tableau, left_out};

/// The type of a method with its coefficients and its plans.
///
/// # Errors
/// [`FormulaError::Taken`] for the name `emitted`; [`ErrorKind::Overflow`] if a coefficient is beyond the largest double;
/// [`ErrorKind::ExpressionSize`] if a fraction of a composition of compositions would be too long.
pub fn method(tableau: &Tableau, header: &Header) -> Result<TokenStream, ErrorKind> {
    of_method(tableau, header, &documentation(tableau))
}

/// The type of a method with this text about it.
fn of_method(
    tableau: &Tableau,
    header: &Header,
    documentation: &str,
) -> Result<TokenStream, ErrorKind> {
    if header.name == "emitted" {
        return Err(ErrorKind::from(FormulaError::Taken {
            name: header.name.to_string(),
            meaning: "the module that generated code imports".to_owned(),
        }));
    }
    let numbers = tableau.numbers();
    let matrices = left_out(tableau);
    // The entries of the matrices that are left out are weights.
    let doubles = match matrices {
        Some(_) => Coefficients {
            a: Vec::new(),
            a_tilde: Vec::new(),
            ..numbers.clone()
        }
        .map(Number::to_f64),
        None => numbers.map(Number::to_f64),
    };
    if let Some(&value) = doubles.iter().find(|value| !value.is_finite()) {
        return Err(ErrorKind::Overflow {
            value: value.to_string(),
        });
    }
    let Header {
        attributes,
        visibility,
        name,
    } = header;
    let constants = constants(tableau, &doubles, matrices);
    let stages = literal::count(tableau.stages());
    let text = name.to_string();
    let provenance = tableau.provenance();
    let definition = provenance.definition.to_string();
    let coefficients = coefficients(tableau, &numbers, matrices);
    // The plans have names of their own, derived from the method's name.
    let [general_plan, separable_plan, plan] =
        ["General", "Separable", "Plan"].map(|class| format_ident!("{name}{class}"));
    let names = [
        (Class::General, &general_plan),
        (Class::Separable, &separable_plan),
    ];
    let orders = orders(tableau);
    let symmetry = symmetry(tableau);
    let parts = tableau.parts()?;
    let both = (&parts.methods[..], &parts.substeps[..]);
    let plans = plan::plans(tableau, &numbers, both, names, &plan);
    let functions = parts.functions.map(|count| {
        let count = literal::count(count);
        quote!(const FUNCTIONS: usize = #count;)
    });
    let constrained = constrained::holonomic(tableau, parts);
    let nonholonomic = nonholonomic::steps(tableau, parts);
    let verlet = constrained
        .as_ref()
        .is_some_and(constrained::are_of_stoermer_verlet);
    let constrained = constrained.map(|steps| steps.code("CONSTRAINED"));
    let nonholonomic = nonholonomic.map(|steps| steps.code("NONHOLONOMIC"));
    let proved = proved(
        tableau,
        name,
        [&constrained, &nonholonomic].map(Option::is_some),
        plans[1].splits,
        matrices.is_none(),
    );
    let verlet = verlet.then(|| quote!(impl emitted::StoermerVerletSteps for #name {}));
    let symmetric = symmetric(tableau, name);
    let processed = processed(tableau, name)?;
    let [general, separable] = [&plans[0].name, &plans[1].name];
    let code = plans.iter().map(|plan| &plan.code);
    Ok(quote! {
        #attributes
        #[doc = #documentation]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        #visibility struct #name;

        // A coefficient may be 1/π.
        #[allow(clippy::approx_constant)]
        impl #name {
            #constants
        }

        #[allow(clippy::approx_constant)]
        const _: () = {
            use ::symplectic::emitted;

            impl emitted::Method for #name {
                const NAME: &'static str = #text;
                const STAGES: usize = #stages;
                const DEFINITION: &'static str = #definition;
                #coefficients
                #orders
                #symmetry
                #functions
                #constrained
                #nonholonomic
                type General = #general;
                type Separable = #separable;
            }

            #proved
            #symmetric
            #verlet
            #processed

            #(#code)*
        };
    })
}

/// The kernel and the processor of a processed method, as methods of their own.
fn processed(tableau: &Tableau, name: &Ident) -> Result<Option<TokenStream>, ErrorKind> {
    let Some(processed) = tableau.processed() else {
        return Ok(None);
    };
    let [kernel, processor, inverse] =
        ["Kernel", "Processor", "Inverse"].map(|part| format_ident!("{name}{part}"));
    let parts = [
        (&processed.kernel, &kernel),
        (&processed.processor, &processor),
        (&processed.inverse, &inverse),
    ];
    let code = parts.map(|(tableau, name)| {
        let header = Header {
            attributes: TokenStream::new(),
            visibility: quote!(pub),
            name: name.clone(),
        };
        of_method(tableau, &header, "Part of a processed method.")
    });
    let code: Vec<TokenStream> = code.into_iter().collect::<Result<_, _>>()?;
    Ok(Some(quote! {
        impl emitted::Processed for #name {
            type Kernel = #kernel;
            type Processor = #processor;
            type Inverse = #inverse;
        }

        #(#code)*
    }))
}

/// The coefficients as constants, each the double nearest to the exact value.
fn constants(
    tableau: &Tableau,
    values: &Coefficients<f64>,
    left_out: Option<LowerTriangular>,
) -> TokenStream {
    let stages = literal::count(tableau.stages());
    // If both halves are equal, the second is written as a reference to the first.
    let same = tableau.equal_halves();
    let vector = |name: &str, doc: &str, values: TokenStream| {
        let name = literal::identifier(name);
        quote! {
            #[doc = #doc]
            pub const #name: [f64; #stages] = #values;
        }
    };
    let matrix = |name: &str, doc: &str, rows: TokenStream| {
        let name = literal::identifier(name);
        quote! {
            #[doc = #doc]
            pub const #name: [[f64; #stages]; #stages] = #rows;
        }
    };
    let or_same = |same: bool, name: &str, values: TokenStream| {
        let name = literal::identifier(name);
        if same { quote!(Self::#name) } else { values }
    };
    let rows = |rows: &[Vec<f64>], weights: &str, own: fn(LowerTriangular) -> bool| {
        if let Some(own) = left_out.map(own) {
            let weights = literal::identifier(weights);
            return quote!(::symplectic::emitted::lower_triangular(Self::#weights, 0.0, #own));
        }
        let rows = rows.iter().map(|row| literal::array(row));
        quote!([#(#rows),*])
    };
    let constants = [
        matrix(
            "A",
            " a_ij: the position stages from the velocities. Correctly rounded.",
            rows(&values.a, "B", LowerTriangular::has_own_drift),
        ),
        matrix(
            "A_TILDE",
            " ã_ij: the momentum stages from the forces. Correctly rounded.",
            or_same(
                same.0,
                "A",
                rows(&values.a_tilde, "B_TILDE", LowerTriangular::has_own_kick),
            ),
        ),
        vector(
            "B",
            " b_j: the weights of the velocities. Correctly rounded.",
            literal::array(&values.b),
        ),
        vector(
            "B_TILDE",
            " b̃_j: the weights of the forces. Correctly rounded.",
            or_same(same.1, "B", literal::array(&values.b_tilde)),
        ),
        vector(
            "C",
            " c_i = Σ_j a_ij. Correctly rounded.",
            literal::array(&values.c),
        ),
        vector(
            "C_TILDE",
            " c̃_i = Σ_j ã_ij. Correctly rounded.",
            or_same(same.0, "C", literal::array(&values.c_tilde)),
        ),
    ];
    let gradient = (!values.gradient.is_empty()).then(|| {
        vector(
            "GRADIENT",
            " g_j: the weights of the gradient kicks. Correctly rounded.",
            literal::array(&values.gradient),
        )
    });
    quote!(#(#constants)* #gradient)
}

/// The coefficients in the form that the runtime takes.
fn coefficients(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    left_out: Option<LowerTriangular>,
) -> TokenStream {
    let stages = literal::count(tableau.stages());
    let length = left_out.map(|_| quote!(; #stages));
    let vector = |name: &Ident, numbers: &[Number<'_>]| {
        let values = literal::coefficients(numbers);
        quote!(const #name: &[emitted::Coefficient #length] = &#values;)
    };
    let matrix = |name: &Ident,
                  rows: &[Vec<Number<'_>>],
                  weights: &str,
                  own: fn(LowerTriangular) -> bool| {
        if let Some(own) = left_out.map(own) {
            let weights = literal::identifier(weights);
            return quote! {
                const #name: &[&[emitted::Coefficient]] = {
                    const ENTRIES: &[[emitted::Coefficient; #stages]; #stages] =
                        &emitted::lower_triangular(*#weights, emitted::exact(0.0), #own);
                    &emitted::rows(ENTRIES)
                };
            };
        }
        let rows = rows.iter().map(|row| literal::coefficients(row));
        quote!(const #name: &[&[emitted::Coefficient]] = &[#(&#rows),*];)
    };
    let [a, b, c] = ["A", "B", "C"].map(literal::identifier);
    let [mut a_tilde, mut b_tilde, mut c_tilde] =
        ["A_TILDE", "B_TILDE", "C_TILDE"].map(literal::identifier);
    let mut constants = vec![
        matrix(&a, &numbers.a, "B", LowerTriangular::has_own_drift),
        vector(&b, &numbers.b),
        vector(&c, &numbers.c),
    ];
    // If both halves are equal, the second is a copy of the first.
    let (same_a, same_b) = tableau.equal_halves();
    if same_a {
        (a_tilde, c_tilde) = (a.clone(), c.clone());
    } else {
        let weights = if same_b { "B" } else { "B_TILDE" };
        constants.push(matrix(
            &a_tilde,
            &numbers.a_tilde,
            weights,
            LowerTriangular::has_own_kick,
        ));
        constants.push(vector(&c_tilde, &numbers.c_tilde));
    }
    if same_b {
        b_tilde = b.clone();
    } else {
        constants.push(vector(&b_tilde, &numbers.b_tilde));
    }
    let mut coefficients =
        quote!(emitted::Coefficients::new([#a, #a_tilde], [#b, #b_tilde], [#c, #c_tilde]));
    if !numbers.gradient.is_empty() {
        let gradient = literal::coefficients(&numbers.gradient);
        coefficients = quote!(emitted::Coefficients { gradient: &#gradient, ..#coefficients });
    }
    quote! {
        const COEFFICIENTS: emitted::Coefficients = {
            #(#constants)*
            #coefficients
        };
    }
}

/// The order for each class of Hamiltonians.
fn orders(tableau: &Tableau) -> TokenStream {
    let orders = tableau.orders();
    let [general, separable, nystrom] = [&orders.general, &orders.separable, &orders.nystrom]
        .map(|class| literal::count(class.order));
    quote! {
        const ORDERS: emitted::Orders =
            emitted::Orders { general: #general, separable: #separable, nystrom: #nystrom };
    }
}

/// Whether the method is its own adjoint; empty for a method that is not.
fn symmetry(tableau: &Tableau) -> Option<TokenStream> {
    let general = tableau.properties().symmetric.holds;
    let separable = general || tableau.separable_properties().symmetric.holds;
    separable.then(|| {
        quote! {
            const SYMMETRY: emitted::Symmetry =
                emitted::Symmetry { general: #general, separable: #separable };
        }
    })
}

/// The classes of systems on which the method is its own adjoint.
fn symmetric(tableau: &Tableau, name: &Ident) -> Option<TokenStream> {
    if tableau.properties().symmetric.holds {
        return Some(quote!(impl<C> emitted::SymmetricFor<C> for #name {}));
    }
    let separable = tableau.separable_properties().symmetric.holds;
    separable.then(|| quote!(impl<C: emitted::SplitClass> emitted::SymmetricFor<C> for #name {}))
}

/// The classes of systems on which the method keeps the order of narrower classes. Systems with holonomic constraints are included if
/// the method is `constrained`, those with non-holonomic constraints if it is `nonholonomic`, those with friction if it `splits`, and
/// general ones if it has a plan for these.
fn proved(
    tableau: &Tableau,
    name: &Ident,
    steps: [bool; 2],
    splits: bool,
    has_general_plan: bool,
) -> TokenStream {
    let kicks = splits.then(|| quote!(impl emitted::Splits for #name {}));
    let keeps = tableau.keeps_its_order_in_general();
    let orders = tableau.orders();
    let proved = if keeps {
        let bound = match (steps, splits) {
            ([true, true], true) => None,
            ([true, true], false) => Some("Frictionless"),
            ([true, false], true) => Some("HolonomicOrDamped"),
            ([true, false], false) => Some("Holonomic"),
            ([false, true], true) => Some("FreePositionsOrDamped"),
            ([false, true], false) => Some("FreePositions"),
            ([false, false], true) => Some("UnconstrainedOrDamped"),
            ([false, false], false) => Some("Unconstrained"),
        };
        let not_general = (!has_general_plan).then_some("NotGeneral");
        let bounds = bound.into_iter().chain(not_general).map(|bound| {
            let bound = format_ident!("{bound}");
            quote!(emitted::#bound)
        });
        quote!(impl<C: #(#bounds)+*> emitted::ProvedFor<C> for #name {})
    } else if splits && orders.separable.order >= orders.nystrom.order {
        quote! {
            #[diagnostic::do_not_recommend]
            impl<C: emitted::SeparableOrDamped> emitted::ProvedFor<C> for #name {}
        }
    } else {
        // With friction, kicks depend on the momenta: an order that needs quadratic kinetic energy does not hold. The second class keeps the
        // compiler from inferring the class from the method.
        quote! {
            impl emitted::ProvedFor<emitted::Separable> for #name {}
            impl emitted::ProvedFor<()> for #name {}
        }
    };
    quote! {
        #proved
        #kicks
    }
}

/// The tableau and what is proved about it, for the page of the type.
fn documentation(tableau: &Tableau) -> String {
    let table = crate::export::text::write(tableau, DOCUMENTATION_DIGITS);
    format!("\n\n```text\n{table}```")
}

/// Digits in the documentation for coefficients without a short exact form.
const DOCUMENTATION_DIGITS: usize = 16;
