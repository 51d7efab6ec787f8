"""What a shell finds: the version, completion and manual pages, all made from the options that there are."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import PROGRAM, ROOT, SUCCESS, WRONG_COMMAND_LINE, figures, one_error, saca


def commands(*before, cwd):
    """All that the help names, with what it says of each."""
    text = saca(*before, "--help", cwd=cwd).stdout
    yield before, text
    for name in re.findall(r"^  ([a-z0-9-]+) ", text.partition("Subcommands:")[2], re.M):
        yield from commands(*before, name, cwd=cwd)


def options_in(text):
    return set(re.findall(r"^  (?:-\w,)?(--[a-z0-9-]+)", text.partition("Options:")[2].partition("Subcommands:")[0], re.M))


def test_the_version_tells_the_commit(tmp_path):
    run = saca("--version", cwd=tmp_path)
    assert run.returncode == SUCCESS
    version, commit = re.fullmatch(r"saca (\d+\.\d+\.\d+) \(commit (unknown|[0-9a-f]{12,40}(?:-dirty)?)\)\n", run.stdout).groups()
    assert f"VERSION {version} " in (ROOT / "CMakeLists.txt").read_text()
    described = subprocess.run(["git", "-C", ROOT, "cat-file", "-e", commit.removesuffix("-dirty")], capture_output=True)
    assert commit == "unknown" or described.returncode == 0  # of this checkout


def test_the_commit_is_written_only_where_it_is_another_one(tmp_path):
    def source(folder):
        subprocess.run(["cmake", f"-DFOLDER={folder}", f"-DSOURCE={tmp_path / 'built_from.cpp'}", "-P", ROOT / "cmake/Commit.cmake"], check=True)
        return (tmp_path / "built_from.cpp").read_text(), (tmp_path / "built_from.cpp").stat().st_mtime_ns

    checkout = tmp_path / "checkout"
    git = ["git", "-C", checkout, "-c", "user.name=a", "-c", "user.email=a@b"]
    subprocess.run(["git", "init", "-q", checkout], check=True)
    (checkout / "below").mkdir()
    (checkout / "file").write_text("a")
    subprocess.run([*git, "add", "file"], check=True)
    subprocess.run([*git, "commit", "-qm", "a"], check=True)
    first = source(checkout)
    commit = subprocess.run([*git, "rev-parse", "--short=12", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
    assert f'"{commit}"' in first[0]
    assert source(checkout) == first  # untouched: nothing is compiled anew
    (checkout / "file").write_text("b")
    assert f'"{commit}-dirty"' in source(checkout)[0]
    assert '"unknown"' in source(checkout / "below")[0]  # in somebody else's checkout
    assert '"unknown"' in source(tmp_path)[0]


def json_table():
    """Of each command what `--json` prints, as docs/formats.md has it."""
    section = (ROOT / "docs/formats.md").read_text().partition("## What `--json` prints")[2].partition("\n## ")[0]
    return {name: schema.strip("`") for name, schema in re.findall(r"^\| `saca ([^`]+)` \| ([^|]+) \| [^|]+ \|$", section, re.M)}


def test_what_json_prints_is_told_of_every_command_that_has_it(tmp_path):
    there = {" ".join(before) for before, text in commands(cwd=tmp_path) if "--json" in options_in(text)}
    assert len(there) > 30 and set(json_table()) == there
    text = (ROOT / "docs/formats.md").read_text()
    for name, schema in json_table().items():
        assert schema in ("list", "figures") or text.count(schema) >= 1, name


@pytest.mark.parametrize("arguments", [
    ("run", "one_way", "--llm", "off", "--pace", "lockstep"), ("scenarios",), ("memory", "list"), ("physics",), ("drive", "--policy", 0), ("harm",),
    ("oracle", "one_way", "--draws", 0), ("whatif", "one_way", "--vary", "grip=0.9:0.9:1"), ("family", "crossing", "--sample", 1),
    ("balance", "--count", 2), ("forecast", "eval", "crossing", "--count", 1), ("suite", "crossing", "--count", 1),
    ("suite", "r152", "--methods", "aeb"), ("ladder", "crossing", "--count", 1), ("atlas", "info"), ("atlas", "check", "--scenes", 3),
    ("reach", "solve", "road_edge", "--without-error"), ("reach", "tables", "one_way"), 
    ("import", "commonroad", ROOT / "saca/lab/recordings/testdata/commonroad_small.xml", "--output", "a.toml"), ("explain", "runs/one_way/record.json"),
    ("verify", "runs/one_way/record.json"),
], ids=lambda arguments: " ".join(map(str, arguments[:2])))
def test_what_json_prints_has_the_schema_that_is_told(arguments, tmp_path):
    if arguments[0] in ("memory", "explain", "verify"):
        (tmp_path / "runs").mkdir()
        assert saca("run", "one_way", "--llm", "off", "--pace", "lockstep", "--memory", "runs/memory.sqlite", cwd=tmp_path).returncode == SUCCESS
    document = figures(saca(*arguments, "--json", cwd=tmp_path))
    table = json_table()
    name = next(" ".join(arguments[:count]) for count in (3, 2, 1) if " ".join(map(str, arguments[:count])) in table)
    if table[name] == "list":
        assert isinstance(document, list) and document
    elif table[name] == "figures":
        assert "schema" not in document and document
        assert all(isinstance(value, (int, float, list)) or value is None or key.startswith("meta") for key, value in document.items())
    else:
        assert document["schema"] == table[name]


def completed(line, cwd):
    """What bash offers for the last word of a line."""
    words = line.split(" ")
    script = f"""
