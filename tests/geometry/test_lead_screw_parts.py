"""A lead screw as parts: where magnets stand, what they weigh, solids and STEP files that are what the outlines say."""

import dataclasses
import math
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from cad_files import assert_sound, read_tree, write_step

import fluxbore
from fluxbore import report_content
from fluxbore.actuators import actuator_of
from fluxbore.cli import main
from fluxbore.design import graphics
from fluxbore.design.errors import DesignError, SpecError
from fluxbore.design.lead_screw_figures import mover_mass, rotor_mass, translator_magnet_mass
from fluxbore.design.spec import Spec, load
from fluxbore.geometry import assembly as geometry
from fluxbore.geometry import helical_clearance, lead_screw_parts, unrolled
from fluxbore.geometry import part as parts_of
from fluxbore.geometry import solid as solids
from fluxbore.geometry.assembly import Assembly
from fluxbore.geometry.helical_part import HelicalPart
from fluxbore.geometry.lead_screw_fittings import fitting_masses
from fluxbore.geometry.mass import part_masses, total
from fluxbore.geometry.part import Part
from fluxbore.geometry.part_surface import surface
from fluxbore.reports.section_drawing import section

MM = 1e-3
PITCH = 36 * MM / 7
ROTLIN = Path(__file__).parents[2] / "examples" / "rotlin.toml"

needs_gl = pytest.mark.skipif(not graphics.has_gl(), reason=f"libGL is missing: {graphics.APT_LINE}")


def arcs(member: str, form: str, angle: str = "60 deg", count: int = 6) -> dict[str, str]:
    key = f"actuator.{member}."
    return {f"{key}magnets": form, f"{key}arc_angle": angle, f"{key}arcs_per_turn": str(count)}


FORMS = {
    "continuous": {},
    "four starts": {
        "actuator.starts": "4",
        "actuator.translator.magnet_width": "2 mm",
        "actuator.rotor.magnet_width": "2 mm",
    },
    "steps in a rotor of arcs": {**arcs("translator", "stepped arcs"), **arcs("rotor", "helical arcs", "55 deg")},
    "arcs in a rotor of steps": {**arcs("translator", "helical arcs"), **arcs("rotor", "stepped arcs", "44 deg", 8)},
}


@pytest.fixture(scope="module")
def specs() -> dict[str, Spec]:
    return {name: load(ROTLIN, overrides) for name, overrides in FORMS.items()}


def drawn(spec: Spec) -> Assembly:
    return actuator_of(spec).assembly(spec)


def magnets(whole: Assembly, member: str, polarity: str) -> list[HelicalPart]:
    chosen = [part for part in whole.parts if part.role.startswith(member) and part.role.endswith(f" {polarity}")]
    helical = [part for part in chosen if isinstance(part, HelicalPart)]
    assert helical
    assert len(helical) == len(chosen)
    return helical


def along(parts: list[HelicalPart], angle: float) -> list[tuple[float, float]]:
    """Where a generator passes the parts, from below, what touches joined."""
    joined: list[tuple[float, float]] = []
    for low, high in sorted(span for part in parts for span in unrolled.spans(part.outline, angle)):
        if joined and low - joined[-1][1] < 1e-9:
            joined[-1] = (joined[-1][0], high)
        else:
            joined.append((low, high))
    return joined


@pytest.mark.parametrize("form", FORMS)
def test_nothing_overlaps_and_every_gap_is_the_specifications(specs: dict[str, Spec], form: str) -> None:
    """Narrowest gaps by hand: the air gap, what the pitch leaves beside two magnets, what the turn leaves of arcs."""
    spec = specs[form]
    whole = drawn(spec)
    assert geometry.interferences(whole) == ()
    for member in ("translator", "rotor"):
        parts = [part for polarity in "NS" for part in magnets(whole, member, polarity)]
        gaps = helical_clearance.narrowest(parts)
        shape = getattr(spec.actuator.shape, member)
        assert gaps.axial == pytest.approx(PITCH / 2 - shape.magnet_width, abs=1e-12)
        if shape.arcs is not None and shape.arcs.stepped:
            free = math.tau / shape.arcs.per_turn - shape.arcs.angle
            assert gaps.angular == pytest.approx(free, abs=1e-12)
    both = [part for part in whole.parts if isinstance(part, HelicalPart)]
    assert helical_clearance.narrowest(both).radial == pytest.approx(0.8 * MM, rel=1e-12)


