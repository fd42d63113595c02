"""Methods: what is derived, proved, exported and refused."""

import copy
import json
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import symplectica as sy


def test_gauss_has_the_exact_coefficients_and_correctly_rounded_doubles():
    gauss = sy.tableau(basis="polynomial(2)", nodes="gauss(2)")
    assert gauss.exact["a"] == [["1/4", "1/4 - sqrt(3)/6"], ["1/4 + sqrt(3)/6", "1/4"]]
    root = np.sqrt(3) / 6
    np.testing.assert_allclose(gauss.a, [[0.25, 0.25 - root], [0.25 + root, 0.25]], rtol=1e-15)
    assert gauss.b.tolist() == [0.5, 0.5]
    with pytest.raises(ValueError, match="read-only"):
        gauss.a[0, 0] = 1


def test_lobatto_has_fractions_and_sympy_forms():
    sympy = pytest.importorskip("sympy")
    lobatto = sy.method("lobatto-3")
    assert lobatto.to_fractions()["a_tilde"][0] == [Fraction(1, 6), Fraction(-1, 6), 0]
    exact = sy.method("gauss-2").to_sympy()["a"][0][1]
    assert sympy.simplify(exact - (sympy.Rational(1, 4) - sympy.sqrt(3) / 6)) == 0
    # An entry without a short form has forty digits.
    assert abs(sy.method("gauss-4").to_sympy()["a"][0][1] + sympy.Float("0.02660418008499879331338513047695310931", 40)) < 1e-30
    with pytest.raises(sy.ArgumentError, match="not rational"):
        sy.method("gauss-2").to_fractions()


def test_orders_are_proved_and_sharp():
    ruth = sy.splitting(kick=["7/24", "3/4", "-1/24"], drift=["2/3", "-2/3", 1])
    assert (ruth.order("separable"), ruth.orders["separable"].evidence) == (3, "proved")
    assert ruth.orders["separable"].refuted_by is not None
    # A perturbed coefficient loses the order.
    wrong = sy.splitting(kick=["7/24", "3/4", "-1/24"], drift=["2/3", "-667/1000", "1 - 2/3 + 667/1000"])
    assert wrong.order("separable") < 3
    with pytest.raises(sy.ArgumentError, match="unknown class"):
        ruth.order("all")


def test_properties_have_evidence_and_witnesses():
    properties = sy.method("gauss-2").properties
    assert properties.symplectic and properties["symplectic"].evidence == "proved"
    assert not properties.explicit and "Q1" in properties.explicit.witness
    with pytest.raises(AttributeError):
        _ = properties.explicitly
    verlet = sy.method("velocity-verlet").properties
    assert not verlet["symplectic"] and verlet["symplectic(separable)"].evidence == "proved"


def test_requirements_are_proved_or_raise_the_witness():
    gauss = sy.tableau(basis="polynomial(3)", nodes="gauss(3)", require=["symplectic", "symmetric", "order == 6", "p_stable"])
    assert gauss.require("order >= 5") is gauss
    with pytest.raises(sy.ProofError, match="order") as caught:
        gauss.require("order == 7")
    assert caught.value.requirement == "order == 7" and isinstance(caught.value, ValueError)


def test_stability_of_velocity_verlet_ends_at_two():
    stability = sy.method("velocity-verlet").stability
    assert stability is not None and stability.exact[0][1] == "2" and not stability.p_stable
    assert sy.method("gauss-2").stability.intervals == [(0.0, float("inf"))]


def test_exact_numbers_of_every_kind_are_the_same():
    texts = sy.splitting(kick=["1/2", "1/2"], drift=["1", "0"])
    for half in (Fraction(1, 2), 0.5, Decimal("0.5"), np.float64(0.5)):
        assert sy.splitting(kick=[half, half], drift=[1, 0]) == texts
    assert texts != sy.splitting(kick=["1/3", "2/3"], drift=["1", "0"])


def test_a_float_that_is_rounded_is_refused_with_the_fraction():
    with pytest.raises(sy.ArgumentError, match=r"7/24"):
        sy.splitting(kick=[7 / 24, 3 / 4, -1 / 24], drift=[2 / 3, -2 / 3, 1])
    with pytest.raises(sy.ArgumentError, match="printed digits are texts, with the `claim`"):
        sy.splitting(kick=[0.1234567891234, 1], drift=[1, 0])
    with pytest.raises(sy.ArgumentError):
        sy.splitting(kick=[float("nan"), 1], drift=[1, 0])


def test_wrong_definitions_have_their_place():
    with pytest.raises(sy.DefinitionError) as caught:
        sy.tableau(basis="polynomial(2)", nodes="0, 1/0")
    error = caught.value
    assert (error.input, error.text, error.span) == ("nodes", "0, 1/0", (5, 6))
    assert error.reason == "division by zero" and "^" in str(error)
    assert pickle.loads(pickle.dumps(error)).span == (5, 6)
    with pytest.raises(sy.ArgumentError, match="did you mean `nodes`"):
        sy.tableau(basis="polynomial(2)", node="gauss(2)")
    with pytest.raises(sy.DefinitionError, match="did you mean `gauss-8`"):
        sy.method("gaus-8")


def test_printed_digits_with_a_claim_become_the_exact_method():
    forest = sy.splitting(
        kick=["0.6756035959798288170", "-0.1756035959798288170", "-0.1756035959798288170", "0.6756035959798288170"],
        drift=["1.3512071919596576340", "-1.7024143839193152681", "1.3512071919596576340", "0"],
        claim="separable(4)",
    )
    assert forest.order("separable") == 4 and forest.wrong_digits == []


