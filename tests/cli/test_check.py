# SPDX-License-Identifier: BSD-2-Clause
"""gearmap check: what it says of the example, and of descriptions that break a rule."""

import math
import re

import pytest
from conftest import EXAMPLE, ROOT, fails, result_of, succeeds

TEXT = EXAMPLE.read_text()
BAD_FILES = sorted((ROOT / "tests" / "model" / "bad").glob("*.yaml"))


@pytest.fixture(scope="module")
def checked():
    return result_of("check", EXAMPLE)


def test_finds_all_gears_of_both_paths(checked):
    gears = {p["name"]: [g["number"] for g in p["gears"]] for p in checked["paths"]}
    assert sorted(gears) == ["even", "odd"]
    assert sorted(gears["odd"] + gears["even"]) == [-1, 1, 2, 3, 4, 5, 6, 7]


def test_ratios_are_the_given_ones_and_fall_with_the_gear(checked):
    gears = sorted((g for p in checked["paths"] for g in p["gears"]),
                   key=lambda g: g["number"])
    for g in gears:
        if g["ratio_given"] is not None:
            # the sweep's own limit between identified and given ratio
            assert g["ratio"] == pytest.approx(g["ratio_given"], rel=1e-3)
    forward = [g["ratio"] for g in gears if g["number"] > 0]
    reverse = [g["ratio"] for g in gears if g["number"] < 0]
    assert all(abs(a) > abs(b) for a, b in zip(forward, forward[1:]))
    assert all(r * forward[0] < 0 for r in reverse)


def test_power_flows_from_the_input_shaft_to_the_output(checked):
    for path in checked["paths"]:
        assert {g["power_flow"][0] for g in path["gears"]} == {path["shaft"]}
        assert {g["power_flow"][-1] for g in path["gears"]} == {checked["output"]}
        assert all(len(g["power_flow"]) == len(set(g["power_flow"])) for g in path["gears"])


def test_inertia_at_the_input_is_reflected(checked):
    for path in checked["paths"]:
        for g in path["gears"]:
            expected = path["inertia_kgm2"] + checked["inertia_output_kgm2"] / g["ratio"]**2
            assert g["inertia_at_input_kgm2"] == pytest.approx(expected, rel=1e-12)


def test_text_shows_every_gear_and_shaft(checked):
    text = succeeds("check", EXAMPLE).stdout
    for shaft in checked["shafts"]:
        assert shaft["name"] in text
    for path in checked["paths"]:
        for g in path["gears"]:
            assert " > ".join(g["power_flow"]) in text


def test_all_gears_at_half_speed_and_torque(checked):
    points = checked["points"]
    assert [p["gear"] for p in points] == [-1, 1, 2, 3, 4, 5, 6, 7]
    for p in points:
        assert (p["speed_rpm"], p["torque_Nm"]) == (pytest.approx(3250), 125)
    alone = result_of("check", EXAMPLE, "--gear", "3")["point"]
    assert alone == points[3]


def test_all_gears_at_a_given_point():
    points = result_of("check", EXAMPLE, "--speed", "2000rpm", "--torque", "100Nm")["points"]
    assert points[3] == point_of(3, 2000, 100)


def row(text, heading, name):
    """The numbers of one row of a table; None where there is a dash."""
    table = text[text.index(f"\n{heading}"):].lstrip("\n").split("\n\n")[0]
    line = re.search(rf"^  {re.escape(name)}  +(.*)$", table, re.M).group(1)
    return [None if word == "-" else float(word) for word in line.split()]


def test_text_has_losses_of_all_gears(checked):
    text = succeeds("check", EXAMPLE).stdout
    points = checked["points"]
    for kind, of_first in points[0]["components_W"].items():
        if not any(p["components_W"][kind] for p in points):
            assert f"  {kind}" not in text  # the gearset has no such parts
            continue
        assert row(text, "loss [W]", kind)[0] == pytest.approx(of_first, abs=0.05)
    assert row(text, "loss [W]", "total") == \
        pytest.approx([p["loss_W"] for p in points], abs=0.05)
    assert row(text, "loss [W]", "efficiency [%]") == \
        pytest.approx([100 * p["efficiency"] for p in points], abs=0.005)


