"""Everything wrong with a vehicle, said at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches


class VehicleError(ValueError):
    """A vehicle cannot be made; ``problems`` holds one sentence for each reason."""

    def __init__(self, problems: Iterable[str], where: str = "") -> None:
        """``where`` names the file or vehicle that the problems belong to."""
        self.problems = tuple(problems)
        self.where = where
        super().__init__(self.problems, where)

    def __str__(self) -> str:
        """One line for one problem, a list for several."""
        prefix = f"{self.where}: " if self.where else ""
        if len(self.problems) == 1:
            return prefix + self.problems[0]
        lines = "".join(f"\n  - {problem}" for problem in self.problems)
        return f"{prefix}{len(self.problems)} problems{lines}"


class Problems:
    """Collects problems, so that a reader sees all of them and not only the first."""

    def __init__(self) -> None:
        """Start with none."""
        self.found: list[str] = []

    def add(self, *problems: str) -> None:
        """Note one or more problems, leaving out repetitions."""
        self.found.extend(problem for problem in problems if problem not in self.found)

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note the problems of a VehicleError raised inside and go on."""
        try:
            yield
        except VehicleError as error:
            self.add(*error.problems)

    def raise_any(self, where: str = "") -> None:
        """Raise VehicleError if there is any problem."""
        if self.found:
            raise VehicleError(self.found, where)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """A hint such as `` (did you mean "Kpx"?)``, or the empty string."""
    by_folded = {name.casefold(): name for name in known}
    close = get_close_matches(word.casefold(), by_folded, n=1)
    return f' (did you mean "{by_folded[close[0]]}"?)' if close else ""
