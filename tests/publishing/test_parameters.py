"""What a reader may ask for, and what he is told when he may not."""

from __future__ import annotations

import pytest

from wheelset.publishing.errors import InputError
from wheelset.publishing.notebooks import find_source
from wheelset.publishing.parameters import all_parameters, check_parameters, parse_assignments


@pytest.fixture
def toy(clone):
    return find_source(clone / "notebooks", "1_toy")


def test_assignments_are_json_or_text():
    texts = ["a=1.5", "b=true", "c=[1, 2]", "d=my.toml", "e=a1=0.3", "f="]
    expected = {"a": 1.5, "b": True, "c": [1, 2], "d": "my.toml", "e": "a1=0.3", "f": ""}
    assert parse_assignments(texts) == expected


def test_an_assignment_needs_its_sign():
    with pytest.raises(InputError, match="name=value"):
        parse_assignments(["speed"])


def test_only_what_was_given_is_injected(toy):
    assert check_parameters(toy, {"speed": "3"}) == {"speed": 3.0}
    assert all_parameters(toy, {"speed": 3.0})["resolution"] == "paper"


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"sped": 3.0}, ["unknown parameter `sped`", "did you mean `speed`?", "in m/s"]),
        ({"speed": -1.0}, ["`speed` = -1.0", "greater than 0", "> 0, <= 100"]),
        ({"speed": "fast"}, ["`speed` = 'fast'", "valid number"]),
        ({"resolution": "fine"}, ["`resolution` = 'fine'", "'quick' or 'paper'"]),
    ],
)
def test_a_refusal_names_value_reason_and_remedy(toy, given, words):
    with pytest.raises(InputError) as caught:
        check_parameters(toy, given)
    assert [word for word in words if word not in str(caught.value)] == []


def test_a_study_that_does_not_exist_is_named(toy):
    from dataclasses import replace

    with pytest.raises(InputError, match=r"wheelset\.studies\.nowhere"):
        check_parameters(replace(toy, study="nowhere"), {})


def test_a_notebook_without_study_takes_nothing(toy):
    from dataclasses import replace

    with pytest.raises(InputError, match="takes no parameters"):
        check_parameters(replace(toy, study=None), {"speed": 1})
