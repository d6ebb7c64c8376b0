"""exp, log, sin, cos and powers on lanes, from their series.

Every argument is reduced to an interval on which a Taylor polynomial is exact, to within about
one unit in the last place; a power passes through a logarithm of twice that precision. Infinite
and undefined values come out as they do in the C library.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from wheelset.bifurcation.compiled.lanes import Lanes

# Added to a double below 2^51, it leaves the nearest integer in the last bits of the sum.
_SHIFT = 1.5 * 2.0**52
_SHIFT_BITS = 0x4338000000000000
# log 2 and pi / 2 as sums of doubles; of log 2, the first has 21 trailing zeros.
_LOG2 = (float.fromhex("0x1.62e42feep-1"), float.fromhex("0x1.a39ef35793c76p-33"))
_QUARTER = (
    float.fromhex("0x1.921fb54442d18p+0"),
    float.fromhex("0x1.1a62633145c07p-54"),
    float.fromhex("-0x1.f1976b7ed8fbcp-110"),
)
_ROOT_HALF_BITS = 0x3FE6A09E667F3BCD
# Coefficients of the tails of the series, whose first terms are added apart.
_EXP = [1 / math.factorial(j) for j in range(2, 14)]
_LOG = [2 / (2 * j + 3) for j in range(11)]
_SIN = [(-1) ** j / math.factorial(2 * j + 1) for j in range(1, 9)]
_COS = [(-1) ** j / math.factorial(2 * j) for j in range(1, 9)]


def polynomial(e: Lanes, x: Any, coefficients: Sequence[float]) -> Any:
    """Sum of c_j x^j, halved and halved again: a chain as short as the logarithm of its length."""
    terms = [e.number(c) for c in coefficients]
    while len(terms) > 1:
        pairs = [
            e.fused(terms[j + 1], x, terms[j]) if j + 1 < len(terms) else terms[j]
            for j in range(0, len(terms), 2)
        ]
        terms, x = pairs, e.multiply(x, x)
    return terms[0]


def exp(e: Lanes, x: Any) -> Any:
    """e^x."""
    return _exp(e, x, e.number(0.0))


def _exp(e: Lanes, x: Any, small: Any) -> Any:
    """e^(x + small): x = k log 2 + r, |r| <= log 2 / 2; 2^k in two halves, for the extremes."""
    x = e.choose(e.exceeds(x, e.number(710.0)), e.number(710.0), x)
    x = e.choose(e.exceeds(e.number(-746.0), x), e.number(-746.0), x)
    shifted = e.fused(x, e.number(1 / math.log(2)), e.number(_SHIFT))
    k = e.subtract(shifted, e.number(_SHIFT))
    r = e.fused(k, e.number(-_LOG2[1]), e.fused(k, e.number(-_LOG2[0]), x))
    r = e.add(r, small)
    tail = e.fused(e.multiply(r, r), polynomial(e, r, _EXP), r)
    whole = e.builder.sub(e.bits(shifted), e.integer(_SHIFT_BITS))
    half = e.builder.ashr(whole, e.integer(1))
    scaled = e.multiply(e.add(tail, e.number(1.0)), _power_of_two(e, half))
    return e.multiply(scaled, _power_of_two(e, e.builder.sub(whole, half)))


def _power_of_two(e: Lanes, k: Any) -> Any:
    return e.pattern(e.builder.shl(e.builder.add(k, e.integer(1023)), e.integer(52)))


def log(e: Lanes, x: Any) -> Any:
    """The logarithm."""
    return _log_at_the_ends(e, x, e.add(*_log(e, x)))


def power(e: Lanes, x: Any, k: float) -> Any:
    """x^k = exp(k log x) for a k that is no integer, to the last place like the rest; nan below
    zero.
    """
    high, low = _log(e, x)
    high = _log_at_the_ends(e, x, high)
    product = e.multiply(high, e.number(k))
    rest = e.fused(high, e.number(k), e.negate(product))
    rest = e.fused(low, e.number(k), rest)
    infinite = e.exceeds(e.magnitude(product), e.number(1e3))
    return _exp(e, product, e.choose(infinite, e.number(0.0), rest))


def _log(e: Lanes, x: Any) -> tuple[Any, Any]:
    """The logarithm of a positive x as the sum of two doubles: x = 2^k m with m from 1/sqrt 2 to
    sqrt 2, and with s = (m - 1) / (m + 1), log m = 2 s + 2 s^3/3 + 2 s^5/5 + ...
    """
    k, m = _split(e, x)
    one, inverse = e.number(1.0), e.divide(e.number(1.0), e.add(m, e.number(1.0)))
    f, below = e.subtract(m, one), e.add(m, one)
    lost = e.subtract(m, e.subtract(below, one))
    s = e.multiply(f, inverse)
    rest = e.fused(e.negate(s), lost, e.fused(e.negate(s), below, f))
    square, twice = e.multiply(s, s), e.add(s, s)
    tail = e.multiply(e.multiply(square, s), polynomial(e, square, _LOG))
    tail = e.fused(e.multiply(rest, inverse), e.number(2.0), tail)
    whole = e.multiply(k, e.number(_LOG2[0]))
    high = e.add(whole, twice)
    tail = e.add(tail, e.add(e.subtract(whole, high), twice))
    return high, e.fused(k, e.number(_LOG2[1]), tail)


def _split(e: Lanes, x: Any) -> tuple[Any, Any]:
    """k and m of x = 2^k m as doubles, 1/sqrt 2 <= m < sqrt 2."""
    tiny = e.exceeds(e.number(2.0**-1022), x)
    bits = e.bits(e.choose(tiny, e.multiply(x, e.number(2.0**54)), x))
    k = e.builder.ashr(e.builder.sub(bits, e.integer(_ROOT_HALF_BITS)), e.integer(52))
    m = e.pattern(e.builder.sub(bits, e.builder.shl(k, e.integer(52))))
    shifted = e.pattern(e.builder.add(k, e.integer(_SHIFT_BITS)))
    return e.subtract(shifted, e.choose(tiny, e.number(_SHIFT + 54), e.number(_SHIFT))), m


def _log_at_the_ends(e: Lanes, x: Any, inside: Any) -> Any:
    positive, finite = e.exceeds(x, e.number(0.0)), e.exceeds(e.number(math.inf), x)
    out = e.choose(positive, e.choose(finite, inside, x), e.number(-math.inf))
    below = e.builder.fcmp_unordered("<", x, e.number(0.0))
    return e.choose(below, e.number(math.nan), out)


def sin(e: Lanes, x: Any) -> Any:
    """The sine, up to |x| = 2^50, where a double no longer tells a point of the circle."""
    return _circular(e, x, 0)


def cos(e: Lanes, x: Any) -> Any:
    """The cosine, up to |x| = 2^50."""
    return _circular(e, x, 1)


def _circular(e: Lanes, x: Any, ahead: int) -> Any:
    """sin(x + ahead pi/2): x = k pi/2 + r, |r| <= pi/4; k tells function and sign."""
    shifted = e.fused(x, e.number(2 / math.pi), e.number(_SHIFT))
    k, r = e.subtract(shifted, e.number(_SHIFT)), x
    for part in _QUARTER:
        r = e.fused(k, e.number(-part), r)
    square = e.multiply(r, r)
    odd = e.fused(e.multiply(square, r), polynomial(e, square, _SIN), r)
    even = e.fused(square, polynomial(e, square, _COS), e.number(1.0))
    quadrant = e.builder.add(e.bits(shifted), e.integer(ahead))
    swap = _bit(e, quadrant, 1)
    out = e.choose(swap, even, odd)
    out = e.choose(_bit(e, quadrant, 2), e.negate(out), out)
    far = e.exceeds(e.magnitude(x), e.number(2.0**50))
    return e.choose(far, e.number(math.nan), out)


def _bit(e: Lanes, integers: Any, bit: int) -> Any:
    return e.builder.icmp_signed("!=", e.builder.and_(integers, e.integer(bit)), e.integer(0))
