"""One module a section of the paper: validated parameters in, tables out; SI units throughout."""
