#!/usr/bin/env python3
"""The first thing that anybody runs: one whole turn in rendered pictures. demo_test.py HOGLINE"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HOGLINE = os.path.abspath(sys.argv[1])


class Demo(unittest.TestCase):
    def test_throws_at_its_first_attempt_and_tells_it_to_a_person(self):
        with tempfile.TemporaryDirectory() as folder:
            shown = subprocess.run([HOGLINE, "demo", "--out", folder], capture_output=True, text=True, timeout=280)
            self.assertEqual(shown.returncode, 0, shown.stderr)
            with open(os.path.join(folder, "turn.json"), encoding="utf-8") as f:
                told = json.load(f)
            for picture in ("above.png", "house_before.png", "house_after.png", "low.png", "near.png", "overview.png"):
                self.assertGreater(os.path.getsize(os.path.join(folder, picture)), 1000, picture)
        self.assertTrue(told["ok"], told["reason"])
        self.assertEqual(told["attempts"], 1, told["remarks"])
        against = told["release"]["against_truth"]
        self.assertLess(abs(against["place_mm"]), 35)
        self.assertLess(abs(against["speed_error_mps"]), 0.01)
        self.assertIn("overview.png", shown.stdout + shown.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
