"""What the parameters of all studies have in common."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from wheelset.vehicle import Vehicle, load_vehicle
from wheelset.vehicle.statements import Overrides

#: quick: coarse grids, for a look and for tests; paper: the resolution of the book.
Resolution = Literal["quick", "paper"]


def _loadable(name: str) -> str:
    load_vehicle(name)
    return name


#: A packaged vehicle or the path of a vehicle file; refused, with all that is wrong, if unreadable.
VehicleName = Annotated[str, AfterValidator(_loadable)]

#: A speed in m/s that a railway vehicle can be asked about.
Speed = Annotated[float, Field(gt=0.0, le=1000.0)]


class StudyParameters(BaseModel):
    """Parameters of a study: unknown names are refused, values are in SI units."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    resolution: Resolution = Field(
        default="paper", description="Fineness of grids: quick (coarse) or paper."
    )
    changes: str = Field(
        default="",
        description=(
            'Changes to the vehicles of the page, as "a1=0.25, flange_law=reciprocal": values in '
            "SI units, or with a unit after the number."
        ),
    )

    @model_validator(mode="after")
    def _changes_fit_the_vehicles(self) -> Self:
        for name in type(self).model_fields:
            if name.startswith("vehicle"):
                self.load(getattr(self, name))
        return self

    def load(self, vehicle: str, given: Overrides = (), rows: Overrides = ()) -> Vehicle:
        """A vehicle with what the study gives it, then the reader's changes, then what makes it the
        row of a table: the later wins. VehicleError with all that is wrong.
        """
        changes = [text for text in self.changes.split(",") if text.strip()]
        return load_vehicle(vehicle, given).with_overrides(changes).with_overrides(rows)


class WindowParameters(StudyParameters):
    """Parameters of a study that looks for instabilities between two speeds."""

    v_min: Speed = Field(
        default=10.0, description="Lower end of the speed window, m/s; 0 < v_min < v_max."
    )
    v_max: Speed = Field(
        default=200.0, description="Upper end of the speed window, m/s; v_min < v_max <= 1000."
    )

    @model_validator(mode="after")
    def _window_is_ordered(self) -> Self:
        if self.v_min >= self.v_max:
            raise ValueError(
                f"v_min = {self.v_min:g} m/s must be below v_max = {self.v_max:g} m/s; "
                "lower v_min or raise v_max"
            )
        return self

    @property
    def window(self) -> tuple[float, float]:
        """(v_min, v_max) in m/s."""
        return self.v_min, self.v_max


class CaseParameters(WindowParameters):
    """Parameters of a study of section 3's two cases."""

    vehicle_case_1: VehicleName = Field(
        default="guo2021_case1",
        description="Vehicle of case 1 (supercritical): packaged name or path of a file.",
    )
    vehicle_case_2: VehicleName = Field(
        default="guo2021_case2",
        description="Vehicle of case 2 (subcritical): packaged name or path of a file.",
    )

    @property
    def cases(self) -> dict[int, str]:
        """Vehicle by case number of the paper."""
        return {1: self.vehicle_case_1, 2: self.vehicle_case_2}
