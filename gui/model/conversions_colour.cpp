#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "doors/message_views.hpp"
#include "gui/model/conversions.hpp"

namespace pilothouse::gui {

namespace {

using Result = Converted<ColourPicture>;
constexpr int kMaxSide = 8192;
constexpr std::size_t kMaxPixels = std::size_t{1} << 24;
constexpr std::size_t kMaxCoded = std::size_t{1} << 25;  // bytes

std::string sizeFault(std::size_t width, std::size_t height) {
  const bool sound = width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide &&
                     width * height <= kMaxPixels;
  if (sound) return {};
  return "picture of " + std::to_string(width) + " x " + std::to_string(height) +
         ", expected 1 to " + std::to_string(kMaxSide) + " a side and at most " +
         std::to_string(kMaxPixels) + " pixels";
}

// Bytes of red, green and blue in a pixel of an encoding; step 0: not known.
struct Channels {
  int step, red, green, blue;
};
Channels channelsOf(const std::string& encoding) {
  if (encoding == "rgb8") return {3, 0, 1, 2};
  if (encoding == "bgr8") return {3, 2, 1, 0};
  if (encoding == "rgba8") return {4, 0, 1, 2};
  if (encoding == "bgra8") return {4, 2, 1, 0};
  if (encoding == "mono8") return {1, 0, 0, 0};
  return {0, 0, 0, 0};
}

Result refuse(const std::string& reason) {
  return Result::refused(reason);
}

std::uint32_t bigEndian(const std::uint8_t* bytes, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8U | bytes[i];
  return value;
}

}  // namespace

Result colourFromImage(const sensor_msgs::Image& image) {
  const std::string fault = sizeFault(image.width, image.height);
  if (!fault.empty()) return refuse(fault);
  const Channels channels = channelsOf(image.encoding);
  if (channels.step == 0) {
    return refuse("encoding '" + image.encoding.substr(0, 32) +
                  "', expected rgb8, bgr8, rgba8, bgra8 or mono8");
  }
  const std::size_t needed = std::size_t{image.width} * static_cast<std::size_t>(channels.step);
  if (image.step < needed) {
    return refuse("step " + std::to_string(image.step) + ", expected at least " +
                  std::to_string(needed));
  }
  const std::size_t total = std::size_t{image.step} * (image.height - 1) + needed;
  if (image.data.size() < total) {
    return refuse(std::to_string(image.data.size()) + " bytes, expected " + std::to_string(total));
  }
  auto picture = std::make_shared<ColourPicture>();
  picture->image =
      QImage(static_cast<int>(image.width), static_cast<int>(image.height), QImage::Format_RGB32);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const std::uint8_t* in = image.data.data() + std::size_t{row} * image.step;
    auto* out = reinterpret_cast<QRgb*>(picture->image.scanLine(static_cast<int>(row)));
    for (std::uint32_t column = 0; column < image.width; ++column, in += channels.step) {
      out[column] = qRgb(in[channels.red], in[channels.green], in[channels.blue]);
    }
  }
  picture->frame = image.header.frame_id;
  return Result::of(std::move(picture));
}

Checked<CodedSize> codedSize(const std::vector<std::uint8_t>& bytes) {
  using Size = Checked<CodedSize>;
  static const std::uint8_t kPng[] = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
  if (bytes.size() >= 24 && std::memcmp(bytes.data(), kPng, sizeof kPng) == 0) {
    const std::uint32_t width = bigEndian(&bytes[16], 4);
    const std::uint32_t height = bigEndian(&bytes[20], 4);
    if (width > 1U << 20U || height > 1U << 20U) return Size::refused("PNG of an absurd size");
    return Size::of({static_cast<int>(width), static_cast<int>(height)});
  }
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) {
    return Size::refused("neither a JPEG nor a PNG");
  }
  // Walk the JPEG's segments up to the first start of frame.
  std::size_t at = 2;
  while (at + 9 < bytes.size()) {
    if (bytes[at] != 0xff) return Size::refused("JPEG with a broken segment");
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const bool frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) {
      return Size::of({static_cast<int>(bigEndian(&bytes[at + 7], 2)),
                       static_cast<int>(bigEndian(&bytes[at + 5], 2))});
    }
    at += 2 + std::size_t{bigEndian(&bytes[at + 2], 2)};
  }
  return Size::refused("JPEG without a frame");
}

Result colourFromCompressed(const sensor_msgs::CompressedImage& image) {
  if (image.data.size() > kMaxCoded) {
    return refuse(std::to_string(image.data.size()) + " bytes, expected at most " +
                  std::to_string(kMaxCoded));
  }
  const auto size = codedSize(image.data);
  if (!size) return refuse(size.reason());
  const std::string fault =
      sizeFault(static_cast<std::size_t>(size->width), static_cast<std::size_t>(size->height));
  if (!fault.empty()) return refuse(fault);
  cv::Mat bgr;
  try {
    bgr = cv::imdecode(image.data, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    return refuse("cannot be decoded: " + error.err);
  }
  if (bgr.empty()) return refuse("cannot be decoded");
  auto picture = std::make_shared<ColourPicture>();
  picture->image = QImage(bgr.cols, bgr.rows, QImage::Format_RGB32);
  cv::Mat out(bgr.rows, bgr.cols, CV_8UC4, picture->image.bits(),
              static_cast<std::size_t>(picture->image.bytesPerLine()));
  cv::cvtColor(bgr, out, cv::COLOR_BGR2BGRA);  // QRgb in memory on a little-endian machine
  picture->frame = image.header.frame_id;
  return Result::of(std::move(picture));
}

Result colourFromCloud(const sensor_msgs::PointCloud2& cloud) {
  const auto view = openView(cloud);
  if (!view) return refuse(view.reason());
  if (view->height() < 2) return refuse("the cloud is not organised");
  const sensor_msgs::PointField* rgb = nullptr;
  for (const auto& field : cloud.fields) {
    if (field.name == "rgb" || field.name == "rgba") rgb = &field;
  }
  if (!rgb) return refuse("the cloud has no field rgb");
  if (view->pointStep() < 4 || rgb->offset > view->pointStep() - 4) {
    return refuse("field rgb at " + std::to_string(rgb->offset) + ", expected at most " +
                  std::to_string(view->pointStep()) + " - 4");
  }
  auto picture = std::make_shared<ColourPicture>();
  picture->image = QImage(static_cast<int>(view->width()), static_cast<int>(view->height()),
                          QImage::Format_RGB32);
  for (std::uint32_t row = 0; row < view->height(); ++row) {
    const std::uint8_t* in = view->row(row) + rgb->offset;
    auto* out = reinterpret_cast<QRgb*>(picture->image.scanLine(static_cast<int>(row)));
    for (std::uint32_t column = 0; column < view->width(); ++column, in += view->pointStep()) {
      out[column] = qRgb(in[2], in[1], in[0]);
    }
  }
  picture->frame = cloud.header.frame_id;
  return Result::of(std::move(picture));
}

}  // namespace pilothouse::gui
