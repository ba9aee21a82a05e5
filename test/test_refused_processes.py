#!/usr/bin/env python3
"""A process that is asked to start a nodelet with bad parameters ends with an error that names them."""
import os
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

import rosgraph
import rospkg
import rospy
import rostest

REFUSED = 3  # the only exit code after which nothing is started again
PATIENCE = 180  # s, for what takes a few


def run(*arguments):
    done = subprocess.run(['rosrun', 'nodelet', 'nodelet'] + list(arguments), timeout=PATIENCE,
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

    def test_host_that_is_started_again_when_killed(self):
        rospy.set_param('/host/nodelets', {'deep': 'pilothouse/DepthFloor'})
        rospy.set_param('/deep/range', 'far')
        done = subprocess.run(['rosrun', 'pilothouse', 'nodelet_host', '--respawn', '__name:=host'], timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(done.returncode, REFUSED, done.stdout)
        self.assertEqual(done.stdout.count('/deep: range is "far" (a string), expected a number from 0.5 to 20'), 1,
                         done.stdout)

    def test_launch_ends(self):
        """Said once, and the launch is over, although its manager is started again when it is killed."""
        output = self.launch_of_a_bad_robot()
        self.assertEqual(output.count('height is -0.75'), 1, output)

    def test_launch_ends_in_somebody_elses_manager(self):
        """Where a loader is refused, which nobody starts again."""
        output = self.launch_of_a_bad_robot('manager:=manager', 'start_manager:=false')
        self.assertIn('REQUIRED process', output)

    def launch_of_a_bad_robot(self, *arguments):
        with open(robot_file()) as file:
            robot = file.read().replace('height: 0.75', 'height: -0.75')
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as bad:
            bad.write(robot)
            bad.flush()
            output = launched('robot.launch', 'robot:=' + bad.name, *arguments)
        rospy.delete_param('/robot')
        return output

    def test_launch_ends_by_the_gate(self):
        """The same where it is the stop gate that refuses."""
        text = '''<launch>
          <include file="$(find pilothouse)/launch/robot.launch"><arg name="motion" value="true"/></include>
          <param name="stop_gate/perception_timeout" value="9.0"/>
        </launch>'''
        with tempfile.NamedTemporaryFile('w', suffix='.launch') as bad:
            bad.write(text)
            bad.flush()
            output = launched(bad.name)
        rospy.delete_param('/robot')
        rospy.delete_param('/stop_gate')
        refusal = '/stop_gate: perception_timeout is 9 (a double), expected a number from 0.05 to 2'
        self.assertEqual(output.count(refusal), 1, output)
        self.assertIn('REQUIRED process [stop_gate', output)


def launched(*arguments):
    """What it said until its end."""
    package = [] if arguments[0].startswith('/') else ['pilothouse']
    done = subprocess.run(['roslaunch'] + package + list(arguments), timeout=PATIENCE,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    return done.stdout


def robot_file():
    return os.path.join(rospkg.RosPack().get_path('pilothouse'), 'config', 'robots', 'platform.yaml')


if __name__ == '__main__':
    rospy.init_node('test_refused_processes')
    rostest.rosrun('pilothouse', 'refused_processes', RefusedProcesses, sys.argv)
