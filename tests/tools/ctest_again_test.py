"""tools/ctest_again.py: which tests have to be run again after a change."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("ctest_again", ROOT / "tools" / "ctest_again.py")
ctest_again = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(ctest_again)

FILES = {
    "README.md": "words", "LICENSE": "words", "CMakeLists.txt": "project",
    "data/harm.toml": "a = 1", "scenarios/one.toml": "s = 1", "saca/base/world/testdata/log.csv": "1",
    "saca/base/world/scene.cpp": "int f();", "saca/base/world/scene_test.cpp": "int g();", "viewer/page.js": "let a",
    "docs/formats.md": "format", "docs/glossary.md": "word", "docs/deep/one.md": "deep", "docs/deep/two.md": "deep",
    "tools/make.py": "PAGE = ROOT / 'docs' / 'deep'", "tools/other.sh": "echo",
    "tests/cli/first_test.py": "import program\nfrom second_test import line", "tests/cli/second_test.py": "import program",
    "tests/cli/third_test.py": "import helper  # reads ROOT / \"docs\" / \"formats.md\"", "tests/cli/program.py": "PROGRAM = 1",
    "tests/cli/helper.py": "open('other.py')", "tests/cli/other.py": "pass", "tests/page/page_test.py": "pages = 1",
    "tests/page/conftest.py": "WRITER = 1", "tests/tools/all_test.py": "run(ROOT / 'tools/make.py', f'{ROOT}/saca/base/world/scene.cpp')",
    "third_party/models/choice.json": "q8",
    "build/p/saca": "\0program\0asks saca-model-host\0see docs/glossary.md for words\0", "build/p/saca-model-host": "\0runs the model\0",
    "build/p/world_test": "\0data/harm.toml\0https://a.b/docs/deep/one.md\0saca/base/world/scene.cpp\0docs\x01",
    "build/p/reason_test": "\0docs/formats.md\0saca-model-host\0README.mdx\0", "build/p/all_docs_test": "\0docs\0",
    "build/p/writer": "\0viewer/\0"}
TESTS = {"world": ["world_test"], "reason": ["reason_test"], "all_docs": ["all_docs_test"], "layers": ["/usr/bin/cmake", "-P", "x"],
         "cli.first": "cli/first", "cli.second": "cli/second", "cli.third": "cli/third", "page": "page/page", "tools": "tools"}
STARTED = {"cli": "SACA_PROGRAM=saca", "page": "WRITER=writer"}


class Tree:
    """A clone of few files, and what CTest says of its tests."""

    def __init__(self, root):
        self.root, self.build, self._clock = root, root / "build/p", 0
        for name, text in FILES.items():
            self.write(name, text)

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        self._clock += 1  # a file written twice in an instant differs by its time
        os.utime(file, (self._clock, self._clock))

    def tests(self):
        for name, asked in TESTS.items():
            if isinstance(asked, list):
                yield {"name": name, "command": [str(self.build / asked[0]) if "/" not in asked[0] else asked[0], *asked[1:]], "properties": []}
                continue
            script = self.root / "tests" / (f"{asked}_test.py" if "/" in asked else asked)
            key, _, program = STARTED.get(asked.partition("/")[0], "=").partition("=")
            environment = [f"{key}={self.build / program}"] if program else []
            yield {"name": name, "command": ["/usr/bin/python3", "-m", "pytest", str(script)],
                   "properties": [{"name": "ENVIRONMENT", "value": environment}]}

    def keys(self):
        clone = ctest_again.Clone(self.root, [name for name in FILES if not name.startswith(("build/", "third_party/"))])
        return {test["name"]: ctest_again.key_of(test, self.build, clone) for test in self.tests()}


@pytest.fixture
def tree(tmp_path):
    return Tree(tmp_path)


CLI = {"cli.first", "cli.second", "cli.third"}
PROGRAMS = {"world", "reason", "all_docs"}
ALL = PROGRAMS | CLI | {"page", "tools"}


@pytest.mark.parametrize("file, again", [
    ("saca/base/world/scene_test.cpp", set()),  # what is compiled is in programs' bytes
    ("saca/base/world/scene.cpp", {"tools"}),  # a script names it
    ("CMakeLists.txt", set()),
    ("LICENSE", set()),
    ("README.md", set()),
    ("data/harm.toml", ALL),
    ("scenarios/one.toml", ALL),
    ("saca/base/world/testdata/log.csv", ALL),
    ("viewer/page.js", {"page"}),  # its program names the folder
    ("docs/formats.md", {"reason", "all_docs", "cli.third"}),
    ("docs/glossary.md", {"all_docs"} | CLI),
    ("docs/deep/one.md", {"all_docs", "tools"}),  # a tool that is started names the folder
    ("tools/make.py", {"tools"}),
    ("tools/other.sh", set()),
    ("tests/cli/first_test.py", {"cli.first"}),
    ("tests/cli/second_test.py", {"cli.first", "cli.second"}),  # the first imports from it
    ("tests/cli/program.py", {"cli.first", "cli.second"}),
    ("tests/cli/other.py", {"cli.third"}),  # started by what is imported
    ("tests/page/conftest.py", {"page"}),
    ("tests/tools/all_test.py", {"tools"}),
    ("build/p/world_test", {"world"}),
    ("build/p/writer", {"page"}),
    ("build/p/saca", CLI),
    ("build/p/saca-model-host", {"reason"} | CLI),
    ("third_party/models/choice.json", {"reason"} | CLI),
])
def test_a_change_runs_what_it_can_reach_and_nothing_else(file, again, tree):
    before = tree.keys()
    tree.write(file, FILES[file] + "\n")
    after = tree.keys()
    assert {name for name in before if before[name] != after[name]} == again


def test_nothing_has_changed_when_files_are_only_touched(tree):
    before = tree.keys()
    for name, text in FILES.items():
        tree.write(name, text)
    assert tree.keys() == before


def test_what_is_neither_program_nor_python_always_runs(tree):
    assert {name for name, key in tree.keys().items() if key is None} == {"layers"}


def test_a_tool_that_has_been_set_up_since_runs_what_was_skipped(tree):
    tree.write("tests/page/page_test.py", "PYTHON = ROOT / 'build/tool/bin/python'")
    before = tree.keys()
    tree.write("build/tool/bin/python", "")
    after = tree.keys()
    assert {name for name in before if before[name] != after[name]} == {"page"}


CTEST = '''#!{python}
import json, pathlib, sys
root = pathlib.Path.cwd()
tests = ["one", "two"]
if "--show-only=json-v1" in sys.argv:
    print(json.dumps({{"tests": [{{"name": name, "command": [str(root / "build/p" / name)]}} for name in tests]}}))
    sys.exit()
chosen = [tests[int(number) - 1] for number in sys.argv[sys.argv.index("-I") + 1].split(",")[3:]] if "-I" in sys.argv else tests
(root / "chosen").write_text(" ".join(chosen))
failed = [name for name in chosen if "fails" in (root / "build/p" / name).read_text()]
cases = "".join(f'<testcase name="{{name}}" status="{{"fail" if name in failed else "run"}}">' +
                ("<failure/>" if name in failed else "") + "</testcase>" for name in chosen)
pathlib.Path(sys.argv[sys.argv.index("--output-junit") + 1]).write_text(f"<testsuite>{{cases}}</testsuite>")
sys.exit(len(failed))
'''


@pytest.fixture
def clone(tmp_path):
    """A clone with the tool, two test programs and a CTest that believes what they say."""
    for folder in ("tools", "build/p", "bin"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "tools/ctest_again.py").write_text((ROOT / "tools/ctest_again.py").read_text())
    (tmp_path / ".gitignore").write_text("build/\nbin/\nchosen\n")
    ctest = tmp_path / "bin/ctest"
    ctest.write_text(CTEST.format(python=sys.executable))
    ctest.chmod(0o755)
    for name in ("one", "two"):
        (tmp_path / "build/p" / name).write_text("passes")
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)
    return tmp_path


def ran(clone, code=0, **environment):
    """Names of tests that were run."""
    (clone / "chosen").write_text("")
    run = subprocess.run([sys.executable, "tools/ctest_again.py", "p"], cwd=clone, capture_output=True, text=True, timeout=1500,
                         env={**os.environ, "SACA_TEST_ALL": "", "PATH": f"{clone / 'bin'}:{os.environ['PATH']}", **environment})
    assert run.returncode == code, run.stderr
    return (clone / "chosen").read_text().split()


def test_what_has_passed_is_left_out_until_it_changes(clone):
    assert ran(clone) == ["one", "two"]
    assert ran(clone) == []
    (clone / "build/p/two").write_text("passes again")
    assert ran(clone) == ["two"]
    assert ran(clone, SACA_TEST_ALL="1") == ["one", "two"]
    assert json.loads((clone / "build/p/passed.json").read_text()).keys() == {"one", "two"}


def test_what_has_failed_is_run_until_it_passes(clone):
    (clone / "build/p/one").write_text("fails")
    assert ran(clone, code=1) == ["one", "two"]
    assert ran(clone, code=1) == ["one"]
    (clone / "build/p/one").write_text("passes")
    assert ran(clone) == ["one"]
    assert ran(clone) == []
