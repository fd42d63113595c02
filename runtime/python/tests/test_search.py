"""Searches for methods."""

import pytest

import symplectica as sy


def test_a_search_finds_proved_methods_the_best_first():
    found = sy.search(4, kicks=6, hamiltonian="nystrom", structure="bab", starts=64, keep=2)
    assert (found.conditions, found.unknowns, found.free, len(found)) == (4, 7, 3, 2)
    assert found[0].efficiency <= found[1].efficiency
    assert found[0].tableau.order("nystrom") == 4
    assert found[0].tableau.properties["symplectic(separable)"]
    assert "claim" in dict(found[0].tableau.definition)


def test_the_same_seed_gives_the_same_methods():
    first, second = (sy.search(4, kicks=4, starts=64, seed=7) for _ in range(2))
    assert [one.tableau.definition for one in first] == [one.tableau.definition for one in second]


def test_what_cannot_be_found_is_an_empty_sequence_with_the_counts():
    found = sy.search(6, kicks=5, starts=64)
    assert (len(found), found.conditions, found.unknowns, found.free) == (0, 10, 6, None)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"order": 5, "kicks": 9, "starts": 1}, "symmetric methods have even orders"),
        ({"order": (8, 4), "kicks": 5, "starts": 1}, "perturbed"),
        ({"order": 4, "kicks": 0, "starts": 1}, "kicks"),
        ({"order": 4, "kicks": 4, "structure": "abc"}, "possible values"),
        ({"order": 4, "kicks": 4, "time": 0}, "positive number of seconds"),
    ],
)
def test_wrong_options_are_argument_errors(arguments, message):
    with pytest.raises(sy.ArgumentError, match=message):
        sy.search(**arguments)
