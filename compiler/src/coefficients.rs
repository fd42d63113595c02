//! One thing for each coefficient of a tableau.

/// One thing for each coefficient of a tableau, in the order of ascending nodes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Coefficients<T> {
    /// `c_i`
    pub c: Vec<T>,
    /// `c̃_i`
    pub c_tilde: Vec<T>,
    /// `b_i`
    pub b: Vec<T>,
    /// `b̃_i`
    pub b_tilde: Vec<T>,
    /// `a_ij`
    pub a: Vec<Vec<T>>,
    /// `ã_ij`
    pub a_tilde: Vec<Vec<T>>,
    /// `g_i` of gradient kicks; empty for methods without such kicks.
    pub gradient: Vec<T>,
}

impl<T> Coefficients<T> {
    /// All of them: `c`, `c̃`, `b`, `b̃`, `g`, then `a` and `ã` by rows.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        let vectors = [
            &self.c,
            &self.c_tilde,
            &self.b,
            &self.b_tilde,
            &self.gradient,
        ];
        vectors
            .into_iter()
            .chain(&self.a)
            .chain(&self.a_tilde)
            .flatten()
    }

    /// Something else for each coefficient.
    pub fn map<U>(&self, each: impl Fn(&T) -> U) -> Coefficients<U> {
        let vector = |v: &Vec<T>| v.iter().map(&each).collect();
        let matrix = |m: &Vec<Vec<T>>| {
            m.iter()
                .map(|row| row.iter().map(&each).collect())
                .collect()
        };
        Coefficients {
            c: vector(&self.c),
            c_tilde: vector(&self.c_tilde),
            b: vector(&self.b),
            b_tilde: vector(&self.b_tilde),
            a: matrix(&self.a),
            a_tilde: matrix(&self.a_tilde),
            gradient: vector(&self.gradient),
        }
    }

    /// The same with the stages in this order.
    pub(crate) fn reordered(&self, order: &[usize]) -> Self
    where
        T: Clone,
    {
        let vector = |v: &Vec<T>| -> Vec<T> { order.iter().map(|&i| v[i].clone()).collect() };
        let matrix = |m: &Vec<Vec<T>>| order.iter().map(|&i| vector(&m[i])).collect();
        Coefficients {
            c: vector(&self.c),
            c_tilde: vector(&self.c_tilde),
            b: vector(&self.b),
            b_tilde: vector(&self.b_tilde),
            a: matrix(&self.a),
            a_tilde: matrix(&self.a_tilde),
            gradient: match self.gradient.is_empty() {
                true => Vec::new(),
                false => vector(&self.gradient),
            },
        }
    }

    /// Both things for each coefficient.
    pub fn zip<U>(self, other: Coefficients<U>) -> Coefficients<(T, U)> {
        fn vector<T, U>(a: Vec<T>, b: Vec<U>) -> Vec<(T, U)> {
            a.into_iter().zip(b).collect()
        }
        fn matrix<T, U>(a: Vec<Vec<T>>, b: Vec<Vec<U>>) -> Vec<Vec<(T, U)>> {
            a.into_iter().zip(b).map(|(a, b)| vector(a, b)).collect()
        }
        Coefficients {
            c: vector(self.c, other.c),
            c_tilde: vector(self.c_tilde, other.c_tilde),
            b: vector(self.b, other.b),
            b_tilde: vector(self.b_tilde, other.b_tilde),
            a: matrix(self.a, other.a),
            a_tilde: matrix(self.a_tilde, other.a_tilde),
            gradient: vector(self.gradient, other.gradient),
        }
    }
}

/// The index of a matrix entry, counted from 1, as a subscript: `21`, and `2,10` where digits would run together.
pub fn subscript(row: usize, column: usize) -> String {
    if row < 10 && column < 10 {
        format!("{row}{column}")
    } else {
        format!("{row},{column}")
    }
}