def test_teeth_meet_as_often_as_they_pass(checked):
    """z n / 60 of the drive gears of third (32 teeth) and of the final drive (16, behind
    32:49); second does not carry load in third."""
    text = succeeds("check", EXAMPLE).stdout
    third = checked["points"][3]
    meshes = {e["name"]: e for e in third["elements"] if e["kind"] == "meshes"}
    assert meshes["third"]["frequency_Hz"] == pytest.approx(32 * 3250 / 60)
    assert meshes["final_drive_1"]["frequency_Hz"] == pytest.approx(16 * 3250 * 32 / 49 / 60)
    assert row(text, "teeth meet", "third")[3] == pytest.approx(32 * 3250 / 60, abs=0.05)
    assert row(text, "teeth meet", "second")[3] is None


def test_bearing_loads_are_the_largest_of_all_gears(checked):
    text = succeeds("check", EXAMPLE).stdout
    loads = {p["gear"]: e["radial_load_N"] for p in checked["points"] for e in p["elements"]
             if (e["name"], e["kind"]) == ("output_1_front", "bearings")}
    gear = max(loads, key=loads.get)
    assert re.search(rf"^  output_1_front +{loads[gear]:.0f} \( ?{gear}\)", text, re.M)


def test_forces_of_a_mesh_and_loads_of_its_bearings():
    """F_bt = 2 T / d_b of third: 32 teeth of 1.75 mm at 27.632888 degrees."""
    elements = point_of(3, 2000, 100)["elements"]
    helix = math.radians(27.632888)
    alpha_t = math.atan(math.tan(math.radians(20)) / math.cos(helix))
    base = 32 * 1.75e-3 / math.cos(helix) * math.cos(alpha_t)
    third = next(e for e in elements if e["name"] == "third")
    # friction of bearings and seals of the input shaft takes less than 1 %
    assert third["force_N"] == pytest.approx(200 / base, rel=0.01)
    rear = next(e for e in elements if e["name"] == "input_odd_rear")
    # of the input shaft only that bearing takes axial load; the drag of idling gears adds
    # a little
    axial = third["force_N"] * math.cos(alpha_t) * math.tan(helix)
    assert rear["axial_load_N"] == pytest.approx(axial, rel=1e-3)


def point_of(gear, speed, torque, *more):
    return result_of("check", EXAMPLE, "--gear", gear, "--speed", speed, "--torque", torque,
                     *more)["point"]


@pytest.mark.parametrize("gear, speed, torque", [
    (3, 2000, 100), (3, 2000, -50), (6, 4000, 150), (1, -500, -80), (-1, 1000, 60)])
def test_losses_of_a_point_close_the_power_balance(gear, speed, torque):
    p = point_of(gear, speed, torque)
    rpm = math.pi / 30
    given = p["torque_Nm"] * p["speed_rpm"] * rpm
    taken = p["output_torque_Nm"] * p["output_speed_rpm"] * rpm
    # the solver stops at 1e-12 of the largest force; powers are differences of those
    assert p["loss_W"] == pytest.approx(given - taken, rel=1e-6)
    assert p["loss_W"] == pytest.approx(sum(p["components_W"].values()), rel=1e-9)
    assert p["loss_W"] == pytest.approx(sum(e["loss_W"] for e in p["elements"]), rel=1e-9)
    assert p["loss_at_input_Nm"] == pytest.approx(p["loss_W"] / abs(speed * rpm), rel=1e-9)
    assert all(e["loss_W"] >= 0 for e in p["elements"])
    assert 0 < p["efficiency"] < 1


def test_reverse_turns_the_output_the_other_way():
    assert point_of(-1, 1000, 50)["output_speed_rpm"] * \
        point_of(1, 1000, 50)["output_speed_rpm"] < 0


