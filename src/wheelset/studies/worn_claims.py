"""What section 6 says in words about Figs 9 and 10, each sentence measured on simulated wheels."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from wheelset.profiles import Contact, PolynomialFit, SineFit
from wheelset.studies.section_rows import claim_frame, part_where
from wheelset.studies.worn_profiles import FIGURE_MILEAGES, Array, conicity_at

Row = tuple[object, ...]

#: Half the width within which wear dominates, m: Fig. 9(b). It dominates with most of the worn
#: area.
BAND, MOST = 15e-3, 0.5

#: Displacements over which r is almost linear, m (Fig. 10a, the panel's end), and how far from a
#: straight line, as a part of its rise, "almost linear" lets it be, and is tolerated.
LINEAR, BENT, CURVED = (-2.5e-3, 6e-3), 0.10, 0.15

#: Exceptions from a rise that are tolerated, as a part of its steps.
RARE = 0.10

#: A fit is better than another with this part of its error; with less than all of it is tolerated.
BETTER = 0.9

#: Displacements shown by Figs 10(c) and (d), m, and over which functions are fitted.
SHOWN, FITTED = 8e-3, 6e-3

#: A curve is much smoother than another with half its roughness.
SMOOTHER = 0.5

#: Range of the linear term of the contact angle in Table 3, 1/m.
TABLE_3_C1 = 400.0


def figure_claims(
    profiles: pd.DataFrame,
    contacts: Mapping[float, Contact],
    curves: pd.DataFrame,
    conicity: pd.DataFrame,
) -> pd.DataFrame:
    """Claims on Figs 9 and 10, columns as ``claim_frame``.

    profiles: ``profile_frame`` over the whole wheel; curves: ``contact_frame``; conicity:
    ``conicity_frame``. Only the figures' mileages count.
    """
    shown = {m: contacts[m] for m in FIGURE_MILEAGES if m in contacts}
    curves = curves[curves["mileage"].isin(shown)]
    rows = [*_wear(profiles), *_radius(curves), *_conicity(conicity, tuple(shown))]
    return claim_frame([*rows, *_angle(curves, shown), *_curvature(curves, shown)])


# --- Fig. 9 ---------------------------------------------------------------------------------------


def _wear(profiles: pd.DataFrame) -> list[Row]:
    worn = profiles[profiles["mileage"] > 0]
    shares = [share_of_wear(rows) for _, rows in worn.groupby("mileage")]
    deepest = worn.loc[worn.groupby("mileage")["depth"].idxmax(), "y"].abs().max()
    return [
        ("Fig. 9: a", "wear dominates within 15 mm of the origin: least share of the worn area",
         min(shares), "1", MOST, 1.0),
        ("Fig. 9: b", "the greatest depth lies there: its largest distance from the origin",
         float(deepest), "m", 0.0, BAND),
    ]  # fmt: skip


def share_of_wear(rows: pd.DataFrame, band: float = BAND) -> float:
    """The part of the worn area that lies within the band [m] about the origin.

    rows: y m, equidistant, and depth m.
    """
    depth = rows["depth"].to_numpy(float)
    return float(depth[abs(rows["y"].to_numpy(float)) <= band].sum() / depth.sum())


# --- Fig. 10 --------------------------------------------------------------------------------------


def _radius(curves: pd.DataFrame) -> list[Row]:
    lines = straight_lines(curves)
    steps = np.diff(lines["slope"]) > 0
    return [
        ("Fig. 10: a", "r is almost linear in y from -2.5 mm on: largest distance from a straight "
         "line, as a part of the rise", float(lines["bent"].max()), "1", 0.0, BENT, CURVED),
        ("Fig. 10: a", "its slope grows with the mileage: part of the steps", part_where(steps),
         "1", 1.0, 1.0),
        ("Fig. 10: a", "r of the new wheel is linear, too", float(lines["bent"].iloc[0]), "1",
         0.0, BENT, CURVED),
    ]  # fmt: skip


def straight_lines(curves: pd.DataFrame) -> pd.DataFrame:
    """Least squares lines through r over ``LINEAR``: mileage, slope, bent (largest distance over
    the line's rise).
    """
    part = curves[curves["y"].between(*LINEAR)]
    return pd.DataFrame([_line(m, rows) for m, rows in part.groupby("mileage")])


def _line(mileage: object, rows: pd.DataFrame) -> dict[str, object]:
    y, r = rows["y"].to_numpy(float), rows["r"].to_numpy(float)
    line = np.polynomial.Polynomial.fit(y, r, 1)
    slope = float(line.deriv()(0.0))
    rise = abs(slope) * (LINEAR[1] - LINEAR[0])
    return {"mileage": mileage, "slope": slope, "bent": float(abs(r - line(y)).max()) / rise}


def _conicity(conicity: pd.DataFrame, mileages: tuple[float, ...]) -> list[Row]:
    table = conicity.pivot_table(index="amplitude", columns="mileage", values="conicity")
    common = table[list(mileages)].dropna()
    falls = np.diff(common.to_numpy(float), axis=1) <= 0
    usual = conicity_at(conicity).reindex(mileages)
    return [
        ("Fig. 10: b", "the conicity increases with the mileage: part of the steps, over all "
         "amplitudes, where it does not", part_where(falls.ravel()), "1", 0.0, 0.0, RARE),
        ("Fig. 10: b", "from the first to the last mileage, at 3 mm: factor",
         float(usual.iloc[-1] / usual.iloc[0]), "1", 1.0, np.inf),
    ]  # fmt: skip


def _angle(curves: pd.DataFrame, contacts: Mapping[float, Contact]) -> list[Row]:
    shown = curves[abs(curves["y"]) <= SHOWN].groupby("mileage")["delta"]
    ranges = shown.max() - shown.min()
    c1 = [linear_term(contact) for contact in contacts.values()]
    return [
        ("Fig. 10: c", "the contact angle varies the most at the last mileage: its range over the "
         "largest of the others", float(ranges.iloc[-1] / ranges.iloc[:-1].max()), "1", 1.0,
         np.inf),
        ("Fig. 10: c", "the linear term of cubic fits varies less than in Table 3: range over "
         "Table 3's", float(np.ptp(c1)) / TABLE_3_C1, "1", 0.0, 1.0),
    ]  # fmt: skip


def linear_term(contact: Contact) -> float:
    """The paper's c1 of a contact, 1/m, from a cubic fit over ``FITTED``."""
    return float(PolynomialFit.of(contact, FITTED).coefficients("delta")[0][1])


def _curvature(curves: pd.DataFrame, contacts: Mapping[float, Contact]) -> list[Row]:
    rough = roughness(curves)
    better = [sine_over_polynomial(contact) for m, contact in contacts.items() if m > min(contacts)]
    return [
        ("Fig. 10: d", "the first wheel's curvature is much smoother than the others': its "
         "roughness over the least of theirs", float(rough.iloc[0] / rough.iloc[1:].min()), "1",
         0.0, SMOOTHER),
        ("Fig. 10: d", "sines fit worn wheels' curvature better than polynomials with as many "
         "terms: mean quotient of the errors", float(np.mean(better)), "1", 0.0, BETTER, 1.0),
    ]  # fmt: skip


def roughness(curves: pd.DataFrame) -> pd.Series:
    """The way the curvature goes up and down over ``SHOWN``, 1/m, indexed by mileage."""
    shown = curves[abs(curves["y"]) <= SHOWN]
    return shown.groupby("mileage")["curvature"].apply(_up_and_down)


def _up_and_down(values: pd.Series) -> float:
    steps: Array = np.diff(values.to_numpy(float))
    return float(abs(steps).sum())


def sine_over_polynomial(contact: Contact) -> float:
    """Root mean square error of two harmonics over that of a quartic, both of five terms, for the
    sum of curvatures over ``FITTED``.
    """
    sines = SineFit.of(contact, FITTED, terms=2).errors["rho_left"].rms
    return sines / PolynomialFit.of(contact, FITTED, degree=4).errors["rho_left"].rms
