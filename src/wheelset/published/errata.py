"""Slips in print, kept visible: where, what is printed, what is meant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Slip:
    """One slip of the paper."""

    place: str
    page: int
    printed: str
    meaning: str


ERRATA: tuple[Slip, ...] = (
    Slip(
        "Table 1, a1",
        995,
        "0.23 with the unit /m",
        "dimensionless by Eq. (1); the value is rounded, Table 3's speeds place it at 0.2266",
    ),
    Slip("Table 1, a3", 995, "-499.40 with the unit /m3", "unit 1/m2 by Eq. (1)"),
    Slip(
        "Eqs. (3), (4), Rw2 and Rr2",
        992,
        "radii of curvature given as polynomials of y",
        "the numbers are curvatures, in 1/m: Eq. (5) takes the polynomials themselves as 1/Rw2 and "
        "1/Rr2, and Fig. 10(d) labels its axis Rw2 in 1/m",
    ),
    Slip(
        "Table 1, e1, f1, e3, f3",
        995,
        "units /m and /m3",
        "as curvatures 1/m2 for e1, f1 and 1/m4 for e3, f3",
    ),
    Slip(
        "p0 below Eq. (7)",
        993,
        "p0 = (mc + 2 mf + 4 mw) g/8, masses of car body and frame not given",
        "nothing: a wheel load cannot be computed from Table 1",
    ),
    Slip(
        "Eqs. (10), (11), C33",
        993,
        "f33 is defined by C33, which the fit of Eq. (11) leaves out",
        "the spin moment is neglected, or C33 is taken from elsewhere",
    ),
    Slip(
        "Sections 3 and 4, Hopf speed",
        998,
        "52.29 and 51.70 m/s, because of the further nonlinear terms",
        "the Hopf speed is decided by linear terms; a1, c1, e1 or f1 must differ as well",
    ),
    Slip(
        "Sections 4 and 5, Hopf speed over a1",
        998,
        "inversely proportional to a1",
        "Table 3 obeys v^2 (a1 - 0.0103) = 578: inverse to the square root",
    ),
    Slip(
        "Table 3, a3 = -500",
        1001,
        "FLC -25.22, where section 4 prints -28.01 for a3 = -499.40",
        "another cubic setting differs between sections 4 and 5 and is not named",
    ),
    Slip(
        "Figs. 9-11 and section 6.1, last profile",
        1001,
        "18.4 in Fig. 9 and 0.184 million km in the text, 18.5 in Figs. 10, 11 and Table 4",
        "one and the same profile",
    ),
    Slip(
        "Table 4, mileages 6.8 and 9.4",
        1002,
        "Hopf speeds of two profiles",
        "profiles that no figure shows",
    ),
    Slip(
        "Section 6.2, Hopf speed over mileage",
        1003,
        "increases with running mileage at first, then decreases",
        "Table 4 rises to 71.50, falls to 62.55, rises to 67.04 and falls again",
    ),
)
