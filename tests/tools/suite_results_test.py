"""docs/suites.md says what docs/suites.json holds."""
import json
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import suite_results  # noqa: E402


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
    assert "| `aeb` | 0.2500 |" in text and "`x`, 7 encounters" in text


def test_harm_in_twins_is_told_where_a_run_has_it():
    figures = {"suite.x.aeb.harm": 0.125, "suite.x.n": 7, "suite.x.faults": 0}
    assert "harm in twins" not in suite_results.suite_section(figures, "x")
    figures |= {"suite.x.aeb.twin_harm": 0.5, "suite.x.aeb.twin_harm.lo": 0.25, "suite.x.aeb.twin_harm.hi": 0.75}
    text = suite_results.suite_section(figures, "x")
    assert "harm in twins" in text and "0.5000 (0.2500 to 0.7500) |" in text and set(suite_results.trimmed(figures)) == set(figures)


def test_a_run_that_is_added_takes_the_place_of_the_same_command():
    kept = [{"meta.command": "a", "x": 1}, {"meta.command": "b", "x": 2}]
    assert suite_results.with_added(kept, [{"meta.command": "a", "x": 3}, {"meta.command": "c", "x": 4}]) == [
        {"meta.command": "a", "x": 3}, {"meta.command": "b", "x": 2}, {"meta.command": "c", "x": 4}]


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """A repository of one commit, with the documents as they are here: the script keeps its figures there."""
    git = ["git", "-c", "user.name=x", "-c", "user.email=x@x", "-C", tmp_path]
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", "x"], check=True)
    for name, path in (("KEPT", suite_results.KEPT), ("PAGE", suite_results.PAGE)):
        copy = tmp_path / path.name
        copy.write_bytes(path.read_bytes())
        monkeypatch.setattr(suite_results, name, copy)
    monkeypatch.setattr(suite_results, "ROOT", tmp_path)
    return tmp_path


def documents():
    return [suite_results.KEPT.read_bytes(), suite_results.PAGE.read_bytes()]


def run_of(monkeypatch, *words):
    monkeypatch.setattr(sys, "argv", ["suite_results.py", *map(str, words)])
    suite_results.main()


def figures_file(folder, **figures):
    """As `saca memory calibrate --json` prints them."""
    path = folder / "run.json"
    path.write_text(json.dumps({"meta.command": "saca x", "memory.transfer.cases": 7} | figures))
    return path


