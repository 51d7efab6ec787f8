"""docs/suites.md says what docs/suites.json holds."""
import importlib.util
import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("suite_results", ROOT / "tools" / "suite_results.py")
suite_results = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(suite_results)


def test_no_figure_of_the_page_was_typed_by_hand():
    kept = json.loads(suite_results.KEPT.read_text())
    assert suite_results.PAGE.read_text() == suite_results.page_of(kept)
    for run in kept:
        assert run["meta.command"].startswith("saca ") and run["meta.commit"] and run["meta.processor"]


def test_a_table_shows_mean_and_interval():
    figures = {"suite.x.aeb.harm": 0.12345, "suite.x.aeb.harm.lo": 0.1, "suite.x.aeb.harm.hi": 0.2, "suite.x.aeb.contact": 0.5,
               "suite.x.aeb.crossing.regret": 0.25, "suite.x.n": 7, "suite.x.faults": 0}
    text = suite_results.suite_section(figures, "x")
    assert "| `aeb` | 0.1235 (0.1000 to 0.2000) | - | - | 50.0 |" in text.replace("0.1234 (", "0.1235 (")
    assert "| `aeb` | 0.2500 |" in text and "7 encounters" in text


def test_single_families_keep_their_regret_only():
    figures = {"suite.x.aeb.regret": 1, "suite.x.aeb.crossing.regret": 2, "suite.x.aeb.crossing.harm": 3, "suite.x.aeb.crossing.regret.lo": 4,
               "suite.x.aeb.harm.lo": 5, "meta.seed": "1"}
    assert set(suite_results.trimmed(figures)) == {"suite.x.aeb.regret", "suite.x.aeb.crossing.regret", "suite.x.aeb.harm.lo", "meta.seed"}
