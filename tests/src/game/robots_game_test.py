"""`hogline game` with both robots on the simulated rink, seen by the oracle, against a foreign Digital Curling client.

usage: robots_game_test.py HOGLINE SOURCE_DIR
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

HOGLINE, SOURCE = sys.argv[1:3]
CLIENT = os.path.join(SOURCE, "tests", "peers", "digital_curling_client.py")


class Game:
    """One under way: the program, and a client for each of the teams named in `misbehaviours` (None: it behaves)."""

    def __init__(self, test, misbehaviours, *words):
        self.folder = tempfile.TemporaryDirectory()
        test.addCleanup(self.folder.cleanup)
        seats = [word for team in misbehaviours for word in ("--" + team, "dc:0")]
        self.program = subprocess.Popen([HOGLINE, "game", "--ends", "1", "--out", self.folder.name, *seats, *words],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        test.addCleanup(self.program.kill)  # where a test has failed before its end
        self.clients = {}
        self.stderr = ""
        for team, kind in misbehaviours.items():
            port = self.port_of(team)
            self.clients[team] = subprocess.Popen(["python3", CLIENT, port, "foreign"] + ([kind] if kind else []),
                                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def port_of(self, team):
        for line in self.program.stderr:
            self.stderr += line
            found = re.match(team + r" waits for its client at 127\.0\.0\.1:(\d+)", line)
            if found:
                return found.group(1)
        raise RuntimeError("the program ended: " + self.stderr)

    def end(self):
        """The exit status, the events, and what each client said."""
        out, err = self.program.communicate(timeout=280)
        self.stderr += err
        told = {}
        for team, client in self.clients.items():
            said, _ = client.communicate("\n" * 20, timeout=60)
            told[team] = [json.loads(line) for line in said.splitlines()]
        return self.program.returncode, [json.loads(line) for line in out.splitlines()], told

    def throws(self):
        with open(os.path.join(self.folder.name, "throws.csv"), encoding="utf-8") as f:
            return list(csv.DictReader(f))

    def figures(self):
        with open(os.path.join(self.folder.name, "figures.json"), encoding="utf-8") as f:
            return json.load(f)


class AnEnd(unittest.TestCase):
    def test_of_a_client_and_the_built_in_strategist_agrees_with_the_truth(self):
        game = Game(self, {"team1": None}, "--seed", "7")
        status, events, told = game.end()
        self.assertEqual(status, 0, game.stderr)
        last = told["team1"][-1]
        self.assertEqual((last["end"], last["problems"]), ("game over", []))
        thrown = [e for e in events if e["event"] == "throw"]
        self.assertEqual(len(thrown) % 16, 0)
        self.assertGreaterEqual(len(thrown), 16)
        self.assertEqual([e["event"] for e in events[:3]], ["practice", "practice", "begin"])
        self.assertEqual(events[-1]["score"], [sum(points) for points in zip(*last["scores"])])
        figures = game.figures()
        self.assertEqual(figures["turns"], len(thrown) + 2, "and the practice")
        self.assertEqual((figures["disagreements"], figures["struck_wrong"]), (0, 0))
        self.assertGreater(figures["struck"], 3, "an end without collisions shows little")
        self.assertLess(figures["worst_m"], 0.03)


class Misbehaviour(unittest.TestCase):
    """Each ends in a clear message, and no robot throws what was not decided."""

    def check_stops(self, team, kind, reason, most_throws=0, words=()):
        with self.subTest(kind):
            game = Game(self, {team: kind}, "--practice", "0", *words)
            status, events, _ = game.end()
            self.assertEqual(status, 1, game.stderr)
            self.assertEqual(events[-1]["event"], "stopped")
            self.assertRegex(events[-1]["reason"], "^" + team + "'s strategist ")
            self.assertIn(reason, events[-1]["reason"])
            self.assertIn(reason, game.stderr)
            done = game.throws()
            self.assertLessEqual(len(done), most_throws)
            for throw in done:  # what ran was let go as the other one had decided, and followed to its end
                self.assertEqual((throw["outcome"], throw["attempts"], throw["team"]), ("thrown", "1", "0"))

    def test_in_its_own_turn(self):
        for kind, reason in (("bad-json", "sent what is not understood as move: it is no JSON"),
                             ("wrong-cmd", "cmd must be 'move' now, not 'ready_ok'"),
                             ("vanish", "vanished: "),
                             ("huge-line", "sent a line of more than 65536 bytes"),
                             ("nan", "it is no JSON"),
                             ("infinite", "number overflow parsing '1e999'"),
                             ("rotation", "move.rotation must be 'cw' or 'ccw', not 'left'"),
                             ("two-moves", "spoke when it was not its turn")):
            self.check_stops("team0", kind, reason)

    def test_before_the_game(self):
        self.check_stops("team0", "never", "did not connect within 1 s", words=("--connect", "1"))

    def test_in_the_others_turn(self):  # whose stone may run by then
        self.check_stops("team1", "out-of-turn", "spoke when it was not its turn", most_throws=1)
        self.check_stops("team1", "vanish-waiting", "vanished: ", most_throws=1)

    def test_who_is_too_slow_loses_and_nothing_is_thrown(self):
        for kind in ("late", "slow"):
            with self.subTest(kind):
                game = Game(self, {"team0": kind}, "--practice", "0", "--thinking", "1")
                status, events, _ = game.end()
                self.assertEqual(status, 0, game.stderr)
                self.assertEqual(events[-1]["result"], {"winner": "team1", "reason": "time_limit"})
                self.assertIn("did not decide within its 1 s", game.stderr)
                self.assertEqual(game.throws(), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
