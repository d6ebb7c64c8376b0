"""Numerical bifurcation of x' = f(x, p); knows nothing of wheels."""
