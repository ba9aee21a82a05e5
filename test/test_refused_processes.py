#!/usr/bin/env python3
"""A process that is asked to start a nodelet with bad parameters ends with an error that names them."""
import subprocess
import sys
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest


def run(*arguments):
    done = subprocess.run(['rosrun', 'nodelet', 'nodelet'] + list(arguments), timeout=60,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    return done.returncode, done.stdout


class RefusedProcesses(unittest.TestCase):
    def refuse(self, *arguments):
        code, output = run(*arguments)
        self.assertNotEqual(code, 0, output)
        return output

    def test_standalone(self):
        output = self.refuse('standalone', 'pilothouse/DepthFloor', '__name:=alone', '_range:=far')
        self.assertIn('/alone: range is "far" (a string), expected a number from 0.5 to 20', output)

    def test_loading_into_a_manager(self):
        rospy.set_param('/loaded/range', 'far')
        self.refuse('load', 'pilothouse/CloudFloor', 'manager', '__name:=loaded')
        manager = rosgraph.Master('/test_refused_processes').lookupNode('/manager')
        code, _, pid = xmlrpc.client.ServerProxy(manager).getPid('/test_refused_processes')
        self.assertEqual(code, 1, 'the manager must live')
        self.assertGreater(pid, 0)

    def test_robot_without_a_camera(self):
        rospy.set_param('/robot/name', 'half')
        output = self.refuse('standalone', 'pilothouse/RobotFrames', '__name:=frames')
        self.assertIn('/robot: camera is missing', output)


if __name__ == '__main__':
    rospy.init_node('test_refused_processes')
    rostest.rosrun('pilothouse', 'refused_processes', RefusedProcesses, sys.argv)
