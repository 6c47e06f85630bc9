"""Programs checked, run and built from Python."""
import pytest

import orb_robot
from orb_robot import OrbError


def test_checks():
    found = orb_robot.check("RGB 300, 0, 0\n")
    assert [one.rule for one in found.errors] == ["value-out-of-range"]
    assert str(found).startswith("program.orb:1:5: error:") and found[0].help
    assert str(orb_robot.check("RGB 30, 0, 0\ndelay 100\n")) == "no findings"


def test_runs():
    run = orb_robot.run({"hello.bas": '10 print "hello"\n20 end\n'})
    assert run.prints == "hello\n" and run.reason == "end" and not run.faults
    with pytest.raises(OrbError) as raised:
        orb_robot.run("pritn 1\n")
    assert raised.value.code == 1 and raised.value.findings.errors
    assert "program.orb:1:1: error" in str(raised.value)


def test_tests():
    files = {"a.orb": 'print "hello"\n', "a.test": 'test "greets"\n  expect print "hello"\n'}
    document = orb_robot.test(files, names=["a.test"])
    assert document["schema"] == "orb.test/1"


def test_builds_and_assembles():
    assert orb_robot.build({"a.bas": "10 print 1\n"}).startswith(b"10 print 1")
    assert orb_robot.format({"a.bas": "10  print   1\n"}) == "10 print 1\n"
    assert "print" in orb_robot.lift("10 print 1\n20 end\n")
    (macro,) = orb_robot.assemble(".macro wink id=40\nrgb 255 0 0\nend\n")
    assert macro.id == 40 and macro.commands and macro.image


def test_packets_are_words():
    assert "wake" in orb_robot.decode(orb_robot.encode("wake"))[0]
    assert "roll" in orb_robot.decode(orb_robot.encode("roll", 80, 90, 1, kind="sprk+"))[0]
    with pytest.raises(ValueError, match="no direction"):
        orb_robot.decode(b"", direction="up")


@pytest.mark.parametrize("call", [
    lambda: orb_robot.check({"a.xyz": "1"}), lambda: orb_robot.check("1", names=["b"]),
    lambda: orb_robot.build("pritn"), lambda: orb_robot.assemble("nonsense"),
])
def test_says_why_there_is_no_answer(call):
    with pytest.raises(OrbError) as raised:
        call()
    assert str(raised.value)


@pytest.mark.parametrize("files, options, sentence", [
    (b"10 end", {}, "`files` is a text or a dictionary of names and contents, not b'10 end'"),
    (None, {}, "`files` is a text or"),
    ({"a.bas": None}, {}, "`a.bas` is a text or bytes, not None"),
    ({7: "10 end"}, {}, "a file's name is a text, not 7"),
    ("print \ud800", {}, "`program.orb` holds what is no text"),
    ({"a.bas": "10 end"}, {"names": [1]}, "`names` is a list of texts"),
    ({"a.bas": "10 end"}, {"names": "a.bas"}, "`names` is a list of texts, not 'a.bas'"),
    ({"a.bas": "10 end"}, {"stimuli": "at 2s shake"}, "`stimuli` is a list of texts"),
    ({"a.bas": "10 end"}, {"input": ["x"]}, "`input` is a list of whole numbers"),
    ({"a.bas": "10 end"}, {"input": 5}, "`input` is a list of whole numbers, not 5"),
    ({"a.bas": "10 end"}, {"line": "x"}, "`line` is a whole number from 1 to 65535, not 'x'"),
    ({"a.bas": "10 end"}, {"line": -1}, "`line` is a whole number from 1 to 65535, not -1"),
    ({"a.bas": "10 end"}, {"seed": "x"}, "`seed` is a whole number"),
    ({"a.bas": "10 end"}, {"seconds": "x"}, "`seconds` is a number"),
    ({"a.bas": "10 end"}, {"course": 1}, "`course` is a text"),
    ({"a.bas": "10 end"}, {"connected": "x"}, "`connected` is True or False, not 'x'"),
])
def test_says_what_a_value_is_not(files, options, sentence):
    with pytest.raises((TypeError, ValueError), match=sentence):
        orb_robot.run(files, **options)
