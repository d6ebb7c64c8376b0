"""`python -m wheelset` is the console script `wheelset`."""

from wheelset.cli import app

if __name__ == "__main__":
    app()
