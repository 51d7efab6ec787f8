"""What people type: a misspelt name is told with the one that was likely meant, options have one spelling, units are asked for."""
import json
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, ROOT, SUCCESS, WRONG_COMMAND_LINE, figures, one_error, quick, saca


@pytest.mark.parametrize("arguments, words", [
    (["rnu", "one_way"], "saca: no command is called 'rnu'; did you mean 'run'?"),
    (["fly"], "saca: no command is called 'fly'; want one of run, "),
    (["memory", "lst"], "saca: memory: no command is called 'lst'; did you mean 'list'?"),
    (["memory"], "saca: memory: a command is missing; want one of list, show"),
    ([], "saca: a command is missing; want one of run, "),
    (["run", "one_way", "--polcy", "3"], "saca: run: no option is called --polcy; did you mean '--policy'?"),
    (["run", "one_way", "--seed=1", "--memroy=a"], "saca: run: no option is called --memroy; did you mean '--memory'?"),
    (["memory", "list", "--yaml"], "saca: memory list: no option is called --yaml; want one of --"),
    (["vehicle", "fit", "a.csv", "--card", "b"], "saca: vehicle fit: no option is called --card; did you mean '--car'?"),
    (["run", "one_way", "two_way"], "saca: run: want no more arguments, got 'two_way'"),
    (["run"], "saca: run: scenario is required"),
    (["run", "one_way", "--pace", "lockstp"], "--pace: 'lockstp' is unknown; did you mean 'lockstep'?"),
    (["bench", "luck"], "'luck' is unknown; want one of all, vehicle"),
    (["suite", "balanced", "--methods", "saca,saca_no_memry"], "did you mean 'saca_no_memory'?"),
])
def test_a_misspelt_command_option_or_word_is_told_with_what_was_meant(arguments, words, tmp_path):
    assert words in one_error(saca(*arguments, cwd=tmp_path), WRONG_COMMAND_LINE)


@pytest.mark.parametrize("arguments, words", [
    (["run", "one_wya"], "one_wya: no scenario is there, neither a file nor the name of a shipped one; did you mean 'one_way'?"),
    (["run", "batmobile"], "`saca scenarios` lists"),
    (["oracle", "intersection"], "want one of intersection_late_truck, "),
    (["drive", "--policy", "0", "--car", "midsize_suf"], "did you mean 'midsize_suv'?"),
    (["drive", "--policy", "0", "--car", "batmobile"], "want one of compact_rwd_ev, delivery_van, midsize_suv, small_fwd_car"),
    (["vehicle", "test-drive", "brake", "--car", "delivery", "--output", "a.csv"], "did you mean 'delivery_van'?"),
    (["family", "crosing"], "crosing: no family is there, neither a file nor the name of a shipped one; did you mean 'crossing'?"),
    (["suite", "balancd"], "balancd: no suite or family is called so; did you mean 'balanced'?"),
    (["suite", "fmvss12"], "did you mean 'fmvss127'?"),
    (["balance", "--suite", "pedestrians"], "did you mean 'pedestrian'?"),
    (["suite", "r152", "--rows", "moose"], "--rows: no row is called moose; want one of "),
    (["reach", "solve", "paper_elipse"], "did you mean 'paper_ellipse'?"),
])
def test_a_misspelt_name_is_told_with_what_was_meant(arguments, words, tmp_path):
    assert words in one_error(saca(*arguments, cwd=tmp_path), BAD_INPUT)
    assert not list(tmp_path.rglob("*.h5"))


@pytest.fixture
def spoilt(tmp_path):
    """A copy of a shipped file with one text replaced."""
    def copy(path, old, new):
        text = (ROOT / path).read_text()
        assert old in text
        file = tmp_path / pathlib.Path(path).name
        file.write_text(text.replace(old, new, 1))
        return file

    return copy


@pytest.mark.parametrize("old, new, words", [
    ("behaviour =", "behavior =", r"toml:\d+: behavior: unknown key; did you mean 'behaviour'\?"),
    ("duration_s =", "durations_s =", r"toml:\d+: durations_s: unknown key; did you mean 'duration_s'\?"),
    ("[road]", "[raod]", r"toml:\d+: raod: unknown key; did you mean 'road'\?"),
    ("[ego.start]", "[ego.strat]", r"toml:\d+: strat: unknown key; did you mean 'start'\?"),
    ("mass_kg = 75", "mass = 75", r"toml:\d+: mass: unknown key; did you mean 'mass_kg'\?"),
    ("speed_mps = 14", "speed_kmh = 50", r"toml:\d+: speed_kmh: unknown key; did you mean 'speed_mps'\?"),
    ("grip = 0.9", "grip = 0.9\ncolour = 1", r"toml:\d+: colour: unknown key; here stand .*grip, duration_s"),
    ("speed_mps = 14", "speed_mps = 130", r"speed_mps: want 0 to 100, got 130 \(did you mean km/h\? that would be 36.1 m/s\)"),
    ("grip = 0.9", "grip = 90", r"grip: want 0.05 to 1.2, got 90 \(did you mean %\? that would be 0.9\)"),
    ('car = "compact_rwd_ev"', 'car = "compact_rwd"', r"toml: car: compact_rwd: no car is there, .*did you mean 'compact_rwd_ev'\?"),
])
def test_a_misspelt_key_of_a_scenario_is_what_is_wrong(old, new, words, spoilt, tmp_path):
    message = one_error(quick(spoilt("scenarios/intersection_t1.toml", old, new), cwd=tmp_path), BAD_INPUT)
    assert re.search(words, message), message


