#!/usr/bin/env python3
"""core/ and sim/ know nothing of ROS or Qt, and the arrows between the rooms go one way.

usage: purity_test.py PROJECT
"""
import os
import re
import sys
import tempfile
import unittest

FOREIGN = r'ros/|_msgs/|tf2|nodelet|<Q'
OWN = r'^\s*#\s*include\s*"(%s)/'
# room -> what must not stand in its sources
RULES = {
    'core': [FOREIGN, OWN % 'sim|doors|nodelets|gui|bench|test', OWN % 'core/.*nodelet'],
    'core/cloud': [OWN % 'core/(?!cloud)[a-z_]+'],
    'sim': [FOREIGN, OWN % 'doors|nodelets|gui|bench|test'],
    'doors': [r'<Q', OWN % 'sim|nodelets|gui|bench|test'],
    'volume': [FOREIGN, OWN % 'sim|doors|nodelets|gui|bench|test'],
    'registration': [FOREIGN, OWN % 'sim|doors|nodelets|gui|bench|test'],
    'gate': [r'<Q|pcl|opencv|octomap|cv_bridge', OWN % 'sim|nodelets|gui|bench|test'],
    'nodelets': [r'<Q', OWN % 'gui|bench|test'],
    'gui': [OWN % 'nodelets|sim|bench|test'],
}
SOURCE = re.compile(r'\.(cpp|hpp|h|cc)$')
# The one nodelet of the simulator.
EXEMPT = re.compile(r'^sim/[^/]*_nodelet[^/]*$')


def without_comments(text):
    return re.sub(r'//[^\n]*|/\*.*?\*/', '', text, flags=re.S)


def finds(project):
    found = []
    for room, patterns in RULES.items():
        for folder, _, names in os.walk(os.path.join(project, room)):
            for name in sorted(names):
                path = os.path.relpath(os.path.join(folder, name), project)
                if not SOURCE.search(name) or EXEMPT.match(path):
                    continue
                with open(os.path.join(project, path), encoding='utf-8') as file:
                    lines = without_comments(file.read()).splitlines()
                for line in lines:
                    found += ['%s: %s' % (path, line.strip()) for pattern in patterns
                              if re.search(pattern, line)]
    return found


class Purity(unittest.TestCase):
    project = None

    def test_rooms_are_pure(self):
        self.assertTrue(os.path.isdir(os.path.join(self.project, 'core')), self.project)
        self.assertEqual(finds(self.project), [])

    def test_a_planted_find_is_found(self):
        planted = {
            'core/floor/a.cpp': '#include <ros/ros.h>',
            'core/cloud/b.hpp': '#include <sensor_msgs/Image.h>',
            'core/c.cpp': '#include <QWidget>',
            'core/d.cpp': '#include <tf2_ros/buffer.h>',
            'sim/e.cpp': '#include <nodelet/nodelet.h>',
            'sim/f.hpp': '#include "gui/model/x.hpp"',
            'core/g.hpp': '#include "sim/x.hpp"',
            'core/cloud/h.hpp': '#include "core/floor/x.hpp"',
            'gui/i.cpp': '#include "nodelets/x.hpp"',
            'nodelets/j.cpp': '#include <QObject>',
        }
        for path, line in planted.items():
            with tempfile.TemporaryDirectory() as project:
                os.makedirs(os.path.join(project, os.path.dirname(path)))
                with open(os.path.join(project, path), 'w', encoding='utf-8') as file:
                    file.write('// a comment about ros/ and tf2\nint x;\n%s\n' % line)
                self.assertEqual(finds(project)[:1], ['%s: %s' % (path, line)])

    def test_what_is_allowed_is_not_found(self):
        allowed = {
            'core/floor/a.cpp': '#include "core/cloud/cloud_view.hpp"  // not ros/ros.h',
            'sim/world_nodelet.cpp': '#include <ros/ros.h>',
            'sim/b.cpp': '#include "core/floor/floor_cells.hpp"',
            'gui/c.cpp': '#include <QWidget>',
        }
        for path, line in allowed.items():
            with tempfile.TemporaryDirectory() as project:
                os.makedirs(os.path.join(project, os.path.dirname(path)))
                with open(os.path.join(project, path), 'w', encoding='utf-8') as file:
                    file.write(line + '\n')
                self.assertEqual(finds(project), [], path)


if __name__ == '__main__':
    Purity.project = os.path.abspath(sys.argv.pop(1))
    unittest.main()
