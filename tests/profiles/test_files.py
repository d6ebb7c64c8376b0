"""Files: what is read as it is, what is repaired and said, what is refused and why."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.profiles import ProfileError, ProfileFileError, load_profile, packaged, read_profile
from wheelset.profiles.points import Points
from wheelset.profiles.repair import repaired

WHEEL = packaged("S1002")
Y = np.arange(-69.5, 60.0, 0.5)
Z = WHEEL.z(Y * 1e-3) * 1e3
RNG = np.random.default_rng(7)


def text(y=Y, z=Z, form="{:.5f},{:.5f}"):
    return "".join(form.format(a, b) + "\n" for a, b in zip(y, z, strict=True))


def written(folder, content, name="wheel.csv"):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
    return path


def is_the_wheel(profile, within=2e-6):
    """Where it was read: between the flange's root and the field side."""
    y = np.linspace(-25, 50, 151) * 1e-3
    y = y[(y > profile.domain[0]) & (y < profile.domain[1])]
    return abs(profile.z(y) - WHEEL.z(y)).max() < within


def with_spike():
    z = Z.copy()
    z[150] += 0.4
    return text(z=z)


def with_nan():
    z = Z.copy()
    z[[40, 41]] = np.nan
    return text(z=z)


def without(low, high):
    kept = abs(Y - (low + high) / 2) > (high - low) / 2
    return text(Y[kept], Z[kept])


def shuffled():
    order = RNG.permutation(len(Y))
    return text(Y[order], Z[order])


def miniprof(count):
    head = f"ProgramName=MiniProf\nColumnDef=X,Y,A,C,N\nXYPoints={count}\nSide=Left\n\n"
    rows = (f"{-(a + 70):.5f}\t{-b:.5f}\t0.1\t0.002\t{k}\n" for k, (a, b) in enumerate(zip(Y, Z)))  # noqa: B905
    return head + "".join(rows)


READ = {
    "plain": (text(), ""),
    "with a header": ("y [mm], z [mm]\n" + text(), ""),
    "with comments": ("# Höhe\n".encode("latin-1") + text().encode(), ""),
    "windows": (text().replace("\n", "\r\n"), ""),
    "tabs": (text(form="{:.5f}\t{:.5f}"), ""),
    "spaces": (text(form="  {:.5f}   {:.5f}"), ""),
    "decimal commas and semicolons": (
        text(form="{:.5f};{:.5f}").replace(".", ","),
        "decimal commas",
    ),
    "decimal commas and tabs": (text(form="{:.5f}\t{:.5f}").replace(".", ","), "decimal commas"),
    "decimal commas and commas": (text().replace(".", ","), "decimal commas"),
    "decimal commas after whole numbers": (
        "-70;9,6\n-69;14\n" + text(Y[2:], Z[2:], "{:.5f};{:.5f}").replace(".", ","),
        "decimal commas",
    ),
    "a unit in words": ("# measured 5 m away, y and z in mm\n" + text(), ""),
    "numbered points": (
        "".join(f"{k},{a:.5f},{b:.5f}\n" for k, (a, b) in enumerate(zip(Y, Z), 1)),  # noqa: B905
        "columns 2 and 3",
    ),
    "in metres": (text(Y * 1e-3, Z * 1e-3, "{:.8f},{:.8f}"), "read in m: as its width says"),
    "in micrometres by its header": ("y_um;z_um\n" + text(Y * 1e3, Z * 1e3), "as the file says"),
    "reversed": (text(Y[::-1], Z[::-1]), "from outside to inside: reversed"),
    "mirrored": (text(-Y), "mirrored: the flange was at positive y"),
    "upside down": (text(z=-Z), "z turned to point down"),
    "shuffled": (shuffled(), "out of order: sorted"),
    "with a spike": (with_spike(), "1 outliers removed, up to 0.400 mm off, at y = 5.50 mm"),
    "with NaN": (with_nan(), "2 points that are not numbers (NaN) left out: lines 41, 42"),
    "with duplicates": (text(np.repeat(Y, 2), np.repeat(Z, 2)), "points of equal y merged"),
    "with a gap": (without(-5, -1), "1 gaps bridged, up to 5.0 mm at y = -5.5 mm"),
    "cut in its last line": (text()[:-10], "cut short"),
    "from the wheel's back": (text(Y + 70, Z - 3), "moved by -70 mm"),
    "moved": (text(Y + 31.2), "the flange's tip put 55 mm from the taping point"),
    "with its back face": (
        text(np.r_[[-70.0] * 40, Y] + 4.0, np.r_[np.linspace(-10, 9.5, 40), Z]),
        "moved by -4.000 mm: the back face is 70 mm",
    ),
    "without the flange's tip": (text(Y[Y > -42], Z[Y > -42]), "the file's origin is kept"),
}


