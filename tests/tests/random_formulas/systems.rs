//! Random formulas; written by `UPDATE_EXPECT=1 cargo test -p symplectic-tests --test random_formulas`.

use super::Look;

symplectic::hamiltonian! {
    /// A random system.
    pub Named0 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = hypot(1 + ((tanh(atan(7)))^3)^2, ((sqrt(2 + cos(pb)))^3 - ((pa - pb)) (acos(cos(0.46)/3)))) + pa^2 + pb^2 + (1 + (tan(sin(tanh((g)^2))))^2)^(-3/2) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named1 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = acos(cos((((((g + pa))/(2 + sin((g) (g)))))^2)^3)/3) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named2 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ((ln(1 + (atan(((pa)/(2 + sin(0.35)))))^2) + hypot(1 + (ln(1 + (ln(1 + (3)^2))^2))^2, tanh(asin(sin(pb)/2)))) - acos(cos(asin(sin((ln(1 + (g)^2) + acos(cos(2)/3)))/2))/3)) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named3 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = (hypot(1 + ((((0.90 + pb))/(2 + sin(atan2(8, 3 + cos(8))))))^2, tan(sin(sqrt(2 + cos(g))))))^2 + pa^2 + pb^2 + (ln(1 + ((exp(sin(0.3)))^2)^2) - (((atan(b))/(2 + sin(tan(sin(g))))))^3) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named4 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = atan(atan(exp(sin(((pa)^3) (sinh(cos(pb))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named5 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tanh(((sqrt(2 + cos(sqrt(2 + cos(g))))) (sinh(cos(asin(sin(a)/2)))) + hypot(1 + (sinh(cos((pb - pa))))^2, acos(cos(tanh(b))/3)))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named6 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ((hypot(1 + (tan(sin(sqrt(2 + cos(1)))))^2, tan(sin(tan(sin(g))))))/(2 + sin(tanh(atan2(exp(sin(g)), 3 + cos(exp(sin(g)))))))) + pa^2 + pb^2 + (tanh(tan(sin(sqrt(2 + cos(g))))))^3 + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named7 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = atan2(atan(sqrt(2 + cos(tan(sin(acos(cos(pb)/3)))))), 3 + cos(atan(sqrt(2 + cos(tan(sin(acos(cos(pb)/3)))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named8 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = exp(sin((atan2(tan(sin(tan(sin(pb)))), 3 + cos(tan(sin(tan(sin(pb)))))) - atan2(tanh(tanh(a)), 3 + cos(tanh(tanh(a))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named9 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tanh(sinh(cos((ln(1 + (pb)^2) + sqrt(2 + cos(3)))))) + pa^2 + pb^2 + tan(sin((exp(sin(asin(sin(g)/2))) - ((a) (a) - ((0.87)/(2 + sin(2))))))) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named10 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = (acos(cos(asin(sin((atan2(g, 3 + cos(g)) - atan(pa)))/2))/3))^3 + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named11 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ((((asin(sin((tan(sin(g)) - acos(cos(g)/3)))/2))/(2 + sin(sqrt(2 + cos(acos(cos((a) (a))/3)))))))/(2 + sin((exp(sin(tan(sin(tanh(0.64)))))) ((((ln(1 + (pa)^2))^2)/(2 + sin((atan(0.36) + sinh(cos(0.11)))))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named12 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ((tanh(atan(pa)))^3)^2 + pa^2 + pb^2 + (((1 + (asin(sin((b) (b))/2))^2)^(-3/2))/(2 + sin(sinh(cos(sinh(cos(((a)/(2 + sin(b)))))))))) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named13 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = sinh(cos(sqrt(2 + cos(tan(sin(tanh(sqrt(2 + cos(9))))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named14 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tan(sin(ln(1 + (tan(sin(sinh(cos((0.33)^3)))))^2))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named15 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = asin(sin(atan(((sinh(cos(pa)))/(2 + sin((pa)^3)))))/2) + pa^2 + pb^2 + atan2((exp(sin(asin(sin(g)/2)))) (ln(1 + (tanh(g))^2)), 3 + cos((exp(sin(asin(sin(g)/2)))) (ln(1 + (tanh(g))^2)))) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named16 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = atan2(((ln(1 + (hypot(1 + ((9 - a))^2, hypot(1 + (a)^2, pa)))^2))/(2 + sin(atan2(atan2(tanh(a), 3 + cos(tanh(a))), 3 + cos(atan2(tanh(a), 3 + cos(tanh(a)))))))), 3 + cos(((ln(1 + (hypot(1 + ((9 - a))^2, hypot(1 + (a)^2, pa)))^2))/(2 + sin(atan2(atan2(tanh(a), 3 + cos(tanh(a))), 3 + cos(atan2(tanh(a), 3 + cos(tanh(a)))))))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named17 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ln(1 + (sinh(cos(((sinh(cos(g)) - hypot(1 + (2)^2, g))) ((acos(cos(0.50)/3)) ((7 - 4))))))^2) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named18 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tan(sin(acos(cos(asin(sin(sinh(cos(g)))/2))/3))) + pa^2 + pb^2 + asin(sin(sqrt(2 + cos(sinh(cos(sqrt(2 + cos(a)))))))/2) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named19 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = asin(sin(((sqrt(2 + cos(tanh(asin(sin(pa)/2)))))/(2 + sin(atan2(acos(cos((7 - b))/3), 3 + cos(acos(cos((7 - b))/3)))))))/2) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named20 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ((acos(cos(atan2(sinh(cos(sqrt(2 + cos(7)))), 3 + cos(sinh(cos(sqrt(2 + cos(7)))))))/3))/(2 + sin((1 + ((1 + (exp(sin((1 + (0.47)^2)^(-3/2))))^2)^(-3/2))^2)^(-3/2)))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named21 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = ln(1 + (atan(sqrt(2 + cos((pb + g)))))^2) + pa^2 + pb^2 + hypot(1 + (tanh(atan2(exp(sin(0.40)), 3 + cos(exp(sin(0.40))))))^2, ((ln(1 + (sinh(cos(7)))^2))/(2 + sin((hypot(1 + (a)^2, b))^2)))) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named22 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = acos(cos((ln(1 + (((pa - pb))^2)^2) + asin(sin(asin(sin(exp(sin(0.42)))/2))/2)))/3) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named23 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = acos(cos(acos(cos(sqrt(2 + cos(sqrt(2 + cos(tan(sin(8)))))))/3))/3) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named24 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = exp(sin(exp(sin(sqrt(2 + cos(((pb)/(2 + sin(0.69))))))))) + pa^2 + pb^2 + asin(sin(exp(sin(ln(1 + ((g - 4))^2))))/2) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named25 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = (sqrt(2 + cos(((asin(sin(0.6)/2)) (acos(cos(a)/3))) (atan2(hypot(1 + (pb)^2, pb), 3 + cos(hypot(1 + (pb)^2, pb)))))) - acos(cos(atan(asin(sin(ln(1 + (pb)^2))/2)))/3)) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named26 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tan(sin(tan(sin(hypot(1 + (acos(cos(ln(1 + (5)^2))/3))^2, (1 + ((0.88 - pa))^2)^(-3/2)))))) + pa^2 + b pb
}

symplectic::hamiltonian! {
    /// A random system.
    pub Named27 { g: 1.25 }
    q: [a, b], p: [pa, pb];
    H = tanh(atan((hypot(1 + (g)^2, 9) - atan(0.36)))) + pa^2 + pb^2 + (((1 + (atan2(g, 3 + cos(g)))^2)^(-3/2) + exp(sin(asin(sin(b)/2)))) - acos(cos(atan2((9)^3, 3 + cos((9)^3)))/3)) + a b
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed0 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: (hypot(1 + (atan(3))^2, (g - 0.60)) - (exp(sin(q[i])) + (g + g))) + p[i]^2) + sum(i < j: acos(cos(acos(cos((4) (5))/3))/3))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed1 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ln(1 + (((g - 9) - tan(sin(0.23))))^2) + p[i]^2) + sum(i in 0..3: acos(cos(asin(sin(exp(sin(2)))/2))/3))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed2 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: tanh(exp(sin(sqrt(2 + cos(0.22))))) + p[i]^2) + sum(i: sum(j in 0..i: (((atan2(0.86, 3 + cos(0.86)))/(2 + sin(atan(0.78))))) (acos(cos(tanh(q[i]))/3))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed3 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ((hypot(1 + (g)^2, q[i]) + hypot(1 + (p[i])^2, g))) (sqrt(2 + cos(sinh(cos(p[i]))))) + p[i]^2) + sin(sum(i: sinh(cos((p[i] + p[i])))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed4 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ((1 + (hypot(1 + (q[i])^2, 0.70))^2)^(-3/2) + (exp(sin(q[i])))^2) + p[i]^2) + sum(i < j: tanh((1 + (sqrt(2 + cos(0.41)))^2)^(-3/2)))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed5 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: asin(sin(tan(sin(sinh(cos(p[i])))))/2) + p[i]^2) + sum(i in 0..3: atan(asin(sin(asin(sin(p[i+1])/2))/2)))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed6 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: sinh(cos(atan(tan(sin(1))))) + p[i]^2) + sum(i: sum(j in 0..i: tanh((1 + (atan(4))^2)^(-3/2))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed7 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ((((q[i] + 8)) (atan(g)))/(2 + sin((acos(cos(p[i])/3) - acos(cos(8)/3))))) + p[i]^2) + sin(sum(i: exp(sin(atan2(p[i], 3 + cos(p[i]))))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed8 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: (((g)^2)^2) ((atan(q[i])) (asin(sin(p[i])/2))) + p[i]^2) + sum(i < j: exp(sin((atan(0.75)) (tanh(q[i])))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed9 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: sqrt(2 + cos(asin(sin(sqrt(2 + cos(q[i])))/2))) + p[i]^2) + sum(i in 0..3: (sqrt(2 + cos(atan2(q[i], 3 + cos(q[i])))) - acos(cos(ln(1 + (p[i+1])^2))/3)))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed10 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ln(1 + ((sinh(cos(q[i])) - tanh(g)))^2) + p[i]^2) + sum(i: sum(j in 0..i: (sqrt(2 + cos(((p[j])/(2 + sin(g)))))) (asin(sin(ln(1 + (q[i])^2))/2))))
}

symplectic::hamiltonian! {
    /// A random system.
    pub Indexed11 { g: 1.25 }
    q: [4], p: [4];
    H = sum(i: ln(1 + (((atan(q[i]))/(2 + sin((1 + (3)^2)^(-3/2)))))^2) + p[i]^2) + sin(sum(i: atan2(atan2(p[i], 3 + cos(p[i])), 3 + cos(atan2(p[i], 3 + cos(p[i]))))))
}

/// Looks at each of them.
pub fn each(look: &mut impl Look) {
    look.at(Named0::default());
    look.at(Named1::default());
    look.at(Named2::default());
    look.at(Named3::default());
    look.at(Named4::default());
    look.at(Named5::default());
    look.at(Named6::default());
    look.at(Named7::default());
    look.at(Named8::default());
    look.at(Named9::default());
    look.at(Named10::default());
    look.at(Named11::default());
    look.at(Named12::default());
    look.at(Named13::default());
    look.at(Named14::default());
    look.at(Named15::default());
    look.at(Named16::default());
    look.at(Named17::default());
    look.at(Named18::default());
    look.at(Named19::default());
    look.at(Named20::default());
    look.at(Named21::default());
    look.at(Named22::default());
    look.at(Named23::default());
    look.at(Named24::default());
    look.at(Named25::default());
    look.at(Named26::default());
    look.at(Named27::default());
    look.at(Indexed0::default());
    look.at(Indexed1::default());
    look.at(Indexed2::default());
    look.at(Indexed3::default());
    look.at(Indexed4::default());
    look.at(Indexed5::default());
    look.at(Indexed6::default());
    look.at(Indexed7::default());
    look.at(Indexed8::default());
    look.at(Indexed9::default());
    look.at(Indexed10::default());
    look.at(Indexed11::default());
}
