"""`saca danger dataset`, `saca danger margins` and `saca danger check`."""

import hashlib
import json
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, INTERRUPTED, PROGRAM, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

SMALL = ["--transitions", "2500", "--part-drives", "4", "--no-tables"]


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.glob("part_*.h5"))}


def test_makes_the_same_whatever_the_threads_and_goes_on_where_it_was(tmp_path):
    first = saca("danger", "dataset", tmp_path / "a", *SMALL, "--threads", "1", "--json", cwd=tmp_path)
    assert first.returncode == SUCCESS, first.stderr
    told = json.loads(first.stdout)
    assert told["danger.dataset.transitions"] >= 2500
    made = digests(tmp_path / "a")
    assert told["danger.dataset.drives"] == 4 * len(made)
    assert told["danger.dataset.situations"] == 40 * len(made)
    assert "simulated" in (tmp_path / "a" / "README.md").read_text()

    other = saca("danger", "dataset", tmp_path / "b", *SMALL, "--threads", "3", cwd=tmp_path)
    assert other.returncode == SUCCESS, other.stderr
    assert digests(tmp_path / "b") == made

    last = sorted((tmp_path / "a").glob("part_*.h5"))[-1]
    last.unlink()
    again = saca("danger", "dataset", tmp_path / "a", *SMALL, cwd=tmp_path)
    assert again.returncode == SUCCESS, again.stderr
    assert digests(tmp_path / "a") == made


@pytest.mark.parametrize("arguments, code, wanted", [
    (["--transitions", "0"], WRONG_COMMAND_LINE, "--transitions"),
    (["--car", "no_such_car"], BAD_INPUT, "no_such_car"),
])
def test_refuses_what_makes_no_data(tmp_path, arguments, code, wanted):
    result = saca("danger", "dataset", tmp_path / "a", *arguments, cwd=tmp_path)
    assert wanted in one_error(result, code)
    assert not digests(tmp_path)


def test_other_settings_are_another_data_set(tmp_path):
    assert saca("danger", "dataset", tmp_path, *SMALL, cwd=tmp_path).returncode == SUCCESS
    result = saca("danger", "dataset", tmp_path, *SMALL, "--seed", "2", cwd=tmp_path)
    assert "journal.txt" in one_error(result, BAD_INPUT)


def test_coverage_wants_a_data_set(tmp_path):
    assert "*.h5" in one_error(saca("danger", "coverage", tmp_path, cwd=tmp_path), BAD_INPUT)
    (tmp_path / "part_00000.h5").write_text("nothing of the kind")
    assert "part_00000.h5" in one_error(saca("danger", "coverage", tmp_path, cwd=tmp_path), BAD_INPUT)
    assert "--among" in one_error(saca("danger", "coverage", tmp_path, "--among", "31", cwd=tmp_path), WRONG_COMMAND_LINE)


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("no folder")
    result = saca("danger", "dataset", tmp_path / "file" / "a", *SMALL, cwd=tmp_path)
    assert "file/a" in one_error(result, CANNOT_WRITE)


def test_a_full_disk_is_told_and_the_same_command_goes_on(tmp_path):
    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    arguments = ("danger", "dataset", tmp_path / "a", *SMALL)
    full = saca(*arguments, cwd=tmp_path, preexec_fn=small_files)
    assert full.returncode == CANNOT_WRITE
    assert "part_00000.h5: cannot be written" in full.stderr
    assert not digests(tmp_path / "a"), "no half part"
    assert saca(*arguments, cwd=tmp_path).returncode == SUCCESS
    assert saca("danger", "dataset", tmp_path / "b", *SMALL, cwd=tmp_path).returncode == SUCCESS
    assert digests(tmp_path / "a") == digests(tmp_path / "b") != {}


