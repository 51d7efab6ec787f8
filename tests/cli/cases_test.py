"""`saca cases`: cases of recorded crashes."""
import html.parser
import json
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from chat_server import server  # noqa: E402, F401, a fixture
from program import BAD_INPUT, CANNOT_WRITE, SUCCESS, WRONG_COMMAND_LINE, figures, one_error, saca

QUICK = ("--draws", "2", "--told-draws", "2")
ACCIDENTS = "STATE,ST_CASE,YEAR,LGT_COND,RELJCT2,TYP_INT\n"
VEHICLES = ("STATE,ST_CASE,VEH_NO,BODY_TYP,BODY_TYPNAME,TRAV_SP,VSPD_LIM,VTRAFWAY,VNUM_LAN,VALIGN,VSURCOND,"
            "P_CRASH1,P_CRASH2,P_CRASH3,ACC_TYPE,IMPACT1\n")
PERSONS = "STATE,ST_CASE,VEH_NO,PER_TYP,AGE,STR_VEH,LOCATION\n"


def crash(number, *vehicles, light=1, junction=1):
    """Rows of one crash of 2016: of each vehicle its body, speed, P_CRASH2, ACC_TYPE and IMPACT1."""
    rows = "".join(f'4,{number},{k},{body},"Some, body",{speed},45,1,2,1,1,1,{event},99,{kind},{impact}\n'
                   for k, (body, speed, event, kind, impact) in enumerate(vehicles, 1))
    return f"4,{number},2016,{light},{junction},1\n", rows


def release(folder, *crashes, persons=""):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "accident.csv").write_text(ACCIDENTS + "".join(accident for accident, _ in crashes))
    (folder / "vehicle.csv").write_text(VEHICLES + "".join(rows for _, rows in crashes))
    (folder / "person.csv").write_text(PERSONS + "4,40001,1,1,40,0,0\n" + persons)
    return folder


@pytest.fixture(scope="module")
def fars(tmp_path_factory):
    """A rear-end crash, a crossing, a walker, one whose ego is a motorcycle, and one of a car alone."""
    return release(tmp_path_factory.mktemp("fars") / "az",
                   crash(40001, (4, 45, 51, 24, 12), (31, 20, 53, 25, 6)),
                   crash(40002, (4, 40, 66, 89, 9), (4, 998, 17, 88, 12), junction=2),
                   crash(40003, (4, 40, 80, 13, 12), light=3),
                   crash(40004, (80, 45, 51, 24, 12), (31, 20, 53, 25, 6)),
                   crash(40005, (4, 70, 13, 1, 12)),
                   persons="4,40003,0,5,30,1,11\n")


@pytest.fixture(scope="module")
def built(fars, tmp_path_factory):
    folder = tmp_path_factory.mktemp("cases")
    run = saca("cases", "build", fars, *QUICK, "--output", "cases.jsonl", "--for-memory", "plain.jsonl", "--json", cwd=folder)
    return folder, figures(run)


