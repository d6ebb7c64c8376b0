"""Exact Hertz by other routes, Kalker's table beside the reference, and what is made of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from pydantic import ValidationError

from wheelset.bifurcation.equilibria.hopf import instabilities
from wheelset.hunting import hunting_system
from wheelset.studies import contact_formulas as study
from wheelset.studies.contact_formulas_bounds import bounds, visited
from wheelset.studies.contact_formulas_exact import (
    COEFFICIENTS,
    POISSON,
    BeyondTable,
    axis_ratio,
    curvature_ratio,
    hertz_ellipse,
    kalker,
    kalker_table,
    table_ratios,
    tabulated,
)
from wheelset.studies.contact_formulas_model import wheel
from wheelset.studies.contact_formulas_speed import correctable, corrections, hopf_speeds
from wheelset.vehicle import load_vehicle

REFERENCE = Path(__file__).parents[3] / "shared" / "reference" / "kalker_coefficients.csv"

#: Hertz's table as Timoshenko and Goodier print it (Theory of Elasticity, art. 140): theta in
#: degrees with cos(theta) = (B - A)/(A + B), and the semi-axes over those of a circle.
HERTZ = (
    (30, 2.731, 0.493), (35, 2.397, 0.530), (40, 2.136, 0.567), (45, 1.926, 0.604),
    (50, 1.754, 0.641), (55, 1.611, 0.678), (60, 1.486, 0.717), (65, 1.378, 0.759),
    (70, 1.284, 0.802), (75, 1.202, 0.846), (80, 1.128, 0.893), (85, 1.061, 0.944),
    (90, 1.000, 1.000),
)  # fmt: skip

STEEL = {"N": 6e4, "E": 2.1e11, "nu": 0.28}


@pytest.fixture(scope="module")
def parameters():
    return study.Parameters(resolution="quick")


@pytest.fixture(scope="module")
def errors(parameters):
    return study.hertz_errors(parameters)


@pytest.mark.parametrize(("theta", "m", "n"), HERTZ)
def test_the_ellipse_is_the_one_of_hertzs_table(theta, m, n):
    """Printed with three decimals, of which Hertz's own interpolation took up to two units."""
    cosine = np.cos(np.radians(theta))
    A, B = 2.0 * (1 - cosine), 2.0 * (1 + cosine)
    patch, k = hertz_ellipse(A, B, **STEEL)
    circle = 1.5 * STEEL["N"] * (1 - STEEL["nu"] ** 2) / (STEEL["E"] * (A + B))
    a, b = np.sqrt(patch / k), np.sqrt(patch * k)
    assert a / np.cbrt(circle) == pytest.approx(m, abs=2.5e-3)
    assert b / np.cbrt(circle) == pytest.approx(n, abs=2.5e-3)


def sinking(x, y, a, b, N, E, nu):
    """Displacement of one half-space at a point of the ellipse under Hertz's pressure.

    Boussinesq: (1 - nu2)/(pi E) times the integral of pressure over distance. In polar
    coordinates about the point the distance cancels, and along a chord the pressure is half an
    ellipse, whose area is known; over the angles the integrand is periodic and smooth.
    """
    angle = np.linspace(0, np.pi, 400, endpoint=False)
    u, v = np.cos(angle), np.sin(angle)
    square, slope = (u / a) ** 2 + (v / b) ** 2, x * u / a**2 + y * v / b**2
    highest = 1 - (x / a) ** 2 - (y / b) ** 2 + slope**2 / square
    area = np.pi / 2 * highest / np.sqrt(square)
    pressure = 3 * N / (2 * np.pi * a * b)
    return (1 - nu**2) / (np.pi * E) * pressure * np.pi * area.mean()


@pytest.mark.parametrize("ratio", [0.05, 0.3, 1.0, 2.0, 20.0])
def test_hertzs_pressure_flattens_the_gap(ratio):
    """Both bodies sink so that the gap A x2 + B y2 is closed all over the ellipse."""
    B = 1.1
    A = ratio * B
    patch, k = hertz_ellipse(A, B, **STEEL)
    a, b = float(np.sqrt(patch / k)), float(np.sqrt(patch * k))
    for x, y in ((0.9 * a, 0), (0, 0.8 * b), (0.5 * a, -0.6 * b)):
        closed = 2 * (sinking(0, 0, a, b, **STEEL) - sinking(x, y, a, b, **STEEL))
        assert closed == pytest.approx(A * x**2 + B * y**2, rel=1e-9)


