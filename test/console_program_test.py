#!/usr/bin/env python3
"""The program console from outside: its options, its screenshot, and that it always ends quickly.

usage: console_program_test.py CONSOLE SOURCE_DIR
"""
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

CONSOLE = SOURCE = None
PATIENCE = 60


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.silent = socket.socket()  # accepts, never answers: the worst kind of master
        self.silent.bind(("127.0.0.1", 0))
        self.silent.listen(8)
        self.addCleanup(self.silent.close)
        self.environment = dict(
            os.environ, QT_QPA_PLATFORM="offscreen", ROS_IP="127.0.0.1", ROS_HOME=self.folder.name,
            ROS_LOG_DIR=self.folder.name, XDG_RUNTIME_DIR=self.folder.name, HOME=self.folder.name,
            XDG_CONFIG_HOME=self.folder.name,
            ROS_MASTER_URI="http://127.0.0.1:%d" % self.silent.getsockname()[1])

    def run_console(self, *arguments):
        return subprocess.run([CONSOLE, *arguments], env=self.environment, timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_help(self):
        done = self.run_console("--help")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stdout.startswith("usage: console"))

    def test_wrong_options_are_one_line_and_exit_2(self):
        for arguments in (["--nonsense"], ["--robot", "nobody"], ["--robot", "/nowhere.yaml"],
                          ["--screenshot"], ["--after", "3"],
                          ["--screenshot", "/nowhere/x.png"]):
            done = self.run_console(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("console: "), done.stderr)

    def test_a_faulty_robot_file_is_named_with_key_and_value(self):
        path = os.path.join(self.folder.name, "robot.yaml")
        with open(os.path.join(SOURCE, "config/robots/platform.yaml")) as source:
            text = source.read()
        with open(path, "w") as out:
            out.write(text.replace("height: 0.75", "height: tall"))
        done = self.run_console("--robot", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn('height is "tall" (a string), expected a number', done.stderr)

    def test_every_robot_of_the_package_is_read(self):
        for name in sorted(os.listdir(os.path.join(SOURCE, "config/robots"))):
            shot = os.path.join(self.folder.name, name + ".png")
            done = self.run_console("--robot", name[:-len(".yaml")], "--screenshot", shot,
                                    "--after", "0.1")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_screenshot_has_the_windows_size_and_the_scale(self):
        for scale in (1, 2):
            self.environment["QT_SCALE_FACTOR"] = str(scale)
            shot = os.path.join(self.folder.name, "shot.png")
            done = self.run_console("--screenshot", shot, "--after", "0.2")
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(shot, "rb") as picture:
                head = picture.read(24)
            width, height = struct.unpack(">II", head[16:24])
            self.assertEqual((width, height), (1280 * scale, 800 * scale))

    def test_rosnode_kill_ends_it_as_a_signal_does(self):
        port = str(free_port())
        self.environment["ROS_MASTER_URI"] = "http://127.0.0.1:" + port
        master = subprocess.Popen(["rosmaster", "--core", "-p", port], env=self.environment,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(master.wait)
        self.addCleanup(master.terminate)
        process = subprocess.Popen([CONSOLE, "__name:=the_console"], env=self.environment)
        self.addCleanup(process.kill)
        until = time.monotonic() + PATIENCE
        names = []
        while not names and time.monotonic() < until:
            names = [name for name in subprocess.run(
                ["rosnode", "list"], env=self.environment, stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL, text=True).stdout.split() if "console" in name]
        self.assertTrue(names, "the console never came to the master")
        subprocess.run(["rosnode", "kill", names[0]], env=self.environment, timeout=PATIENCE,
                       stdout=subprocess.DEVNULL)
        self.assertEqual(process.wait(timeout=PATIENCE), 0)

    def test_ends_quickly_while_a_master_does_not_answer(self):
        process = subprocess.Popen([CONSOLE], env=self.environment)
        self.addCleanup(process.kill)
        self.silent.settimeout(PATIENCE)
        connection, _ = self.silent.accept()  # it is now waiting for an answer
        self.addCleanup(connection.close)
        asked = time.monotonic()
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=PATIENCE), 0)
        self.assertLess(time.monotonic() - asked, 10.0)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        print(__doc__.strip().splitlines()[-1], file=sys.stderr)
        sys.exit(2)
    SOURCE, CONSOLE = sys.argv.pop(), sys.argv.pop()
    unittest.main(verbosity=2)
