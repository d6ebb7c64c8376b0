"""The command ``wear``: what it writes, how it resumes, what it refuses."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from wheelset.cli import app
from wheelset.wear import ContactLost

SMALL = ("wear", "LMB10", "CHN60", "--law", "usfd", "--mileages", "0.2,0.5", "--conditions", "8")


def run(*arguments):
    return CliRunner().invoke(app, list(arguments))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("worn") / "new"
    result = run(*SMALL, "--out", str(path))
    assert result.exit_code == 0, result.output
    assert "wrote 4 files" in result.stderr
    assert "calibrated: the law times" in result.stdout
    return path


def test_profiles_go_into_the_conicity(folder):
    arguments = ("CHN60", "--amplitudes", "3", "--json")
    found = json.loads(run("conicity", str(folder / "LMB10@0.5-usfd.csv"), *arguments).stdout)
    expected = pd.read_csv(folder / "history.csv", index_col=0).loc[0.5, "conicity_3mm"]
    assert found["conicity"][0]["integration"] == pytest.approx(expected, abs=5e-4)


def test_the_history_and_the_depths_are_written(folder):
    history = pd.read_csv(folder / "history.csv", index_col=0)
    assert history.index.tolist() == [0.2, 0.5]
    assert history["greatest_depth_mm"].iloc[-1] == pytest.approx(0.0275, rel=1e-6)
    depths = pd.read_csv(folder / "depths.csv", comment="#", index_col=0)
    assert depths.max().tolist() == pytest.approx(history["greatest_depth_mm"].tolist(), abs=1e-8)
    profile = np.loadtxt(folder / "LMB10@0.2-usfd.csv", delimiter=",", skiprows=2)
    assert profile.shape[1] == 2


def test_a_second_run_resumes_and_changes_nothing(folder):
    before = {path.name: path.read_bytes() for path in folder.glob("*.csv")}
    states = {path: path.stat().st_mtime_ns for path in folder.glob("run/*.npz")}
    assert run(*SMALL, "--out", str(folder)).exit_code == 0
    assert {path.name: path.read_bytes() for path in folder.glob("*.csv")} == before
    assert {path: path.stat().st_mtime_ns for path in folder.glob("run/*.npz")} == states


def test_another_simulation_does_not_go_into_the_folder(folder):
    result = run(*SMALL, "--out", str(folder), "--seed", "5")
    assert result.exit_code == 2
    assert "seed is 1 there and 5 here" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--law", "archard"), 'law "archard" is unknown; choose one of archard_kth'),
        (("--mileages", "much"), "--mileages"),
        (("--mileages", "2,1"), "ascending"),
        (("--rate", "55"), "field rate = 55 is out of range"),
        (("--conditions", "100"), "no power of two"),
        (("--smoothing", "0.01"), "smoothing"),
    ],
)
def test_wrong_input_is_one_clear_message_and_exit_code_2(tmp_path, arguments, said):
    result = run("wear", "LMB10", "CHN60", "--out", str(tmp_path), *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


def test_an_outcome_is_exit_code_1(tmp_path, monkeypatch):
    def lost(*_):
        raise ContactLost(0.3, "the contact of the left wheel reaches the end")
        yield

    monkeypatch.setattr("wheelset.wear.evolve", lost)
    result = run(*SMALL, "--out", str(tmp_path))
    assert result.exit_code == 1
    assert "30.0% of the distance" in result.stderr