def test_the_axis_ratio_inverts_the_curvature_ratio():
    k = np.geomspace(1e-3, 1e3, 61)
    assert axis_ratio(curvature_ratio(k)) == pytest.approx(k, rel=1e-11)


@pytest.mark.parametrize("ratio", [0.0, -1.0, np.nan, np.inf])
def test_a_contact_without_ellipse_is_refused(ratio):
    with pytest.raises(ValueError, match="A/B"):
        axis_ratio(ratio)


@pytest.mark.skipif(not REFERENCE.is_file(), reason="the reference table is not in this checkout")
def test_kalkers_table_is_the_reference():
    reference = pd.read_csv(REFERENCE).sort_values("b_over_a")
    assert table_ratios() == pytest.approx(reference["b_over_a"].to_numpy(), rel=1e-4)
    for name in COEFFICIENTS:
        rows = kalker_table().query("coefficient == @name")
        columns = [f"{name}_nu{nu:g}" for nu in POISSON]
        assert (rows[list(POISSON)].to_numpy() == reference[columns].to_numpy()).all()


def test_without_poissons_ratio_rolling_is_alike_in_both_directions():
    assert tabulated("C11", 0.0).to_numpy() == pytest.approx(tabulated("C22", 0.0).to_numpy())


def test_the_table_tends_to_its_limits():
    """Of plane rolling, b/a to infinity; at its end the table is within a few per cent of them."""
    for nu in POISSON:
        limits = study.thin_limits(study.Parameters(nu=nu)).set_index("coefficient")["exact"]
        for name in ("C11", "C22"):
            assert tabulated(name, nu).iloc[-1] == pytest.approx(limits[name], rel=0.03)


@pytest.mark.parametrize("name", COEFFICIENTS)
def test_between_the_tables_ratios_the_spline_is_as_good_as_the_tables_digits(name):
    """A row left out is found again from its neighbours; half a unit of the third digit is up to
    0.5 per cent, and leaving out widens the step.
    """
    k, values = table_ratios(), tabulated(name, 0.25).to_numpy()
    assert kalker(name, k, 0.25) == pytest.approx(values, rel=1e-12)
    midway = kalker(name, np.sqrt(k[1:] * k[:-1]), 0.25)
    assert midway == pytest.approx(np.sqrt(values[1:] * values[:-1]), rel=0.05)


def test_beyond_the_table_there_is_no_coefficient():
    with pytest.raises(BeyondTable, match=r"b/a = 12 .* from 0\.1 to 10"):
        kalker("C11", [1.0, 12.0], 0.28)
    with pytest.raises(ValueError, match=r"nu = 0\.6"):
        tabulated("C11", 0.6)


def test_a_circle_has_no_error_but_the_tables(errors):
    """At A = B Eq. (6) is Hertz's, whichever way it is read."""
    there = errors[np.isclose(errors["ratio"], 1.0) & (errors["against"] == "Hertz")]
    assert len(there) == 9
    assert there["error"].abs().max() < 1e-12


def test_the_size_of_the_models_ellipse_is_absolute():
    """Not only ratios: a circle's radius, Johnson (1985) Eq. (4.22)."""
    vehicle = load_vehicle("guo2021_physical")
    values = vehicle.values
    modulus = values["E"] / (2 * (1 - values["nu"] ** 2))
    radius = np.cbrt(3 * values["p0"] * values["r0"] / (4 * modulus))
    assert wheel(1.0, vehicle)["ab"] == pytest.approx(radius**2, rel=1e-12)


def test_the_printed_reading_is_hertzs_and_keeps_to_its_bounds(parameters, errors):
    points = study.kalker_points(parameters).query("nu == 0.28")
    table = bounds(errors, points, visited(parameters))
    rows = table.set_index(["quantity", "reading", "against"])
    assert abs(rows.loc[("ab", "inside", "Hertz"), "greatest"]) < 0.0066
    assert abs(rows.loc[("b/a", "inside", "Hertz"), "greatest"]) < 0.055
    assert abs(rows.loc[("ab", "outside", "Hertz"), "greatest"]) > 0.1
    assert (table["rms"] <= table["greatest"].abs()).all()
    assert (table["visited"] <= table["greatest"].abs()).all()


