#!/usr/bin/env python3
"""Makes docs/report.png, the picture of README.md: the page of its shipped emergency 1.8 s after the decision, with full braking beside it.

usage: tools/readme_picture.py [PROGRAM]    default: build/release/saca
"""
import base64
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "report"))
from chromium import Page

program = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/saca").resolve()
with tempfile.TemporaryDirectory() as folder, Page(1280, 1240) as page:
    subprocess.run([program, "run", "100car_8456", "--llm", "off", "--pace", "lockstep", "--report", "report.html", "--json"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    page.open(pathlib.Path(folder) / "report.html")
    page.run("[...document.querySelectorAll('.chip')].find((chip) => chip.textContent === 'AEB').click(), page.seek(record.t1 + 1.8), plan.zoom = 0.6, page.show()")
    page.settle()
    picture = page.call("Page.captureScreenshot", format="png")["data"]
(ROOT / "docs" / "report.png").write_bytes(base64.b64decode(picture))