def test_runs_of_the_named_commit_are_taken(repository):
    head = subprocess.run(["git", "-C", repository, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
    built_from = f"0.1.0 (commit {head[:12]})"
    (run,) = suite_results.merged("HEAD", [figures_file(repository, **{"meta.built_from": built_from})])
    assert head.startswith(run["meta.commit"]) and run["meta.built_from"] == built_from and run["memory.transfer.cases"] == 7
    assert len(suite_results.merged(head, [figures_file(repository)])) == 1  # of before programs told what they were built from
    for other in ("0.1.0 (commit 0123456789ab)", f"0.1.0 (commit {head[:12]}-dirty)"):
        with pytest.raises(SystemExit, match="run.json: want figures of a program of commit .*, got those of .0.1.0 .commit"):
            suite_results.merged("HEAD", [figures_file(repository, **{"meta.built_from": other})])


def test_what_is_added_is_kept_and_told(repository, monkeypatch):
    before = documents()
    run_of(monkeypatch)
    assert documents() == before
    run_of(monkeypatch, "add", "HEAD", figures_file(repository))
    kept, page = documents()
    assert len(json.loads(kept)) == len(json.loads(before[0])) + 1 and page.decode() == suite_results.page_of(json.loads(kept))
    run_of(monkeypatch, "HEAD", figures_file(repository))
    assert [run["meta.command"] for run in json.loads(documents()[0])] == ["saca x"]
    assert not list(repository.glob("*.part"))


def test_figures_of_which_no_page_can_be_made_change_nothing(repository, monkeypatch):
    before = documents()
    lacking = figures_file(repository, **{"suite.x.aeb.harm": 0.5})
    for words in (("HEAD", lacking), ("add", "HEAD", lacking)):
        with pytest.raises(SystemExit, match="want the figure 'suite.x.n', got none"):
            run_of(monkeypatch, *words)
        assert documents() == before


@pytest.mark.parametrize("text, problem", [(None, "want a file of figures, got No such file"), ("{", "want JSON, got "), ("[1]", 'want figures with "meta.command", got none'),
                                           ("{}", 'want figures with "meta.command", got none')])
def test_what_is_no_run_is_refused_in_one_line(repository, monkeypatch, text, problem):
    if text is not None:
        (repository / "bad.json").write_text(text)
    before = documents()
    with pytest.raises(SystemExit) as refused:
        run_of(monkeypatch, "add", "HEAD", repository / "bad.json")
    assert str(refused.value).startswith(f"{repository}/bad.json: {problem}") and "\n" not in str(refused.value) and documents() == before


def test_words_that_name_no_run_are_refused(repository, monkeypatch, capsys):
    with pytest.raises(SystemExit, match="want a commit of this repository, got none.json"):
        run_of(monkeypatch, "none.json", figures_file(repository))
    for words in (("HEAD",), ("add", "HEAD"), ("HEAD", figures_file(repository), "--"), ("HEAD", "--", "HEAD")):
        with pytest.raises(SystemExit) as refused:
            run_of(monkeypatch, *words)
        assert refused.value.code == 2 and capsys.readouterr().err.startswith("usage: ")


def test_verdicts_stand_beside_what_happened():
    figures = {"suite.x.n": 7, "suite.x.faults": 0, "suite.x.saca.harm": 0.1, "suite.x.saca.expected.knowingly_worse": 0.25}
    for k, place in enumerate(("suite.x.saca.", "suite.x.saca.crossing.")):
        figures[place + "expected.n"] = 6 - k
        for i, key in enumerate(suite_results.EXPECTED):
            figures[place + key] = 0.1 * (i + 1) + 0.01 * k
    figures["suite.x.saca.crossing.regret"] = 0.5
    text = suite_results.suite_section(figures, "x")
    assert "25.0 % were knowingly worse" in text
    assert "| all | 6 | 0.1000 | 0.2000 | 0.3000 | 0.4000 |" in text and "| crossing | 5 | 0.1100 | 0.2100 | 0.3100 | 0.4100 |" in text
    assert set(suite_results.trimmed(figures)) == set(figures)
    assert "knowingly" not in suite_results.suite_section({key: value for key, value in figures.items() if "expected" not in key}, "x")


def test_parts_are_told_by_what_is_lost_without_them():
    figures = {"meta.command": "saca suite x --methods saca,saca_no_memory --count 7", "suite.x.n": 7, "suite.x.faults": 0}
    for method, more in (("saca", 0.0), ("saca_no_memory", 0.25)):
        figures |= {f"suite.x.{method}.harm": 0.5, f"suite.x.{method}.harm_over_first": more, f"suite.x.{method}.harm_over_first.lo": more - 0.125,
                    f"suite.x.{method}.harm_over_first.hi": more + 0.125}
    text = suite_results.suite_section(figures, "x")
    assert "harm above that of `saca`" in text and "0.2500 (0.1250 to 0.3750)" in text
    assert set(suite_results.trimmed(figures)) == set(figures)
    assert "above that of" not in suite_results.suite_section({key: value for key, value in figures.items() if "over_first" not in key}, "x")


def forecasts_of(models):
    figures = {f"forecast.x.{part}": 3 for part in ("num_encounters", "num_failed", "num_forecasts", "num_acting")}
    for k, model in enumerate(models):
        for time in suite_results.TIMES:
            figures[f"forecast.x.all.nll.{time}ms.{model}"] = 1.0 + k
            if model != "shipped":
                figures |= {f"forecast.x.all.nll.{time}ms.{model}.above_shipped" + end: value
                            for end, value in (("", 0.5), (".lo", 0.25 if time < 2000 else -0.25), (".hi", 0.75))}
        figures[f"forecast.x.head_on_acting.nll.2000ms.{model}"] = 2.0 + k
    return figures


def test_forecasts_show_each_model_beside_what_ships():
    text = suite_results.forecast_section(forecasts_of(suite_results.MODELS), "x")
    assert "| negative log likelihood, ln m2, 1 s | 1.000 | 2.000 | 3.000 | 4.000 | 5.000 | 6.000 | 7.000 |" in text
    assert "| head_on | 2.000 | 3.000 | 4.000 | 5.000 | 6.000 | 7.000 | 8.000 |" in text
    assert "forecast.x.all.nll.1000ms.law.above_shipped.lo" in suite_results.trimmed(forecasts_of(suite_results.MODELS))


def test_forecasts_say_whether_what_ships_is_better_than_every_baseline():
    text = suite_results.forecast_section(forecasts_of(("law", "particle_filter", "shipped")), "x")
    assert "| 1 s | 0.500 (0.250 to 0.750) | 0.500 (0.250 to 0.750) | yes |" in text
    assert "| 2 s | 0.500 (-0.250 to 0.750) | 0.500 (-0.250 to 0.750) | not than `law`, `particle_filter` |" in text


def test_forecasts_made_before_a_model_was_there_do_without_it():
    text = suite_results.forecast_section(forecasts_of(("constant_velocity", "shipped")), "x")
    assert "| negative log likelihood, ln m2, 1 s | 1.000 | 2.000 |" in text and "particle_filter" not in text


def test_recalls_are_told_by_confidence():
    figures = {"memory.transfer.cases": 1234, "memory.transfer.check.queries": 50}
    for k, (key, _) in enumerate(suite_results.CONFIDENCES):
        place = f"memory.transfer.check.{key}."
        figures[place + "coverage"] = 0.25
        for i, (what, _) in enumerate(suite_results.RECALLED):
            figures |= {place + what: 0.5 + 0.1 * i, place + what + ".lo": 0.125, place + what + ".hi": 0.875}
    text = suite_results.memory_section(figures)
    assert "1,234 cases" in text and "Each held against" not in text and "50 scenes in which" in text
    assert "| above 0.9 | 25.0 | 50.0 (12.5 to 87.5) | 60.0 (12.5 to 87.5) |" in text


def test_replies_are_told_beside_simple_rules():
    figures = {f"eval.{key}.{what}": value for key in ("model", "aeb") for what, value in (("best_within", 0.75), ("admissible", 1.0), ("harm", 0.5),
                                                                                          ("regret", 0.25), ("above_rule", -0.125))}
    figures |= {"eval." + key: 0.5 for key in ("ended", "text_and_answer_agree", "true_statements", "statements_checked", "true_replies", "unfounded", "shown",
                                               "shown_in_part", "shown_at_last", "temperature")}
    figures |= {"eval.num_examples": 9, "eval.num_known": 5, "eval.num_failed": 0, "eval.tokens.p50": 80, "eval.tokens.max": 99}
    text = suite_results.replies_section(figures)
    assert "| the model, after reasoning | 75.0 | 100.0 | 0.2500 | -0.1250 |" in text and "the best forecast" not in text
    assert "As the reason 50.0 % are shown" in text and "three times, 50.0 % in all" in text and text.endswith("Temperature that fits best: 0.50.")


def test_single_families_keep_their_regret_only():
    figures = {"suite.x.aeb.regret": 1, "suite.x.aeb.crossing.regret": 2, "suite.x.aeb.crossing.harm": 3, "suite.x.aeb.crossing.regret.lo": 4,
               "suite.x.aeb.harm.lo": 5, "meta.seed": "1"}
    assert set(suite_results.trimmed(figures)) == {"suite.x.aeb.regret", "suite.x.aeb.crossing.regret", "suite.x.aeb.harm.lo", "meta.seed"}


def test_a_figure_that_is_missing_is_named_with_its_file():
    kept = json.loads(suite_results.KEPT.read_text())
    del kept[0]["suite.balanced.faults"]
    with pytest.raises(SystemExit, match=r"docs/suites\.json, `saca suite balanced .*`: want the figure 'suite\.balanced\.faults', got none"):
        suite_results.page_of(kept)


def test_tables_have_replies_and_what_was_in_time_where_a_model_was_asked():
    figures = {}
    for key in ("collision_loss", "false_trigger_loss"):
        for draws, n in (("", 60), (".ten_draws", 10)):
            figures |= {f"tables.3.saca.{key}{draws}{end}": value for end, value in (("", 0.5), (".lo", 0.25), (".hi", 0.75), (".n", n))}
    figures |= {f"tables.3.saca.harm_over_aeb{end}": value for end, value in (("", -0.5), (".lo", -0.75), (".hi", -0.25))}
    text = suite_results.tables_section(figures)
    assert "## Tables II and III of the paper" in text and "Table III, 60 encounters" in text and "Table II," not in text and "in time" not in text
    assert "| `saca` | 0.50 (0.25 to 0.75) | 0.50 (0.25 to 0.75) | 0.50 (0.25 to 0.75) | 0.50 (0.25 to 0.75) | -0.5000 (-0.7500 to -0.2500) |" in text
    figures |= {f"tables.3.saca.collision_loss.in_time{end}": value for end, value in (("", 0.12), (".lo", 0.0), (".hi", 0.25), (".n", 7))}
    figures |= {"tables.4.3.model.asked": 20, "tables.4.3.model.done": 19, "tables.4.3.model.ended": 18, "tables.4.3.model.in_time": 12, "tables.4.3.model.least_seconds": 2.2,
                "tables.4.3.untuned.asked": 20, "tables.4.3.untuned.done": 0, "tables.4.3.untuned.ended": 0, "tables.4.3.untuned.in_time": 0}
    for what, value in (("tokens", 80.0), ("seconds", 4.5)):
        figures |= {f"tables.4.3.model.{what}{end}": value + more for end, more in (("", 0.0), (".lo", -1.0), (".hi", 1.0), (".n", 19))}
    text = suite_results.tables_section(figures)
    assert "Tables II, III and IV" in text and "| 0.12 (0.00 to 0.25), 7 |" in text
    assert "| III, the model | 20 | 19 | 18 | 80 (79 to 81) | 4.5 (3.5 to 5.5) | 2.2 | 12 |" in text
    assert "| III, without fine-tuning | 20 | 0 | 0 | - | - | - | 0 |" in text
    assert set(suite_results.trimmed(figures)) == set(figures)
