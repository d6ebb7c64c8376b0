"""The physics: vehicles as data, and the symbolic model of a wheelset.

Loading a vehicle needs neither sympy nor numba; the equations are imported from their module.
"""

from wheelset.vehicle.documents import vehicle_names
from wheelset.vehicle.loading import load_vehicle
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.problems import VehicleError
from wheelset.vehicle.quantity import Quantity
from wheelset.vehicle.vehicle import Vehicle

__all__ = [
    "ModelOptions",
    "Quantity",
    "Vehicle",
    "VehicleError",
    "load_vehicle",
    "vehicle_names",
]
