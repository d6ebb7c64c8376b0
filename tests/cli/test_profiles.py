"""The commands over profiles: what an engineer types, sees and can parse."""

from __future__ import annotations

import json

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from wheelset.cli import app
from wheelset.profiles import packaged

NAMES = ("LMB10", "LMA", "S1002", "60E1", "CHN60")
STANDARD = ("conicity", "EN15302-A", "EN15302-RailA", "--en15302")


def run(*arguments):
    return CliRunner().invoke(app, list(arguments))


@pytest.fixture
def measured(tmp_path):
    y, z = packaged("S1002").points(5e-4)
    z[100] += 1e-3
    path = tmp_path / "worn.csv"
    np.savetxt(path, np.c_[y, z], delimiter=";", fmt="%.8f")
    return path


def test_profiles_are_listed():
    result = run("profiles")
    assert result.exit_code == 0
    assert all(name in result.stdout for name in NAMES)
    records = json.loads(run("profiles", "--json").stdout)
    assert {r["kind"] for r in records} == {"wheel", "rail"}


def test_the_standards_conicity_is_printed():
    result = run(*STANDARD, "--amplitudes", "1,3,6")
    assert result.exit_code == 0
    assert "profile origins at 750 mm" in result.stdout
    assert "nonlinearity parameter" in result.stdout
    rows = json.loads(run(*STANDARD, "--amplitudes", "1,3,6", "--json").stdout)["conicity"]
    # EN 15302 prints 0.125, 0.188, 0.303
    assert [r["integration"] for r in rows] == pytest.approx([0.125, 0.188, 0.303], abs=1e-3)
    assert all(f"{r['integration']:.4f}" in result.stdout for r in rows)


def test_json_has_everything_in_si():
    record = json.loads(run("conicity", "S1002", "60E1", "--amplitudes", "2:4:1", "--json").stdout)
    assert [row["amplitude"] for row in record["conicity"]] == pytest.approx([2e-3, 3e-3, 4e-3])
    assert record["setup"]["gauge"] == 1.435
    assert {jump["side"] for jump in record["jumps"]} == {"left", "right"}
    low, high = record["conicity"][0]["integration"], record["conicity"][2]["integration"]
    assert record["nonlinearity"] == pytest.approx((high - low) / 2e-3)


def test_files_are_read_and_their_repairs_told(measured):
    result = run("conicity", str(measured), "60E1", "--unit", "m", "--amplitudes", "3")
    assert result.exit_code == 0
    assert "worn.csv: 1 outliers removed" in result.stderr
    assert "smoothed by GCV" in result.stderr
    found = json.loads(run("conicity", str(measured), "60E1", "--amplitudes", "3", "--json").stdout)
    exact = json.loads(run("conicity", "S1002", "60E1", "--amplitudes", "3", "--json").stdout)
    assert found["conicity"][0]["integration"] == pytest.approx(
        exact["conicity"][0]["integration"], abs=1e-3
    )
    assert "read in m" in " ".join(found["profiles"][0]["notes"])


def test_an_origin_that_cannot_be_found_is_stated(tmp_path):
    """Most of the flange is missing, and the file begins somewhere."""
    y, z = packaged("LMB10").points(5e-4)
    tread = y > -0.045
    path = tmp_path / "part.csv"
    np.savetxt(path, np.c_[y[tread] + 0.07, z[tread]] * 1e3, delimiter=";", fmt="%.6f")
    refused = run("conicity", str(path), "CHN60")
    assert refused.exit_code == 2
    assert "state the y of the origin" in " ".join(refused.stderr.split())
    stated = run(
        "conicity", str(path), "CHN60", "--wheel-origin", "70", "--amplitudes", "3", "--json"
    )
    whole = run("conicity", "LMB10", "CHN60", "--amplitudes", "3", "--json")
    one, other = (json.loads(r.stdout)["conicity"][0]["integration"] for r in (stated, whole))
    assert one == pytest.approx(other, abs=2e-3)


def test_results_go_to_files(tmp_path):
    table, contacts, plot = (tmp_path / name for name in ("a.csv", "b.csv", "c.svg"))
    result = run(
        *STANDARD, "--csv", str(table), "--contact-csv", str(contacts), "--plot", str(plot)
    )  # fmt: skip
    assert result.exit_code == 0
    written = pd.read_csv(table)
    assert written["amplitude_mm"].tolist() == pytest.approx(range(1, 9))
    assert written["integration"][2] == pytest.approx(0.188, abs=1e-3)
    assert len(pd.read_csv(contacts)) == 201
    assert plot.read_text("utf-8").lstrip().startswith("<?xml")


def test_different_wheels_move_the_middle():
    record = json.loads(
        run(
            "conicity", "S1002", "60E1", "--wheel-right", "LMA", "--amplitudes", "2", "--json"
        ).stdout
    )
    row = record["conicity"][0]
    assert abs(row["low"] + row["high"]) > 1e-4
    assert len(record["profiles"]) == 3


def test_options_reach_the_search():
    level = json.loads(run("conicity", "LMB10", "CHN60", "--no-roll", "--json").stdout)
    rolling = json.loads(
        run("conicity", "LMB10", "CHN60", "--cant", "0.025", "--r0-right", "460", "--json").stdout
    )
    assert not level["setup"]["roll"]
    assert level["conicity"][2]["integration"] < rolling["conicity"][2]["integration"]
    assert rolling["conicity"][2]["integration"] == pytest.approx(0.104, abs=1e-3)


def test_amplitudes_without_a_wave_are_named():
    result = run("conicity", "LMB10", "CHN60", "--amplitudes", "3,20")
    assert result.exit_code == 0
    assert "0.1037" in result.stdout
    alone = run("conicity", "LMB10", "CHN60", "--gauge", "1600", "--amplitudes", "3")
    assert alone.exit_code in (1, 2)
    assert "Traceback" not in alone.output


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("LMB11", "CHN60"), "unknown profile"),
        (("CHN60", "LMB10"), "a wheel is wanted"),
        (("nowhere.csv", "CHN60"), "cannot be read"),
        (("LMB10", "CHN60", "--gauge", "1.435"), "gauge = 0.001435"),
        (("LMB10", "CHN60", "--cant", "one"), "--cant"),
        (("LMB10", "CHN60", "--amplitudes", "3mm"), "--amplitudes"),
        (("LMB10", "CHN60", "--plot", "x.png"), "SVG"),
        (("LMB10", "CHN60", "--smooth", "much"), "--smooth"),
    ],
)
def test_wrong_input_is_one_clear_message_and_exit_code_2(arguments, said):
    result = run("conicity", *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output
