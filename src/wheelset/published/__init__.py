"""What the paper prints, and how near a computed number comes to it.

Guo, Shi, Luo, Zeng: Bifurcation analysis of a railway wheelset with nonlinear wheel-rail contact,
Nonlinear Dynamics 104 (2021) 989-1005.
"""