def documents(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_each_family_is_counted_with_its_share(built):
    _, told = built
    assert told["cases.num_crashes"] == 5 and told["cases.num_failed"] == 0
    assert told["cases.rear_end.num_crashes"] == 2 and told["cases.rear_end.share"] == 0.4
    assert told["cases.rear_end.ego_is_no_car"] == 1 and told["cases.rear_end.worked_on"] == 1
    assert told["cases.pedestrian.num_crashes"] == 1 and told["cases.ramp.num_crashes"] == 0
    assert told["cases.num_cases"] == 3
    assert sum(told[f"cases.best.{name}"] for name in ("AEB", "AES-L", "AES-R", "ES-B-L", "ES-B-R", "T-D-L", "T-D-R", "NI")) == 3


def test_a_case_has_its_record_and_says_what_is_assumed(built):
    folder, _ = built
    header, *cases = documents(folder / "cases.jsonl")
    assert header == {"schema": "saca.crash_cases/1", "cases": 3}
    rear_end = cases[0]
    assert rear_end["record"] == {"study": "FARS", "name": "fars_2016_40001", "state": "Arizona", "year": 2016, "number": 40001}
    assert rear_end["family"] == "rear_end" and rear_end["kind"] == "slower_lead" and rear_end["place"] == "road"
    facts = {(fact["about"], fact["key"]): fact for fact in rear_end["facts"]}
    assert facts["ego", "TRAV_SP"]["code"] == 45 and facts["other", "BODY_TYP"]["words"] == "pickup"
    assert facts["crash", "LGT_COND"]["words"] == "daylight"
    ranges = {entry["key"]: entry for entry in rear_end["ranges"]}
    assert ranges["ego_speed_mps"]["source"].startswith("recorded: ego's TRAV_SP 45 mph")
    assert ranges["ego_speed_mps"]["min"] == pytest.approx(40.5 * 0.44704)
    assert ranges["follower_gap_s"]["source"].startswith("assumption")
    assert ranges["ego_speed_mps"]["min"] <= rear_end["case"]["scene"]["ego"]["forward_mps"] <= ranges["ego_speed_mps"]["max"]


def test_the_recorded_crash_happens_without_avoidance(built):
    folder, _ = built
    for one in documents(folder / "cases.jsonl")[1:]:
        assert one["as_recorded"] and one["without_avoidance"]["first_actor"]
    crossing = next(one for one in documents(folder / "cases.jsonl")[1:] if one["family"] == "crossing")
    assert crossing["without_avoidance"]["ego_face"] == "left" and crossing["impact_agrees"], "ACC_TYPE 89, IMPACT1 9"


def test_what_is_admissible_is_what_the_arbiter_calls_so(built):
    folder, _ = built
    for one in documents(folder / "cases.jsonl")[1:]:
        assert any(plan["admissible"] for plan in one["plans"])
        for plan in one["plans"]:
            assert plan["admissible"] == (plan["harm"] <= one["admissible_harm"])
        driven = [entry["harm"] for entry in one["happened"] if entry]
        assert one["case"]["best_harm"] == one["happened"][one["case"]["best_policy"]]["harm"] <= min(driven) + 0.005
        assert one["case"]["details"]["draws"] == 2


def test_same_seed_same_bytes_whatever_the_threads_and_where_it_was_interrupted(fars, built, tmp_path):
    folder, _ = built
    again = saca("cases", "build", fars, *QUICK, "--output", "again.jsonl", "--threads", "1", cwd=tmp_path)
    assert again.returncode == SUCCESS, again.stderr
    assert "rear_end" in again.stdout and "3 cases of 5 crashes" in again.stdout
    assert (tmp_path / "again.jsonl").read_bytes() == (folder / "cases.jsonl").read_bytes()
    lines = (folder / "cases.jsonl.journal").read_text().splitlines(keepends=True)
    (tmp_path / "resumed.jsonl.journal").write_text("".join(lines[:2]) + lines[2][:80])  # killed while it wrote
    assert saca("cases", "build", fars, *QUICK, "--output", "resumed.jsonl", cwd=tmp_path).returncode == SUCCESS
    assert (tmp_path / "resumed.jsonl").read_bytes() == (folder / "cases.jsonl").read_bytes()
    other = saca("cases", "build", fars, *QUICK, "--seed", "2", "--output", "resumed.jsonl", cwd=tmp_path)
    assert "--seed 2" in one_error(other, BAD_INPUT)


def test_fewer_are_of_all_families_in_turn(fars, tmp_path):
    told = figures(saca("cases", "build", fars, *QUICK, "--count", "2", "--output", "two.jsonl", "--json", cwd=tmp_path))
    assert told["cases.rear_end.worked_on"] == told["cases.crossing.worked_on"] == 1
    assert told["cases.pedestrian.worked_on"] == 0


def test_memory_takes_them_over(built, tmp_path):
    folder, _ = built
    run = saca("memory", "import", folder / "plain.jsonl", "--memory", "bank.db", cwd=tmp_path)
    assert run.returncode == SUCCESS and "3 cases" in run.stdout, run.stderr


class Texts(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.texts, self.pictures, self.depth = [], 0, 0

    def handle_starttag(self, tag, attrs):
        self.pictures += tag == "svg" and self.depth == 0 and ("width", "0") not in attrs
        self.depth += tag == "svg"

    def handle_endtag(self, tag):
        self.depth -= tag == "svg"

    def handle_data(self, data):
        self.texts.append(data)


def test_a_page_shows_pictures_facts_and_harms(built, tmp_path):
    folder, _ = built
    run = saca("cases", "show", folder / "cases.jsonl", "--output", "page.html", "--json", cwd=tmp_path)
    told = figures(run)
    assert told["schema"] == "saca.cases_page/1" and len(told["shown"]) == told["cases"] == 3
    page = Texts()
    page.feed((tmp_path / "page.html").read_text())
    text = "".join(page.texts)
    assert page.pictures == 6, "without avoidance and the best, of each"
    assert "ST_CASE 40001" in text and "dark - lighted" in text and "recorded: ego's TRAV_SP 45 mph" in text
    assert "admissible plans" in text and "Without avoidance" in text
    one = saca("cases", "show", folder / "cases.jsonl", "--record", "fars_2016_40003", "--output", "one.html", cwd=tmp_path)
    assert one.returncode == SUCCESS and "1 of 3 cases" in one.stdout
    assert (tmp_path / "page.html").read_bytes() != (tmp_path / "one.html").read_bytes()


@pytest.mark.parametrize("name, text, message", [
    ("vehicle.csv", "STATE,ST_CASE,VEH_NO,BODY_TYP\n4,40001,1,4\n", "vehicle.csv: want a column TRAV_SP, got 4 columns without it"),
    ("accident.csv", "", "accident.csv: want a column ST_CASE"),
    ("person.csv", PERSONS, "person.csv: want at least one row, got none"),
    ("vehicle.csv", VEHICLES + "4,40001\n", "want 16 fields, got 2"),
])
def test_another_release_is_refused(tmp_path, name, text, message):
    folder = release(tmp_path / "az", crash(40001, (4, 45, 51, 24, 12), (31, 20, 53, 25, 6)))
    (folder / name).write_text(text)
    assert message in one_error(saca("cases", "build", folder, cwd=tmp_path), BAD_INPUT)
    assert not (tmp_path / "runs").exists()


def test_what_cannot_be_read_or_written_is_told(fars, built, tmp_path):
    folder, _ = built
    assert "want one file accident.csv, got 0" in one_error(saca("cases", "build", tmp_path, cwd=tmp_path), BAD_INPUT)
    assert "in two" in one_error(saca("cases", "build", fars, fars, cwd=tmp_path), BAD_INPUT)
    assert "got neither" in one_error(saca("cases", "build", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert "--drivers: want --hundred-car" in one_error(saca("cases", "build", tmp_path, "--drivers", "drivers.jsonl", cwd=tmp_path), WRONG_COMMAND_LINE)
    assert saca("cases", "build", fars, "--draws", "1", cwd=tmp_path).returncode == WRONG_COMMAND_LINE
    (tmp_path / "file").write_text("x")
    assert "file" in one_error(saca("cases", "build", fars, "--output", "file/cases.jsonl", cwd=tmp_path), CANNOT_WRITE)
    assert "file" in one_error(saca("cases", "show", folder / "cases.jsonl", "--output", "file/a.html", cwd=tmp_path), CANNOT_WRITE)
    assert "none.jsonl" in one_error(saca("cases", "show", "none.jsonl", cwd=tmp_path), BAD_INPUT)
    assert "of the family boat, got none of 3" in one_error(
        saca("cases", "show", folder / "cases.jsonl", "--family", "boat", cwd=tmp_path), BAD_INPUT)


@pytest.mark.parametrize("spoil, message", [
    (lambda text: "", "line 1: want cases, got nothing"),
    (lambda text: "".join(text.splitlines(keepends=True)[:-1]), "as line 1 says, got 2"),
    (lambda text: text.replace('"family":', '"kin":', 1), "line 2: family: is missing"),
    (lambda text: text.replace("saca.crash_cases/1", "saca.cases/1"), "line 1: schema: want saca.crash_cases/1"),
])
def test_what_is_no_such_file_is_refused(built, tmp_path, spoil, message):
    folder, _ = built
    (tmp_path / "cases.jsonl").write_text(spoil((folder / "cases.jsonl").read_text()))
    assert message in one_error(saca("cases", "show", "cases.jsonl", cwd=tmp_path), BAD_INPUT)


def examples(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_sets_hold_prompts_and_admissible_replies_of_one_record_each(built, tmp_path):
    folder, _ = built
    told = figures(saca("cases", "export", folder / "cases.jsonl", "--output", "sets", "--json", cwd=tmp_path))
    sets = {name: examples(tmp_path / "sets" / f"{name}.jsonl") for name in ("train", "calibration", "test")}
    records = {name: {one["record"] for one in lines[1:]} for name, lines in sets.items()}
    assert sum(len(names) for names in records.values()) == len(set().union(*records.values())) == 3
    for name, (header, *lines) in sets.items():
        assert header == {"schema": "saca.reply_examples/1", "examples": len(lines)}
        assert told[f"export.{name}.num_examples"] == len(lines)
        for one in lines:
            assert one["set"] == name and one["prompt"].startswith("ego: ")
            assert one["choice"] in one["admissible"] and one["reply"].endswith(f"\nResponse to user: {one['choice']}")
            assert one["forecast"][one["choice"]] <= min(harm for harm in one["forecast"] if harm is not None) + 0.05
            assert one["twin"] == all(harm is None for harm in one["known"])
    assert "FARS" in (tmp_path / "sets" / "README.md").read_text()
    assert (tmp_path / "sets" / "system.txt").read_text().endswith("from 0 to 7.")


def test_sets_are_the_same_again_and_other_words_come_of_another_seed(built, tmp_path):
    folder, _ = built
    texts = []
    for output, seed in (("a", 1), ("b", 1), ("c", 2)):
        figures(saca("cases", "export", folder / "cases.jsonl", "--output", output, "--seed", seed, "--json", cwd=tmp_path))
        texts.append("".join((tmp_path / output / f"{name}.jsonl").read_text() for name in ("train", "calibration", "test")))
    assert texts[0] == texts[1] != texts[2]


# As the guide to supervised fine-tuning of chat models has it: messages with a role and a text, the assistant's the last.
def test_chats_have_the_form_that_fine_tuning_takes(built, tmp_path):
    folder, _ = built
    figures(saca("cases", "export", folder / "cases.jsonl", "--format", "openai", "--output", "sets", "--json", cwd=tmp_path))
    chats = [chat for name in ("train", "calibration", "test") for chat in examples(tmp_path / "sets" / f"{name}.jsonl")]
    assert len(chats) >= 3
    for chat in chats:
        assert list(chat) == ["messages"] and [one["role"] for one in chat["messages"]] == ["system", "user", "assistant"]
        assert all(one["content"].strip() for one in chat["messages"])


def test_chats_are_checked(built, tmp_path):
    folder, _ = built
    figures(saca("cases", "export", folder / "cases.jsonl", "--format", "openai", "--output", "sets", "--json", cwd=tmp_path))
    chat = next(line for name in ("train", "calibration", "test") for line in (tmp_path / "sets" / f"{name}.jsonl").read_text().splitlines())
    (tmp_path / "chats.jsonl").write_text((chat + "\n") * 10)
    told = json.loads(saca("cases", "check", "chats.jsonl", "--json", cwd=tmp_path).stdout)
    assert told["schema"] == "saca.chat_sets/1" and told["sets"][0]["examples"] == 10
    assert told["sets"][0]["tokens_at_most"] == 10 * told["sets"][0]["longest_tokens_at_most"] > 10 * 500
    (tmp_path / "spoilt.jsonl").write_text((chat + "\n") * 10 + chat.replace('"user"', '"robot"') + "\n")
    run = saca("cases", "check", "chats.jsonl", "spoilt.jsonl", cwd=tmp_path)
    assert "spoilt.jsonl: line 11: " in one_error(run, BAD_INPUT) and "robot" in run.stderr and "messages[1]" in run.stderr
    assert "want at least 10 examples" in one_error(saca("cases", "check", "sets/test.jsonl", cwd=tmp_path), BAD_INPUT)
    assert "none.jsonl" in one_error(saca("cases", "check", "none.jsonl", cwd=tmp_path), BAD_INPUT)


def test_prompts_tell_of_the_case_that_a_memory_would_recall(built, tmp_path):
    folder, _ = built
    saca("memory", "import", folder / "plain.jsonl", "--keep-trust", "--memory", "bank.sqlite", cwd=tmp_path)
    figures(saca("cases", "export", folder / "cases.jsonl", "--memory", "bank.sqlite", "--output", "sets", "--json", cwd=tmp_path))
    prompts = [one["prompt"] for name in ("train", "calibration", "test") for one in examples(tmp_path / "sets" / f"{name}.jsonl")[1:]]
    assert all("% alike" in prompt for prompt in prompts)


def test_what_cannot_be_exported_is_told(built, tmp_path):
    folder, _ = built
    cases = documents(folder / "cases.jsonl")
    crossing = [dict(case, kind="cyclist") for case in cases[1:]]
    (tmp_path / "cyclists.jsonl").write_text("\n".join(json.dumps(line) for line in [cases[0], *crossing]) + "\n")
    assert "0 recorded ones and 3 of families for tests" in one_error(
        saca("cases", "export", "cyclists.jsonl", cwd=tmp_path), BAD_INPUT)
    assert "none.jsonl" in one_error(saca("cases", "export", "none.jsonl", cwd=tmp_path), BAD_INPUT)
    assert "none.sqlite" in one_error(
        saca("cases", "export", folder / "cases.jsonl", "--memory", "none.sqlite", cwd=tmp_path), BAD_INPUT)
    (tmp_path / "file").write_text("x")
    assert "file" in one_error(saca("cases", "export", folder / "cases.jsonl", "--output", "file/a", cwd=tmp_path), CANNOT_WRITE)


def key_of(prompt):
    """FNV-1a, 64 bits, as its authors publish it."""
    key = 0xCBF29CE484222325
    for byte in prompt.encode():
        key = (key ^ byte) * 0x100000001B3 % 2**64
    return f"{key:016x}"


@pytest.fixture(scope="module")
def hand_written(built, tmp_path_factory):
    """For each example a reply that says its expert's choice, though it begins with braking; and in which set there is one."""
    folder, _ = built
    made = tmp_path_factory.mktemp("replies")
    figures(saca("cases", "export", folder / "cases.jsonl", "--output", "sets", "--json", cwd=made))
    known = {name: examples(made / "sets" / f"{name}.jsonl")[1:] for name in ("train", "calibration", "test")}
    name = max(known, key=lambda one: sum(not example["twin"] for example in known[one]))
    replies = {}
    for example in known[name]:
        answers = [{"after_ns": 1_000_000 * (k + 1), "kind": kind, "probability": [float(policy == choice) for policy in range(8)]}
                   for k, (kind, choice) in enumerate((("first", 0), ("ended", example["choice"])))]
        replies[key_of(example["prompt"])] = {"prompt": example["prompt"], "reasoning": example["reply"][:-2], "prompt_tokens": 400,
                                              "reply_tokens": 80, "answers": answers}
    file = made / "replies.json"
    file.write_text(json.dumps({"schema": "saca.replies/1", "model": "by hand", "replies": replies}))
    return folder, file, name, known[name]


def test_a_model_is_scored_beside_simple_rules(hand_written, tmp_path):
    folder, file, name, known = hand_written
    asked = ("cases", "eval", folder / "cases.jsonl", "--llm", f"replay:{file}", "--set", name, "--output", "replies.jsonl")
    told = figures(saca(*asked, "--json", cwd=tmp_path))
    real = [one for one in known if not one["twin"]]
    assert told["eval.num_examples"] == len(known) and told["eval.num_known"] == len(real) >= 1
    assert told["eval.ended"] == told["eval.text_and_answer_agree"] == told["eval.true_replies"] == 1.0
    assert told["eval.statements_checked"] >= 2.0 and told["eval.tokens.max"] == 80
    harm = lambda choice: sum(choice(one) for one in real) / len(real)
    assert told["eval.model.harm"] == told["eval.expert.harm"] == pytest.approx(harm(lambda one: one["known"][one["choice"]]))
    assert told["eval.model_at_once.harm"] == told["eval.aeb.harm"] == pytest.approx(harm(lambda one: one["known"][0]))
    assert told["eval.best_within.harm"] == pytest.approx(harm(lambda one: min(one["known"][k] for k in one["admissible"])))
    assert told["eval.expert.best_within"] == 1.0 and told["eval.expert.admissible"] == 1.0
    header, *lines = examples(tmp_path / "replies.jsonl")
    assert header == {"schema": "saca.example_replies/2", "replies": len(known)}
    assert [one["example"]["prompt"] for one in lines] == [one["prompt"] for one in known]
    again = saca(*asked, cwd=tmp_path)  # from the journal
    assert again.returncode == SUCCESS and "always AEB" in again.stdout and "by hand" in again.stdout


def test_what_cannot_be_scored_is_told(hand_written, tmp_path):
    folder, file, name, _ = hand_written
    ask = lambda *more: saca("cases", "eval", folder / "cases.jsonl", "--set", name, *more, cwd=tmp_path)
    assert "want a language model to ask, got `off`" in one_error(ask("--llm", "off"), BAD_INPUT)
    assert "none.gguf" in one_error(ask("--llm", "local:none.gguf"), BAD_INPUT)
    assert ask("--set", "dev").returncode == WRONG_COMMAND_LINE
    (tmp_path / "file").write_text("x")
    assert "file" in one_error(ask("--llm", f"replay:{file}", "--output", "file/a"), CANNOT_WRITE)
    nobody = tmp_path / "nobody.json"
    nobody.write_text(json.dumps({"schema": "saca.replies/1", "model": "by hand", "replies": {}}))
    assert "goes on there" in one_error(ask("--llm", f"replay:{nobody}"), BAD_INPUT)
    assert len((tmp_path / "runs/replies.jsonl.journal").read_text().splitlines()) == 1, "no row without its answers is kept"


def test_a_model_that_dies_while_it_is_scored_is_gone_on_with(server, hand_written, tmp_path):
    folder, _, name, known = hand_written
    model = f"some-model@http://127.0.0.1:{server.server_address[1]}/v1"
    asked = ("cases", "eval", folder / "cases.jsonl", "--llm", model, "--set", name, "--output", "replies.jsonl")
    server.refuses_after = 1
    died = saca(*asked, cwd=tmp_path)
    assert died.returncode == BAD_INPUT and "--llm: " in died.stderr and "goes on there" in died.stderr.splitlines()[-1]
    kept = len((tmp_path / "replies.jsonl.journal").read_text().splitlines()) - 1
    server.refuses_after = None
    figures_now = figures(saca(*asked, "--json", cwd=tmp_path))
    assert figures_now["eval.num_examples"] == len(known) and figures_now["eval.num_failed"] == 0
    assert kept < len((tmp_path / "replies.jsonl.journal").read_text().splitlines()) - 1
