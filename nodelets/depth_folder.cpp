#include "nodelets/depth_folder.hpp"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/fill_image.h>
#include <sensor_msgs/image_encodings.h>
#include <yaml-cpp/yaml.h>
#include <opencv2/imgcodecs.hpp>

#include <sstream>
#include <stdexcept>

#include "core/replay/png_header.hpp"
#include "doors/file_bytes.hpp"
#include "doors/message_views.hpp"

namespace pilothouse {
namespace {

// Some 200 bytes in practice; old yaml-cpp recurses without a limit.
constexpr std::size_t kLargestIntrinsics = 4096;
constexpr std::size_t kLargestPng = std::size_t{1} << 26;

template <class T>
T valueOf(const YAML::Node& node, const std::string& key, const std::string& expected) {
  if (!node.IsDefined()) throw std::runtime_error(key + " is missing, expected " + expected);
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(key + " is " + (node.IsScalar() ? node.Scalar() : "not a scalar") +
                             ", expected " + expected);
  }
}

YAML::Node parse(const std::string& path) {
  try {
    const YAML::Node file = YAML::Load(readWhole(path, kLargestIntrinsics));
    if (!file.IsMap()) throw std::runtime_error("not a JSON object");
    return file;
  } catch (const YAML::Exception& fault) {
    throw std::runtime_error(std::string("not JSON: ") + fault.what());
  }
}

sensor_msgs::CameraInfo infoOf(const YAML::Node& file) {
  sensor_msgs::CameraInfo info;
  info.width = valueOf<std::uint32_t>(file["width"], "width", "pixels");
  info.height = valueOf<std::uint32_t>(file["height"], "height", "pixels");
  const YAML::Node matrix = file["intrinsic_matrix"];
  const std::size_t numbers = matrix.IsDefined() && matrix.IsSequence() ? matrix.size() : 0;
  if (numbers != 9)
    throw std::runtime_error("intrinsic_matrix has " + std::to_string(numbers) +
                             " numbers, expected 9, column by column");
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t col = 0; col < 3; ++col) {
      const double value = valueOf<double>(matrix[col * 3 + row], "intrinsic_matrix", "numbers");
      info.K[row * 3 + col] = value;
      info.P[row * 4 + col] = value;
    }
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  return info;
}

/// @param mode of cv::imdecode. The header is checked first: a decoder allocates what it says.
cv::Mat readPng(const std::string& path, int mode) {
  const std::string bytes = readWhole(path, kLargestPng);
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const auto header = parsePngHeader(data, bytes.size());
  if (!header) throw std::runtime_error(header.reason());
  // Only read from; OpenCV has no view of constant bytes.
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<std::uint8_t*>(data));
  cv::Mat picture = cv::imdecode(encoded, mode);
  if (picture.empty()) throw std::runtime_error("PNG data is damaged, expected a picture");
  return picture;
}

sensor_msgs::Image imageOf(const cv::Mat& picture, const std::string& encoding) {
  sensor_msgs::Image image;
  sensor_msgs::fillImage(image, encoding, static_cast<std::uint32_t>(picture.rows),
                         static_cast<std::uint32_t>(picture.cols),
                         static_cast<std::uint32_t>(picture.step[0]), picture.data);
  return image;
}

/// Runs `read` and puts the file's name before what it throws.
template <class Read>
auto naming(const std::string& name, Read read) {
  try {
    return read();
  } catch (const std::exception& fault) {
    throw std::runtime_error(name + ": " + fault.what());
  }
}

}  // namespace

sensor_msgs::CameraInfo readIntrinsics(const std::string& path) {
  return naming(path, [&] { return infoOf(parse(path)); });
}

DepthFolder::DepthFolder(const std::string& folder) : folder_(folder) {
  const std::vector<std::string> names = listFolder(folder);
  auto pairs = pairFrames(names);
  if (!pairs) throw std::runtime_error(pairs.reason());
  frames_ = *pairs;
  std::vector<std::string> intrinsics;
  for (const std::string& name : names)
    if (endsWith(name, ".json")) intrinsics.push_back(name);
  if (intrinsics.size() != 1)
    throw std::runtime_error("folder has " + std::to_string(intrinsics.size()) +
                             " files named *.json, expected one with the intrinsics");
  info_ = readIntrinsics(folder + "/" + intrinsics[0]);
}

DepthFrame DepthFolder::read(std::size_t index) const {
  const FramePair& pair = frames_.at(index);
  DepthFrame frame;
  const cv::Mat depth = readPng(folder_ + "/" + pair.depth, cv::IMREAD_UNCHANGED);
  if (depth.type() != CV_16UC1)
    throw std::runtime_error("PNG has " + std::to_string(depth.channels()) + " channels of " +
                             std::to_string(depth.elemSize1() * 8) +
                             " bits, expected one of 16, millimetres");
  frame.depth = imageOf(depth, sensor_msgs::image_encodings::TYPE_16UC1);
  const auto view = openView(frame.depth, info_);
  if (!view) throw std::runtime_error(view.reason());
  if (pair.colour.empty()) return frame;
  naming(pair.colour, [&] {
    const cv::Mat colour = readPng(folder_ + "/" + pair.colour, cv::IMREAD_COLOR);
    frame.colour = imageOf(colour, sensor_msgs::image_encodings::BGR8);
    if (frame.colour.width != info_.width || frame.colour.height != info_.height)
      throw std::runtime_error("PNG size is " + std::to_string(frame.colour.width) + " x " +
                               std::to_string(frame.colour.height) + ", expected " +
                               std::to_string(info_.width) + " x " + std::to_string(info_.height) +
                               " as its intrinsics");
  });
  return frame;
}

}  // namespace pilothouse
