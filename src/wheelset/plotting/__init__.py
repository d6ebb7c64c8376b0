"""Drawing: tables in SI units go in, figures come out; nothing is computed here.

Millimetres, kilonewtons and km/h appear only on the axes.
"""
