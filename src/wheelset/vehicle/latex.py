r"""LaTeX of the model's equations, written from the very objects that are computed.

Names become the paper's letters: ``xi_x`` is \xi_{x,s} for a wheel of side s and \xi_{x,\mathrm{l}}
for the left one; a dot is a time derivative.
"""

from __future__ import annotations

import sympy as sp
from sympy.printing.latex import LatexPrinter

from wheelset.vehicle.equations import Equation
from wheelset.vehicle.flange import region
from wheelset.vehicle.parameters import BY_NAME
from wheelset.vehicle.symbols import STATE

_STATE = {
    "y": "y", "psi": r"\psi", "yd": r"\dot y", "psid": r"\dot\psi", "v": "v", "s": "s",
    "ydd": r"\ddot y", "psidd": r"\ddot\psi",
}  # fmt: skip

#: Quantities of the wheelset.
_BODY = {
    "phi": r"\varphi", "Fyc": r"F_{y\mathrm{c}}", "Mzc": r"M_{z\mathrm{c}}",
    "Ft": r"F_\mathrm{t}", region.name: r"\chi",
}  # fmt: skip

#: Quantities of a wheel: base, subscript, superscript; the side joins the subscript.
_WHEEL = {
    "dr": (r"\Delta r", "", ""), "delta": (r"\delta", "", ""), "rho": (r"\rho", "", ""),
    "r": ("r", "", ""), "gamma": (r"\gamma", "", ""),
    "cos_gamma": (r"\cos\gamma", "", ""), "sin_gamma": (r"\sin\gamma", "", ""),
    "A": ("A", "", ""), "B": ("B", "", ""), "k": ("k", "", ""), "N": ("N", "", ""),
    "shape": (r"\lambda", "", ""), "ab_cubed": (r"\zeta", "", ""), "ab": ("(ab)", "", ""),
    "C11": ("C", "11", ""), "C22": ("C", "22", ""), "C23": ("C", "23", ""), "C33": ("C", "33", ""),
    "f11": ("f", "11", ""), "f22": ("f", "22", ""), "f23": ("f", "23", ""), "f33": ("f", "33", ""),
    "xi_x": (r"\xi", "x", ""), "xi_y": (r"\xi", "y", ""), "xi_s": (r"\xi", r"\mathrm{sp}", ""),
    "Fx_linear": ("F", "x", r"\mathrm{lin}"), "Fy_linear": ("F", "y", r"\mathrm{lin}"),
    "Mz_linear": ("M", "z", r"\mathrm{lin}"),
    "u_squared": ("u", "", "2"), "saturation": (r"\varepsilon", "", ""),
    "Fx": ("F", "x", "'"), "Fy": ("F", "y", "'"), "Mz": ("M", "z", "'"),
    "Fyn": ("F", r"y\mathrm{n}", ""),
    "Fx_track": ("F", "x", "''"), "Fy_track": ("F", "y", "''"), "Mz_track": ("M", "z", "''"),
}  # fmt: skip

_SIDES = {"_left": r"\mathrm{l}", "_right": r"\mathrm{r}"}


def symbol_latex(symbol: sp.Symbol) -> str:
    """LaTeX of any symbol of the model; its plain name if it has no letter in the paper."""
    name = symbol.name
    if name in BY_NAME:
        return BY_NAME[name].latex
    plain = {**_STATE, **_BODY}
    return plain[name] if name in plain else _wheel_latex(name)


def _wheel_latex(name: str) -> str:
    for suffix, side in _SIDES.items():
        if name.endswith(suffix):
            return _with_side(name.removesuffix(suffix), side)
    return _with_side(name, "s")


def _with_side(name: str, side: str) -> str:
    if name not in _WHEEL:
        return rf"\mathrm{{{name.replace('_', ' ')}}}"
    base, below, above = _WHEEL[name]
    subscript = f"{below},{side}" if below else side
    primes = set(above) == {"'"}
    superscript = above if primes or not above else f"^{{{above}}}"
    return f"{base}{superscript}_{{{subscript}}}"


def expression_latex(expression: sp.Expr) -> str:
    """LaTeX of an expression in the model's symbols, terms in the order they are stored."""
    names = {symbol: symbol_latex(symbol) for symbol in expression.free_symbols}
    printer = _Printer({"symbol_names": names, "mul_symbol": r" \, "})
    return str(printer.doprint(expression))


def ordered_terms(expression: sp.Expr) -> list[sp.Expr]:
    """Terms of a sum by their degree in the state; among equals positive ones first, then by what
    they are divided by.
    """

    def rank(term: sp.Expr) -> tuple[int, bool, int, str]:
        powers = {x: sp.sympify(power) for x, power in term.as_powers_dict().items()}
        whole = {x: int(power) for x, power in powers.items() if power.is_Integer}
        degree = sum(power for x, power in whole.items() if x in STATE)
        under = -sum(power for power in whole.values() if power < 0)
        return degree, term.could_extract_minus_sign(), under, str(term)

    return sorted(sp.Add.make_args(expression), key=rank)


class _Printer(LatexPrinter):
    """sympy's printer, but a sum goes by rising powers of the state, its first term positive, and
    a power of a cosine keeps its bracket: (cos gamma)^n.
    """

    def _as_ordered_terms(self, expr: sp.Expr, order: object = None) -> list[sp.Expr]:
        """Terms of a sum in the order of the paper."""
        return ordered_terms(expr)

    def _print_Pow(self, expr: sp.Pow) -> str:
        named = isinstance(expr.base, sp.Symbol) and expr.base.name.startswith(("cos_", "sin_"))
        if named and expr.exp.is_Symbol:
            base, exponent = self._print(expr.base), self._print(expr.exp)
            return rf"\left({base}\right)^{{{exponent}}}"
        return str(super()._print_Pow(expr))


def equation_latex(equation: Equation) -> str:
    r"""``symbol = expression`` of an equation, tagged with its number in the paper."""
    body = _display(symbol_latex(equation.symbol), equation.expression)
    # Sphinx puts a display with a double backslash into a split, where no tag may stand: use cr.
    one_line = body.replace(r"\\", r"\cr ")
    return rf"{one_line} \tag{{{equation.number}}}" if equation.number else one_line


#: Sums of more terms than the first number are broken into lines of the second.
_TERMS_AT_MOST, _TERMS_A_LINE = 5, 4


def _display(name: str, expression: sp.Expr) -> str:
    """``name = expression``, a long sum on several lines."""
    terms = ordered_terms(expression)
    if len(terms) <= _TERMS_AT_MOST:
        return f"{name} = {expression_latex(expression)}"
    rows = [sp.Add(*terms[i : i + _TERMS_A_LINE]) for i in range(0, len(terms), _TERMS_A_LINE)]
    lines = [expression_latex(row).strip() for row in rows]
    signed = [line if line.startswith("-") else f"+ {line}" for line in lines[1:]]
    body = r" \cr & \quad ".join([lines[0], *signed])
    return rf"\begin{{aligned}} {name} = {{}}& {body} \end{{aligned}}"
