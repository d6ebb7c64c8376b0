"""The convergence study: orders by theory, two forms that agree, and a reference that is known."""

from __future__ import annotations

from importlib.resources import files

import pytest
from pydantic import ValidationError

from tests.exact_systems import VAN_DER_POL
from tests.systems import TOY_HOPF, TOY_LPC, toy_wheelset
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.studies import engine, example_cycles


@pytest.fixture(scope="module")
def errors():
    return engine.convergence(engine.Parameters(resolution="quick"))


def test_errors_fall_with_the_orders_of_theory(errors):
    """A fit over 10 to 80 intervals, of which 10 do not quite resolve the flange."""
    rows = engine.summary(errors).dropna()
    assert set(rows["quantity"]) >= {"mesh points", "between them", "period", "multiplier"}
    assert (rows["order"] > rows["theory"] - 0.8).all()
    between = rows[rows["quantity"] == "between them"]
    assert between["order"].to_numpy() == pytest.approx(5.0, abs=0.8)


def test_both_forms_err_alike(errors):
    """Half the period on half the intervals is the same discretisation."""
    assert engine.forms_apart(errors) < 1e-11


def test_every_system_is_there_in_both_forms_and_the_wheelsets_have_folds(errors):
    cases = errors.groupby(["system", "form"])["quantity"].unique()
    assert len(cases) == 6
    for (system, _), quantities in cases.items():
        assert ("fold speed" in quantities) == (system != "van der Pol")


def test_the_finest_meshes_are_good_enough_to_be_references():
    example = example_cycles.wheelset_cycle("toy", example_cycles.toy_wheelset())
    fold = example_cycles.fold_value(example, engine.FINEST, half=True)
    assert fold == pytest.approx(TOY_LPC[100.0][0], abs=1e-9)
    cycle = example_cycles.computed(example_cycles.oscillator_cycle(), engine.FINEST, half=False)
    assert cycle.period == pytest.approx(VAN_DER_POL[1.0][0], rel=1e-12)


def test_the_studys_toy_wheelset_is_the_one_of_the_oracles():
    mine = hopf_point(example_cycles.toy_wheelset(), "v", 50.0)
    other = hopf_point(toy_wheelset(), "v", 50.0)
    assert mine.value == pytest.approx(TOY_HOPF["v"], rel=1e-12)
    assert mine.lyapunov == pytest.approx(other.lyapunov, rel=1e-12)


def test_a_vehicle_without_a_flange_is_refused_before_anything_runs(tmp_path):
    text = (files("wheelset.data") / "vehicles" / "guo2021.toml").read_text("utf-8")
    path = tmp_path / "bare.toml"
    path.write_text("\n".join(line for line in text.splitlines() if not line.startswith("q1 =")))
    with pytest.raises(ValidationError, match="q1"):
        engine.Parameters(vehicle=str(path))
