#!/usr/bin/env python3
"""catkin_lint at its strictest finds nothing but what is excused here.

usage: catkin_lint_test.py PROJECT
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

# (id, pattern of the complaint, why it stands)
EXCUSES = [
    ('UNINSTALLED_SCRIPT', r"'(scripts|test|bench)/",
     'commands for the source tree, which they need to build and test'),
    ('UNINSTALLED_TARGET', r"'(guarded_listener|fake_camera|fake_robot)'", 'helpers of the tests'),
    ('EXTERNAL_DIRECTORY', r'CATKIN_DEVEL_PREFIX', 'where the messages are generated'),
    ('EXTERNAL_INTERFACE_PATH', r'', 'targets of this build only, none is exported'),
    ('LITERAL_PROJECT_NAME', r'', 'target names are searched for as they are written'),
    ('GLOBAL_VAR_COLLISION', r"'(PILOTHOUSE_|CMAKE_BUILD_TYPE)",
     'the name in upper case is the convention; a default for a build without a type'),
    ('UNSORTED_LIST', r'', 'lists stand in the order that reads best'),
    ('MISSING_FILE', r'catkin_generated/installspace', 'written by catkin while it configures'),
    ('WRONG_(BIN_)?INSTALL_DESTINATION', r'', "catkin's own environment, at the prefix by design"),
    ('ENV_VAR', r'', 'DESTDIR, while installing'),
    ('CMD_CASE', r'ExternalProject_Add', 'the name that CMake itself writes'),
]
NOT_SOURCES = shutil.ignore_patterns('.*', 'build', 'devel', 'install', 'out', '__pycache__')


def complaints(package):
    environment = dict(os.environ, PATH='/usr/bin:/bin:' + os.environ.get('PATH', ''))
    done = subprocess.run(['catkin_lint', '-W2', '--strict', '--json', package], env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    try:
        report = json.loads(done.stdout)
    except ValueError:
        raise RuntimeError('catkin_lint failed: ' + done.stderr)
    return [(e['id'], e['text'], e.get('location', {})) for kind in ('errors', 'warnings', 'notices')
            for e in report[kind]]


def is_excused(complaint):
    return any(re.fullmatch(name, complaint[0]) and re.search(pattern, complaint[1])
               for name, pattern, _ in EXCUSES)


class CatkinLint(unittest.TestCase):
    project = None

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        # A folder of the package's name, without what a build leaves behind.
        self.package = os.path.join(self.folder.name, 'pilothouse')
        shutil.copytree(self.project, self.package, ignore=NOT_SOURCES)

    def tearDown(self):
        self.folder.cleanup()

    def test_finds_nothing_unexcused(self):
        self.assertEqual([c for c in complaints(self.package) if not is_excused(c)], [])

    def test_would_find_a_missing_dependency(self):
        path = os.path.join(self.package, 'package.xml')
        with open(path, encoding='utf-8') as file:
            text = file.read()
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text.replace('<depend>tf2_ros</depend>', ''))
        found = [c for c in complaints(self.package) if not is_excused(c)]
        self.assertTrue(any('tf2_ros' in c[1] for c in found), found)


if __name__ == '__main__':
    CatkinLint.project = os.path.abspath(sys.argv.pop(1))
    unittest.main()
