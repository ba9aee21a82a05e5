#!/usr/bin/env python3
"""Write the seeds of the fuzz targets into corpus/TARGET beside this file. Run it after changing
what an input looks like (cloud_input.hpp, depth_input.hpp, fuzz_*.cpp), and commit the result."""
import math
import os
import struct
import zlib

XYZ = [(0, 0, 7, 1), (1, 4, 7, 1), (2, 8, 7, 1)]  # name's number, offset, datatype, count


def floats(*values):
    return struct.pack("<%df" % len(values), *values)


def cloud(width, height, step, row_step=None, fields=XYZ, data=None, flags=0):
    row_step = width * step if row_step is None else row_step
    head = struct.pack("<IIIIBB", width, height, step, row_step, flags, len(fields))
    head += b"".join(struct.pack("<BIBI", *field) for field in fields)
    return head + (bytes(height * row_step) if data is None else data)


def depth(width, height, pixel, encoding, data=None, step=None, info=None, f=500.0, flags=0):
    step = width * pixel if step is None else step
    info = info or (width, height)
    head = struct.pack("<IIIBBII4d", width, height, step, encoding, flags, *info, f, f,
                       width / 2.0, height / 2.0)
    return head + (bytes(height * step) if data is None else data)


def text(value):
    return struct.pack("<I", len(value)) + value


HEADER = bytes(12) + text(b"camera")


def cloud_message(fields=1, data=4):
    return (HEADER + struct.pack("<III", 1, 1, fields) + text(b"x") + struct.pack("<IBI", 0, 7, 1) +
            struct.pack("<BIII", 0, 4, 4, data) + bytes(4) + b"\1")


def image_message(data=2):
    return HEADER + struct.pack("<II", 1, 1) + text(b"16UC1") + struct.pack("<BII", 0, 2, data) + bytes(2)


def info_message(coefficients=5):
    return (HEADER + struct.pack("<II", 1, 1) + text(b"plumb_bob") +
            struct.pack("<I", coefficients) + bytes(40 + 240 + 25))


def pcd(data, coding, points=2, fields="x y z", size="4 4 4", kind="F F F", count="COUNT 1 1 1\n"):
    return (b"\0# .PCD v0.7\nVERSION 0.7\nFIELDS %s\nSIZE %s\nTYPE %s\n%sWIDTH %d\nHEIGHT 1\n"
            b"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA %s\n" %
            tuple(v.encode() if isinstance(v, str) else v
                  for v in (fields, size, kind, count, points, points, coding)) + data)


def png(width, height):
    return b"\1\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBBI", 13, b"IHDR", width, height,
                                                16, 0, 0, 0, 0, 0)


def own_map(blocks, size=0.05, version=1):
    data = b"".join(struct.pack("<ii", *place) + struct.pack("<hbb", 190, 0, 3) * 256 for place in blocks)
    head = struct.pack("<8sIIdddIIQI", b"PHMAP\r\n\x1a", version, 64, size, 0.0, 0.0, 16, len(blocks),
                       64 + len(data), zlib.crc32(data))
    return b"\0" + head + struct.pack("<I", zlib.crc32(head)) + data


def map_picture(head, pixels, resolution=0.05):
    return b"\1" + struct.pack("<3d", resolution, -1.0, -0.5) + head + pixels


def octree(nodes, data, res="0.05", tree="OcTree"):
    return (b"# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
            b"id %s\nsize %d\nres %s\ndata\n" % (tree.encode(), nodes, res.encode())) + data