def weights(path, without="", **words):
    """Networks whose layers are 0: each value is h + log 2."""
    header, numbers = {"__metadata__": {"car": "compact_rwd_ev"} | words}, 0
    for net, inputs in (("v", 47), ("q1", 49), ("q2", 49)):
        for layer in range(4):
            rows, columns = 96 if layer < 3 else 1, 96 if layer else inputs
            for name, shape in ((f"{net}.{layer}.weight", [rows, columns]), (f"{net}.{layer}.bias", [rows])):
                if name == without:
                    continue
                count = shape[0] * (shape[1] if len(shape) > 1 else 1)
                header[name] = {"dtype": "F32", "shape": shape, "data_offsets": [4 * numbers, 4 * (numbers + count)]}
                numbers += count
    text = json.dumps(header).encode()
    path.write_bytes(struct.pack("<Q", len(text)) + text + bytes(4 * numbers))
    return path


def test_check_tells_how_often_networks_are_wrong(tmp_path):
    # Who tells h + log 2 sees what comes within 0.7 m at most, and drives on with full power: it must be found out.
    path = weights(tmp_path / "blind.safetensors")
    arguments = ("danger", "check", path, "--situations", "120")
    result = saca(*arguments, "--json", cwd=tmp_path)
    assert result.returncode == SUCCESS, result.stderr
    told = json.loads(result.stdout)
    assert told["danger.net.plain.hit_given_told_safe"] > 0.1
    assert told["danger.net.plain.told_safe_given_hit"] > 0.7
    assert told["danger.net.plain.hit_given_told_safe.hi"] > told["danger.net.plain.hit_given_told_safe"]
    assert told["danger.net.one.hit_given_told_safe.n"] + told["danger.net.several.hit_given_told_safe.n"] == told["danger.net.plain.hit_given_told_safe.n"]
    assert told["danger.net.plain.pincer.n"] > 30
    assert told["danger.net.several.lost_by_acting_m"] > 0.2
    again = json.loads(saca(*arguments, "--threads", "1", "--json", cwd=tmp_path).stdout)
    same = [key for key in told if key != "danger.net.us_batch32"]
    assert [told[key] for key in same] == [again[key] for key in same]
    plain = saca(*arguments, cwd=tmp_path)
    assert plain.returncode == SUCCESS and "all, no margin" in plain.stdout and "pincers" in plain.stdout


def test_without_enough_situations_nothing_is_told_safe(tmp_path):
    # Some 14,000 that are told safe and none of them hit would be needed in each bin.
    path, careful = weights(tmp_path / "blind.safetensors"), tmp_path / "careful.safetensors"
    result = saca("danger", "margins", path, "--output", careful, "--situations", "150", "--json", cwd=tmp_path)
    assert result.returncode == SUCCESS, result.stderr
    told = json.loads(result.stdout)
    margins = [told[key] for key in told if key.endswith(".margin_m")]
    assert len(margins) == 16 and min(margins) == 1000.0
    assert sum(told[key] for key in told if key.endswith(".told_safe")) > 50
    assert not list(tmp_path.glob("*.json")), "what was counted is not left behind"
    checked = json.loads(saca("danger", "check", careful, "--situations", "60", "--json", cwd=tmp_path).stdout)
    assert checked["danger.net.hit_given_told_safe.n"] == 0
    assert checked["danger.net.false_alarm"] == 1.0
    assert checked["danger.net.plain.false_alarm"] < 0.5
    assert checked["danger.net.turning.from_20_mps.good_grip.one.margin_m"] == 1000.0


def test_an_interrupted_count_for_margins_goes_on(tmp_path):
    path, output, state = weights(tmp_path / "blind.safetensors"), tmp_path / "a.safetensors", tmp_path / "a.safetensors.margins.json"
    arguments = ("danger", "margins", path, "--output", output, "--situations", "9000000")
    first = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    while not state.exists():
        assert first.poll() is None, first.stderr.read()
        time.sleep(0.05)
    first.send_signal(signal.SIGINT)
    _, said = first.communicate(timeout=100)
    assert first.returncode == INTERRUPTED and "goes on from here" in said
    counted = json.loads(state.read_text())["situations"]
    assert counted >= 2000 and not output.exists()
    assert "another seed" in one_error(saca(*arguments, "--seed", "2", cwd=tmp_path), BAD_INPUT)
    rest = saca("danger", "margins", path, "--output", output, "--situations", counted, "--json", cwd=tmp_path)
    assert rest.returncode == SUCCESS and json.loads(rest.stdout)["meta.situations"] == counted
    state.write_text("no count")
    assert "a.safetensors.margins.json" in one_error(saca(*arguments, cwd=tmp_path), BAD_INPUT)
    state.unlink()
    assert "no/folder" in one_error(saca("danger", "margins", path, "--output", "no/folder/x", cwd=tmp_path), CANNOT_WRITE)


