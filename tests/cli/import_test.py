"""`saca import 100car`."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, ROOT, SUCCESS, WRONG_COMMAND_LINE, one_error, saca

EXCERPT = ROOT / "saca/lab/recordings/testdata"


def test_all_events_are_tried_and_counted(tmp_path):
    folder = tmp_path / "study"
    folder.mkdir()
    series = (EXCERPT / "timeseries/HundredCar_Public_8911.txt").read_text()
    (folder / "HundredCar_NearCrash_Public_Compiled.txt").write_text(series + "17,1,2\n")
    table = "100CarEventVideoReducedData_v1_5.txt"
    (folder / table).write_bytes((EXCERPT / "meta" / table).read_bytes())
    told = saca("import", "100car", folder, "--all", "--output", "made", cwd=tmp_path)
    assert told.returncode == SUCCESS, told.stderr
    assert "2 events: 1 rebuilt, 1 refused" in told.stdout and "unreadable" in told.stdout
    alone = saca("import", "100car", folder, "--event", 8911, cwd=tmp_path)
    assert (tmp_path / "made/100car_8911.toml").read_text() == alone.stdout
    report = json.loads(saca("import", "100car", folder, "--all", "--json", cwd=tmp_path).stdout)
    assert report["schema"] == "saca.hundred_car_import/1"
    assert (report["events"], report["rebuilt"], report["refused"]) == (2, 1, {"unreadable": 1})
    refused, rebuilt = report["list"]
    assert (refused["event"], refused["refused"]) == (17, "unreadable") and "event 17" in refused["message"]
    assert rebuilt["scenario"] == "100car_8911" and abs(rebuilt["gyro_bias_degps"]) < 1.5


def test_what_cannot_be_imported_is_said(tmp_path):
    assert "want a file or folder" in one_error(saca("import", "100car", "nowhere", "--all", cwd=tmp_path), BAD_INPUT)
    for arguments in ([], ["--all", "--event", 8911], ["--event", 8911, "--json"], ["--all", "--narrative", "x"]):
        assert saca("import", "100car", EXCERPT, *arguments, cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    (tmp_path / "file").write_text("")
    run = saca("import", "100car", EXCERPT, "--all", "--output", "file/made", cwd=tmp_path)
    assert run.returncode == CANNOT_WRITE and "file" in run.stderr
