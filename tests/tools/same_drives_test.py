"""tools/same_drives.py: which tables of drives it takes for the same."""
import importlib.util
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("same_drives", ROOT / "tools/same_drives.py")
same_drives = importlib.util.module_from_spec(spec)
spec.loader.exec_module(same_drives)

HEAD = "situation,speed_m_s,grip,policy,strength,begun_s,x_m,y_m,yaw_rad,end_speed_m_s\n"


def table(folder, name, *rows):
    path = folder / name
    path.write_text(HEAD + "".join(row + "\n" for row in rows))
    return str(path)


def test_the_same_but_for_rounding(tmp_path, capsys):
    a = table(tmp_path, "a", "wreck,9.0,0.9,0,1.000,1.10,12.300000,0.0,0.0,0.0")
    b = table(tmp_path, "b", "wreck,9.0,0.9,0,1.000,1.10,12.300002,0.0,0.0,0.0")
    assert same_drives.main([a, b]) == 0
    assert "1 drives; largest differences: x_m 2e-06" in capsys.readouterr().out


@pytest.mark.parametrize("other, told", [
    ("wreck,9.0,0.9,1,1.000,1.10,12.3,0.0,0.0,0.0", "line 2: policy: 0 and 1"),
    ("wreck,9.0,0.9,0,1.000,1.11,12.3,0.0,0.0,0.0", "line 2: begun_s"),
    ("wreck,9.0,0.9,0,1.000,1.10,12.302,0.0,0.0,0.0", "x_m: differs by 0.002, want at most 0.001"),
    ("wreck,9.0,0.9,0,1.000,1.10,12.3,0.0,nan,0.0", "yaw_rad: differs by nan"),
])
def test_another_drive(tmp_path, capsys, other, told):
    a = table(tmp_path, "a", "wreck,9.0,0.9,0,1.000,1.10,12.3,0.0,0.0,0.0")
    assert same_drives.main([a, table(tmp_path, "b", other)]) == 1
    assert told in capsys.readouterr().err


def test_one_drive_fewer(tmp_path, capsys):
    row = "wreck,9.0,0.9,0,1.000,1.10,12.3,0.0,0.0,0.0"
    assert same_drives.main([table(tmp_path, "a", row, row), table(tmp_path, "b", row)]) == 1
    assert "want 2 drives, got 1" in capsys.readouterr().err


def test_what_is_no_table(tmp_path, capsys):
    (tmp_path / "other").write_text("a,b\n1,2\n")
    assert same_drives.main([str(tmp_path / "other"), str(tmp_path / "other")]) == 3
    assert "want rows of situation" in capsys.readouterr().err
    assert same_drives.main([str(tmp_path / "missing"), str(tmp_path / "other")]) == 3
    assert same_drives.main([]) == 2
