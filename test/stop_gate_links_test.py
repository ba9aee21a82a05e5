#!/usr/bin/env python3
"""The stop gate links nothing of the large libraries whose faults must not be its own.

usage: stop_gate_links_test.py STOP_GATE
"""
import re
import subprocess
import sys
import unittest

LARGE = re.compile(r'pcl|octo|opencv|cv_bridge|Qt|vtk|embree|rviz|libpilothouse_nodelets|sdformat', re.I)


class Links(unittest.TestCase):
    program = None

    def test_nothing_large(self):
        linked = subprocess.run(['ldd', self.program], check=True, stdout=subprocess.PIPE,
                                universal_newlines=True).stdout
        names = [line.split()[0] for line in linked.splitlines() if line.strip()]
        self.assertTrue([n for n in names if 'roscpp' in n], names)
        self.assertEqual([n for n in names if LARGE.search(n.rsplit('/', 1)[-1])], [])


if __name__ == '__main__':
    Links.program = sys.argv.pop(1)
    unittest.main()
