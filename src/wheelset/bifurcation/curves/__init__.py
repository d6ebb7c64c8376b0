"""Zero problems, the one continuer, branches and their files."""