CORPUS = {
    "cloud_view": {
        "organised": cloud(3, 2, 16, data=floats(*range(24))),
        "unorganised": cloud(4, 1, 12, data=floats(*range(12))),
        "padded": cloud(2, 2, 16, row_step=40),
        "odd_step": cloud(2, 2, 13),
        "empty": cloud(0, 0, 12),
        "not_finite": cloud(2, 1, 12, data=floats(float("nan"), 0, 1, float("inf"), -1e38, 1e38)),
        "reordered": cloud(2, 1, 20, fields=[(2, 0, 7, 1), (3, 4, 6, 1), (0, 8, 7, 0), (1, 16, 7, 1)]),
        "short": cloud(2, 2, 12, data=bytes(47)),
        "huge": cloud(0xFFFFFFFF, 0xFFFFFFFF, 12, row_step=12, data=b""),
        "overflow": cloud(4, 1, 0x40000000, row_step=0, data=b""),
        "offset": cloud(1, 1, 12, fields=[(0, 0xFFFFFFFC, 7, 1)] + XYZ[1:]),
        "twice": cloud(1, 1, 16, fields=XYZ + [(0, 12, 7, 1)]),
        "big_endian": cloud(1, 1, 12, flags=1),
        "unaligned": cloud(4, 1, 12, data=floats(*range(12)), flags=2),
        "no_xyz": cloud(1, 1, 12, fields=[]),
    },
    "depth_view": {
        "millimetres": depth(4, 3, 2, 0, struct.pack("<12H", *range(0, 12000, 1000))),
        "metres": depth(2, 2, 4, 1, floats(1.5, float("nan"), float("inf"), -1.0)),
        "mono16": depth(3, 2, 2, 2),
        "padded": depth(3, 2, 2, 0, step=8),
        "odd_step": depth(3, 2, 2, 0, step=7),
        "rgb8": depth(2, 2, 3, 3),
        "oversized": depth(0xFFFFFFFF, 0xFFFFFFFF, 0, 0, b"", step=0, info=(1, 1)),
        "short": depth(4, 3, 2, 0, bytes(23)),
        "other_info": depth(4, 3, 2, 0, info=(3, 4)),
        "uncalibrated": depth(4, 3, 2, 0, f=0.0),
        "big_endian": depth(4, 3, 2, 0, flags=1),
        "unaligned": depth(2, 2, 4, 1, floats(1.5, float("nan"), float("inf"), -1.0), flags=2),
    },
    "message_bounds": {
        "cloud": b"\0" + cloud_message(),
        "cloud_bomb": b"\0" + cloud_message(fields=40000000),
        "cloud_data_bomb": b"\0" + cloud_message(data=0xFFFFFFFF),
        "image": b"\1" + image_message(),
        "image_bomb": b"\1" + image_message(data=0x80000000),
        "compressed": b"\2" + HEADER + text(b"jpeg") + text(b"\xff\xd8\xff"),
        "info": b"\3" + info_message(),
        "info_bomb": b"\3" + info_message(coefficients=0x20000001),
        "path": b"\6" + HEADER + struct.pack("<I", 1) + HEADER + bytes(56),
    },
    "wire_schema": {
        "nested": b"\0" + HEADER + struct.pack("<I", 1) + text(b"n") + struct.pack("<If", 1, 1.0) +
                  struct.pack("<I", 1) + bytes(8) + text(b"data") + bytes(72) + text(b"a") + text(b"b"),
        "bomb": b"\0" + HEADER + struct.pack("<I", 40000000) + bytes(40),
        "words": b"\1" + struct.pack("<I", 2) + text(b"one") + text(b"two") + struct.pack("<I", 3),
        "empty_ones": b"\1" + struct.pack("<II", 0, 0xFFFFFFFF),
        "definition": b"\2B[3] b\nstring S=# c\n~p/B\nint16[] x # y\nHeader h\n~std_msgs/Header\n"
                      b"time t\n\0" + 3 * (struct.pack("<Ih", 1, 5) + bytes(8)),
        "itself": b"\2A[] a\n\0",
    },
    "map_files": {
        "own": own_map([(-1, 0), (0, 0)]),
        "own_empty": own_map([]),
        "own_far": own_map([(1000000, 0)]),
        "own_twice": own_map([(0, 0), (0, 0)]),
        "own_nan": own_map([(0, 0)], size=float("nan")),
        "own_version": own_map([(0, 0)], version=2),
        "own_mended": b"\2" + own_map([(0, 0)])[1:-1],
        "picture": map_picture(b"P5\n# a map\n3 2\n255\n", bytes([0, 205, 254] * 2)),
        "picture_short": map_picture(b"P5 3 2 255\n", bytes(5)),
        "picture_huge": map_picture(b"P5 4294967295 4294967295 255\n", b""),
        "picture_nan": map_picture(b"P5 1 1 255\n", b"\0", resolution=float("nan")),
    },
    "octree_bytes": {
        "leaf": octree(2, b"\1\0"),
        "levels": octree(17, b"\3\0" * 15 + b"\1\0"),
        "too_deep": octree(18, b"\3\0" * 16 + b"\1\0"),
        "all_inner": octree(1000, b"\xff" * 2000),
        "none": octree(0, b""),
        "short": octree(3, b"\3"),
        "childless": octree(1, b"\0\0"),
        "nan": octree(2, b"\1\0", res="nan"),
        "colour": octree(2, b"\1\0", tree="ColorOcTree"),
        "noise": b"\xff" * 64,
    },
    "file_headers": {
        "pcd_binary": pcd(bytes(24), "binary"),
        "pcd_ascii": pcd(b"0 0 1\n0 nan 1\n", "ascii"),
        "pcd_compressed": pcd(struct.pack("<II", 3, 24) + bytes(3), "binary_compressed"),
        "pcd_no_count": pcd(bytes(24), "binary", count=""),
        "pcd_label": pcd(bytes(32), "binary", fields="label x y z", size="4 4 4 4",
                         kind="U F F F", count="COUNT 1 1 1 1\n"),
        "pcd_huge": pcd(b"", "binary", points=4294967295),
        "pcd_inflates": pcd(struct.pack("<II", 3, 0xFFFFFFFF) + bytes(3), "binary_compressed"),
        "png": png(640, 480),
        "png_huge": png(0xFFFFFFFF, 0xFFFFFFFF),
    },
}