def test_exports_are_those_of_the_command_line():
    gauss = sy.method("gauss-2")
    facts = json.loads(gauss.to("json"))
    assert facts["order"]["general"]["order"] == 4
    assert "\\begin{array}" in gauss.to("latex") and gauss.to("toml") and "static const" in gauss.to("c")
    assert gauss.certificate().lstrip().startswith("{")
    assert "def " in gauss.emit("python")
    assert "9.81" in gauss.emit("c", sy.system("P { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)"))
    with pytest.raises(sy.ArgumentError, match="latex"):
        gauss.to("latx")
    with pytest.raises(sy.ArgumentError, match="digits"):
        gauss.to("text", digits=0)


def test_notebooks_see_an_array_that_mathjax_can_set():
    text = sy.method("lobatto-3")._repr_latex_()
    assert text is not None and text.count("\\begin{array}") == 2 and "\\tilde a" in text
    assert not any(word in text for word in ("toprule", "multicolumn", "quad}"))
    assert text.count("{") == text.count("}")
    # A table that is too wide is shown as text.
    assert sy.method("gauss-8")._repr_latex_() is None


def test_tableaux_pickle_copy_and_compare():
    for name in ("gauss-3", "ruth-1983", "blanes-moan-2002-s10", "lobatto-4"):
        made = sy.method(name)
        for other in (pickle.loads(pickle.dumps(made)), copy.copy(made), copy.deepcopy(made)):
            assert other == made and hash(other) == hash(made) and other.name == name
    assert sy.method("gauss-3") != sy.method("lobatto-3") and sy.method("gauss-3") != 3


def test_adjoint_of_symplectic_euler_is_the_other_one():
    euler = sy.method("symplectic-euler")
    assert euler.adjoint != euler and euler.adjoint.adjoint == euler


def test_methods_come_from_names_texts_files_and_definitions(tmp_path):
    gauss = sy.method("gauss-2")
    path = tmp_path / "gauss.toml"
    path.write_text(gauss.to("toml"), encoding="utf-8")
    assert sy.method(path) == sy.method(str(path)) == sy.method(gauss.to("toml")) == sy.method({"basis": "polynomial(2)", "nodes": "gauss(2)"}) == gauss
    path.write_text(gauss.to("toml").replace("1/4", "1/5"), encoding="utf-8")
    with pytest.raises((sy.ProofError, sy.DefinitionError)):
        sy.method(path)
    with pytest.raises(sy.ArgumentError, match="cannot read"):
        sy.method(tmp_path / "none.toml")
    with pytest.raises(sy.ArgumentError, match="expected a method"):
        sy.method(3)


def test_methods_of_doubles_are_marked_and_refused_if_not_symplectic():
    gauss = sy.method("gauss-2")
    made = sy.Doubles(gauss.a, gauss.b, order=4)
    assert not made.proved and "nothing proved" in repr(made)
    assert pickle.loads(pickle.dumps(made)).order() == 4
    with pytest.raises(sy.ArgumentError, match="symplectic"):
        sy.Doubles([[0.0, 0.0], [1.0, 0.0]], [0.5, 0.5])
    with pytest.raises(sy.ArgumentError, match="dimensions"):
        sy.Doubles([0.5], [1.0])


def test_audit_finds_the_exact_method_behind_doubles():
    gauss = sy.method("gauss-3")
    found = sy.audit(gauss.a, gauss.b)
    assert found.tableau == gauss and found.note is not None and "near" in found.note
    exact = sy.audit([["1/2"]], ["1"])
    assert exact.note is None and exact.tableau.order() == 2
    assert sy.audit(sy.Doubles(gauss.a, gauss.b)).tableau == gauss


def test_refine_proves_digits_and_refuses_wrong_ones():
    good = sy.refine(["0.2916667", "3/4", "-0.0416667"], ["0.6666667", "-0.6666667", "1"], order=3)
    assert "0.2916666666666666666" in good.text
    with pytest.raises((sy.ProofError, sy.DefinitionError)):
        sy.refine(["0.2916667", "3/4", "-0.0416667"], ["0.6666667", "-0.6766667", "1"], order=3)
    with pytest.raises(sy.ArgumentError, match="order"):
        sy.refine(["1"], ["1"])


def test_compositions_take_derived_methods():
    for name in ("velocity-verlet", "gauss-1", "lobatto-2"):
        made = sy.composition(sy.method(name), "triple_jump(4)")
        assert made == sy.composition(name, "triple_jump(4)") and made.order("separable") == 4
    ours = sy.splitting(kick=["1/2", "1/2"], drift=["1", "0"])
    assert sy.composition(ours, ["1/2", "1/2"]).order("separable") == 2


def test_roots_of_sympy_are_exact():
    sympy = pytest.importorskip("sympy")
    w = 1 / (2 - sympy.cbrt(2))
    made = sy.composition("velocity-verlet", [w, 1 - 2 * w, w])
    assert made == sy.composition("velocity-verlet", "triple_jump(4)")


def test_catalogue_has_titles_sources_and_tableaux():
    known = sy.catalogue()
    entry = known["gauss-4"]
    assert entry.stages == 4 and entry.source and entry.tableau.order() == 8
    assert sy.method(entry) is entry.tableau
