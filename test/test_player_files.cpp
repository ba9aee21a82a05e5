// What the players refuse to read, and that they read real recordings.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>

#include "doors/message_views.hpp"
#include "nodelets/depth_folder.hpp"
#include "nodelets/pcd_file.hpp"

namespace pilothouse {
namespace {

class PlayerFiles : public testing::Test {
 protected:
  PlayerFiles() {
    std::string name = testing::TempDir() + "player_files_XXXXXX";
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    folder = name + "/";
  }
  ~PlayerFiles() override { std::filesystem::remove_all(folder); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder + name, std::ios::binary) << bytes;
    return folder + name;
  }
  std::string writeJson(const std::string& width = "4",
                        const std::string& matrix = "[500, 0, 0, 0, 501, 0, 1.5, 1, 1]") {
    return write("camera.json", "{\n\t\"width\" : " + width +
                                    ",\n\t\"height\" : 3,\n\t\"intrinsic_matrix\" :\n\t" + matrix +
                                    "\n}");
  }
  std::string writePicture(const std::string& name, int type, int rows = 3, int cols = 4) const {
    cv::imwrite(folder + name, cv::Mat(rows, cols, type, cv::Scalar(200, 100, 50)));
    return folder + name;
  }
  std::string folder;
};

std::string pcd(const std::string& coding, const std::string& data, const std::string& width = "2",
                const std::string& fields = "x y z") {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields +
         "\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + width +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + width + "\nDATA " + coding + "\n" + data;
}

std::string reasonOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return "";
}
std::string pcdReason(const std::string& path) {
  return reasonOf([&] { readPcd(path); });
}
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(PlayerFiles, ReadsAnAsciiCloud) {
  const auto cloud = readPcd(write("a.pcd", pcd("ascii", "1 2 3\n4 5 nan\n")));
  const auto view = openView(cloud);
  ASSERT_TRUE(view) << view.reason();
  EXPECT_EQ(view->point(0, 0), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(std::isnan(view->point(0, 1).z()));
}

TEST_F(PlayerFiles, RefusesHostileClouds) {
  EXPECT_EQ(pcdReason(folder + "none.pcd"), "no such file");
  EXPECT_EQ(pcdReason(folder), "not a regular file");
  ASSERT_EQ(mkfifo((folder + "pipe.pcd").c_str(), 0600), 0);
  EXPECT_EQ(pcdReason(folder + "pipe.pcd"), "not a regular file") << "would block for ever";
  EXPECT_EQ(pcdReason(write("huge.pcd", pcd("binary", "", "4294967295"))),
            "PCD WIDTH is \"4294967295\", expected 1 to 4194304");
  EXPECT_EQ(pcdReason(write("short.pcd", pcd("binary", std::string(23, '\0')))),
            "PCD data is 23 bytes, expected at least 24 for 2 points");
  EXPECT_EQ(pcdReason(write("no_xyz.pcd", pcd("binary", std::string(24, '\0'), "2", "a b c"))),
            "PCD field x is there 0 times, expected once");
  EXPECT_EQ(pcdReason(write("empty.pcd", "")),
            "PCD header ends without a DATA line, expected one within 8192 bytes");
}

TEST_F(PlayerFiles, RefusesDamagedCompressedData) {
  // 24 bytes are announced, but the back reference of the coding points before their beginning.
  const std::string sizes("\x04\0\0\0\x18\0\0\0", 8);
  EXPECT_EQ(pcdReason(write("a.pcd", pcd("binary_compressed", sizes + "\xFF\xFF\xFF\xFF"))),
            "PCD data is damaged, expected points");
}

TEST_F(PlayerFiles, ReadsOrRefusesEveryMutationOfACloud) {
  // 24 zero bytes as one run of literals.
  const std::string lzf = std::string("\x19\0\0\0\x18\0\0\0\x17", 9) + std::string(24, '\0');
  const std::string files[] = {pcd("ascii", "1 2 3\n4 5 nan\n"),
                               pcd("binary", std::string(24, 'a')), pcd("binary_compressed", lzf)};
  std::mt19937 random(1);
  std::size_t read = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string file = files[i % 3];
    for (auto change = random() % 3; change-- > 0;) {
      const std::size_t at = random() % file.size();
      const char byte = static_cast<char>(random() % 2 == 0 ? random() : '0' + random() % 10);
      if (random() % 3 == 0)
        file.insert(at, 1, byte);
      else
        file[at] = byte;
    }
    pcdReason(write("mutated.pcd", file)).empty() ? ++read : ++refused;
  }
  EXPECT_GT(read, 900U) << "a third is not mutated at all";
  EXPECT_GT(refused, 300U);
}

TEST_F(PlayerFiles, ReadsDepthWithColour) {
  writeJson();
  writePicture("0_depth.png", CV_16UC1);
  writePicture("0_color.png", CV_8UC3);
  const DepthFolder source(folder);
  ASSERT_EQ(source.frames().size(), 1U);
  const DepthFrame frame = source.read(0);
  const auto view = openView(frame.depth, source.info());
  ASSERT_TRUE(view) << view.reason();
  EXPECT_FLOAT_EQ(view->metres(2, 3), 0.2F);
  EXPECT_EQ(view->intrinsics().fy, 501.0);
  EXPECT_EQ(view->intrinsics().cx, 1.5);
  EXPECT_EQ(frame.colour.encoding, "bgr8");
  EXPECT_EQ(frame.colour.data[2], 50);
}

