"""Data that travels with the package: vehicles, worn profiles."""
