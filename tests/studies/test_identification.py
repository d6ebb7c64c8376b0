"""The search for hidden values: recovers known ones, holds what it is told, names what fails."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.hunting import hunting_system
from wheelset.plotting.identification import (
    load_curves,
    profile_panels,
    ranking_bars,
    residual_marks,
)
from wheelset.published.items import ITEMS, item_frame
from wheelset.studies import identification, identification_confidence
from wheelset.studies import identification_evidence as evidence
from wheelset.studies import identification_section_3 as section_3
from wheelset.studies.identification_data import (
    SECTION_4,
    TABLE_3,
    changes_of,
    observations,
    tolerance,
)
from wheelset.studies.identification_fit import cost_of, fit, starts
from wheelset.studies.identification_predict import predictions, zero_near
from wheelset.studies.identification_problem import CEILING, coordinates, problem, problem_of
from wheelset.studies.identification_variants import CORRECTIONS, FREE, REVERSED, variant, variants

P = identification.Parameters(resolution="quick")
#: Hidden values that are nobody's, to be found again.
TRUTH = {
    "a1": 0.2290, "p0": 7000.0, "e0": 25.0, "c0": 0.06, "nu": 0.22, "radius_offset": 2e-3,
}  # fmt: skip


@pytest.fixture(scope="module")
def data():
    return observations(item_frame(ITEMS))


@pytest.fixture(scope="module")
def made(data):
    """Table 3 as a wheelset with the true values would have it, unrounded."""
    return made_from(identification.group(data, TABLE_3))


def made_from(rows: pd.DataFrame) -> pd.DataFrame:
    of = problem(P, P.vehicle, variant(REVERSED), rows)
    table = predictions(of, coordinates(of, TRUTH))
    return rows.assign(printed=table["computed"])


class TestObservations:
    def test_all_of_table_3_and_section_4_with_their_rounding(self, data):
        assert data["group"].value_counts().to_dict() == {TABLE_3: 24, SECTION_4: 9}
        assert set(data["half_unit"]) == {0.005}
        first = data.iloc[0]
        assert (first["item"], first["printed"]) == ("Table 3: a1=0.05", 120.67)
        assert changes_of(first["changes"]) == {"a3": 200.0, "a1": 0.05}

    def test_a_missing_number_is_an_error(self):
        with pytest.raises(KeyError, match=r"Table 3: a1=0\.05"):
            observations(item_frame(ITEMS).query("item != 'Table 3: a1=0.05'"))

    def test_a_tolerance_is_rounding_and_model_error(self, data):
        rows = data.assign(tolerance=tolerance(data)).set_index(["item", "quantity"])["tolerance"]
        assert rows["Table 3: a1=0.05", "hopf_speed"] == pytest.approx(0.005 + 2e-4 * 120.67)
        assert rows["Table 3: a3=-500", "flc"] == pytest.approx(0.005 + 0.2522)
        assert rows["Section 4: GH a3=102.47", "gh_value"] == pytest.approx(0.055)


class TestVariants:
    def test_signs_are_both_there_and_every_structure_once(self):
        chosen = variants("paper")
        assert len(set(chosen)) == len(chosen) >= 16
        reversed_signs = [one for one in chosen if REVERSED in one.choices]
        assert 0 < len(reversed_signs) < len(chosen)
        assert len({(REVERSED in one.choices, one.words) for one in chosen}) == len(chosen)

    @pytest.mark.parametrize("one", [*FREE, *CORRECTIONS], ids=lambda one: one.name)
    def test_coordinates_and_values_are_each_others_inverse(self, one):
        assert one.value(0.0) == one.start
        assert one.value(one.coordinate(1.1 * one.start + 0.1)) == pytest.approx(
            1.1 * one.start + 0.1, rel=1e-12
        )
        low, high = one.bounds
        assert low < 0 < high
        assert one.value(low) == pytest.approx(one.low, abs=1e-12)


class TestFit:
    def test_residuals_are_those_of_single_hopf_points(self, data):
        rows = identification.group(data, TABLE_3)
        of = problem(P, P.vehicle, variant(REVERSED), rows)
        at = coordinates(of, TRUTH)
        residual = of.residuals(at)
        for k in (0, 9, 23):
            values = {**TRUTH, **changes_of(rows["changes"][k])}
            point = hopf_point(of.system.with_values(**values), "v", 52.0)
            computed = point.value if rows["quantity"][k] == "hopf_speed" else point.lyapunov
            assert residual[k] * of.tolerances[k] == pytest.approx(
                computed - rows["printed"][k], abs=1e-8
            )

    def test_its_jacobian_is_that_of_central_differences(self, made):
        of = problem(P, P.vehicle, variant(REVERSED), made)
        at = coordinates(of, TRUTH) + 0.1
        jacobian = of.jacobian(at, of.hopf(at))
        for k, step in enumerate(1e-4 * np.eye(len(at))):
            column = (of.residuals(at + step) - of.residuals(at - step)) / 2e-4
            # forward differences err by half a step's curvature, some 1e-4 of the greatest
            assert jacobian[:, k] == pytest.approx(column, abs=2e-3 * np.abs(column).max())

    def test_known_values_are_found_again(self, made):
        of = problem(P, P.vehicle, variant(REVERSED), made)
        found = fit(of, starts(of, 1), 1e-12)
        assert found.cost < 1e-6
        for name, value in TRUTH.items():
            assert found.values[name] == pytest.approx(value, rel=1e-2), name

    def test_a_wrong_structure_cannot_have_them(self, made):
        wrong = problem(P, P.vehicle, variant(), made)
        assert fit(wrong, starts(wrong, 1)).cost > 10

    def test_a_row_without_a_hopf_point_counts_as_the_ceiling(self, data):
        rows = identification.group(data, TABLE_3).head(2)
        of = problem_of(hunting_system(P.load(P.vehicle)).with_values(e0=-1.0), (), rows)
        assert np.abs(of.residuals(np.empty(0))) == pytest.approx(CEILING)

    def test_what_a_reader_changes_is_not_free(self, data):
        p = identification.Parameters(changes="nu=0.28, e0=20")
        of = problem(p, p.vehicle, variant(REVERSED), data)
        assert {"nu", "e0"}.isdisjoint(one.name for one in of.free)
        assert of.system.values["nu"] == 0.28

    def test_a_held_value_stays_but_where_the_row_has_its_own(self, data):
        of = problem(P, P.vehicle, variant(REVERSED), data).holding("a1", 0.3)
        rows = of.rows_at(np.zeros(len(of.free)))
        a1 = rows[of.which, of.system.index("a1")]
        own = [changes_of(text).get("a1", 0.3) for text in data["changes"]]
        assert a1 == pytest.approx(own)

    def test_soft_loss(self):
        assert cost_of(np.array([0.0, 3.0])) == pytest.approx(np.sqrt(10) - 1)


class TestPredictions:
    def test_zeros_are_zeros_and_the_nearest_to_print(self, data):
        of = problem_of(
            hunting_system(P.load(P.vehicle)), (), identification.group(data, SECTION_4)
        )
        table = predictions(of, np.empty(0)).set_index("item")
        place = table.loc["Section 4: GH a3=102.47", "computed"]
        point = hopf_point(of.system.with_values(a3=place), "v", 52.0)
        assert point.lyapunov == pytest.approx(0.0, abs=1e-6)

    def test_no_zero_says_where_it_was_sought(self):
        system = hunting_system(P.load(P.vehicle))
        value, words = zero_near(system, system.p(v=52.0, e0=-1.0), "a3", 100.0)
        assert value is None
        assert words == "FLC has no zero at a3 = -100 to 300"

    def test_beside_keeps_the_order_and_every_reading(self, data):
        rows = identification.group(data, TABLE_3).head(4)
        one = identification.vehicle_fit(P, P.vehicle, rows)
        table = identification.beside(
            identification.residual_table({"one": one, "two": one}, rows), "off"
        )
        assert table["item"].tolist() == rows["item"].tolist()
        assert (table["one"] == table["two"]).all()


class TestConfidence:
    def test_directions_are_orthogonal_and_ordered(self, made):
        of = problem(P, P.vehicle, variant(REVERSED), made)
        best = fit(of, [coordinates(of, TRUTH)], 1e-12)
        found = identification_confidence.directions(best)
        weights = np.array([list(one.weights.values()) for one in found])
        np.testing.assert_allclose(weights @ weights.T, np.eye(len(found)), atol=1e-12)
        assert sorted(one.error for one in found) == [one.error for one in found]

    def test_a_profile_is_lowest_where_the_truth_is(self, made):
        of = problem(P, P.vehicle, variant(REVERSED), made)
        best = fit(of, [coordinates(of, TRUTH)], 1e-12)
        curve = identification_confidence.profile(best, "p0", 1)
        assert curve["value"].is_monotonic_increasing
        assert curve.loc[curve["excess"].idxmin(), "value"] == pytest.approx(7000.0, rel=1e-3)
        assert (curve["excess"].iloc[[0, -1]] > 0.1).all()


class TestEvidence:
    def test_the_print_is_affine_in_a3_with_one_slope(self, data):
        table = evidence.affine_in_a3(data).set_index("source")
        assert table["slope"]["Table 3"] == pytest.approx(table["slope"]["section 4"], rel=2e-4)
        assert table["worst"]["Table 3"] < 0.005
        assert table["zero"]["Table 3"] == pytest.approx(41.87, abs=0.05)

    def test_a_parabola_through_three_zeros_leaves_nothing(self, data):
        table = evidence.curvature_zeros(data).set_index("reading")
        assert table["worst"]["a constant"] < 1e-6
        assert abs(table["const"]["a constant"]) < 3

    def test_gravity_alone_pushes_the_physical_wheelset_back_and_the_other_out(self):
        physical = evidence.angle_effect(P, P.vehicle_physical)
        papers = evidence.angle_effect(P, P.vehicle)
        assert physical["without_spin"] > 0 > papers["without_spin"]
        assert physical["effect"] > 0 > papers["effect"]

    def test_loads_of_section_3_give_the_printed_jump(self):
        printed = section_3.Printed.of(item_frame(ITEMS))
        assert printed.jump == pytest.approx(289.62)
        found = section_3.readings(P, printed, section_3.jumps(P, printed))
        assert set(found["wheels"]) == {1, 2}
        assert found["jump"].to_numpy() == pytest.approx(printed.jump, abs=1e-6)
        assert found["v"].to_numpy() == pytest.approx(52.36, abs=0.02)


class TestFigures:
    def test_axes_carry_units(self, data):
        rows = identification.group(data, TABLE_3)
        table = identification.residual_table(
            {"one": identification.vehicle_fit(P, P.vehicle, rows)}, rows
        )
        ranking = pd.DataFrame(
            {"words": ["as printed"], "signs": ["physical"], "cost": [30.0], "corrected": [True]}
        )
        profiles = pd.DataFrame({"name": "p0", "value": [5e3, 6e3], "excess": [1.0, 0.0]})
        jumps = pd.DataFrame({"wheels": [1, 2], "p0": 5e3, "jump": [100.0, 200.0]})
        for figure in (
            ranking_bars(ranking),
            residual_marks(table),
            profile_panels(profiles),
            load_curves(jumps, jumps, 150.0),
        ):
            labels = [t for ax in figure.axes for t in (ax.get_xlabel(), ax.get_ylabel()) if t]
            assert labels
            assert all("(" in label for label in labels)