@pytest.mark.parametrize("form", ["continuous", "four starts"])
@pytest.mark.parametrize("position", [0.0, 13.7 * MM, -33.3 * MM])
def test_like_poles_face_one_another_wherever_the_rotor_is(specs: dict[str, Spec], form: str, position: float) -> None:
    """x_d = 0: each stretch of the rotor's north lies over the translator's and over no south, all round."""
    whole = lead_screw_parts.assembly(specs[form].actuator, position)
    rotor, north, south = (
        magnets(whole, "rotor", "N"),
        magnets(whole, "translator", "N"),
        magnets(whole, "translator", "S"),
    )
    for angle in (0.0, 1.1, 3.0, 5.9):
        for low, high in along(rotor, angle):
            middle = (low + high) / 2
            assert abs(middle - position) < PITCH * 1.01
            assert any(bottom <= middle <= top for bottom, top in along(north, angle))
            assert not any(bottom < middle < top for bottom, top in along(south, angle))
            if (
                high - low > 0.999 * specs[form].actuator.shape.rotor.magnet_width
            ):  # a whole pole, not one that the end of the rotor cuts
                nearest = min(
                    ((bottom + top) / 2 for bottom, top in along(north, angle)), key=lambda z: abs(z - middle)
                )
                assert nearest == pytest.approx(middle, abs=1e-12)


@pytest.mark.parametrize("form", FORMS)
def test_every_piece_is_on_its_helix(specs: dict[str, Spec], form: str) -> None:
    """ζ = z - hθ of all middles: the same for north of both members, half a pitch on for south, at any position."""
    spec = specs[form]
    whole = lead_screw_parts.assembly(spec.actuator, 17.3 * MM)
    waves = {}
    for member in ("translator", "rotor"):
        for polarity in "NS":
            places = [unrolled_middle(part) for part in magnets(whole, member, polarity)]
            zeta = np.array([z - spec.actuator.shape.h * theta for theta, z in places])
            waves[member, polarity] = np.exp(2j * math.pi * zeta / PITCH)
    first = waves["translator", "N"][0]
    for (_, polarity), wave in waves.items():
        assert wave == pytest.approx(first if polarity == "N" else -first, abs=1e-9)


def unrolled_middle(part: HelicalPart) -> tuple[float, float]:
    theta, z = np.mean(part.outline, axis=0)
    return float(theta), float(z)


def test_every_generator_crosses_as_many_poles_as_the_specification_says(specs: dict[str, Spec]) -> None:
    """Continuous magnets by length, whole arcs by number: catches a column of arcs that is one short."""
    for form, spec in specs.items():
        whole = drawn(spec)
        for angle in (0.05, 1.1, 3.2):
            spans = [span for polarity in "NS" for span in along(magnets(whole, "rotor", polarity), angle)]
            if spec.actuator.shape.rotor.arcs is None:
                filled = sum(high - low for low, high in spans)
                assert filled == pytest.approx(4 * spec.actuator.shape.rotor.magnet_width, rel=1e-9), form
            elif spans:  # not where there is a gap between arcs
                assert len(spans) == 4, form