def floor_seeds():
    """A level floor seen from 0.65 m, 26 degrees down (74 of 255 parts of 1.5 rad)."""
    def depth_at(row, rows, focal):
        down = math.sin(0.4353) + math.cos(0.4353) * (row - rows / 2.0) / focal
        return 0.65 / down
    millimetres = b"".join(struct.pack("<16H", *[int(1000 * depth_at(r, 12, 12.0)) if r else 0] * 16)
                           for r in range(12))
    nan = float("nan")
    points = b"".join(floats((c - 8) * z / 12.0, (r - 6) * z / 12.0, z if c else nan, 0.0)
                      for r in range(12) for c in range(16) for z in [depth_at(r, 12, 12.0)])
    seeds = {}
    for choice in range(4):
        seeds["depth_%d" % choice] = bytes([choice, 74]) + depth(16, 12, 2, 0, millimetres, f=12.0)
        seeds["cloud_%d" % choice] = bytes([choice | 4, 74]) + cloud(16, 12, 16, data=points)
    seeds["depth_unaligned"] = bytes([0, 74]) + depth(16, 12, 2, 0, millimetres, f=12.0, flags=2)
    seeds["cloud_unaligned"] = bytes([4, 74]) + cloud(16, 12, 16, data=points, flags=2)
    seeds["far"] = bytes([4, 74]) + cloud(2, 1, 12, data=floats(3e38, -3e38, 3e38, 1e-40, 0, 1e30))
    seeds["metres"] = bytes([0, 74]) + depth(4, 1, 4, 1, floats(1.0, 3e38, 1e-40, 1.5), f=1.0)
    return seeds


CORPUS["floor"] = floor_seeds()


def main():
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "corpus")
    for target, seeds in CORPUS.items():
        os.makedirs(os.path.join(root, target), exist_ok=True)
        for name, data in seeds.items():
            with open(os.path.join(root, target, name), "wb") as seed:
                seed.write(data)


if __name__ == "__main__":
    main()