def test_a_preselected_gear_costs_more_than_a_free_shaft():
    free = point_of(3, 3000, 0)
    preselected = point_of(3, 3000, 0, "--preselect", "4")
    assert preselected["loss_W"] > free["loss_W"]


def test_cold_oil_costs_more():
    cold = point_of(3, 2000, 50, "--oil-temperature", "20degC")
    warm = point_of(3, 2000, 50, "--oil-temperature", "80degC")
    assert cold["loss_W"] > warm["loss_W"]


def test_text_of_a_point_lists_components_and_elements():
    text = succeeds("check", EXAMPLE, "--gear", "3", "--speed", "2000", "--torque", "100").stdout
    assert re.search(r"^gear 3 \(odd\) at 2000 rpm and 100\.0 N·m, oil ", text, re.M)
    shares = [float(s) for s in re.findall(r"N·m +([\d.]+) %$", text, re.M)]
    assert sum(shares) == pytest.approx(100, abs=0.5)  # each is rounded to 0.1 %


def test_a_gear_that_does_not_exist():
    assert fails("check", EXAMPLE, "--gear", "8", "--speed", "100", "--torque", "1") == \
        f"{EXAMPLE}: there is no gear 8"


def test_a_gear_that_cannot_be_preselected():
    assert fails("check", EXAMPLE, "--gear", "3", "--speed", "100", "--torque", "1",
                 "--preselect", "5") == \
        f"{EXAMPLE}: gear 5 cannot be preselected while gear 3 drives: both are on path odd"
    assert fails("check", EXAMPLE, "--gear", "3", "--speed", "100", "--torque", "1",
                 "--preselect", "9") == f"{EXAMPLE}: there is no gear 9 to preselect"


def test_what_is_not_there_is_not_listed():
    head = succeeds("check", EXAMPLE.parents[1] / "tests" / "cli" / "two_speed.yaml").stdout
    assert ", 1 synchroniser\n" in head and "seal" not in head


def test_a_shaft_that_friction_holds():
    """In third gear at 2000 rpm the even shafts of the example stand still."""
    text = succeeds("check", EXAMPLE, "--gear", "3", "--speed", "2000", "--torque", "100").stdout
    assert re.search("^even in neutral, (held|turning) ", text, re.M)
    assert "held by friction at 0 rpm" not in text


# Damage done to the example: (name, pattern, replacement, words the sentence must hold).
DAMAGE = [
    ("not_a_number", r"(width_mm: *)[\d.]+", r"\g<1>3o0", "3o0"),
    ("with_a_unit", r"(width_mm: *)[\d.]+", r"\g<1>30 mm", "30 mm"),
    ("nan", r"(width_mm: *)[\d.]+", r"\g<1>.nan", "nan"),
    ("infinite", r"(width_mm: *)[\d.]+", r"\g<1>.inf", "inf"),
    ("negative", r"(width_mm: *)[\d.]+", r"\g<1>-12", "-12"),
    ("unknown_key", r"width_mm: *([\d.]+)", r"widht_mm: \g<1>", "widht_mm"),
    ("wrong_teeth", r"(teeth: *)(\d+)", r"\g<1>7\g<2>", "mm"),
    ("not_yaml", r"\Z", "\nx: [1, 2\n", ""),
]


def refused(path, *words):
    """check, sweep and reduce refuse the file with one sentence and leave nothing."""
    before = set(path.parent.iterdir())
    sentence = fails("check", path)
    assert sentence.startswith(f"{path}")
    for word in words:
        assert word in sentence
    for command, output in (("sweep", "out.map"), ("reduce", "out.fmu")):
        assert fails(command, path, "-o", path.parent / output) == sentence
    assert set(path.parent.iterdir()) == before
    return sentence


@pytest.mark.parametrize("name, pattern, replacement, word", DAMAGE, ids=[d[0] for d in DAMAGE])
def test_damaged_descriptions(name, pattern, replacement, word, tmp_path):
    damaged, n = re.subn(pattern, replacement, TEXT, count=1)
    assert n == 1 and damaged != TEXT
    path = tmp_path / f"{name}.yaml"
    path.write_text(damaged)
    sentence = refused(path, word)
    assert re.match(rf"{re.escape(str(path))}:\d+", sentence), "no line number"


