"""Limit cycles: collocation, multipliers, bifurcations, normal forms, curves."""
