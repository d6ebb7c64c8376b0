"""Compiled kernels for f and its derivatives at many points."""