@pytest.mark.parametrize("file", BAD_FILES, ids=[f.stem for f in BAD_FILES])
def test_bad_descriptions_of_the_model_tests(file, tmp_path):
    path = tmp_path / file.name
    path.write_bytes(file.read_bytes())
    refused(path)


def test_a_missing_file(tmp_path):
    sentence = refused(tmp_path / "none.yaml")
    assert "No such file" in sentence


def test_a_folder_in_place_of_a_file(tmp_path):
    folder = tmp_path / "folder.yaml"
    folder.mkdir()
    refused(folder)


@pytest.mark.parametrize("content", [b"", b"\0" * 100, b"\xff\xfe\x00", b"- 1\n- 2\n",
                                     b"{" * 5000])
def test_files_that_are_no_description(content, tmp_path):
    path = tmp_path / "odd.yaml"
    path.write_bytes(content)
    refused(path)


def test_a_truncated_description(tmp_path):
    path = tmp_path / "half.yaml"
    path.write_text(TEXT[:len(TEXT) // 2])
    refused(path)


def test_parts_stand_where_the_description_puts_them(checked):
    parts = checked["parts"]
    gears = {g["name"]: g for g in parts["gears"]}
    shafts = {s["name"]: s for s in parts["shafts"]}
    assert len(gears) == 20 and len(shafts) == 7 and len(parts["bearings"]) == 15
    for mesh in parts["meshes"]:  # centre distance at zero backlash, shifts apart
        a, b = (gears[name] for name in mesh["gears"])
        distance = math.hypot(*(shafts[a["shaft"]][k] - shafts[b["shaft"]][k]
                                for k in ("y_mm", "z_mm")))
        radii = a["reference_radius_mm"] + b["reference_radius_mm"]
        assert radii == pytest.approx(distance, abs=1.0)
    assert {b["designation"] for b in parts["bearings"]} & {"6207", "6307", "6206"}


def test_many_points_are_those_of_single_points(tmp_path):
    table = tmp_path / "points.csv"
    table.write_text("gear,preselected,speed_rpm,torque_Nm\n3,0,2000,100\n2,3,1500,-40\n")
    text = succeeds("check", EXAMPLE, "--points", table).stdout
    names, *rows = [line.split(",") for line in text.split()]
    assert len(rows) == 2
    for row, options in zip(rows, (("--gear", 3, "--speed", 2000, "--torque", 100),
                                   ("--gear", 2, "--preselect", 3, "--speed", 1500,
                                    "--torque=-40"))):
        point = result_of("check", EXAMPLE, *options)["point"]
        found = dict(zip(names, map(float, row)))
        assert found["loss_W"] == pytest.approx(point["loss_W"], rel=1e-8)
        assert found["efficiency"] == pytest.approx(point["efficiency"], rel=1e-8)
        for kind, power in point["components_W"].items():
            assert found[kind.replace(" ", "_") + "_W"] == pytest.approx(power, rel=1e-8)
    listed = result_of("check", EXAMPLE, "--points", table)["points"]
    assert [p["gear"] for p in listed] == [3, 2]


@pytest.mark.parametrize("rows, words", [
    ("speed_rpm,torque_Nm\n1,2\n", "the column gear is missing"),
    ("gear,speed_rpm,torque_Nm\n0,1000,1\n", "a gear other than 0"),
    ("gear,speed_rpm,torque_Nm\n1.5,1000,1\n", "the number of a gear"),
    ("gear,speed_rpm,torque_Nm\n1,0,1\n", "a speed other than 0"),
    ("gear,speed_rpm,torque_Nm\n9,1000,1\n", "there is no gear 9"),
    ("gear,speed_rpm,torque_Nm,oil\n", "oil"),
])
def test_a_wrong_table_of_points_is_one_sentence(tmp_path, rows, words):
    table = tmp_path / "points.csv"
    table.write_text(rows)
    assert words in fails("check", EXAMPLE, "--points", table)
