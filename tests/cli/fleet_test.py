"""A memory bank on a PostgreSQL server."""
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from program import BAD_INPUT, CANNOT_WRITE, PROGRAM, ROOT, SUCCESS, one_error, quick, saca

SCRIPT = ROOT / "tests/support/postgres_server.sh"
NOT_INSTALLED = 77
COUNT = 6


def server(*arguments):
    return subprocess.run([SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=300)


def folder():
    """Of a server, which another user can go to."""
    made = pathlib.Path(tempfile.mkdtemp(prefix="saca_pg_", dir="/tmp"))
    made.chmod(0o755)
    return made


@pytest.fixture(scope="module")
def fleet():
    """A server that is asked through its socket, and with TLS and a password from afar."""
    home = folder()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    started = server("start", home, port)
    if started.returncode == NOT_INSTALLED:
        shutil.rmtree(home)
        pytest.skip("PostgreSQL is not installed")
    assert started.returncode == SUCCESS, started.stderr
    yield {"folder": home, "port": port, "url": f"postgresql://saca@:{port}/postgres?host={home}"}
    server("kill", home)
    shutil.rmtree(home, ignore_errors=True)


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    made = tmp_path_factory.mktemp("cases")
    run = saca("memory", "build", "balanced", "--count", str(COUNT), "--draws", "4", "--output", "cases.jsonl", cwd=made)
    assert run.returncode == SUCCESS, run.stderr
    return made / "cases.jsonl"


def statement(fleet, sql):
    done = subprocess.run(["psql", fleet["url"], "--quiet", "--tuples-only", "--no-align", "--command", sql], capture_output=True, text=True)
    assert done.returncode == SUCCESS, done.stderr
    return done.stdout.strip()


def bank(fleet, name):
    """A bank of its own, in a schema."""
    statement(fleet, f"CREATE SCHEMA IF NOT EXISTS {name}")
    return f"{fleet['url']}&options=-csearch_path%3D{name}"


def test_a_bank_on_a_server_is_used_as_one_in_a_file(fleet, cases, tmp_path):
    there = bank(fleet, "as_a_file")
    assert "no such memory bank" in one_error(saca("memory", "list", "--memory", there, cwd=tmp_path), BAD_INPUT)
    for memory in (there, "here.sqlite"):
        run = saca("memory", "import", cases, "--keep-trust", "--memory", memory, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
    told = [json.loads(saca("memory", "verify", "--json", "--memory", memory, cwd=tmp_path).stdout) for memory in (there, "here.sqlite")]
    assert told[0]["cases"] == told[1]["cases"] > COUNT
    assert told[0]["digest"] == told[1]["digest"]
    assert saca("memory", "export", "there.jsonl", "--memory", there, cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "there.jsonl").read_bytes() == cases.read_bytes()
    assert saca("memory", "thin", "--most", "3", "--memory", there, cwd=tmp_path).returncode == SUCCESS
    run = saca("memory", "show", "1", "--memory", there, "--svg", "case.svg", cwd=tmp_path)
    assert run.returncode == SUCCESS and (tmp_path / "case.svg").exists(), run.stderr


def test_an_encounter_is_learnt_there(fleet, tmp_path):
    there = bank(fleet, "learning")
    run = quick("intersection_t1", "--memory", there, "--empty-memory", "--output", "out", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert statement(fleet, "SELECT count(*) FROM learning.saca_cases") == "1"
    run = quick("intersection_t1", "--memory", there, "--output", "again", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert statement(fleet, "SELECT details::json ->> 'count' FROM learning.saca_cases") == "2", "merged"
    statement(fleet, "DELETE FROM learning.saca_cases")
    run = quick("intersection_t1", "--memory", there, "--output", "third", cwd=tmp_path)
    assert run.returncode == SUCCESS, run.stderr
    assert int(statement(fleet, "SELECT count(*) FROM learning.saca_cases")) > 7_000, "a new bank begins with the shipped cases"


def test_four_programs_import_at_once(fleet, cases, tmp_path):
    there = bank(fleet, "four")
    lines = cases.read_text().splitlines()
    for k in range(4):
        own = [json.loads(line) for line in lines[1:]]
        for one in own:
            one["source"] += f" of car {k}"
        (tmp_path / f"{k}.jsonl").write_text("\n".join([lines[0], *map(json.dumps, own)]) + "\n")
    programs = [subprocess.Popen([PROGRAM, "memory", "import", f"{k}.jsonl", "--memory", there], cwd=tmp_path, stderr=subprocess.PIPE)
                for k in range(4)]
    for program in programs:
        _, told = program.communicate(timeout=300)
        assert program.returncode == SUCCESS, told
    assert json.loads(saca("memory", "verify", "--json", "--memory", there, cwd=tmp_path).stdout)["cases"] == 4 * (len(lines) - 1)


def test_a_server_proves_who_it_is(fleet, tmp_path):
    statement(fleet, "DROP ROLE IF EXISTS car")
    statement(fleet, "CREATE ROLE car LOGIN PASSWORD 'secret word'; CREATE SCHEMA IF NOT EXISTS car AUTHORIZATION car")
    far = f"postgresql://car@localhost:{fleet['port']}/postgres?sslmode=verify-full&sslrootcert="
    (tmp_path / "pass").write_text(f"localhost:{fleet['port']}:*:car:secret word\n")
    (tmp_path / "pass").chmod(0o600)
    environment = {**os.environ, "PGPASSFILE": str(tmp_path / "pass")}
    trusted = far + str(fleet["folder"] / "root.crt")
    run = saca("memory", "add", "intersection_t1", "--policy", "ES-B-R", "--memory", trusted, cwd=tmp_path, env=environment)
    assert run.returncode == SUCCESS, run.stderr
    assert f"postgresql://car@localhost:{fleet['port']}/postgres: case 1" in run.stdout
    assert statement(fleet, "SELECT count(*) FROM car.saca_cases") == "1"

    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=root", "-keyout",
                    "other.key", "-out", "other.crt"], cwd=tmp_path, capture_output=True, check=True)
    told = one_error(saca("memory", "list", "--memory", far + str(tmp_path / "other.crt"), cwd=tmp_path, env=environment), BAD_INPUT)
    assert "certificate verify failed" in told
    named_otherwise = trusted.replace("localhost", "127.0.0.1")
    told = one_error(saca("memory", "list", "--memory", named_otherwise, cwd=tmp_path, env=environment), BAD_INPUT)
    assert "does not match host name" in told or "127.0.0.1" in told


def test_a_password_that_is_refused_is_not_printed(fleet, tmp_path):
    wrong = f"postgresql://saca:not%20this@localhost:{fleet['port']}/postgres"
    told = one_error(saca("memory", "list", "--memory", wrong, cwd=tmp_path), BAD_INPUT)
    assert "password authentication failed" in told and "not this" not in told and "not%20this" not in told
    unreadable = "postgresql://saca:not%20this@localhost:1/postgres?no=such"
    told = one_error(saca("memory", "list", "--memory", unreadable, cwd=tmp_path), BAD_INPUT)
    assert "not%20this" not in told and "postgresql://" in told


def test_a_replica_gives_and_takes_nothing(fleet, cases, tmp_path):
    there = bank(fleet, "followed")
    assert saca("memory", "import", cases, "--keep-trust", "--memory", there, cwd=tmp_path).returncode == SUCCESS
    home = folder()
    try:
        started = server("replica", home, fleet["folder"])
        if started.returncode != SUCCESS:  # its port is in the copied settings
            pytest.fail(started.stderr)
        follower = there.replace(str(fleet["folder"]), str(home))
        run = saca("memory", "export", "copy.jsonl", "--memory", follower, cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
        assert (tmp_path / "copy.jsonl").read_bytes() == cases.read_bytes()
        told = one_error(saca("memory", "add", "intersection_t1", "--policy", "ES-B-R", "--memory", follower, cwd=tmp_path), CANNOT_WRITE)
        assert "may only be read" in told
        run = quick("intersection_t1", "--memory", follower, "--no-learning", "--output", "out", cwd=tmp_path)
        assert run.returncode == SUCCESS, run.stderr
    finally:
        server("kill", home)
        shutil.rmtree(home, ignore_errors=True)


def test_a_server_that_is_not_there_is_told_at_once(tmp_path):
    for url in ("postgresql://saca@localhost:1/postgres", f"postgresql:///x?host={tmp_path}"):
        for command in (["memory", "list"], ["run", "intersection_t1", "--llm", "off", "--pace", "lockstep"]):
            told = one_error(saca(*command, "--memory", url, cwd=tmp_path), BAD_INPUT)
            assert re.search(r"cannot be read: connection to server .* failed", told)
