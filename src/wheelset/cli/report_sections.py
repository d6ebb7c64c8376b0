"""The sections of a report: what was read, contact, conicity, critical speeds, diagram."""

from __future__ import annotations

from typing import Any

from wheelset.cli.profile_options import distinct, named_jumps
from wheelset.cli.report_read import number, read_section
from wheelset.plotting.profiles import contact_lines, profile_panels
from wheelset.plotting.report import conicity_panel, function_panels, speed_diagram
from wheelset.plotting.style import svg
from wheelset.profiles import Contact, Profile
from wheelset.publishing.report_page import Grid, Listing, Page, Picture, Section, Words
from wheelset.studies.profile_contact import shape
from wheelset.studies.profile_report import ProfileReport, speeds_table
from wheelset.studies.profile_report_words import conclusion

#: Every so many displacements a contact's line is drawn.
LINES = 10


def page_of(heading: dict[str, Any], report: ProfileReport) -> Page:
    """The whole report."""
    sections = (
        read_section(heading),
        _shapes(report.contact),
        _geometry(report.contact),
        _conicity(report),
        _speeds(report),
        _diagram(report),
        _meaning(),
    )
    return Page(heading["title"], conclusion(report), sections, heading["made"])


def page_without_contact(heading: dict[str, Any], words: str) -> Page:
    """Where not even the centred wheelset has a contact on either rail."""
    shapes = Section("Profiles", (_profile_picture(heading["profiles"]),))
    lead = (f"Nothing could be computed: {words}.",)
    return Page(heading["title"], lead, (read_section(heading), shapes), heading["made"])


def _shapes(contact: Contact) -> Section:
    wheel, rail = contact.wheels[0], contact.setup.laid(contact.rails[0])
    frame = contact.to_frame()
    lines = contact_lines(shape(wheel), shape(rail), frame.iloc[::LINES])
    alt = (
        f"{wheel.name} above {rail.name}: lines join the places that touch on the left side as "
        f"the wheelset moves from {frame.index[0] * 1e3:.1f} to {frame.index[-1] * 1e3:.1f} mm."
    )
    caption = (
        "Where wheel and rail touch, left side; numbers: lateral displacement in mm, positive "
        "towards this rail's flange contact. The rail stands inclined as in the track."
    )
    return Section(
        "Profiles", (_profile_picture(list(distinct(contact))), Picture(svg(lines), alt, caption))
    )


def _profile_picture(profiles: list[Profile]) -> Picture:
    figure = profile_panels({p.name: shape(p) for p in profiles})
    names = ", ".join(p.name for p in profiles)
    alt = f"Height over lateral position of {names}, and the curvature of each below."
    caption = "Profiles as used, and their curvature: positive where convex, cut at 30 1/m."
    return Picture(svg(figure), alt, caption)


def _geometry(contact: Contact) -> Section:
    jumps = named_jumps(contact, "") or ["no jump of the contact in this range"]
    known = f"{contact.y[0] * 1e3:.2f} to {contact.y[-1] * 1e3:.2f} mm"
    alt = (
        f"Three panels over the lateral displacement from {known}: rolling radius, contact angle "
        f"and sum of curvatures of both wheels, with {len(contact.jumps)} jumps marked."
    )
    picture = svg(function_panels(contact.to_frame(), [jump.y for jump in contact.jumps]))
    caption = (
        "Rolling radius, contact angle and sum of the curvatures of wheel and rail, as searched; "
        "dotted lines: jumps of the contact."
    )
    ended = tuple(str(outcome) for outcome in contact.ended)
    parts = (Picture(picture, alt, caption), Listing((*jumps, *ended)))
    return Section("Contact geometry", parts)