@pytest.mark.parametrize("case", READ)
def test_it_is_read_and_what_was_done_is_said(case, tmp_path):
    content, note = READ[case]
    profile = read_profile(written(tmp_path, content), "wheel", smoothing="none")
    assert note in "; ".join(profile.notes)
    # a bridged gap and a tip placed by its shape are as good as they say
    assert is_the_wheel(profile, {"with a gap": 3e-5, "moved": 1e-4}.get(case, 2e-6))


REFUSED = {
    "empty": (b"", r"wheel.csv: is empty; two columns"),
    "one column": (text(form="{1:.4f}"), r"wheel.csv, line 1: holds one column"),
    "binary": (bytes(range(256)) * 8, r"is binary; export it as text"),
    "words": ("y,z\nhello\n", r"holds no numbers"),
    "a word among numbers": (
        text(Y[:30], Z[:30]) + "x,1\n" + text(Y[30:], Z[30:]),
        r"line 31: \"x,1\"",
    ),
    "mostly NaN": (
        text(z=np.where(np.arange(len(Z)) % 3, Z, np.nan)),
        r"line 1: \d+ of \d+ points",
    ),
    "truncated": (text()[:150], r"holds \d+ points, a profile needs 20; is the file truncated"),
    "truncated before the tread": (text()[:1800], r"the taping point is not on the profile"),
    "a hole": (without(-5, 20), r"a hole of 26.0 mm at y = -5.5 mm"),
    "no flange": (text(Y[Y > -15], Z[Y > -15]), r"no flange: .* measure up to the flange"),
    "a strange width": (text(Y / 20, Z / 20), r"neither in mm nor in m; state the unit"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_it_is_refused_with_file_reason_and_remedy(case, tmp_path):
    content, said = REFUSED[case]
    with pytest.raises(ProfileFileError, match=said) as caught:
        read_profile(written(tmp_path, content), "wheel")
    assert caught.value.path.name == "wheel.csv"
    assert caught.value.remedy


def test_miniprof_names_its_columns_side_and_count(tmp_path):
    profile = read_profile(written(tmp_path, miniprof(len(Y)), "a.whl"))
    assert (profile.kind, profile.side) == ("wheel", "left")
    assert is_the_wheel(profile)
    short = read_profile(written(tmp_path, miniprof(999), "b.mpt"), "wheel")
    assert "announces 999 points" in "; ".join(short.notes)


def test_a_stated_unit_and_origin_are_believed(tmp_path):
    path = written(tmp_path, text((Y + 12) / 25.4, Z / 25.4, "{:.7f},{:.7f}"))
    assert is_the_wheel(read_profile(path, "wheel", unit="in", origin=0.012))
    with pytest.raises(ValueError, match='unknown unit "ell"'):
        read_profile(path, "wheel", unit="ell")


@pytest.mark.parametrize("deeper", [False, True])
def test_a_rail_is_turned_and_its_top_found(deeper, tmp_path):
    rail = packaged("60E1")
    y = np.arange(-37.0, 37.0, 0.25)
    z = rail.z(y * 1e-3) * 1e3
    kept = y < 35.5 if deeper else abs(y) < 37
    path = written(tmp_path, text(-y[kept], 5 - z[kept]), "rail.ban")
    profile = read_profile(path)
    notes = "; ".join(profile.notes)
    assert "z turned to point down" in notes and "z set to 0 at the top" in notes
    assert ("mirrored: the gauge side" in notes) == deeper
    at = np.linspace(-0.03, 0.03, 61)
    assert profile.z(at) == pytest.approx(rail.z(at), abs=2e-6)


def test_an_overhang_is_cut_off():
    y = np.concatenate([[-34.0, -35.0, -36.5], np.arange(-37.0, 37.0, 0.25)]) * 1e-3
    z = packaged("60E1").z(y)
    z[:3] = [0.045, 0.042, 0.040]
    points = repaired(Points("rail", y, z))
    assert points.y[0] == pytest.approx(-0.037)
    assert "overhang" in "; ".join(points.notes)


@pytest.mark.parametrize("name", ["LMA", "S1002", "60E1", "EN15302-A"])
@pytest.mark.parametrize("spacing", [1e-4, 5e-4])
def test_smooth_points_hold_no_outliers(name, spacing):
    profile = packaged(name)
    y, z = profile.points(spacing)
    z = z + 5e-6 * np.random.default_rng(1).standard_normal(len(z))
    assert not any("outliers" in note for note in repaired(Points(profile.kind, y, z)).notes)


def test_names_files_and_nonsense(tmp_path):
    assert load_profile("LMA", "wheel").name == "LMA"
    assert load_profile(written(tmp_path, text()), "wheel").name == "wheel.csv"
    with pytest.raises(ProfileError, match="60E1 is a rail"):
        load_profile("60E1", "wheel")
    with pytest.raises(ProfileFileError, match="cannot be read"):
        load_profile(tmp_path / "nowhere.csv", "wheel")
    with pytest.raises(ProfileError, match="wheel or rail"):
        read_profile(written(tmp_path, text()))
