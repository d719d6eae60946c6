#!/usr/bin/env python3
"""The program's edges: wrong use is exit status 2 and one line that says what is allowed. cli_test.py HOGLINE SOURCE_DIR"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HOGLINE, SOURCE = sys.argv[1], sys.argv[2]
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

    def test_a_missing_picture(self):
        self.refuses(run("pose", "--rig", RIG, "--camera", "near", "nowhere.jpg"), "nowhere.jpg", "no such picture")

    def test_a_text_file_named_jpg(self):
        path = self.file("note.jpg", b"this is no picture\n" * 50)
        self.refuses(run("pose", "--rig", RIG, "--camera", "near", path), "note.jpg")

    def test_a_truncated_picture(self):
        with open(SCENE, "rb") as f:
            path = self.file("half.jpg", f.read()[:300000])
        self.refuses(run("pose", "--rig", RIG, "--camera", "near", path), "half.jpg")

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

    def test_no_subcommand(self):
        self.assertEqual(run().returncode, 2)


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

    def test_help_has_examples(self):
        for command in ("pose", "throw", "demo"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertIn("Example", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
