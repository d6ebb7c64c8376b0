"""Equilibria, Hopf points and curves, Lyapunov coefficients."""
