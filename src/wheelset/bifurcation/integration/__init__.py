"""Time integration with events, corners and settling."""
