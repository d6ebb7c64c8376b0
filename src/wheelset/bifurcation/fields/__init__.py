"""The right-hand side f(x, p) as symbols and as a tape, with derivatives of any order."""
