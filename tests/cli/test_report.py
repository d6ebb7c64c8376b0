"""The command report: one page that stands alone, with what was read, found, and not found."""

from __future__ import annotations

import base64
import re
from functools import cache
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from wheelset.bifurcation.equilibria.hopf import instabilities
from wheelset.cli import app
from wheelset.hunting import hunting_system
from wheelset.profiles import SplineGeometry, packaged
from wheelset.studies.on_profiles import reach_of, searched
from wheelset.vehicle import load_vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

VOID = {"meta", "img"}
NAMED = ("--wheel", "LMB10", "--rail", "CHN60", "--vehicle", "guo2021_physical")


class Document(HTMLParser):
    """Checks that tags close in order; keeps the words, images and links."""

    def __init__(self, text):
        super().__init__()
        self.open, self.words, self.images, self.links = [], "", [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag == "img":
            self.images.append(given)
        self.links += [given[key] for key in ("href", "src") if key in given]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "style" not in self.open:
            self.words += data


def run(*arguments):
    return CliRunner().invoke(app, ["report", *map(str, arguments)])


def checked(path):
    """The page as any report has to be."""
    page = Document(path.read_text("utf-8"))
    assert all(link.startswith("data:image/svg+xml;base64,") for link in page.links)
    assert all(image["alt"].strip() for image in page.images)
    for image in page.images:
        assert "</svg>" in base64.b64decode(image["src"].split(",")[1]).decode("utf-8")
    assert not re.search(r"\b(nan|inf|None)\b", page.words)
    assert not list(path.parent.glob("*.part"))
    return page


@cache
def made(folder, *arguments):
    result = run(*arguments, "-o", folder / "report.html", "--csv", folder / "tables")
    return result, checked(folder / "report.html")


@pytest.fixture(scope="module")
def named(tmp_path_factory):
    folder = tmp_path_factory.mktemp("named")
    return folder, *made(folder, *NAMED)


def test_speeds_are_those_of_the_model_with_these_contacts(named):
    folder, result, page = named
    assert result.exit_code == 0
    vehicle = load_vehicle("guo2021_physical")
    contact = searched(packaged("LMB10"), packaged("CHN60"), vehicle)
    geometry = SplineGeometry.of(contact, reach_of(contact), 5e-4)
    system = hunting_system(vehicle, ExpandedGeometry(geometry.functions, geometry.reach))
    (hopf,) = instabilities(system, "v", (10.0, 200.0))
    row = pd.read_csv(folder / "tables/speeds.csv").set_index("width").loc[5e-4]
    assert row["v_lin"] == pytest.approx(hopf.value, rel=1e-9)
    assert f"{hopf.value:.2f}" in page.words
    assert f"{hopf.value * 3.6:.1f}" in page.words
    assert row["v_non"] < row["v_lin"]


def test_the_page_tells_what_was_read_and_assumed(named):
    _, _, page = named
    assert "wheelset report --wheel LMB10 --rail CHN60 --vehicle guo2021_physical" in page.words
    assert "gauge 1435" in page.words
    assert "assumed" in page.words
    assert "Young's modulus" in page.words
    assert len(page.images) == 5


def test_jumps_and_the_width_are_named(named):
    folder, _, page = named
    assert "contact jumps from" in page.words
    widths = pd.read_csv(folder / "tables/speeds.csv")["width"]
    assert widths.tolist() == pytest.approx([3e-4, 5e-4, 1e-3])
    assert "First Lyapunov coefficient" in page.words


def test_tables_have_all_the_numbers(named):
    folder, _, _ = named
    contact, cycles, conicity = (
        pd.read_csv(folder / "tables" / f"{n}.csv") for n in ("contact", "cycles", "conicity")
    )
    assert np.isfinite(contact[["r_left", "delta_left", "rho_left"]]).all(axis=None)
    assert set(cycles["width"].round(7)) == {3e-4, 5e-4, 1e-3}
    assert conicity["integration"].between(0.0, 1.0).all()


@pytest.mark.slow
def test_a_measured_wheel_and_another_vehicle(tmp_path):
    y, z = packaged("S1002").points(2e-4)
    noisy = z + np.random.default_rng(3).normal(0, 2e-6, len(z))
    noisy[200] += 5e-4
    rows = "".join(f"{-a:.5f}\t{-b:.5f}\n" for a, b in zip(y * 1e3, noisy * 1e3, strict=True))
    head = f"ProgramName=MiniProf\nColumnDef=X,Y\nXYPoints={len(y)}\n\n"
    wheel = tmp_path / "mywheel.mpt"
    wheel.write_text(head + rows)
    page_at = tmp_path / "page.html"
    result = run(
        "--wheel", wheel, "--rail", "60E1", "--vehicle", "guo2021", "--set", "Kpx=2e6",
        "--v-max", 400, "-o", page_at,
    )  # fmt: skip
    assert result.exit_code == 0
    page = checked(page_at)
    assert "outliers removed" in page.words
    assert "smoothed by GCV" in page.words
    assert "user" in page.words
    assert "Linear critical speed" in page.words


@pytest.mark.slow
def test_different_wheels_rest_off_the_middle(tmp_path):
    page_at = tmp_path / "page.html"
    result = run(*NAMED, "--wheel-right", "LMA", "-o", page_at)
    assert result.exit_code == 0
    page = checked(page_at)
    # the larger rolling radius of two unequal wheels pulls towards the other side
    shift = re.search(r"does not rest in the middle but ([\d.]+) mm to the (\w+)", page.words)
    vehicle = load_vehicle("guo2021_physical")
    contact = searched(packaged("LMB10"), packaged("CHN60"), vehicle)
    assert shift
    assert 1.0 < float(shift[1]) < -contact.y[0] * 1e3
    assert "Linear critical speed" in page.words


def test_what_is_not_found_is_a_named_outcome(tmp_path):
    page_at = tmp_path / "page.html"
    result = run(*NAMED, "--v-max", 40, "-o", page_at)
    assert result.exit_code == 0
    page = checked(page_at)
    assert "No Hopf point between 10 and 40 m/s: straight running is stable" in page.words
    assert "No cycles" in page.words


def test_a_gauge_without_contact_is_told_in_a_page(tmp_path):
    page_at = tmp_path / "page.html"
    result = run(*NAMED, "--gauge", 1650, "-o", page_at)
    assert result.exit_code == 1
    assert "Nothing could be computed" in checked(page_at).words
    assert "Traceback" not in result.output


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"--wheel": "LMB11"}, "unknown profile"),
        ({"--rail": "LMB10"}, "a rail is wanted"),
        ({"--vehicle": "nobody"}, "nobody"),
        ({"--width": "9"}, "between 0.1 and 2 mm"),
        ({"--v-max": "5"}, "below the second"),
        ({"--amplitudes": "x"}, "--amplitudes"),
        ({"--cant": "steep"}, "--cant"),
        ({"--set": "a9=1"}, "a9"),
    ],
)
def test_wrong_input_is_refused_before_anything_is_written(tmp_path, changed, said):
    page_at = tmp_path / "page.html"
    options = {**dict(zip(NAMED[::2], NAMED[1::2], strict=True)), **changed}
    result = run(*(word for pair in options.items() for word in pair), "-o", page_at)
    assert result.exit_code == 2
    assert said in result.stderr
    assert not page_at.exists()


def test_a_bad_file_is_named_with_its_line(tmp_path):
    wheel = tmp_path / "bad.csv"
    wheel.write_text("0,1\n1,2\nthree,4\n2,x\n3,1\n" + "4,1,2\n" * 3)
    result = run("--wheel", wheel, *NAMED[2:], "-o", tmp_path / "page.html")
    assert result.exit_code == 2
    assert "bad.csv, line" in result.stderr