def test_check_refuses_what_are_no_weights(tmp_path):
    assert "q1.2.bias" in one_error(saca("danger", "check", weights(tmp_path / "a", without="q1.2.bias"), cwd=tmp_path), BAD_INPUT)
    assert "no_such" in one_error(saca("danger", "check", tmp_path / "no_such", cwd=tmp_path), BAD_INPUT)
    assert "no_such_car" in one_error(saca("danger", "check", weights(tmp_path / "b", car="no_such_car"), cwd=tmp_path), BAD_INPUT)
    (tmp_path / "c").write_text("no weights")
    one_error(saca("danger", "check", tmp_path / "c", cwd=tmp_path), BAD_INPUT)
    bad_margin = weights(tmp_path / "d", **{"margin.straight.below_20_mps.slippery.one": "much"})
    assert "margin.straight.below_20_mps.slippery.one: want metres" in one_error(saca("danger", "check", bad_margin, cwd=tmp_path), BAD_INPUT)


def test_a_data_set_by_a_network_is_another(tmp_path):
    path = weights(tmp_path / "blind.safetensors")
    plain = saca("danger", "dataset", tmp_path / "a", *SMALL, cwd=tmp_path)
    by_it = saca("danger", "dataset", tmp_path / "b", *SMALL, "--by", path, cwd=tmp_path)
    assert plain.returncode == SUCCESS and by_it.returncode == SUCCESS, by_it.stderr
    assert digests(tmp_path / "a") != digests(tmp_path / "b")
    assert "journal.txt" in one_error(saca("danger", "dataset", tmp_path / "a", *SMALL, "--by", path, cwd=tmp_path), BAD_INPUT)
    other = weights(tmp_path / "other", car="suv_awd")
    assert "suv_awd" in one_error(saca("danger", "dataset", tmp_path / "c", *SMALL, "--by", other, cwd=tmp_path), BAD_INPUT)


def test_outcomes_are_the_networks_alone(tmp_path):
    path = weights(tmp_path / "blind.safetensors")
    arguments = ("danger", "dataset", tmp_path / "a", "--transitions", "400", "--part-drives", "20", "--no-tables", "--outcomes")
    result = saca(*arguments, "--by", path, "--json", cwd=tmp_path)
    assert result.returncode == SUCCESS, result.stderr
    told = json.loads(result.stdout)
    assert told["danger.dataset.situations"] == told["danger.dataset.drives"], "one situation a drive"
    one_error(saca(*arguments, cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "journal.txt" in one_error(saca("danger", "dataset", tmp_path / "a", *SMALL, "--by", path, cwd=tmp_path), BAD_INPUT)


def test_shows_values_beside_exact_ones(tmp_path):
    path = weights(tmp_path / "blind.safetensors")
    (tmp_path / "small.toml").write_text((ROOT / "data/reach/paper_ellipse.toml").read_text()
                                         .replace("points = 56", "points = 14").replace("points = 24", "points = 8")
                                         .replace("points = 36", "points = 12").replace("points = 16", "points = 6"))
    assert saca("reach", "solve", "small.toml", "--output", "small.h5", "--without-error", cwd=tmp_path).returncode == SUCCESS
    show = ("danger", "show", path, "--table", "small.h5")
    shown = saca(*show, "--output", "a.png", "--speed-mps", "8", cwd=tmp_path)
    assert shown.returncode == SUCCESS, shown.stderr
    assert (tmp_path / "a.png").read_bytes()[1:4] == b"PNG"
    one_error(saca(*show, "--output", "a.html", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "no_such.h5" in one_error(saca("danger", "show", path, "--table", "no_such.h5", cwd=tmp_path), BAD_INPUT)
    assert "no/folder" in one_error(saca(*show, "--output", "/proc/no/folder/a.png", cwd=tmp_path), CANNOT_WRITE)
