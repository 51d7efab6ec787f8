"""docs/results.md says what docs/results.json holds, and tools/bench.sh measures what is missing."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import figures  # noqa: E402
import results_page  # noqa: E402


def committed():
    return results_page.runs_of(json.loads(results_page.KEPT.read_text()), "docs/results.json")


def test_no_figure_of_the_page_was_typed_by_hand():
    runs = committed()
    assert results_page.PAGE.read_text() == results_page.page_of(runs)
    for run in runs.values():
        assert run["meta.command"] and run["meta.processor"] and re.fullmatch(r"\d{4}-\d\d-\d\d", run["meta.date"])
        assert re.fullmatch("[0-9a-f]{7,}", run["meta.commit"]), "measured with changes that are in no commit"


def test_only_what_the_page_shows_is_kept():
    runs = committed()
    results_page.page_of(runs)
    assert results_page.kept_of(runs) == json.loads(results_page.KEPT.read_text())


def test_every_run_of_the_page_is_in_the_list():
    listed = dict(line.split(maxsplit=1) for line in
                  re.search(r"<<'END'\n(.*?)\nEND\n", (ROOT / "tools/bench.sh").read_text(), re.DOTALL).group(1).splitlines())
    for run in committed().values():
        assert listed[run["meta.name"]] == run["meta.command"]


def test_a_figure_that_is_missing_is_named_with_its_file():
    runs = committed()
    del runs["physics"]["physics.outside_band"]
    with pytest.raises(SystemExit, match=r"docs/results\.json, run `physics`: want the figure 'physics\.outside_band', got none"):
        results_page.page_of(runs)


def test_a_run_that_is_missing_is_named():
    runs = committed()
    del runs["physics"]
    page = results_page.page_of(runs)
    assert "## Physics\n\nNot measured yet: `tools/bench.sh physics` does that.\n" in page and "## Choice\n\nDeterministic" in page


def test_weights_that_were_taught_are_not_called_untaught():
    runs = committed()
    runs["model_bench"]["meta.model"] = "SmolLM2-135M-Instruct.BF16.gguf e76cc47c (llama 256M BF16)"
    assert "BF16), not fine-tuned. `saca model score`" in results_page.page_of(runs)
    runs["model_bench"]["meta.model"] = "saca-SmolLM2-135M.BF16.gguf eabe6055 (llama 256M BF16)"
    assert "BF16), fine-tuned. `saca model score`" in results_page.page_of(runs)


@pytest.fixture
def documents(tmp_path, monkeypatch):
    """Copies, in the places of those that are here."""
    for name, path in (("KEPT", results_page.KEPT), ("PAGE", results_page.PAGE)):
        copy = tmp_path / path.name
        copy.write_bytes(path.read_bytes())
        monkeypatch.setattr(results_page, name, copy)
    return [results_page.KEPT, results_page.PAGE]


def test_a_page_that_is_made_again_is_the_same(documents):
    before = [path.read_bytes() for path in documents]
    results_page.main([])
    assert [path.read_bytes() for path in documents] == before and sorted(documents[0].parent.iterdir()) == sorted(documents)


@pytest.mark.parametrize("text, problem", [(None, "want a file of figures, got No such file"), ("{", "want JSON, got "), ("[1]", 'want figures with "meta.name", got none'),
                                           ('{"x": 1}', 'want figures with "meta.name", got none'),
                                           ('{"meta.name": "physics"}', "run `physics`: want ")])
def test_what_is_no_run_is_refused_and_changes_nothing(documents, tmp_path, text, problem):
    bad = tmp_path / "bad.json"
    if text is not None:
        bad.write_text(text)
    before = [path.read_bytes() for path in documents]
    with pytest.raises(SystemExit, match=f"bad.json.*{re.escape(problem)}"):
        results_page.main([bad])
    assert [path.read_bytes() for path in documents] == before


def test_a_file_is_written_whole_or_not_at_all(tmp_path):
    (tmp_path / "file").write_text("before")
    (tmp_path / "file.part").mkdir()  # nothing can be written there
    with pytest.raises(OSError):
        figures.write_whole(tmp_path / "file", b"after")
    assert (tmp_path / "file").read_text() == "before"
    (tmp_path / "file.part").rmdir()
    figures.write_whole(tmp_path / "file", b"after")
    assert (tmp_path / "file").read_text() == "after" and len(list(tmp_path.iterdir())) == 1


def test_nested_figures_are_flat():
    assert figures.flat({"a": [{"b": 1}, 2], "c": {"d": None}}) == {"a.0.b": 1, "a.1": 2, "c.d": None}


def test_benchmarks_are_known_by_name():
    document = {"context": {"host_name": "x"}, "benchmarks": [
        {"name": "f/8", "time_unit": "ns", "cpu_time": 1500, "real_time": 2000}, {"name": "g", "error_occurred": True, "error_message": "no AVX-512"}]}
    assert figures.by_name(document) == {"f/8": {"cpu_time_us": 1.5, "real_time_us": 2.0, "items_per_second": None}, "g": {"error": "no AVX-512"}}


# A clone with the tools, a program `saca` that notes its calls, and a page that notes its files.
@pytest.fixture
def clone(tmp_path):
    (tmp_path / "tools").mkdir()
    for name in ("bench.sh", "figures.py"):
        shutil.copy(ROOT / "tools" / name, tmp_path / "tools" / name)
    for path, text in (("tools/results_page.py", '#!/bin/sh\necho "$@" > page_of\n'),
                       ("build/release/saca", f'#!/bin/sh\necho "$@" >> {tmp_path}/calls\ncase $1 in atlas) echo broken >&2; exit 3;; esac\necho \'{{"x": 1}}\'\n')):
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        file.chmod(0o755)
    (tmp_path / "saca").mkdir()
    (tmp_path / "saca" / "source").write_text("1")
    (tmp_path / ".gitignore").write_text("/build/\n")
    commit(tmp_path)
    return tmp_path


def commit(clone):
    git = ["git", "-c", "user.name=x", "-c", "user.email=x@x", "-C", clone]
    subprocess.run(["git", "init", "-q", clone], check=True)
    subprocess.run([*git, "add", "."], check=True)
    subprocess.run([*git, "commit", "-q", "-m", "x"], check=True)


def bench(clone, *names, **variables):
    return subprocess.run([clone / "tools/bench.sh", *names], capture_output=True, text=True, timeout=60, env=os.environ | variables)


def calls(clone):
    return (clone / "calls").read_text().splitlines()


def test_a_bench_goes_on_where_it_stopped(clone):
    run = bench(clone, "physics")
    assert run.returncode == 0, run.stderr
    assert "[1/1] physics: " in run.stdout and "is there" not in run.stdout
    kept = json.loads((clone / "build/figures/physics.json").read_text())
    assert kept["x"] == 1 and kept["meta.name"] == "physics" and kept["meta.command"] == "saca " + calls(clone)[0]
    assert re.fullmatch("[0-9a-f]{7,}", kept["meta.commit"])
    run = bench(clone, "physics", "reach_check")
    assert "[1/2] physics: is there" in run.stdout and "[2/2] reach_check: " in run.stdout
    assert [call.split()[0] for call in calls(clone)] == ["physics", "reach"]
    assert (clone / "page_of").read_text().count(".json") == 2


def test_other_programs_are_measured_anew(clone):
    assert bench(clone, "physics").returncode == 0
    (clone / "README.md").write_text("not a program")
    commit(clone)
    assert "is there" in bench(clone, "physics").stdout
    (clone / "saca" / "source").write_text("2")
    assert "is there" not in bench(clone, "physics").stdout
    assert json.loads((clone / "build/figures/physics.json").read_text())["meta.commit"].endswith(" with changes")
    commit(clone)
    assert "is there" not in bench(clone, "physics").stdout
    assert len(calls(clone)) == 3


def test_what_needs_a_file_that_is_not_there_is_left_out_and_said(clone):
    run = bench(clone, "authors_network", SACA_AUTHORS_NETWORK="/does/not/exist")
    assert run.returncode == 0 and "left out: SACA_AUTHORS_NETWORK does not name what it needs" in run.stdout
    assert not (clone / "calls").exists()


def test_a_run_that_fails_is_told_and_does_not_stop_the_others(clone):
    run = bench(clone, "atlas_check", "reach_check")
    assert run.returncode == 1 and "atlas_check: failed: broken" in run.stdout and "failed: atlas_check" in run.stderr
    assert [file.name for file in (clone / "build/figures").iterdir()] == ["reach_check.json"]


def test_a_name_that_is_no_run_is_refused(clone):
    run = bench(clone, "phisics")
    assert run.returncode == 2 and "got phisics" in run.stderr
