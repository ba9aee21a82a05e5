#!/usr/bin/python3
"""Prints how a bag's own topics map to those that Pilothouse listens to, as roslaunch arguments.

usage: bag_topics.py FILE [FROM:=TO]...
A FROM:=TO names one of the bag's topics and one of Pilothouse's (such as
/my_cam/depth:=camera/depth/image_rect) and goes before what is guessed from the types.
"""
import sys

import rosbag

# Pilothouse's topic -> launch argument
ARGUMENTS = {
    'camera/depth/image_rect': 'depth_topic',
    'camera/depth/camera_info': 'info_topic',
    'camera/rgb/image_rect_color': 'colour_topic',
    'camera/rgb/image_rect_color/compressed': 'compressed_colour_topic',
    'camera/depth/points': 'points_topic',
}


def refuse(text):
    print('bag_topics.py: ' + text, file=sys.stderr)
    sys.exit(2)


def guess(types):
    """Pilothouse's topic -> the bag's, by type and name."""
    found = {}

    def first(target, wanted_type, test):
        names = sorted(n for n, t in types.items() if t == wanted_type and test(n.lower()))
        if names:
            found[target] = names[0]

    def is_depth(name):
        return 'depth' in name

    first('camera/depth/image_rect', 'sensor_msgs/Image', is_depth)
    depth = found.get('camera/depth/image_rect')
    first('camera/depth/camera_info', 'sensor_msgs/CameraInfo', is_depth)
    if depth:
        sibling = depth.rsplit('/', 1)[0] + '/camera_info'
        if types.get(sibling) == 'sensor_msgs/CameraInfo':
            found['camera/depth/camera_info'] = sibling
    first('camera/rgb/image_rect_color', 'sensor_msgs/Image', lambda n: not is_depth(n))
    first('camera/rgb/image_rect_color/compressed', 'sensor_msgs/CompressedImage',
          lambda n: not is_depth(n))
    first('camera/depth/points', 'sensor_msgs/PointCloud2', lambda n: True)
    return found


def main(arguments):
    if not arguments or arguments[0] in ('--help', '-h'):
        print(__doc__.strip())
        return
    path, remaps = arguments[0], arguments[1:]
    try:
        with rosbag.Bag(path) as bag:
            types = {n: i.msg_type for n, i in bag.get_type_and_topic_info().topics.items()}
    except (OSError, rosbag.ROSBagException) as error:
        refuse('%s is not a bag that can be read: %s' % (path, error))
    found = guess(types)
    for remap in remaps:
        source, separator, target = remap.partition(':=')
        target = target.lstrip('/')
        if not separator or target not in ARGUMENTS:
            refuse('--remap %s, expected FROM:=TO with TO one of: %s'
                   % (remap, ', '.join(ARGUMENTS)))
        if source not in types:
            refuse('--remap %s: %s has no topic %s, it has: %s'
                   % (remap, path, source, ', '.join(sorted(types))))
        found[target] = source
    if 'camera/depth/image_rect' in found and 'camera/depth/camera_info' in found:
        print('input:=depth')
    elif 'camera/depth/points' in found:
        print('input:=cloud')
    else:
        refuse('%s has neither a depth image with its CameraInfo nor a point cloud; it has: %s'
               % (path, ', '.join('%s (%s)' % t for t in sorted(types.items()))))
    has_tf = any(n.lstrip('/') in ('tf', 'tf_static') for n in types)
    print('mounting_source:=' + ('tf' if has_tf else 'search'))
    for target, source in sorted(found.items()):
        print('%s:=%s' % (ARGUMENTS[target], source))


if __name__ == '__main__':
    main(sys.argv[1:])