def test_masses_are_the_models(specs: dict[str, Spec]) -> None:
    """Helices flat at their ends weigh what rings do, at any start; whole arcs of a length of two pitches too."""
    for form, spec in specs.items():
        whole = drawn(spec)
        rows = part_masses(whole, spec.materials)
        screw = spec.actuator.magnetised(spec.materials, 293.15)
        held = fitting_masses(spec.actuator, spec.materials)
        assert total(rows, "mover") == pytest.approx(rotor_mass(screw) + held.moving, rel=1e-12), form
        assert total(rows, "mover") + whole.carried_mass == pytest.approx(mover_mass(screw) + held.moving, rel=1e-12)
        translator = sum(row.mass for row in rows if row.part.role.startswith(("translator magnet", "translator arc")))
        # 85 mm are 99.2 arcs of each polarity; whole ones are 99 or 100.
        close = 1e-12 if spec.actuator.shape.translator.arcs is None else 1 / 99
        assert translator == pytest.approx(translator_magnet_mass(screw), rel=close), form


def test_bodies_without_thickness_are_left_out_and_the_carrier_is_drawn() -> None:
    bare = {"actuator.fittings": "none"}  # whose ends would be let into a bore
    spec = load(ROTLIN, {**bare, "actuator.rotor.iron_thickness": "0 mm", "actuator.translator.thickness": "9 mm"})
    whole = drawn(spec)
    names = [part.name for part in whole.parts]
    assert "rotor iron" not in names
    assert whole.part("translator carrier").profile[0][0] == pytest.approx(8.45 * MM)
    assert whole.part("translator carrier").profile[1][0] == pytest.approx(9.95 * MM)
    solid = drawn(load(ROTLIN, {**bare, "actuator.translator.thickness": ""}))
    assert solid.part("translator carrier").profile[0][0] == 0.0


def test_a_stepped_arc_of_the_whole_turn_is_a_ring() -> None:
    whole = drawn(load(ROTLIN, arcs("translator", "stepped arcs", "360 deg", 1)))
    rings = [part for part in whole.parts if part.role == "translator arc N"]
    assert len(rings) == 16
    assert all(isinstance(part, Part) for part in rings)


@pytest.mark.parametrize(
    ("overrides", "sentence"),
    [
        ({"actuator.pitch": "0.01 mm"}, r"actuator\.pitch must be at least 0\.0425 mm, or .*; got 0\.01 mm\.$"),
        (arcs("translator", "stepped arcs", "0.1 deg", 1000), r"actuator\.translator\.arcs_per_turn .* 33056\.$"),
    ],
)
def test_drawings_that_nobody_would_wait_for_are_refused(overrides: dict[str, str], sentence: str) -> None:
    with pytest.raises(DesignError, match=sentence):
        drawn(load(ROTLIN, overrides))


def test_a_position_beyond_the_stroke_is_refused(specs: dict[str, Spec]) -> None:
    with pytest.raises(DesignError, match=r"within the stroke, -35 mm to 35 mm; got 35\.1 mm\.$"):
        lead_screw_parts.assembly(specs["continuous"].actuator, 35.1 * MM)


def test_there_is_no_femm_model_of_it(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match=r'^actuator\.kind must be "coils" or "hybrid" for .*; got "lead-screw"\.$'):
        fluxbore.export(ROTLIN, tmp_path / "out", form="fem")
    assert not (tmp_path / "out").exists()


def test_the_report_has_a_line_for_all_that_are_alike(specs: dict[str, Spec]) -> None:
    spec = specs["steps in a rotor of arcs"]
    whole = drawn(spec)
    rows = {row.name: row for row in report_content.part_rows(spec, whole)}
    assert {name: row.count for name, row in rows.items() if "arc" in name.split()} == {
        "translator arc N": 100,
        "translator arc S": 100,
        "rotor arc N": 12,
        "rotor arc S": 12,
    }
    assert rows["translator arc N"].size == "Ø34.9 / Ø29.9 × 2.5714 mm, 60°"
    assert rows["rotor arc S"].size.endswith(" mm, 55° of a helix 2.5714 mm wide, lead 5.1429 mm")
    assert (rows["motor stator"].material, rows["motor stator"].mass) == ("envelope only", 0.0)
    assert rows["carried along, not drawn"].mass == spec.number("actuator.carried_mass")
    sentences = report_content.checked(whole)
    assert sentences[0] == "Interference of all 238 parts in their section: none."
    assert "0.8 mm between the members, neighbours touch along the axis" in sentences[1]