TEST_F(PlayerFiles, RefusesBadFolders) {
  const auto reason = [this] { return reasonOf([this] { DepthFolder{folder}; }); };
  EXPECT_TRUE(contains(reasonOf([this] { DepthFolder{folder + "none"}; }), "none cannot be read"));
  EXPECT_TRUE(contains(reason(), "none named *_depth.png")) << reason();
  writePicture("0_depth.png", CV_16UC1);
  EXPECT_EQ(reason(), "folder has 0 files named *.json, expected one with the intrinsics");
  writeJson();
  EXPECT_EQ(reason(), "");
  write("second.json", "{}");
  EXPECT_EQ(reason(), "folder has 2 files named *.json, expected one with the intrinsics");
}

TEST_F(PlayerFiles, RefusesBadIntrinsics) {
  const auto reason = [this](const std::string& bytes) {
    const std::string path = write("camera.json", bytes);
    const std::string text = reasonOf([&] { readIntrinsics(path); });
    EXPECT_EQ(text.rfind(path + ": ", 0), 0U) << text;
    return text.substr(std::min(text.size(), path.size() + 2));
  };
  EXPECT_TRUE(contains(reason("{"), "not JSON: ")) << reason("{");
  EXPECT_EQ(reason("17"), "not a JSON object");
  EXPECT_EQ(reason("{}"), "width is missing, expected pixels");
  EXPECT_EQ(reason("{\"width\": -4, \"height\": 3}"), "width is -4, expected pixels");
  EXPECT_EQ(reason("{\"width\": 4, \"height\": 3}"),
            "intrinsic_matrix has 0 numbers, expected 9, column by column");
  EXPECT_EQ(reason("{\"width\": 4, \"height\": 3, \"intrinsic_matrix\": [1, 2]}"),
            "intrinsic_matrix has 2 numbers, expected 9, column by column");
  EXPECT_EQ(
      reason("{\"width\": 4, \"height\": 3, \"intrinsic_matrix\": [f, 0, 0, 0, 1, 0, 1, 1, 1]}"),
      "intrinsic_matrix is f, expected numbers");
  EXPECT_EQ(reason(std::string(4097, '[')), "file is 4097 bytes, expected at most 4096");
  EXPECT_FALSE(reason(std::string(4096, '[')).empty());
}

TEST_F(PlayerFiles, RefusesBadPictures) {
  writeJson();
  const auto reason = [this] { return reasonOf([this] { DepthFolder(folder).read(0); }); };
  writePicture("0_depth.png", CV_8UC3);
  EXPECT_EQ(reason(), "PNG has 3 channels of 8 bits, expected one of 16, millimetres");
  writePicture("0_depth.png", CV_16UC1, 3, 5);
  EXPECT_EQ(reason(), "CameraInfo size is 4 x 3, expected 5 x 3 as the depth image");
  write("0_depth.png", "no picture at all, though long enough for one");
  EXPECT_EQ(reason(), "PNG signature is wrong, expected a PNG file");

  writePicture("0_depth.png", CV_16UC1);
  writePicture("0_color.png", CV_8UC3, 30, 40);
  EXPECT_EQ(reason(), "0_color.png: PNG size is 40 x 30, expected 4 x 3 as its intrinsics");
}

TEST_F(PlayerFiles, RefusesTruncatedAndHugePictures) {
  writeJson();
  const std::string path = writePicture("0_depth.png", CV_16UC1);
  std::ifstream file(path, std::ios::binary);
  std::string whole((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto reason = [this] { return reasonOf([this] { DepthFolder(folder).read(0); }); };
  write("0_depth.png", whole.substr(0, 40));
  EXPECT_EQ(reason(), "PNG data is damaged, expected a picture");
  whole.replace(16, 8, "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF");
  write("0_depth.png", whole);
  EXPECT_TRUE(contains(reason(), "PNG size is 4294967295 x 4294967295")) << reason();
}

TEST_F(PlayerFiles, RefusesAnUncalibratedCamera) {
  writeJson("4", "[0, 0, 0, 0, 0, 0, 0, 0, 1]");
  writePicture("0_depth.png", CV_16UC1);
  EXPECT_EQ(reasonOf([this] { DepthFolder(folder).read(0); }),
            "CameraInfo fx and fy are 0, expected a calibrated camera");
}

TEST(RealFiles, AreRead) {
  const char* data = std::getenv("PILOTHOUSE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PILOTHOUSE_DATA is not set: no recordings to read";
  const std::string root = std::string(data) + "/";
  for (const std::string name :
       {"floor_depth/kinect_labelled/learn0.pcd", "people/five_people.pcd",
        "stairs/anymal_ori_entrance_stairs_06.pcd", "stairs/tilted-steps.pcd"}) {
    const auto cloud = readPcd(root + name);
    const auto view = openView(cloud);
    ASSERT_TRUE(view) << name << ": " << view.reason();
    EXPECT_GT(view->points(), 100000U) << name;
  }
  const DepthFolder source(root + "floor_depth/realsense_floor");
  ASSERT_EQ(source.frames().size(), 6U);
  EXPECT_DOUBLE_EQ(source.info().K[0], 617.25);
  EXPECT_DOUBLE_EQ(source.info().K[2], 317.3921203613281);
  for (std::size_t i = 0; i < source.frames().size(); ++i)
    EXPECT_EQ(source.read(i).colour.width, 640U);
}

}  // namespace
}  // namespace pilothouse
