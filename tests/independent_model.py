"""The wheelset model a second time, in plain Python arithmetic: no sympy, no code of the package.

Written from Eqs. (1)-(21) with the operators of the numbers it is given, so that mpmath numbers
make it exact to any precision. Used to check the compiled model, its Jacobian and its multilinear
forms against an independent route.
"""

from __future__ import annotations

from itertools import product

import mpmath as mp


def derivative(x, v, q, o):
    """d/dt (y, psi, yd, psid) for parameters q (name -> number) and options o (name -> choice)."""
    y, psi, yd, psid = x
    sigma = {"physical": 1, "reversed": -1}[o["contact_angle_sign"]]
    dr, delta, rho = (
        {s: polynomial(q, letter, s, y) for s in (1, -1)} for letter in ("a", "c", "h")
    )
    phi = (dr[1] - dr[-1]) / (2 * q["b"])
    force, moment = flange(y, q, o), mp.mpf(0)
    for s in (1, -1):
        wheel = contact(s, dr[s], delta[s] + s * phi, rho[s], (psi, yd, psid, v), q, o, sigma)
        force += wheel["lateral"]
        moment += wheel["yaw"]
    spring_y = 2 * q["Kpy"] * y + 2 * q["Cpy"] * yd
    spring_psi = 2 * q["wp"] ** 2 * (q["Kpx"] * psi + q["Cpx"] * psid)
    return [yd, psid, (force - spring_y) / q["mw"], (moment - spring_psi) / q["Iwz"]]


def polynomial(q, letter, s, y):
    total = mp.mpf(0)
    for k in range(4):
        common = q[f"e{k}"] + q[f"f{k}"] if letter == "h" else q.get(f"{letter}{k}", 0)
        total += (common + s * q[f"d{letter}{k}"]) * (s * y) ** k
    return total


def contact(s, dr, gamma, rho, motion, q, o, sigma):
    psi, yd, psid, v = motion
    cosine, sine = mp.cos(gamma), mp.sin(gamma)
    A, B = 1 / (2 * (q["r0"] + dr)), rho / (2 if o["transverse_curvature"] == "half" else 1)
    n063 = mp.mpf("0.63")
    k = (A / B) ** n063
    lifting = cosine if o["normal_force"] == "vertical" else mp.mpf(1)
    normal = q["p0"] / lifting
    hertz = mp.mpf(3) / 2 * (1 - q["nu"] ** 2) / q["E"] / (A + B)
    bracket = (1 + A / B) / (2 * mp.sqrt(A / B))
    under, beside = (bracket**n063, 1) if o["shape_exponent"] == "inside" else (1, bracket**n063)
    ab = (hertz * under * normal) ** (mp.mpf(2) / 3) * beside
    G = q["E"] / (2 * (1 + q["nu"]))
    c11 = mp.mpf("3.2893") + mp.mpf("0.9750") / k - mp.mpf("0.0120") / k**2
    c22 = mp.mpf("2.4014") + mp.mpf("1.3179") / k - mp.mpf("0.0200") / k**2
    c23 = (
        mp.mpf("0.4147") + mp.mpf("1.0184") / k + mp.mpf("0.0565") / k**2 - mp.mpf("0.0013") / k**3
    )
    c33 = mp.mpf(0)
    if o["spin_moment"] == "fit":
        c33 = mp.mpf("0.3501") + mp.mpf("0.8051") * k + mp.mpf("0.0596") / (1 + k)
    f11, f22, f33 = G * ab * c11, G * ab * c22, G * ab**2 * c33
    f23 = q["f23_factor"] * G * mp.sqrt(ab) ** 3 * c23
    xi_x = -q["radius_offset"] - dr / q["r0"] - s * q["b"] * psid / v
    xi_y = (yd / v - psi) * (cosine if o["lateral_creepage_cosine"] == "included" else 1)
    xi_s = -sigma * s * sine / q["r0"] * cosine ** q["spin_cosine_exponent"] + psid / v * cosine
    moment = f23 * xi_y if o["lateral_spin_moment"] == "plus" else -f23 * xi_y
    fx, fy, mz = -f11 * xi_x, -f22 * xi_y - f23 * xi_s, moment - f33 * xi_s
    if o["creep_law"] == "shen_hedrick_elkins":
        u = mp.sqrt(fx**2 + fy**2) / (q["mu"] * normal)
        factor = 1 - u / 3 + u**2 / 27 if u < 3 else 1 / u
        fx, fy, mz = factor * fx, factor * fy, factor * mz
    gravity = -sigma * s * q["p0"] * sine / lifting
    lateral = fx * psi + fy * cosine + gravity
    yaw = -s * q["b"] * fx - s * q["b"] * psi * lateral + mz * cosine
    return {"lateral": lateral, "yaw": yaw, "fx": fx, "fy": fy, "normal": normal}


def flange(y, q, o):
    law, wheels = o["flange_law"], o["flange_wheels"]
    if law == "none":
        return mp.mpf(0)
    if law == "piecewise_linear":
        beyond = max(abs(y) - q["eta"], 0)
        return -wheels * q["k0"] * beyond * mp.sign(y)
    if law == "quintic":
        return wheels * (q["d1"] * y**3 - q["d2"] * y**5)
    if law == "exponential":
        return wheels * q["p1"] * (mp.exp(q["q1"] * y) - mp.exp(-q["q1"] * y))
    return wheels * q["p2"] * (1 / (q["q2"] - y) - 1 / (q["q2"] + y))


def multilinear_form(f, x, *directions, digits=60):
    """D^k f(x)[v_1..v_k] by nested central differences in extended precision.

    With steps of 10^-h the error is of order 10^-2h; the working precision pays for the k-fold
    cancellation, so at least 2h - 2 digits are right.
    """
    k = len(directions)
    h = digits // 4
    with mp.workdps(digits + k * h):
        step = mp.mpf(10) ** -h
        total = [mp.mpf(0)] * len(x)
        for signs in product((1, -1), repeat=k):
            shifted = [
                mp.mpf(xi)
                + step
                * mp.fsum(s * mp.mpmathify(d[i]) for s, d in zip(signs, directions, strict=True))
                for i, xi in enumerate(x)
            ]
            sign = mp.mpf(1)
            for s in signs:
                sign *= s
            total = [t + sign * value for t, value in zip(total, f(shifted), strict=True)]
        return [t / (2 * step) ** k for t in total]
