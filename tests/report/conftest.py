import json
import os
import pathlib
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chromium import Page

WRITE_REPORT = os.environ.get("SACA_WRITE_REPORT", "build/release/tests/report/write_report")


@pytest.fixture(scope="module")
def browser():
    with Page(1280, 800) as page:
        yield page


@pytest.fixture
def open_report(browser, tmp_path):
    """Opens the report of a record in a window of 1280 x 800, light, and returns the page."""
    def made(kind, record, width=1280, height=800):
        source, target = tmp_path / "record.json", tmp_path / "report.html"
        source.write_text(json.dumps(record), encoding="utf-8")
        subprocess.run([WRITE_REPORT, kind, source, target], check=True)
        browser.problems.clear()
        browser.requests.clear()
        browser.resize(width, height)
        browser.open(target)
        return browser
    return made
