"""Wheel and rail profiles: formulas and files, contact, equivalent conicity, fits for the model."""

from wheelset.profiles.catalogue import packaged, packaged_profiles
from wheelset.profiles.conicity import conicity_table, equivalent_conicity
from wheelset.profiles.contact import Contact, contact_geometry
from wheelset.profiles.errors import ContactOutcome, ProfileError, ProfileFileError
from wheelset.profiles.geometry import PolynomialFit, SineFit, SplineGeometry
from wheelset.profiles.measured import load_profile, profile_from_points, read_profile
from wheelset.profiles.profile import Profile
from wheelset.profiles.setup import EN_15302, EN_15302_GRID, Setup

__all__ = [
    "EN_15302",
    "EN_15302_GRID",
    "Contact",
    "ContactOutcome",
    "PolynomialFit",
    "Profile",
    "ProfileError",
    "ProfileFileError",
    "Setup",
    "SineFit",
    "SplineGeometry",
    "conicity_table",
    "contact_geometry",
    "equivalent_conicity",
    "load_profile",
    "packaged",
    "packaged_profiles",
    "profile_from_points",
    "read_profile",
]
