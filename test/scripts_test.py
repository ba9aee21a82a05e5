#!/usr/bin/python3
"""The commands in scripts/ from a user's side: help, and mistakes that cost one line and exit 2."""
import os
import subprocess
import sys
import unittest

PROJECT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def call(*arguments):
    # A bare shell: nothing of ROS in the environment.
    environment = {k: os.environ[k] for k in ('HOME', 'PATH') if k in os.environ}
    return subprocess.run([os.path.join(PROJECT, 'scripts', arguments[0])] + list(arguments[1:]),
                          env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True, timeout=180)


class Commands(unittest.TestCase):

    def test_each_explains_itself(self):
        for name in ('run', 'test', 'bench', 'eval', 'fuzz', 'screenshots'):
            with self.subTest(name):
                result = call(name, '--help')
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn('usage: scripts/' + name, result.stdout)

    def refuses(self, named, *arguments):
        with self.subTest(arguments):
            result = call(*arguments)
            self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
            self.assertIn(named, result.stderr)

    def test_wrong_options_are_one_line_and_exit_2(self):
        for name in ('run', 'test', 'bench', 'eval', 'fuzz', 'screenshots'):
            self.refuses('--nonsense', name, '--nonsense')
        self.refuses('nonsense', 'bench', 'nonsense')
        self.refuses('nonsense', 'eval', 'nonsense')
        self.refuses('which experiment', 'eval')

    def test_run_names_what_is_wrong(self):
        self.refuses('/no/such.bag', 'run', '--bag', '/no/such.bag')
        self.refuses('--bag needs a value', 'run', '--bag')
        self.refuses('/no/such.pcd', 'run', '--pcd', '/no/such.pcd')
        self.refuses('/no/such', 'run', '--depth', '/no/such')
        self.refuses('platform', 'run', '--robot', 'hovercraft')
        self.refuses('sonar', 'run', '--input', 'sonar')
        self.refuses('--rate is 0', 'run', '--rate', '0')
        self.refuses('--remap needs --bag', 'run', '--remap', 'a:=b')
        self.refuses('furnished_room', 'run', '--world', 'no_such_room')
        self.refuses('/no/such.sdf', 'run', '--world', '/no/such.sdf')
        self.refuses('one source', 'run', '--world', 'furnished_room', '--live')
        self.refuses('--seed is -1', 'run', '--seed', '-1')
        self.refuses('--seed needs', 'run', '--live', '--seed', '1')
        self.refuses('--still needs', 'run', '--live', '--still')
        self.refuses('--motion needs', 'run', '--motion')
        self.refuses('--input needs --live', 'run', '--input', 'cloud')
        self.refuses('--rate needs', 'run', '--rate', '2')
        self.refuses('leave out --live', 'run', '--console-only', '--live')
        self.refuses('--calibrate learns', 'run', '--depth', PROJECT, '--calibrate')
        self.refuses('no display', 'run')

    def test_a_file_that_is_no_bag_is_refused(self):
        self.refuses('not a bag', 'bag_topics.py', os.path.join(PROJECT, 'LICENSE'))


if __name__ == '__main__':
    sys.exit(unittest.main())
