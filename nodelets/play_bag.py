#!/usr/bin/env python3
"""Plays a bag by `rosbag play`, with its static transforms there for whoever comes late.

usage: play_bag.py BAG [options of rosbag play] [FROM:=TO]...
Most recordings hold tf_static once, at their beginning, and not latched: who subscribes a moment
later would miss it until the bag starts again. So it is read beforehand and published latched.
"""
import subprocess
import sys

import rosbag
import rospy
from tf2_msgs.msg import TFMessage


def static_transforms(path):
    """The newest static transform of each frame."""
    newest = {}
    with rosbag.Bag(path) as bag:
        names = [n for n in bag.get_type_and_topic_info().topics if n.strip('/') == 'tf_static']
        for _, message, _ in bag.read_messages(topics=names) if names else []:
            for transform in message.transforms:
                newest[transform.child_frame_id] = transform
    return list(newest.values())


def main():
    arguments = rospy.myargv()[1:]
    remaps = [a for a in sys.argv[1:] if ':=' in a and not a.startswith('__')]
    if not arguments or not arguments[0]:
        sys.exit('play_bag: no bag is named, expected its path (bag:=FILE)')
    path = arguments[0]
    try:
        transforms = static_transforms(path)
    except (OSError, rosbag.ROSBagException) as error:
        sys.exit('play_bag: %s is not a bag that can be read: %s' % (path, error))
    # roslaunch ends the whole process group; the player then ends by itself.
    rospy.init_node('play_bag', disable_signals=True)
    publisher = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
    publisher.publish(TFMessage(transforms))
    player = subprocess.Popen(['rosrun', 'rosbag', 'play', path] + arguments[1:] + remaps +
                              ['__name:=' + rospy.get_name().strip('/').replace('/', '_') + '_player'])
    try:
        sys.exit(player.wait())
    except KeyboardInterrupt:
        sys.exit(player.wait())


if __name__ == '__main__':
    main()