def _conicity(report: ProfileReport) -> Section:
    rows = tuple(
        (
            number(row.amplitude, "g", 1e3),
            *(number(v, ".4f") for v in (row.integration, row.regression, row.harmonic)),
            number(row.wavelength, ".2f"),
            number(row.dr, ".3f", 1e3),
            number(row.contact_angle, ".2f"),
        )
        for row in report.conicity.rows
    )
    missing = Listing(tuple(str(outcome) for outcome in report.conicity.missing))
    if not rows:
        return Section("Equivalent conicity", (missing,))
    headings = (
        "mm", "tan γe", "regression", "harmonic", "wave m", "Δr mm", "contact angle parameter",
    )  # fmt: skip
    slope = report.conicity.nonlinearity
    words = (
        "The nonlinearity parameter needs waves of 2 and 4 mm; one of them is missing."
        if slope is None
        else f"Nonlinearity parameter, 2 to 4 mm: {number(slope, '+.4f', 1e-3)} per mm."
    )
    alt = "Equivalent conicity by amplitude, by integration and by regression; values in the table."
    picture = Picture(svg(conicity_panel(report.conicity.to_frame())), alt, "By EN 15302.")
    table = Grid("Equivalent conicity by amplitude", headings, rows)
    return Section("Equivalent conicity", (table, Words(words), missing, picture))


def _speeds(report: ProfileReport) -> Section:
    table = speeds_table(report).astype(object)
    rows = tuple(_speed_row(row) for row in table.where(table.notna(), None).to_dict("records"))
    headings = (
        "average mm", "Hopf m/s", "km/h", "Hz", "kind", "FLC 1/s", "first fold m/s", "at mm",
        "lowest cycle m/s", "km/h", "at mm",
    )  # fmt: skip
    words = tuple(
        f"averaged over {s.width * 1e3:g} mm: {s.words}"
        for s in report.speeds
        if s.run is None or not s.run.folds
    )
    caption = "Critical speeds, by the width of the average over the displacement"
    return Section("Critical speeds", (Grid(caption, headings, rows), Listing(words)))


def _speed_row(row: dict[Any, Any]) -> tuple[str, ...]:
    get = row.get
    bound = "≤ " if get("bound") else ""
    lowest = number(get("v_non"), ".2f")
    return (
        number(get("width"), "g", 1e3),
        number(get("v_lin"), ".2f"),
        number(get("v_lin"), ".1f", 3.6),
        number(get("frequency"), ".2f"),
        get("kind") or "–",
        number(get("flc"), ".3g"),
        number(get("v_fold"), ".2f"),
        number(get("fold_amplitude"), ".2f", 1e3),
        bound + lowest,
        number(get("v_non"), ".1f", 3.6),
        number(get("amplitude"), ".2f", 1e3),
    )


def _diagram(report: ProfileReport) -> Section:
    branches = {s.width: s.branch for s in report.speeds if s.branch is not None}
    run = report.chosen.run
    hopf = None if run is None or run.hopf is None else run.hopf.value
    if not branches:
        return Section("Bifurcation diagram", (Words(f"No cycles: {report.chosen.words}."),))
    figure = speed_diagram(branches, report.chosen.width, hopf, report.window)
    alt = (
        "Amplitude of hunting over the speed. "
        + " ".join(conclusion(report)[:2])
        + " Solid lines are stable, dashed ones unstable."
    )
    caption = (
        "Straight running and the cycles born where it loses its stability; solid: stable, "
        "dashed: unstable. H: Hopf point. LPC: fold of cycles; BPC, PD, NS: others branch off. "
        "Thin: with other averages, stability not drawn."
    )
    return Section("Bifurcation diagram", (Picture(svg(figure), alt, caption),))


def _meaning() -> Section:
    """What the words mean and what the numbers rest on."""
    return Section(
        "How to read this",
        (
            Listing(
                (
                    "One wheelset on elastic suspension to a body that runs straight on; creep "
                    "forces as the vehicle's options say. Bogie and body are not in it.",
                    "Linear critical speed: above it straight running is unstable (Hopf point). "
                    "H+: cycles are born unstable (subcritical), H−: stable (supercritical).",
                    "Nonlinear critical speed: the lowest speed at which a cycle exists; below it "
                    "every disturbance dies out, as far as cycles were followed. “At most” or “≤” "
                    "says that the branch was still falling where the known contact ends.",
                    "The contact's functions of y go into the model averaged over the width "
                    "given; a jump becomes a steep passage of that width. No polynomial is fitted.",
                    "Conicities are those of the rigid contact, not averaged.",
                )
            ),
        ),
    )
