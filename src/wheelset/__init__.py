"""Hunting of a railway wheelset: a model, its bifurcations, and a book that computes itself.

The package has two wings that never import each other: `wheelset.vehicle` holds the
physics, `wheelset.bifurcation` the mathematics. `wheelset.hunting` is the door between them.
"""

__version__ = "0.1.0"