def test_a_claim_is_kept_where_the_table_says(parameters, errors):
    points = study.kalker_points(parameters).query("nu == 0.28")
    claims = bounds(errors, points, visited(parameters)).dropna(subset="claimed")
    for _, row in claims[claims["quantity"].isin(COEFFICIENTS)].iterrows():
        inside = points[(points["coefficient"] == row["quantity"])]
        inside = inside[inside["k"].between(row["from"], row["to"])]
        assert inside["error"].abs().max() <= row["claimed"]
        everywhere = len(inside) == len(table_ratios())
        assert everywhere == (abs(row["greatest"]) <= row["claimed"])


def test_the_fits_stand_for_steel():
    assert study.best_poisson()["nu"].between(0.27, 0.30).all()


def test_the_best_ratio_is_the_lowest_of_the_curve(parameters):
    best = study.best_poisson().set_index("coefficient")
    least = study.poisson(parameters).groupby("coefficient")["rms"].min()
    assert (best["rms"] <= least).all()


def test_the_profiles_are_visited_inside_the_formulas_range(parameters):
    rows = visited(parameters).set_index("of")
    pair = rows.loc["LMB10 on CHN60"]
    # R350 on R300, the flattest contact: 1/(2 r) over half of 1/0.3 - 1/0.35
    assert pair["high"] == pytest.approx(1 / (0.46 * (1 / 0.3 - 1 / 0.35)), rel=2e-3)
    assert rows.loc["guo2021_physical", "high"] == np.inf
    assert rows.loc["guo2021_physical", "words"].endswith("|y| = 1.15 mm")


def test_a_correction_acts_like_the_models_own_factor():
    """f23 can be scaled by a parameter of the vehicle, so that both ways must agree."""
    scaled = correctable(hunting_system(load_vehicle("guo2021"))).with_values(f23_correction=1.2)
    factor = 1.2 * load_vehicle("guo2021").values["f23_factor"]
    other = hunting_system(load_vehicle("guo2021", {"f23_factor": factor}))
    speeds = [instabilities(s, "v", (10.0, 200.0))[0].value for s in (scaled, other)]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-10)


def test_corrections_make_the_coefficients_exact_nearby(parameters):
    """To first order, so that the rest is quadratic in the distance from the centred contact."""
    found = corrections(parameters, "guo2021", "Hertz", 0.28)
    vehicle = load_vehicle("guo2021")
    centre = 1 / (vehicle.values["r0"] * (vehicle.values["e0"] + vehicle.values["f0"]))
    for step, allowed in ((1e-3, 1e-7), (1e-2, 1e-5)):
        ratio = centre * (1 + step)
        exact, ours = wheel(ratio, vehicle, "Hertz"), wheel(ratio, vehicle)
        for f in ("f11", "f22", "f23"):
            law = found[f"{f}_correction"] * ratio ** found[f"{f}_exponent"]
            assert ours[f] * law == pytest.approx(exact[f], rel=allowed)


def test_hopf_speeds_with_exact_formulas():
    """The first row is the vehicle's own speed; a contact beyond Kalker's table is named."""
    p = study.Parameters(resolution="quick", vehicle="guo2021_physical", changes="e0=0.05, f0=0")
    rows = hopf_speeds(p)
    own = instabilities(hunting_system(p.load(p.vehicle)), "v", p.window)
    assert rows["v"].iloc[0] == pytest.approx(own[0].value, rel=1e-12)
    beyond = rows[rows["against"] == "Kalker"]
    assert beyond["v"].isna().all()
    assert beyond["words"].str.contains("beyond Kalker's table").all()


def test_no_hopf_point_in_the_window_is_said_in_words():
    rows = hopf_speeds(study.Parameters(resolution="quick", v_min=10.0, v_max=12.0))
    assert rows["change"].isna().all()
    assert rows["words"].str.startswith("no Hopf point").all()


@pytest.mark.parametrize(
    ("given", "words"),
    [({"wheel": "LMB11"}, "LMB10"), ({"rail": "LMB10"}, "a rail is wanted"), ({"nu": 0.6}, "0.5")],
)
def test_what_cannot_be_computed_is_refused(given, words):
    with pytest.raises(ValidationError, match=words):
        study.Parameters(**given)
