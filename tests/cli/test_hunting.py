"""The command line over the physics: what a user types, sees and can parse."""

from __future__ import annotations

import json

import pandas as pd
import pytest
from typer.testing import CliRunner

from wheelset.cli import app


def run(*arguments):
    return CliRunner().invoke(app, list(arguments))


def test_vehicles_lists_every_packaged_one():
    result = run("vehicles")
    assert result.exit_code == 0
    assert "guo2021_physical" in result.stdout


def test_a_vehicle_in_full_names_units_and_sources():
    record = json.loads(run("vehicles", "guo2021", "--set", "a1=0.3", "--json").stdout)
    a1 = next(row for row in record["quantities"] if row["name"] == "a1")
    assert (a1["value"], a1["status"]) == (0.3, "user")
    assert record["options"]["contact_angle_sign"] == "reversed"
    assert "Table 1" in run("vehicles", "guo2021").stdout


def test_hopf_prints_speed_coefficient_and_words():
    result = run("hopf", "guo2021")
    assert result.exit_code == 0
    assert "51.7061" in result.stdout
    assert "-23.2553" in result.stdout
    assert "supercritical" in result.stdout


def test_hopf_as_json_has_full_precision():
    (point,) = json.loads(run("hopf", "guo2021", "--set", "a3=200", "--json").stdout)
    assert point["kind"] == "H+"
    assert point["speed"] == pytest.approx(51.70606841, abs=5e-9)
    assert point["lyapunov"] == pytest.approx(7.405071, abs=5e-7)


def test_hopf_says_so_when_nothing_happens_in_the_window():
    result = run("hopf", "guo2021", "--v-max", "40")
    assert result.exit_code == 0
    assert "no change of stability between 5 and 40 m/s" in result.stdout


def test_a_users_own_file_works_where_a_name_does(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text('title = "mine"\nextends = "guo2021"\n[suspension]\nKpx = "2 MN/m"\n')
    (point,) = json.loads(run("hopf", str(file), "--json").stdout)
    assert point["speed"] > 60


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("hopf", "guo2020"), "unknown vehicle"),
        (("hopf", "guo2021", "--set", "mw=-3"), "mw"),
        (("hopf", "guo2021", "--v-min", "50", "--v-max", "40"), "window"),
        (("simulate", "guo2021", "--speed", "40", "--method", "Euler"), "Euler"),
    ],
)
def test_wrong_input_is_one_clear_message_and_exit_code_2(arguments, said):
    result = run(*arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


def test_simulate_reports_flange_contacts_and_writes_the_motion(tmp_path):
    file = tmp_path / "motion.csv"
    result = run(
        "simulate", "guo2021", "--speed", "40", "--y0", "0.010", "--duration", "1",
        "--set", "flange_law=exponential", "--csv", str(file), "--json",
    )  # fmt: skip
    record = json.loads(result.stdout)
    assert record["outcome"] == "reached the end"
    assert "flange contact left" in [event["what"] for event in record["events"]]
    frame = pd.read_csv(file)
    assert list(frame.columns) == ["t", "y", "psi", "yd", "psid"]
    assert frame["y"].iloc[0] == 0.010
    assert not list(tmp_path.glob("*.part"))


def test_simulate_shows_how_it_ended():
    result = run("simulate", "guo2021", "--speed", "40", "--y0", "0.003", "--duration", "0.5")
    assert "reached the end" in result.stdout


def test_leaving_the_domain_is_exit_code_1_and_names_the_quantity():
    result = run("simulate", "guo2021", "--speed", "40", "--y0", "0.0125", "--json")
    assert result.exit_code == 1
    record = json.loads(result.stdout)
    assert record["outcome"] == "domain left"
    assert "sum of curvatures (B of Eq. 5), right wheel" in record["words"]


def test_help_names_every_command():
    result = run("--help")
    assert all(name in result.stdout for name in ("vehicles", "hopf", "simulate", "run", "book"))