source <("$SACA" completion bash)
COMP_WORDS=({" ".join(f"'{word}'" for word in words)}) COMP_CWORD={len(words) - 1}
_saca
printf '%s\\n' "${{COMPREPLY[@]}}"
"""
    run = subprocess.run(["bash", "-c", script], cwd=cwd, capture_output=True, text=True, timeout=1500,
                         env={**os.environ, "SACA": PROGRAM, "PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"})
    assert run.returncode == 0 and run.stderr == "", run.stderr
    return run.stdout.split()


def test_bash_completes_every_command_and_option(tmp_path):
    for before, text in commands(cwd=tmp_path):
        line = " ".join(("saca", *before))
        assert options_in(text) and options_in(text) <= set(completed(line + " --", tmp_path)), line
        names = re.findall(r"^  ([a-z0-9-]+) ", text.partition("Subcommands:")[2], re.M)
        if names:
            assert completed(line + " ", tmp_path) == names


@pytest.mark.parametrize("line, offered", [
    ("saca ru", ["run"]), ("saca memory l", ["list"]), ("saca run --pa", ["--pace"]), ("saca run one_way --pace l", ["lockstep"]),
    ("saca run --pace = r", ["real"]), ("saca run --policy A", ["AEB", "AES-L", "AES-R"]), ("saca run intersection_t1_", ["intersection_t1_truck_brakes"]),
    ("saca bench a", ["all", "atlas", "air3d"]), ("saca --quiet reach so", ["solve"]), ("saca --cache elsewhere run --tar", ["--target-speed"]),
    ("saca run --report pa", ["page.html"]), ("saca explain pa", ["page.html"]), ("saca vehicle test-drive st", ["steer"]),
])
def test_bash_completes_words_values_and_files(line, offered, tmp_path):
    (tmp_path / "page.html").write_text("")
    assert completed(line, tmp_path) == offered


@pytest.mark.parametrize("shell, check", [("zsh", ["zsh", "-n"]), ("fish", ["fish", "--no-execute"])])
def test_other_shells_take_their_completion(shell, check, tmp_path):
    run = saca("completion", shell, "--output", "made/file", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    text = (tmp_path / "made/file").read_text()
    for _, help_text in commands("run", cwd=tmp_path):
        for option in options_in(help_text):
            assert (option if shell == "zsh" else f"-l {option[2:]} ") in text
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed: its completion was looked at, and not read by it")
    subprocess.run([*check, tmp_path / "made/file"], check=True, timeout=1500)


def test_a_shell_that_is_not_known_is_told(tmp_path):
    assert "'powershell' is unknown; want one of bash, zsh, fish" in one_error(saca("completion", "powershell", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "no command is called 'rnu'; did you mean 'run'?" in one_error(saca("man", "rnu", cwd=tmp_path), WRONG_COMMAND_LINE)


def test_manual_pages_tell_every_option_without_a_warning(tmp_path):
    run = saca("man", "--all", "man1", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    pages = {page.stem: page.read_text() for page in (tmp_path / "man1").iterdir()}
    assert pages["saca"] == saca("man", cwd=tmp_path).stdout and pages["saca-run"] == saca("man", "run", cwd=tmp_path).stdout
    for before, text in commands(cwd=tmp_path):
        page = pages["-".join(("saca", *before[:1]))]
        for option in options_in(text):
            assert "\\fB" + option.replace("-", "\\-") + "\\fR" in page, (before, option)
    formats = (ROOT / "docs/formats.md").read_text().partition("## Exit codes of `saca`")[2]
    for code in re.findall(r"^\| (\d+) \|", formats, re.M):
        assert f".TP\n\\fB{code}\\fR\n" in pages["saca"]
    if shutil.which("groff") is None:
        pytest.skip("groff is not installed: the pages were looked at, and not set")
    for page in (tmp_path / "man1").iterdir():
        told = subprocess.run(["groff", "-man", "-ww", "-Tutf8", page], capture_output=True, text=True, timeout=1500)
        assert told.returncode == 0 and told.stderr == "", (page, told.stderr)
        assert "NAME" in told.stdout.replace("N\bN", "N").replace("A\bA", "A").replace("M\bM", "M").replace("E\bE", "E") or "NAME" in re.sub("\x1b\\[[0-9;]*m", "", told.stdout)
