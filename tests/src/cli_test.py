#!/usr/bin/env python3
"""The program's edges: wrong use is exit status 2 and one line that says what is allowed. cli_test.py HOGLINE SOURCE_DIR"""
import fcntl
import importlib.util
import json
import math
import os
import re
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

HOGLINE, SOURCE = os.path.abspath(sys.argv[1]), sys.argv[2]
RIG = os.path.join(SOURCE, "config/rigs/practice.yaml")
SCENE = os.path.join(SOURCE, "tests/data/near/near-11-000.jpg")


def run(*words):
    return subprocess.run([HOGLINE, *words], capture_output=True, text=True, timeout=120)


class WrongUse(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def file(self, name, content):
        path = os.path.join(self.folder.name, name)
        with open(path, "wb") as f:
            f.write(content)
        return path

    def rig(self, old, new):
        with open(RIG, encoding="utf-8") as f:
            text = f.read()
        self.assertIn(old, text)
        return self.file("rig.yaml", text.replace(old, new, 1).encode())

    def refuses(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_not_a_number_is_no_number(self):
        for words in (["game", "--thinking", "nan"], ["game", "--connect", "inf"], ["skip", "--far-hz", "nan"],
                      ["skips", "--near-hz", ""], ["link", "--rig", RIG, "--seconds", "nan"]):
            result = run(*words)
            self.assertEqual(result.returncode, 2, words)
            self.assertIn("is no number from", result.stderr)

    def test_no_fault_of_that_name(self):
        self.refuses(run("faults", "--only", "nosuch"), "--only", "nosuch", "doc/faults.md")
        self.refuses(run("faults", "--only", "Gyro", "--out", self.folder.name), "--out", "is a folder")

    def test_the_oracle_records_nothing(self):
        self.refuses(run("skip", "--oracle", "--record", os.path.join(self.folder.name, "r")), "--record", "oracle")

    def test_a_missing_picture(self):
        self.refuses(run("pose", "--rig", RIG, "--camera", "near", "nowhere.jpg"), "nowhere.jpg", "no such picture")

    def test_a_missing_rig(self):
        self.refuses(run("pose", "--rig", "nowhere.yaml", "--camera", "near", SCENE), "nowhere.yaml", "no such file")

    def test_an_unknown_key(self):
        self.refuses(run("pose", "--rig", self.rig("gamma: 1.0", "gamma: 1.0\n    colour: 3"), "--camera", "near", SCENE),
                     "cameras.near.colour", "unknown key")

    def test_a_missing_key(self):
        self.refuses(run("pose", "--rig", self.rig("    fx_px: 780.0\n", ""), "--camera", "near", SCENE),
                     "cameras.near.fx_px", "missing")

    def test_a_zero_focal_length(self):
        self.refuses(run("pose", "--rig", self.rig("fx_px: 780.0", "fx_px: 0"), "--camera", "near", SCENE),
                     "rig.yaml", "cameras.near.fx_px", "= 0", "above 0")

    def test_not_a_number(self):
        self.refuses(run("pose", "--rig", self.rig("fx_px: 780.0", "fx_px: .nan"), "--camera", "near", SCENE),
                     "cameras.near.fx_px", "finite")

    def test_a_wrong_unit(self):
        self.refuses(run("pose", "--rig", self.rig("fx_px: 780.0", "fx_mm: 4.2"), "--camera", "near", SCENE),
                     "cameras.near.fx_mm", "did you mean fx_px?")

    def test_a_camera_the_rig_lacks(self):
        self.assertEqual(run("pose", "--rig", RIG, "--camera", "far", SCENE).returncode, 2)

    def test_a_speed_beyond_the_robots(self):
        self.refuses(run("throw", "--speed", "9"), "--speed", "limits.max_speed_mps")

    def test_an_unknown_fault(self):
        self.assertEqual(run("throw", "--fault", "earthquake@1").returncode, 2)

    def test_a_doctor_without_a_rig(self):
        self.assertEqual(run("doctor").returncode, 2)
        self.refuses(run("doctor", "--rig", "nowhere.yaml"), "nowhere.yaml", "no such file")

    def test_a_doctor_for_steel_without_a_can_interface(self):
        rig = self.rig("can: {interface: can0}", "")
        with open(rig, encoding="utf-8") as f:
            text = f.read().replace("source: {simulated: {},", "source: {video: {path: run.mp4},", 1)
        self.refuses(run("doctor", "--rig", self.file("rig.yaml", text.encode())), "can.interface", "missing")

    def part(self, *sections, edits=()):
        """A rig with these of the practice rig's sections alone."""
        with open(RIG, encoding="utf-8") as f:
            parts = re.split(r"(?m)^(?=[a-z]+:)", f.read())
        text = "".join(p for p in parts if p.split(":")[0] in ("cameras", "sheet", "ice", "stone", *sections))
        for old, new in edits:
            self.assertIn(old, text)
            text = text.replace(old, new)
        return self.file("part.yaml", text.encode())

    def test_a_doctor_examines_what_a_rig_declares(self):
        for sections, devices in (((), ["near camera", "low camera"]), (("can",), ["CAN bus"]),
                                  (("can", "head"), ["CAN bus", "pan", "tilt"]), (("gyro",), ["gyro"])):
            edits = [("interface: can0", "interface: nosuchcan0")] if "can" in sections else []
            result = run("doctor", "--json", "--rig", self.part(*sections, edits=edits))
            found = [d["device"] for d in json.loads(result.stdout)["devices"]]
            self.assertEqual(found[:len(devices)], devices)
            self.assertEqual(len(found), len(devices) if not sections else len(devices) + 2)
            self.assertEqual(result.returncode, 1 if sections else 0, result.stdout)

    def test_a_gripper_without_a_line(self):
        self.refuses(run("doctor", "--rig", self.part("gripper")), "modbus", "missing", "gripper")

    def test_a_number_in_quotes(self):
        self.refuses(run("pose", "--rig", self.rig("fx_px: 780.0", 'fx_px: "780"'), "--camera", "near", SCENE),
                     "cameras.near.fx_px", "text in quotes", "above 0")

    def test_whole_numbers(self):
        for words in (["game", "--ends", "1.5"], ["keys", "--out", "/proc/x", "--domain", "1.5"], ["skips", "--jobs", "2.0"]):
            self.refuses(run(*words), words[-2], "no whole number from")

    def test_pictures_that_are_no_files(self):
        for path, told in (("/dev/zero", "is not a file"), ("", "name a file"), ("nope.jpg", "no such picture")):
            self.refuses(run("stones", "--rig", RIG, SCENE, path), told)
        self.refuses(run("stones", "--rig", RIG, SCENE, self.folder.name), "is a folder")

    def test_an_empty_value_after_an_equals_sign(self):
        self.refuses(run("stones", "--rig", RIG, "--camera", "far", "--at=", SCENE), "--at", "is empty")

    def test_two_clients_on_one_port(self):
        for command in (["game", "--outcome-model"], ["game"]):
            self.refuses(run(*command, "--team0", "dc:40111", "--team1", "dc:40111"), "--team0", "--team1", "40111")

    def test_an_address_of_another_machine(self):
        result = run("game", "--outcome-model", "--team0", "dc:0", "--address", "192.0.2.1", "--out", self.folder.name)
        self.assertEqual(result.returncode, 3, result.stderr)
        for word in ("--team0", "--address", "192.0.2.1"):
            self.assertIn(word, result.stderr)

    def test_a_mistyped_subcommand(self):
        self.refuses(run("dcotor", "--rig", RIG), "dcotor", "did you mean doctor?", "pose", "faults")
        self.refuses(run("xylophone"), "xylophone", "throw")

    def test_a_mistyped_option(self):
        self.refuses(run("--helpp"), "--helpp", "did you mean --help?")
        self.refuses(run("throw", "--sped", "2"), "--sped", "hogline throw --help")

    def test_an_empty_value(self):
        for words in (["throw", "--out", ""], ["throw", "--learn", ""], ["stones", "--rig", "", SCENE],
                      ["skip", "--ice", ""], ["campaign", "--throws", "1", "--rig", ""]):
            self.refuses(run(*words), words[words.index("") - 1], "is empty")

    def test_options_that_contradict_each_other(self):
        for words in (["throw", "--from", "a:1", "--speed", "2"], ["skip", "--number", "3", "--throw", "draw"],
                      ["campaign", "--throws", "1", "--per-fault", "2"],
                      ["campaign", "--throws", "1", "--tee-draws", "--speed", "2"],
                      ["campaign", "--throws", "1", "--faults", "all"],
                      ["game", "--outcome-model", "--rig", RIG],
                      ["pose", "--rig", RIG, "--camera", "near", "--rate", "30", SCENE]):
            self.refuses(run(*words), words[0], "--help")

    def test_orders_that_nobody_would_throw(self):
        rig = os.path.join(SOURCE, "config/rigs/skip_live.yaml")
        for words in (["--speed", "99"], ["--speed", "-1"], ["--heading-deg", "80"], ["--spin", "nan"]):
            self.refuses(run("order", "--rig", rig, *words), words[0])
        self.refuses(run("order", "--rig", os.path.join(SOURCE, "config/rigs/thrower.yaml")), "link.robot", "skip")

    def test_what_is_missing(self):
        self.refuses(run("campaign"), "--throws", "missing")
        self.refuses(run("sights"), "--throws", "required")
        self.refuses(run("throw", "--fault", "gyro-silent"), "KIND@SECONDS")

    def test_results_that_can_not_be_written(self):
        for words in (["game", "--out"], ["stones", "--rig", RIG, SCENE, "--draw"],
                      ["board", "--rig", RIG, SCENE, "--out"], ["throw", "--out"], ["sights", "--throws", "1", "--out"],
                      ["faults", "--out"]):
            self.refuses(run(*words, "/proc/none/of/this"), words[-1], "can be written to")

    def test_a_skip_is_not_examined_on_the_throwers_rink(self):
        self.refuses(run("doctor", "--simulated", "--rig", os.path.join(SOURCE, "config/rigs/skip.yaml")), "thrower")

    def test_no_subcommand(self):
        self.assertEqual(run().returncode, 2)


class OneFolderOneProgram(unittest.TestCase):
    """A folder that a command fills over time is one program's at a time."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = os.path.join(self.folder.name, "out")

    def tearDown(self):
        self.folder.cleanup()

    def test_a_folder_in_use_is_refused(self):
        os.mkdir(self.out)
        held = os.open(self.out, os.O_RDONLY | os.O_DIRECTORY)
        try:
            fcntl.flock(held, fcntl.LOCK_EX)
            for words in (["game", "--outcome-model"], ["game"], ["turn"], ["demo"], ["throw"], ["skip"], ["skips"],
                          ["campaign", "--throws", "1"], ["campaign", "--faults", "all"], ["sights", "--throws", "1"],
                          ["track", "--rig", os.path.join(SOURCE, "config/rigs/skip.yaml"), SOURCE]):
                refused = run(*words, "--out", self.out)
                self.assertEqual(refused.returncode, 2, words)
                self.assertIn("another program is writing into this folder", refused.stderr)
                self.assertIn(self.out, refused.stderr)
        finally:
            os.close(held)
        self.assertEqual(os.listdir(self.out), [])

    def test_a_dead_game_leaves_its_folder_free(self):
        with subprocess.Popen([HOGLINE, "game", "--outcome-model", "--team0", "dc:0", "--connect", "100", "--out", self.out],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as waiting:
            self.assertIn("waits for its client", waiting.stderr.readline())
            refused = run("game", "--outcome-model", "--ends", "1", "--out", self.out)
            self.assertEqual((refused.returncode, refused.stdout), (2, ""))
            waiting.kill()
        played = run("game", "--outcome-model", "--ends", "1", "--out", self.out)
        self.assertEqual(played.returncode, 0, played.stderr)

    def test_a_turn_writes_into_its_own_folder_alone(self):
        result = subprocess.run([HOGLINE, "turn", "--seed", "3", "--out", "mine"], capture_output=True, text=True,
                                check=False, cwd=self.folder.name)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(os.listdir(self.folder.name), ["mine"])
        self.assertNotIn("game.jsonl", os.listdir(os.path.join(self.folder.name, "mine")))


class Link(unittest.TestCase):
    """Keys and the link's own command; what goes over the wire is tested in tests/hw/link."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def test_keys_are_made_once(self):
        keys = os.path.join(self.folder.name, "keys")
        made = run("keys", "--out", keys, "--domain", "7", "--observer", "coach")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("coach.permissions.p7s", made.stdout)
        again = run("keys", "--out", keys, "--domain", "7")
        self.assertEqual(again.returncode, 2)
        self.assertIn("holds a team's keys", again.stderr)

    def test_wrong_uses_of_keys(self):
        for words in (["--domain", "233"], ["--days", "0"], ["--skip", "a/b"], ["--observer", "skip"]):
            refused = run("keys", "--out", os.path.join(self.folder.name, "none"), *words)
            self.assertEqual(refused.returncode, 2, words)

    def test_names_whose_files_would_collide(self):
        keys = os.path.join(self.folder.name, "none")
        for words, told in ((["--observer", "ca"], "'ca'"), (["--skip", "CA"], "'CA'"), (["--thrower", "identity_ca"], "'identity_ca'"),
                            (["--observer", "permissions_ca"], "own files"), (["--observer", "governance"], "own files"),
                            (["--observer", "thrower"], "two robots"), (["--observer", "Skip"], "two robots"),
                            (["--observer", "a", "--observer", "a"], "two robots"), (["--observer", "../a"], "no name"),
                            (["--observer", "a.key"], "no name"), (["--observer", "x" * 65], "no name")):
            refused = run("keys", "--out", keys, *words)
            self.assertEqual(refused.returncode, 2, words)
            self.assertIn(told, refused.stderr)
            self.assertFalse(os.path.exists(keys), words)

    def test_a_folder_with_a_robots_keys(self):
        keys = os.path.join(self.folder.name, "keys")
        os.mkdir(keys)
        own = os.path.join(keys, "skip.key.pem")
        with open(own, "w", encoding="utf-8") as f:
            f.write("a key")
        refused = run("keys", "--out", keys)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("skip.key.pem", refused.stderr)
        with open(own, encoding="utf-8") as f:
            self.assertEqual(f.read(), "a key")
        self.assertEqual(run("keys", "--out", own).returncode, 2)

    def test_a_disk_that_is_full_leaves_no_keys_behind(self):
        def small_files(limit):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        for limit in (0, 400, 1000):
            keys = os.path.join(self.folder.name, "deep", "keys")
            failed = subprocess.run([HOGLINE, "keys", "--out", keys], capture_output=True, text=True, check=False,
                                    preexec_fn=lambda: small_files(limit))
            self.assertEqual(failed.returncode, 3, failed.stdout)
            self.assertIn("no keys were made", failed.stderr)
            self.assertEqual(os.listdir(self.folder.name), [])
        self.assertEqual(run("keys", "--out", keys).returncode, 0)

    def test_a_folder_that_can_not_be_made(self):
        for folder in ("/proc/x", "/proc/self/x/y"):
            failed = run("keys", "--out", folder)
            self.assertEqual(failed.returncode, 3, failed.stderr)
            self.assertIn(folder[:7], failed.stderr)

    def test_a_rig_without_a_link(self):
        refused = run("link", "--rig", RIG)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("link", refused.stderr)

    def lonely_skip(self):
        path = os.path.join(self.folder.name, "skip.yaml")
        with open(RIG, encoding="utf-8") as rig, open(path, "w", encoding="utf-8") as f:
            f.write(rig.read() + f"\nlink: {{robot: skip, peers: [thrower], domain: {os.getpid() % 200}, interface: lo}}\n")
        return path

    def test_alone_on_the_link(self):
        alone = run("link", "--rig", self.lonely_skip(), "--seconds", "0.2", "--json")
        self.assertEqual(alone.returncode, 1, alone.stderr)
        self.assertEqual(json.loads(alone.stdout)["presence"], "not heard")

    def test_ctrl_c_ends_the_listening_and_what_was_heard_is_told(self):
        with subprocess.Popen([HOGLINE, "link", "--rig", self.lonely_skip(), "--seconds", "86400", "--json"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as listener:
            self.wait_until_caught(listener, signal.SIGINT)
            listener.send_signal(signal.SIGINT)
            out, err = listener.communicate(timeout=60)
            self.assertEqual(listener.returncode, 1, err)
            self.assertEqual(json.loads(out)["presence"], "not heard")

    def wait_until_caught(self, process, number):
        """Returns once the process has a handler of its own for the signal."""
        while process.poll() is None:
            with open(f"/proc/{process.pid}/status", encoding="utf-8") as f:
                caught = next(line for line in f if line.startswith("SigCgt")).split()[1]
            if int(caught, 16) >> (number - 1) & 1:
                return
            time.sleep(0.01)
        self.fail("ended before it listened: " + process.stderr.read())


class Pose(unittest.TestCase):
    def test_prints_one_json_object_a_picture(self):
        result = run("pose", "--rig", RIG, "--camera", "near", SCENE, SCENE)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual(len(lines), 2)
        for key in ("image", "ok", "yaw_deg", "x_m", "y_m", "hog_distance_m", "sheet_width_m", "eMc", "sigma",
                    "residual_px", "elapsed_ms", "reason"):
            self.assertIn(key, lines[0])
        self.assertEqual(len(lines[0]["eMc"]), 16)
        self.assertIsNone(lines[0]["reason"])

    def test_tracks_the_frames_of_a_sequence(self):
        result = run("pose", "--rig", RIG, "--camera", "near", "--sequence", "--rate", "60", SCENE, SCENE, SCENE)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([line["features"][0] for line in lines], ["acquired", "tracked", "tracked"])
        self.assertAlmostEqual(lines[0]["yaw_deg"], lines[2]["yaw_deg"], delta=0.005)

    def test_output_that_can_not_be_written_is_a_failure(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([HOGLINE, "pose", "--rig", RIG, "--camera", "near", SCENE], stdout=full,
                                    stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(result.returncode, 3)
        self.assertIn("output", result.stderr)

    def test_a_picture_of_another_size_is_not_estimated(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(RIG, encoding="utf-8") as f:
                text = f.read().replace("width_px: 1600", "width_px: 1280", 1)
            rig = os.path.join(folder, "rig.yaml")
            with open(rig, "w", encoding="utf-8") as f:
                f.write(text)
            result = run("pose", "--rig", rig, "--camera", "near", SCENE)
        self.assertEqual(result.returncode, 1)
        line = json.loads(result.stdout)
        self.assertFalse(line["ok"])
        self.assertTrue(line["reason"])

    def test_a_picture_that_can_not_be_read_does_not_end_the_others(self):
        with tempfile.TemporaryDirectory() as folder:
            half = os.path.join(folder, "half.jpg")
            note = os.path.join(folder, "note.jpg")
            with open(SCENE, "rb") as f, open(half, "wb") as g:
                g.write(f.read()[:300000])
            with open(note, "wb") as f:
                f.write(b"this is no picture\n" * 50)
            for command in (("pose", "--camera", "near"), ("pose", "--camera", "near", "--sequence"), ("stones",)):
                result = run(*command, "--rig", RIG, SCENE, half, note, SCENE)
                self.assertEqual(result.returncode, 1, result.stderr)
                lines = [json.loads(line) for line in result.stdout.splitlines()]
                self.assertEqual([line["ok"] for line in lines], [True, False, False, True])
                self.assertIn("ends early", lines[1]["reason"])
                self.assertIn("neither a JPEG nor a PNG", lines[2]["reason"])

    def test_a_stamps_file_gives_a_sequence_its_pictures(self):
        low = os.path.join(SOURCE, "tests/data/low")
        with tempfile.TemporaryDirectory() as folder:
            stamps = os.path.join(folder, "run.csv")
            with open(stamps, "w", encoding="utf-8") as f:
                f.write("name,id,time_s\n")
                for k, name in enumerate(("low-13-006.jpg", "low-13-007.jpg")):
                    f.write(f"{os.path.join(low, name)},{3 * k},{k}\n")
            result = run("pose", "--rig", RIG, "--camera", "low", "--sequence", stamps)
            again = run("pose", "--rig", RIG, "--camera", "low", "--sequence", low)
            with open(stamps, "a", encoding="utf-8") as f:
                f.write("late.jpg,1,9\n")
            refused = run("pose", "--rig", RIG, "--camera", "low", "--sequence", stamps)
        for r in (result, again):
            self.assertEqual([os.path.basename(json.loads(line)["image"]) for line in r.stdout.splitlines()],
                             ["low-13-006.jpg", "low-13-007.jpg"], r.stderr)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("run.csv:4", refused.stderr)

    def test_help_has_examples(self):
        for command in ("pose", "throw", "demo", "turn", "doctor"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Example", result.stdout)


class Stones(unittest.TestCase):
    SKIP = os.path.join(SOURCE, "tests/data/skip/skip-12-002.jpg")

    def test_prints_one_json_object_a_picture(self):
        result = run("stones", "--rig", RIG, self.SKIP, self.SKIP)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([len(line["stones"]) for line in lines], [6, 6])
        stone = lines[0]["stones"][0]
        self.assertEqual(set(stone), {"x_m", "y_m", "team", "sigma_m", "handle_deg", "handle_sigma_deg"})
        handles = [s["handle_deg"] for s in lines[0]["stones"] if s["handle_deg"] is not None]
        self.assertGreaterEqual(len(handles), 4)
        self.assertTrue(all(-90.0 <= h <= 90.0 for h in handles), handles)

    def test_a_sequence_is_averaged(self):
        one = json.loads(run("stones", "--rig", RIG, self.SKIP).stdout)
        result = run("stones", "--rig", RIG, "--sequence", self.SKIP, self.SKIP, self.SKIP)
        self.assertEqual(result.returncode, 0, result.stderr)
        line = json.loads(result.stdout)
        self.assertEqual((line["pictures"], line["frames"]), (3, 3))
        self.assertEqual(len(line["stones"]), len(one["stones"]))
        self.assertAlmostEqual(line["stones"][0]["x_m"], one["stones"][0]["x_m"], delta=1e-9)
        self.assertLess(line["stones"][0]["sigma_m"], one["stones"][0]["sigma_m"])

    def test_pictures_from_two_places_are_not_taken_together(self):
        result = run("stones", "--rig", RIG, "--sequence", self.SKIP, self.SKIP, SCENE)
        self.assertEqual(result.returncode, 1, result.stderr)
        line = json.loads(result.stdout)
        self.assertEqual((line["ok"], line["pictures"], line["frames"], line["stones"]), (False, 3, 0, []))
        self.assertIn("stands 0.38 m and 3.1 deg from", line["reason"])
        result = run("board", "--rig", RIG, self.SKIP, SCENE)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("not of one robot that stands still: in " + SCENE, result.stderr)
        self.assertIn(self.SKIP, result.stderr)

    def test_a_sequence_says_which_picture_was_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            empty = os.path.join(folder, "empty.jpg")
            open(empty, "wb").close()
            line = json.loads(run("stones", "--rig", RIG, "--sequence", self.SKIP, empty).stdout)
        self.assertEqual((line["ok"], line["reason"], line["pictures"], line["frames"]), (True, None, 2, 1))
        self.assertEqual([left["image"] for left in line["left_out"]], [empty])
        self.assertIn("is empty", line["left_out"][0]["reason"])

    def test_teams_are_called_as_the_rig_calls_them(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(RIG, encoding="utf-8") as f:
                text = f.read().replace("name: red,", "name: scarlet,", 1)
            rig = os.path.join(folder, "rig.yaml")
            with open(rig, "w", encoding="utf-8") as f:
                f.write(text)
            line = json.loads(run("stones", "--rig", rig, self.SKIP).stdout)
        self.assertEqual({s["team"] for s in line["stones"]}, {"scarlet", "yellow"})


class Rink(unittest.TestCase):
    """The simulated rink as a program: what it serves is its own, and what it could not do it tells."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        number = os.getpid()
        with open(os.path.join(SOURCE, "config/rigs/thrower.yaml"), encoding="utf-8") as f:
            self.text = f.read()
        for old, new in (("group: 239.74.163.2", f"group: 239.76.{1 + number % 250}.1"),
                         ("/tmp/hogline-thrower-gyro", os.path.join(self.folder.name, "gyro")),
                         ("/tmp/hogline-thrower-operator", os.path.join(self.folder.name, "operator")),
                         ("hogline-thrower-near", f"hogline-cli-{number}-near"),
                         ("hogline-thrower-low", f"hogline-cli-{number}-low")):
            self.assertIn(old, self.text)
            self.text = self.text.replace(old, new)

    def tearDown(self):
        self.folder.cleanup()

    def rig(self, port):
        path = os.path.join(self.folder.name, f"rig-{port}.yaml")
        with open(path, "w", encoding="utf-8") as f:
            f.write(self.text.replace("port: 15502", f"port: {port}"))
        return path

    @staticmethod
    def free_port():
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            return s.getsockname()[1]

    def test_what_a_running_rink_serves_is_its_own(self):
        first = subprocess.Popen([HOGLINE, "rink", "--rig", self.rig(self.free_port())], stdin=subprocess.PIPE,
                                 stdout=subprocess.PIPE, text=True)
        try:
            self.assertIn("ready", first.stdout.readline())
            gyro = os.readlink(os.path.join(self.folder.name, "gyro"))
            second = run("rink", "--rig", self.rig(self.free_port()))
            self.assertEqual(second.returncode, 3, second.stdout)
            self.assertIn("is another running program's", second.stderr)
            self.assertEqual(os.readlink(os.path.join(self.folder.name, "gyro")), gyro)
        finally:
            first.kill()
            first.communicate()
        third = subprocess.run([HOGLINE, "rink", "--rig", self.rig(self.free_port())], input="quit\n",
                               capture_output=True, text=True, timeout=60)
        self.assertEqual(third.returncode, 0, "what a killed one left behind is no obstacle: " + third.stderr)

    def test_a_port_that_is_taken_is_named(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            result = run("rink", "--rig", self.rig(port))
        self.assertEqual(result.returncode, 3)
        for word in (f"modbus.tcp.port = {port}", "in use", "another port"):
            self.assertIn(word, result.stderr)

    def test_a_rig_of_steel_is_no_rig_for_it(self):
        result = run("rink", "--rig", RIG)
        self.assertEqual(result.returncode, 2)
        self.assertIn("config/rigs/thrower.yaml", result.stderr)

    def test_truth_that_is_lost_is_told(self):
        result = subprocess.run([HOGLINE, "rink", "--rig", self.rig(self.free_port()), "--truth", "/dev/full"],
                                input="quit\n", capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 3, result.stdout)
        self.assertIn("could not be written", result.stdout)
        for path in ("/nonexistent/truth.jsonl", self.folder.name):
            result = run("rink", "--rig", self.rig(self.free_port()), "--truth", path)
            self.assertEqual(result.returncode, 2)
            self.assertIn("--truth", result.stderr)


class Far(unittest.TestCase):
    NAME = os.path.join(SOURCE, "tests/data/far/far-14-001")

    def setUp(self):
        with open(self.NAME + ".json", encoding="utf-8") as f:
            self.truth = json.load(f)
        spec = importlib.util.spec_from_file_location("score", os.path.join(SOURCE, "tests/score.py"))
        self.score = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.score)
        self.folder = tempfile.TemporaryDirectory()
        self.rig = os.path.join(self.folder.name, "rig.yaml")
        with open(self.rig, "w", encoding="utf-8") as f:
            f.write(self.score.rig(self.truth))

    def tearDown(self):
        self.folder.cleanup()

    def far(self, *words):
        return run("stones", "--rig", self.rig, "--camera", "far", *words, self.NAME + ".jpg")

    def test_the_moving_stone_and_the_heads_correction(self):
        result = self.far(*self.score.at(self.truth))
        self.assertEqual(result.returncode, 0, result.stderr)
        line = json.loads(result.stdout)
        self.assertEqual(list(line), ["image", "ok", "stones", "correction", "features", "elapsed_ms", "reason"])
        [stone] = line["stones"]
        self.assertAlmostEqual(stone["x_m"], self.truth["stones"][0]["x_end"], delta=0.01)
        self.assertAlmostEqual(stone["y_m"], self.truth["stones"][0]["y_end"], delta=0.06)
        self.assertEqual(stone["team"], self.truth["stones"][0]["team"])
        self.assertAlmostEqual(line["correction"]["tilt_deg"], -0.094, delta=0.01)
        self.assertIn("far_hog_line", line["features"])

    def test_wrong_use_is_told_in_plain_words(self):
        for words, told in (((), "--at"), (("--at=1,2",), "three numbers"), (("--at=1,2,3,4",), "three numbers"),
                            (("--at=1,b,3",), "'b' is no number"), (("--at=1,,3",), "no number"),
                            (("--at=nan,0,0",), "no number"), (("--at=0,500,0",), "100 m"), (("--at=0,0,1e3",), "360"),
                            (("--at=0,-3,0", "--sequence"), "near camera")):
            result = self.far(*words)
            self.assertEqual(result.returncode, 2, words)
            self.assertIn(told, result.stderr, words)
            self.assertEqual(result.stdout, "")
        result = run("stones", "--rig", RIG, "--at=0,-3,0", SCENE)
        self.assertEqual(result.returncode, 2)
        self.assertIn("far camera", result.stderr)

    def test_a_wrong_place_is_refused_with_the_reason(self):
        result = self.far("--at=3,-3.3,0")
        self.assertEqual(result.returncode, 1)
        line = json.loads(result.stdout)
        self.assertFalse(line["ok"])
        self.assertEqual((line["stones"], line["correction"]), ([], None))
        self.assertIn("how the camera looks", line["reason"])


class Score(unittest.TestCase):
    def score(self, *words):
        return subprocess.run([sys.executable, os.path.join(SOURCE, "tests/score.py"), *words, "--hogline", HOGLINE],
                              capture_output=True, text=True, check=False)

    def test_what_was_not_measured_is_null(self):
        scored = self.score("pose", "--camera", "low", "--scenes", os.path.join(SOURCE, "tests/data/low"))
        self.assertEqual(scored.returncode, 0, scored.stderr)
        self.assertNotIn("nan", scored.stdout.lower())
        self.assertEqual(json.loads(scored.stdout.splitlines()[-1])["estimated"], 2)

    def test_folders_that_are_none(self):
        for words in (("nosuch",), ("pose", "/nonexist")):
            refused = subprocess.run([os.path.join(SOURCE, "dev"), "score", *words], capture_output=True, text=True, check=False)
            self.assertEqual(refused.returncode, 1)
            self.assertIn("no such folder: " + words[-1], refused.stderr)
        self.assertIn("no such folder", self.score("far", "--scenes", "/nonexist").stderr)

    def test_an_error_names_the_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(os.path.join(SOURCE, "tests/data/near/near-11-000.json"), folder)
            failed = self.score("pose", "--scenes", folder)
        self.assertNotEqual(failed.returncode, 0)
        self.assertTrue(failed.stderr.startswith("near-11-000.jpg: "), failed.stderr)


class Draw(unittest.TestCase):
    def test_a_folder_must_be_named(self):
        for words in (("pose", "--rig", RIG, "--camera", "near", "--draw", "", SCENE),
                      ("stones", "--rig", RIG, "--draw", "", SCENE), ("board", "--rig", RIG, "--out", "", SCENE)):
            result = run(*words)
            self.assertEqual(result.returncode, 2, words)
            self.assertIn(words[words.index("") - 1], result.stderr)

    def test_pictures_of_one_name_from_two_folders_are_two_drawings(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = []
            for name in ("a", "b"):
                os.mkdir(os.path.join(folder, name))
                pictures.append(os.path.join(folder, name, "frame.jpg"))
                shutil.copy(SCENE, pictures[-1])
            out = os.path.join(folder, "out")
            result = run("stones", "--rig", RIG, "--draw", out, *pictures)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(sorted(os.listdir(out)), ["b-frame.png", "frame.png"])


class Doctor(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        with open(RIG, encoding="utf-8") as f:
            self.text = f.read()

    def tearDown(self):
        self.folder.cleanup()

    def doctor(self, text, *words):
        path = os.path.join(self.folder.name, "rig.yaml")
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        return run("doctor", "--rig", path, *words)

    def test_all_is_well_on_the_simulated_rink(self):
        small = self.text.replace("width_px: 1600", "width_px: 320").replace("height_px: 1200", "height_px: 240")
        result = self.doctor(small)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("on the simulated rink", result.stdout)
        self.assertIn("all well", result.stdout)
        report = json.loads(self.doctor(small, "--simulated", "--json").stdout)
        self.assertTrue(report["ok"] and report["simulated"])
        self.assertEqual([d["device"] for d in report["devices"]],
                         ["CAN bus", "left wheel", "right wheel", "jaws", "spin belt", "arm", "gyro", "near camera",
                          "low camera"])

    def test_steel_that_is_not_there_is_said_device_by_device(self):
        text = self.text.replace("can: {interface: can0}", "can: {interface: nosuchcan0}")
        text = text.replace("port: 502", "port: 1").replace(
            "source: {simulated: {},", "source: {folder: {path: %s, rate_hz: 60}," % os.path.join(SOURCE, "tests/data/low"))
        result = self.doctor(text, "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        report = json.loads(result.stdout)
        self.assertFalse(report["ok"] or report["simulated"])
        verdicts = {d["device"]: d["verdict"] for d in report["devices"]}
        self.assertEqual(verdicts["CAN bus"], "wrong")
        self.assertEqual(verdicts["jaws"], "wrong")
        self.assertEqual(verdicts["arm"], "wrong")
        self.assertEqual(verdicts["near camera"], "note")
        self.assertEqual(verdicts["low camera"], "ok", result.stdout)
        for device in report["devices"]:
            for remark in device["remarks"]:
                self.assertTrue(remark["what"] and remark["advice"])


class Game(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.out = os.path.join(self.folder.name, "game")

    def tearDown(self):
        self.folder.cleanup()

    def game(self, *words):
        return run("game", "--outcome-model", "--ends", "1", "--out", self.out, *words)

    def test_an_end_is_played_and_written_down(self):
        result = self.game("--seed", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        events = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([e["event"] for e in events[:3]], ["practice", "practice", "begin"])
        self.assertEqual(events[-1]["event"], "over")
        self.assertGreaterEqual(sum(e["event"] == "throw" for e in events), 16)
        with open(os.path.join(self.out, "game.jsonl"), encoding="utf-8") as f:
            self.assertEqual(f.read(), result.stdout)
        with open(os.path.join(self.out, "game.dcl2"), encoding="utf-8") as f:
            record = [json.loads(line) for line in f]
        self.assertEqual([e["log"]["cmd"] for e in record[:9]],
                         ["dc", "meta", "meta", "dc_ok", "dc_ok", "is_ready", "ready_ok", "ready_ok", "new_game"])
        self.assertEqual(record[-1]["log"], {"cmd": "game_over"})
        self.assertEqual(record[-2]["log"]["state"]["game_result"]["reason"], "score")
        self.assertEqual(self.game("--seed", "3").stdout, result.stdout, "the same seed plays the same game")

    def test_a_client_that_never_comes_stops_the_game(self):
        result = self.game("--team1", "dc:0", "--connect", "1")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("did not connect within 1 s", result.stderr)
        self.assertEqual(json.loads(result.stdout.splitlines()[-1])["event"], "stopped")

    def test_wrong_uses(self):
        for words in (["--team0", "dc:70000"], ["--team0", "somebody"], ["--ends", "0"], ["--thinking", "0"], ["--practice", "17"],
                      ["--team0", "dc:0", "--address", "localhost"]):
            self.assertEqual(self.game(*words).returncode, 2, words)
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = str(taken.getsockname()[1])
            result = self.game("--team0", "dc:" + port)
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertIn("127.0.0.1:" + port, result.stderr)


class Turn(unittest.TestCase):
    def turn(self, folder, *words):
        result = run("turn", "--seed", "3", "--out", folder, *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_is_thrown_followed_and_told_and_the_same_again(self):
        with tempfile.TemporaryDirectory() as folder:
            told = self.turn(folder)
            with open(os.path.join(folder, "turn.json"), encoding="utf-8") as f:
                self.assertEqual(json.load(f), told)
            for picture in ("above.png", "house.png", "overview.png"):
                self.assertTrue(os.path.getsize(os.path.join(folder, picture)) > 1000, picture)
            again = self.turn(folder)
        self.assertEqual((told["ok"], told["attempts"], told["plan"]), (True, 1, "take out"))
        self.assertLess(abs(told["release"]["against_truth"]["speed_error_mps"]), 0.03)
        self.assertEqual([(s["team"], s["stone"]) for s in told["board"]], [(s["team"], s["stone"]) for s in told["true_board"]])
        for seen, true in zip(told["board"], told["true_board"]):
            self.assertLess(math.hypot(seen["x_m"] - true["x_m"], seen["y_m"] - true["y_m"]), 0.02)
        self.assertEqual({**told, "wall_s": 0}, {**again, "wall_s": 0}, "the same seed is the same turn")

    def test_wrong_uses(self):
        for words in (["--skip-hz", "nan"], ["--skip-hz", "1"], ["--skip-hz", "121"], ["--stones", "16"], ["--seer", "somebody"], ["--strategist", "nobody"], ["--scenario", "none.yaml"]):
            self.assertEqual(run("turn", *words).returncode, 2, words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