def test_the_section_shows_each_polarity(specs: dict[str, Spec]) -> None:
    """By the faces that are filled: as many as generators at 0 and 180 degrees cross, besides the turned parts."""
    whole = drawn(specs["continuous"])
    markup = str(section(whole).markup)
    for polarity in "NS":
        parts = [*magnets(whole, "translator", polarity), *magnets(whole, "rotor", polarity)]
        crossed = sum(len(unrolled.spans(part.outline, angle)) for part in parts for angle in (0.0, math.pi))
        colour = "".join(f"{round(255 * share):02x}" for share in lead_screw_parts.COLOURS[polarity])
        # Two more are the legend's.
        assert markup.count(f"fill: #{colour}") == crossed + 2


@pytest.fixture(scope="module")
def short(specs: dict[str, Spec]) -> dict[str, Assembly]:
    """Few turns, so that the kernel's work is short."""
    found = {}
    for form, spec in specs.items():
        shape = dataclasses.replace(spec.actuator.shape, translator_length=12 * MM)
        found[form] = lead_screw_parts.assembly(dataclasses.replace(spec.actuator, shape=shape, stroke=1 * MM))
    return found


@needs_gl
@pytest.mark.parametrize("form", FORMS)
def test_solids_are_what_the_outlines_say(short: dict[str, Assembly], form: str) -> None:
    """Volume and centre by the kernel's integration over the faces against the closed formulas, which share nothing."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    kinds = {part.role: part for part in short[form].parts if isinstance(part, HelicalPart)}
    for part in kinds.values():
        body, properties = solids.solid(part), GProp_GProps()
        assert body.isValid()
        assert solids.is_closed(body)
        BRepGProp.VolumeProperties_s(body.wrapped, properties, 1e-9)
        assert properties.Mass() * MM**3 == pytest.approx(parts_of.volume(part), rel=1e-8)
        middle = properties.CentreOfMass()
        found = (middle.X() * MM, middle.Y() * MM, middle.Z() * MM)
        assert found == pytest.approx(parts_of.centre_of_mass(part), abs=1e-10)


@needs_gl
def test_step_files_come_back_as_they_were(short: dict[str, Assembly], tmp_path: Path) -> None:
    """Names, groups, colours, places and volumes of bands and of arcs, through the file."""
    import cadquery

    for form in ("continuous", "steps in a rotor of arcs"):
        kinds = {part.role: part for part in short[form].parts}
        whole = dataclasses.replace(short[form], parts=tuple(kinds.values()))
        paths = write_step(whole, tmp_path / form)
        name, pieces = read_tree(paths[0])
        assert name == "RotLin"
        assert [(piece.group, piece.name) for piece in pieces] == [(part.group, part.name) for part in whole.parts]
        for piece, part in zip(pieces, whole.parts, strict=True):
            assert piece.colour == pytest.approx(part.colour, abs=2e-3)
            assert_sound(piece.body, parts_of.volume(part), 1e-6)
            box = piece.body.BoundingBox()
            low, high = min(z for _, z in part.profile), max(z for _, z in part.profile)
            assert (box.zmin * MM, box.zmax * MM) == pytest.approx((low, high), abs=1e-6)
        assert len(paths) == 1 + len(whole.parts)
        alone = cadquery.importers.importStep(str(paths[1 + list(kinds).index(whole.parts[2].role)])).val()
        assert solids.kernel_volume(alone) == pytest.approx(parts_of.volume(whole.parts[2]), rel=1e-6)


@needs_gl
def test_no_lead_is_the_limit_of_little_for_the_kernel_too(short: dict[str, Assembly]) -> None:
    """h to 0: a sector of a ring, and the same with a lead of a nanometre."""
    part = magnets(short["steps in a rotor of arcs"], "translator", "N")[0]
    (start, low), (end, _), (_, high), _ = part.outline
    rise = 1e-9 * (end - start) / math.tau
    little = dataclasses.replace(part, outline=((start, low), (end, low + rise), (end, high + rise), (start, high)))
    volumes = [solids.kernel_volume(solids.solid(one)) for one in (part, little)]
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-9)


def test_pictures_can_cut_every_part_of_the_rotor_open(short: dict[str, Assembly]) -> None:
    for name in ("rotor magnet N", "motor stator"):
        for cut_open in (True, False):
            x, y, _ = surface(short["continuous"].part(name), 2e-5, cut_open=cut_open).points.T
            assert bool(((x > 1e-6) & (y > 1e-6)).any()) is not cut_open


def test_arcs_overhang_alike_at_both_ends(specs: dict[str, Spec]) -> None:
    """By less than half of a magnet's width, and of its rise where it follows the helix."""
    for form in ("steps in a rotor of arcs", "arcs in a rotor of steps"):
        whole = drawn(specs[form])
        heights = [z for polarity in "NS" for part in magnets(whole, "rotor", polarity) for _, z in part.outline]
        assert min(heights) == pytest.approx(-max(heights), rel=1e-12)
        own = max(z for _, z in magnets(whole, "rotor", "N")[0].profile) - min(
            z for _, z in magnets(whole, "rotor", "N")[0].profile
        )
        assert 0 < max(heights) - PITCH < own / 2