def test_a_misspelt_key_of_a_car_a_family_and_a_case_is_told_likewise(spoilt, tmp_path):
    car = spoilt("data/vehicles/compact_rwd_ev.toml", "mass_kg =", "mas_kg =")
    assert "mas_kg: unknown key; did you mean 'mass_kg'?" in one_error(
        saca("drive", "--policy", 0, "--car", car, cwd=tmp_path), BAD_INPUT)
    spoilt("scenarios/families/surroundings.toml", "schema", "schema")
    family = spoilt("scenarios/families/crossing.toml", "late_s = {", "late = {")
    assert "late: unknown key; did you mean 'late_s'?" in one_error(saca("family", family, cwd=tmp_path), BAD_INPUT)
    case = spoilt("data/reach/paper_ellipse.toml", "schema", "scheme")
    assert "scheme: unknown key; did you mean 'schema'?" in one_error(saca("reach", "solve", case, cwd=tmp_path), BAD_INPUT)


def test_options_are_spelt_with_hyphens_and_the_old_way_still_works(tmp_path):
    def all_help(*command):
        text = saca(*command, "--help", cwd=tmp_path).stdout
        yield text
        for name in re.findall(r"^  ([a-z0-9-]+) ", text.partition("Subcommands:")[2], re.M):
            yield from all_help(*command, name)

    texts = list(all_help())
    assert len(texts) > 40
    assert not [word for text in texts for word in re.findall(r"--\w[\w-]*", text) if "_" in word]
    arguments = ("oracle", "intersection_t1", "--draws", 0, "--json")
    assert figures(saca(*arguments, "--at_s", 5, cwd=tmp_path)) == figures(saca(*arguments, "--at-s", 5, cwd=tmp_path))
    assert saca(*arguments, "--at_s=5", cwd=tmp_path).returncode == SUCCESS


@pytest.mark.parametrize("typed", ["3", "ES-B-L", "es-b-l", "es_b_l"])
def test_a_policy_is_its_number_or_its_name(typed, tmp_path):
    record = figures(quick("one_way", "--policy", typed, "--target-speed", 5, "--no-memory", "--json", cwd=tmp_path))
    assert record["decision"]["policy"] == 3 and record["decision"]["target_speed_mps"] == 5
    drive = figures(saca("drive", "--policy", typed, "--target-speed", 5, "--json", cwd=tmp_path))
    assert drive["policy"] == {"id": 3, "name": "ES-B-L", "target_speed_mps": 5, "strength": None}


@pytest.mark.parametrize("arguments, words", [
    (["--policy", "AEBB"], "want a policy's number, 0 to 7, or its name, got 'AEBB'; did you mean 'AEB'?"),
    (["--policy", "8"], "want one of AEB, AES-L, AES-R, ES-B-L, ES-B-R, T-D-L, T-D-R, NI"),
    (["--policy", "0", "--speed", "130"], "130 m/s: want 0 to 100 m/s (did you mean km/h? that would be 36.1 m/s)"),
    (["--policy", "0", "--speed", "fast"], "fast: want 0 to 100 m/s, got no number"),
    (["--policy", "0", "--grip", "90"], "90: want 0.01 to 1.2 (did you mean %? that would be 0.9)"),
    (["--policy", "0", "--strength", "80"], "80: want 0.2 to 1 (did you mean %? that would be 0.8)"),
    (["--policy", "0", "--seconds", "4200"], "4200 s: want 0.01 to 600 s (did you mean ms? that would be 4.2 s)"),
])
def test_a_number_in_another_unit_is_asked_about(arguments, words, tmp_path):
    assert words in one_error(saca("drive", *arguments, cwd=tmp_path), WRONG_COMMAND_LINE)


def test_a_target_speed_is_of_the_policies_that_have_one(tmp_path):
    for policy in ([], ["--policy", "AEB"]):
        assert "--target-speed: only of --policy 3 and 4" in one_error(
            quick("one_way", *policy, "--target-speed", 5, "--no-memory", cwd=tmp_path), BAD_INPUT)
