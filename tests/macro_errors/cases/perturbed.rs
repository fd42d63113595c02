//! Orders for perturbed systems that a method does not have, or that are not written as such.

symplectic::splitting! {
    Refuted { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) >= (4, 2)] }
    Second { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) == (2, 1)] }
    Ascending { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) >= (2, 4)] }
    Open { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) >= 8, 4] }
    Word { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturb) >= (2, 2)] }
    NoOrder { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) >= ()] }
    NoSign { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed)] }
    Greater { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) > (1, 1)] }
    Several { kick: [1/2, 1/2], drift: [1, 0], require: [order(separable) >= (2, 2)] }
    Enough { kick: [1/2, 1/2], drift: [1, 0], require: [order(perturbed) == (2, 2), order(perturbed) >= 2] }
}

symplectic::tableau! {
    NoSplitting { basis: polynomial(2), nodes: gauss(2), require: [order(perturbed) >= (2, 2)] }
}

fn main() {}
