"""Pages as they are written, before any browser: the record comes back out whole whatever it says, and bad input is one line."""

import json
import pathlib
import re
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import make_drive
import make_record
import value_test
from conftest import WRITE_REPORT
from pages import poisoned

RECORDS = [("encounter", make()) for make in make_record.RECORDS.values()] + \
    [("drive", make()) for make in make_drive.RECORDS.values()] + \
    [("value", value_test.record(from_ego, lambda x, y, course: x + y - 3.0)) for from_ego in (False, True)]
NAMES = [f"{kind}-{index}" for index, (kind, _) in enumerate(RECORDS)]


def written(folder, kind, content):
    source, target = folder / "record.json", folder / "report.html"
    source.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
    run = subprocess.run([WRITE_REPORT, kind, source, target], capture_output=True, text=True, timeout=1500)
    return run, target.read_text(encoding="utf-8") if target.exists() else None


def embedded(page):
    found = re.findall(r'<script type="application/json" id="record">(.*?)</script>', page, re.DOTALL)
    assert len(found) == 1
    return json.loads(found[0])


@pytest.mark.parametrize("kind, record", RECORDS, ids=NAMES)
def test_a_page_holds_its_record_whole_and_asks_for_no_other_file(kind, record, tmp_path):
    run, page = written(tmp_path, kind, record)
    assert run.returncode == 0, run.stderr
    assert embedded(page) == record
    assert not re.search(r'<(script|link|img|iframe)[^>]*(src|href)=', page)


@pytest.mark.parametrize("kind, record", RECORDS, ids=NAMES)
def test_texts_of_a_record_are_never_markup(kind, record, tmp_path):
    hostile = poisoned(record, {"schema"})
    run, page = written(tmp_path, kind, hostile)
    assert run.returncode == 0, run.stderr
    assert embedded(page) == hostile
    assert "<img" not in page and "\u2028" not in page


@pytest.mark.parametrize("kind", ["encounter", "drive", "value"])
@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"null", b'{"schema": 3}', b'{"schema": "other/1"}', b"\xff\xfe", b'{"schema": "\xc3"}', b"\x00" * 100])
def test_what_is_no_record_is_one_line(kind, content, tmp_path):
    run, page = written(tmp_path, kind, content)
    assert run.returncode == 1 and page is None
    assert len(run.stderr.strip().splitlines()) == 1 and "record.json" in run.stderr


def test_a_page_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "report.html").mkdir()
    (tmp_path / "record.json").write_text(json.dumps(RECORDS[0][1]))
    run = subprocess.run([WRITE_REPORT, RECORDS[0][0], tmp_path / "record.json", tmp_path / "report.html"], capture_output=True, text=True, timeout=1500)
    assert run.returncode == 1 and "report.html" in run.stderr