@needs_gl
def test_the_pages_command_writes_what_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = (ROTLIN.parents[1] / "docs" / "lead_screw.md").read_text(encoding="utf-8")
    first, second = re.findall(r"^fluxbore (export .*)$", page, re.MULTILINE)
    monkeypatch.chdir(tmp_path)
    assert main([str(ROTLIN) if word == "examples/rotlin.toml" else word for word in shlex.split(first)]) == 0
    assert capsys.readouterr().err == ""
    assert (tmp_path / "cad" / "RotLin.step").exists()
    assert len(list((tmp_path / "cad" / "parts").iterdir())) == 13
    overrides = dict(word.split("=", 1) for word in shlex.split(second) if "=" in word)
    whole = drawn(load(ROTLIN, overrides))
    assert [len(magnets(whole, "translator", polarity)) for polarity in "NS"] == [100, 100]
    assert "100 arcs of each polarity" in page
    for form, overhang in (("stepped arcs", "0.86 mm in steps"), ("helical arcs", "1.29 mm along the helix")):
        rotor = magnets(drawn(load(ROTLIN, arcs("rotor", form))), "rotor", "N")
        assert overhang in " ".join(page.split())
        beyond = max(z for part in rotor for _, z in part.outline) - PITCH
        assert f"{beyond * 1e3:.2f} mm" == " ".join(overhang.split()[:2])


@needs_gl
def test_corners_that_rounding_parts_and_thin_magnets_do_not_crash_the_kernel(specs: dict[str, Spec]) -> None:
    """Found at random: a rotor of one pole, whose band has two corners a rounding apart, ended the process."""
    actuator = specs["continuous"].actuator
    pitch = 6.147598996695839 * MM
    touching = dataclasses.replace(actuator.shape.rotor, magnet_width=pitch / 2, magnet_thickness=2 * MM)
    shape = dataclasses.replace(actuator.shape, pitch=pitch, poles=1, rotor=touching, translator=touching)
    whole = lead_screw_parts.assembly(dataclasses.replace(actuator, shape=shape), 3.2849 * MM)
    for part in magnets(whole, "rotor", "N") + magnets(whole, "rotor", "S"):
        assert solids.solid(part).isValid()
    thin = dataclasses.replace(part, outer_radius=part.inner_radius + 1e-8)
    with pytest.raises(DesignError, match=r"at least 0\.001 mm radially for the CAD kernel; got 1e-05 mm\.$"):
        solids.solid(thin)
