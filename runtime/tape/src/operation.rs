//! The operations of a tape.

use symplectic::Scalar;

/// An operation on numbers, which ignores the operands that it does not need.
///
/// Not a closure: the compiler may not inline closures into code for wide registers.
pub(crate) trait Operation {
    /// The number of operands that it needs.
    const ARITY: usize;

    /// Applies the operation.
    fn of<T: Scalar>(operands: [T; 3]) -> T;
}

/// Use of an operation.
pub(crate) trait Use {
    /// The result of the use.
    type Output;

    /// Uses the operation.
    fn with<O: Operation>(self) -> Self::Output;
}

macro_rules! operations {
    ($($(#[$doc:meta])+ $name:ident $arity:literal [$a:tt $b:tt $c:tt] $value:expr;)*) => {
        /// The operation of a step.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub(crate) enum Code {
            $($(#[$doc])+ $name,)*
        }

        impl Code {
            /// The number of operands.
            pub(crate) const fn arity(self) -> usize {
                match self {
                    $(Code::$name => $arity,)*
                }
            }
        }

        $(
            struct $name;

            impl Operation for $name {
                const ARITY: usize = $arity;

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn of<T: Scalar>([$a, $b, $c]: [T; 3]) -> T {
                    $value
                }
            }
        )*

        /// Uses the operation with a code.
        #[cfg_attr(not(debug_assertions), inline(always))]
        pub(crate) fn dispatch<U: Use>(code: Code, to: U) -> U::Output {
            match code {
                $(Code::$name => to.with::<$name>(),)*
            }
        }
    };
}

operations! {
    /// `a + b`
    Add 2 [a b _] a + b;
    /// `a − b`
    Subtract 2 [a b _] a - b;
    /// `a b`
    Multiply 2 [a b _] a * b;
    /// `a/b`
    Divide 2 [a b _] a / b;
    /// `a b + c`, rounded twice.
    MultiplyAdd 3 [a b c] a * b + c;
    /// `a b − c`, rounded twice.
    MultiplySubtract 3 [a b c] a * b - c;
    /// `c − a b`, rounded twice.
    SubtractProduct 3 [a b c] c - a * b;
    /// `−a`
    Negative 1 [a _ _] -a;
    /// `1/a`
    Reciprocal 1 [a _ _] a.recip();
    /// `√a`
    Root 1 [a _ _] a.sqrt();
    /// `|a|`
    Absolute 1 [a _ _] a.abs();
    /// `a`, or 0 if b is 0
    OrZero 2 [a b _] a.or_zero(b);
    /// eᵃ
    Exp 1 [a _ _] a.exp();
    /// The natural logarithm.
    Ln 1 [a _ _] a.ln();
    /// The sine.
    Sin 1 [a _ _] a.sin();
    /// The cosine.
    Cos 1 [a _ _] a.cos();
    /// The tangent.
    Tan 1 [a _ _] a.tan();
    /// The inverse sine.
    Asin 1 [a _ _] a.asin();
    /// The inverse cosine.
    Acos 1 [a _ _] a.acos();
    /// The inverse tangent.
    Atan 1 [a _ _] a.atan();
    /// The hyperbolic sine.
    Sinh 1 [a _ _] a.sinh();
    /// The hyperbolic cosine.
    Cosh 1 [a _ _] a.cosh();
    /// The hyperbolic tangent.
    Tanh 1 [a _ _] a.tanh();
    /// The angle of the point `(b, a)`.
    Atan2 2 [a b _] a.atan2(b);
}

/// Application to three numbers.
struct AtOnce<T>([T; 3]);

impl<T: Scalar> Use for AtOnce<T> {
    type Output = T;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with<O: Operation>(self) -> T {
        O::of(self.0)
    }
}

/// Applies an operation to numbers.
pub(crate) fn apply<T: Scalar>(code: Code, operands: [T; 3]) -> T {
    dispatch(code, AtOnce(operands))
}
