#!/usr/bin/env python3
"""What the evaluations' command lines answer. Usage: eval_cli_test.py FOLDER_OF_PROGRAMS"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

FOLDER = sys.argv.pop(1)
DATA = os.environ.get("PILOTHOUSE_DATA")
NAMES = ("eval_floor", "eval_labelled", "eval_realfloor")


def call(name, *options):
    return subprocess.run([os.path.join(FOLDER, name), *options], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True)


class EvalCommandLine(unittest.TestCase):
    def test_help(self):
        for name in NAMES:
            done = call(name, "--help")
            self.assertEqual(done.returncode, 0, name)
            self.assertIn("usage: ", done.stdout)

    def test_drive(self):
        if not os.path.exists(os.path.join(FOLDER, "eval_drive")):
            self.skipTest("eval_drive is not built: no simulator")
        self.assertIn("usage: ", call("eval_drive", "--help").stdout)
        self.assertIn("--wrong", self.refused("eval_drive", "--wrong"))
        self.assertIn("--runs is '0'", self.refused("eval_drive", "--runs", "0"))
        self.assertIn("--only N", call("eval_goals", "--help").stdout)
        self.assertIn("--only is 3, expected less than --runs, 3",
                      self.refused("eval_goals", "--runs", "3", "--only", "3"))

    def test_pose(self):
        self.assertIn("usage: ", call("eval_pose", "--help").stdout)
        self.assertIn("--wrong", self.refused("eval_pose", "--wrong"))
        self.assertIn("/no/such.bag", self.refused("eval_pose", "--bag", "/no/such.bag"))
        with tempfile.NamedTemporaryFile(suffix=".bag") as empty:
            self.assertIn(empty.name, self.refused("eval_pose", "--bag", empty.name))

    @unittest.skipUnless(DATA, "PILOTHOUSE_DATA is not set")
    def test_pose_of_recordings(self):
        def bag(name):
            return os.path.join(DATA, "bags", name + ".bag")
        done = call("eval_pose", "--bag", bag("jarvis_circular_path_fast"))
        summary = json.loads(done.stdout.splitlines()[-1])
        self.assertTrue(summary["judged"], done.stdout + done.stderr)
        # Half of the raw error by the fit of the whole track is missed there (docs/pose.md).
        self.assertEqual(done.returncode, 0 if summary["pass"] else 1)
        # What was reached, and a little: no change may undo it.
        self.assertLess(summary["corrected_fit_rms_m"], 0.87 * summary["raw_fit_rms_m"])
        self.assertLess(summary["corrected_fit_rms_m"], 0.0182)
        self.assertLess(summary["corrected_begin_rms_m"], 0.024)
        self.assertLess(summary["begin_share"], 0.51)
        done = call("eval_pose", "--bag", bag("guardian_climb_palette_door"))
        self.assertIn("nothing to judge by", done.stderr)
        self.assertFalse(json.loads(done.stdout.splitlines()[-1])["judged"])
        self.assertIn("no odometry", self.refused("eval_pose", "--bag", bag("scans_demo")))
        self.assertIn("no sensor_msgs/LaserScan",
                      self.refused("eval_pose", "--bag", bag("robot_localization_test2")))

    def refused(self, name, *options):
        done = call(name, *options)
        self.assertEqual(done.returncode, 2, (name, options))
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_wrong_calls_are_one_line_and_exit_code_2(self):
        for name in NAMES:
            self.assertIn("--wrong", self.refused(name, "--wrong"))
            self.assertIn("--out", self.refused(name, "--out"))
            self.assertIn("/dev/null/x", self.refused(name, "--out", "/dev/null/x"))
        for number in ("0", "-1", "1.5", "", "many", "9" * 30):
            self.assertIn("--runs is '%s'" % number, self.refused("eval_floor", "--runs", number))
        for name in NAMES[1:]:
            self.assertIn("/no/such/folder", self.refused(name, "--data", "/no/such/folder"))
            self.assertIn("--data", self.refused(name))
            with tempfile.TemporaryDirectory() as empty:
                self.assertIn(empty, self.refused(name, "--data", empty))

    def test_damaged_list_of_planes_names_the_line(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "floor_planes.txt"), "w") as file:
                file.write("# comment\nx.pcd n=(0 -1 0) h=high tilt=3\n")
            self.assertIn("line 2", self.refused("eval_realfloor", "--data", folder))

    def test_damaged_cloud_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "x.pcd"), "w") as file:
                file.write("no cloud")
            done = call("eval_labelled", "--data", folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn("x.pcd", done.stderr)

    def test_random_scenes_are_the_same_again_and_drawn(self):
        with tempfile.TemporaryDirectory() as out:
            done = call("eval_floor", "--runs", "1", "--seed", "7", "--out", out)
            again = call("eval_floor", "--runs", "1", "--seed", "7")
            self.assertEqual(done.stdout, again.stdout)
            lines = [json.loads(line) for line in done.stdout.splitlines()]
            self.assertEqual(len(lines), 2 * 9 + 1)
            drawn = set(os.listdir(out))
            for line in lines[:-1]:
                suffix = "_mount_error" if line["mounting"] == "mount_error" else ""
                self.assertIn(line["scene"] + suffix + ".png", drawn)
        summary = lines[-1]
        self.assertEqual(done.returncode, 0 if summary["pass"] else 1)
        missed = [summary[part]["missed"] for part in ("as_configured", "mount_error")]
        self.assertEqual(summary["pass"], not any(missed))
        for part in ("as_configured", "mount_error"):
            for method in ("ceiling", "original", "improved"):
                for figure in ("iou", "precision", "recall_7cm", "recall_18cm", "ramp_drivable",
                               "sill_drivable", "false_on_empty", "beyond_blocked"):
                    self.assertIn(figure, summary[part][method])
        # What no change of a method may undo: the flood finds tops that the original leaves out,
        # and the ceiling knows best.
        figures = summary["as_configured"]
        self.assertGreater(figures["improved"]["iou"], figures["original"]["iou"] + 20.0)
        self.assertGreater(figures["ceiling"]["iou"], 90.0)

    @unittest.skipUnless(DATA, "PILOTHOUSE_DATA is not set: no recordings")
    def test_recordings_meet_their_bars(self):
        for name in NAMES[1:]:
            with tempfile.TemporaryDirectory() as out:
                done = call(name, "--data", os.path.join(DATA, "floor_depth"), "--out", out)
                lines = [json.loads(line) for line in done.stdout.splitlines()]
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertTrue(lines[-1]["summary"] and lines[-1]["pass"])
                self.assertEqual(len(os.listdir(out)), len(lines) - 1)


if __name__ == "__main__":
    unittest.main()
