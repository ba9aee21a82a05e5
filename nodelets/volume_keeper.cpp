#include "nodelets/volume_keeper.hpp"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "doors/atomic_file.hpp"
#include "doors/file_bytes.hpp"
#include "doors/map_files.hpp"
#include "doors/message_views.hpp"

namespace pilothouse {
namespace {

using Lock = std::lock_guard<std::mutex>;

constexpr std::size_t kMostBytes = std::size_t{1} << 26;

std_msgs::ColorRGBA colourOf(float height) {
  const float share = std::min(1.0F, std::max(0.0F, height / 2.0F));
  std_msgs::ColorRGBA colour;  // blue on the floor, over green, to red
  colour.r = std::min(1.0F, std::max(0.0F, 2.0F * share - 0.6F));
  colour.g = 1.0F - std::abs(2.0F * share - 1.0F);
  colour.b = std::max(0.0F, 1.0F - 2.0F * share);
  colour.a = 1.0F;
  return colour;
}

sensor_msgs::PointField field(const char* name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  return field;
}

}  // namespace

VolumeKeeper::VolumeKeeper(const VolumeKeeperSettings& settings)
    : folder_(settings.folder), volume_(settings.volume), kept_(settings.name) {
  std::error_code error;
  if (settings.name.empty() || !std::filesystem::exists(pathOf(settings.name), error)) return;
  try {
    load(settings.name);
  } catch (const std::runtime_error& fault) {
    kept_.isBad(fault.what());
  }
}

std::string VolumeKeeper::add(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info,
                              const Eigen::Isometry3d& T_map_optical) {
  const auto view = openView(image, info);
  if (!view) return view.reason();
  const Lock lock(mutex_);
  return volume_.add(*view, T_map_optical);
}

std::string VolumeKeeper::pathOf(const std::string& name) const {
  const std::string fault = mapNameFault(name);
  if (!fault.empty()) throw std::runtime_error(fault);
  return folder_ + "/" + name + ".bt";
}

std::string VolumeKeeper::save(const std::string& name) {
  const std::string chosen = kept_.chosen(name), path = pathOf(chosen);
  const Lock files_lock(files_);
  std::string bytes;
  std::uint64_t saved = 0;
  {
    const Lock lock(mutex_);
    bytes = volume_.encode();
    saved = version();
  }
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::runtime_error("cannot make " + folder_ + ": " + error.message());
  writeAtomically(path, bytes);
  const Lock lock(mutex_);
  kept_.saved(chosen, saved);
  return "saved " + path;
}

void VolumeKeeper::saveByItself() {
  {
    const Lock lock(mutex_);
    if (!kept_.isBehind(version(), volume_.isEmpty())) return;
  }
  try {
    save({});
  } catch (const std::runtime_error& fault) {
    const Lock lock(mutex_);
    kept_.failed(fault.what());
  }
}

std::string VolumeKeeper::load(const std::string& name) {
  const std::string chosen = kept_.chosen(name), path = pathOf(chosen);
  try {
    const std::string bytes = readWhole(path, kMostBytes);
    const Lock lock(mutex_);
    const std::uint64_t before = version();
    const std::string fault = volume_.decode(bytes);
    if (!fault.empty()) throw std::runtime_error(fault);
    version_ = before + 1;  // never one that was saved
    kept_.loaded(chosen, version());
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error(path + ": " + fault.what());
  }
  return "loaded " + path;
}

void VolumeKeeper::clear() {
  const Lock lock(mutex_);
  version_ = version() + 1;
  volume_.clear();
}

std::string VolumeKeeper::fault() const {
  const Lock lock(mutex_);
  return kept_.fault();
}

VolumeMap::Report VolumeKeeper::report() const {
  const Lock lock(mutex_);
  return volume_.report();
}

sensor_msgs::PointCloud2::Ptr VolumeKeeper::points(const std_msgs::Header& header,
                                                   std::size_t most) const {
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header = header;
  cloud->fields = {field("x", 0), field("y", 4), field("z", 8), field("size", 12)};
  cloud->point_step = 16;
  cloud->height = 1;
  cloud->is_dense = true;
  const Lock lock(mutex_);
  volume_.forEachOccupied([&](const Eigen::Vector3f& middle, float edge) {
    if (cloud->width >= most) return;
    const float words[4] = {middle.x(), middle.y(), middle.z(), edge};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(words);
    cloud->data.insert(cloud->data.end(), bytes, bytes + sizeof words);
    ++cloud->width;
  });
  cloud->row_step = cloud->width * cloud->point_step;
  return cloud;
}

visualization_msgs::Marker::Ptr VolumeKeeper::cubes(const std_msgs::Header& header,
                                                    std::size_t most) const {
  auto marker = boost::make_shared<visualization_msgs::Marker>();
  marker->header = header;
  marker->ns = "volume";
  marker->type = visualization_msgs::Marker::CUBE_LIST;
  marker->pose.orientation.w = 1.0;
  const Lock lock(mutex_);
  const double voxel = volume_.parameters().voxel;
  marker->scale.x = marker->scale.y = marker->scale.z = voxel;
  volume_.forEachOccupied([&](const Eigen::Vector3f& middle, float edge) {
    // A leaf that stands for several voxels, voxel by voxel: a list has cubes of one size.
    const auto steps = static_cast<int>(std::lround(static_cast<double>(edge) / voxel));
    const auto size = static_cast<float>(voxel);
    const Eigen::Vector3f first = (middle.array() - 0.5F * (edge - size)).matrix();
    for (int i = 0; i < steps * steps * steps && marker->points.size() < most; ++i) {
      geometry_msgs::Point point;
      point.x = first.x() + static_cast<float>(i % steps) * size;
      point.y = first.y() + static_cast<float>(i / steps % steps) * size;
      point.z = first.z() + static_cast<float>(i / steps / steps) * size;
      marker->points.push_back(point);
      marker->colors.push_back(colourOf(static_cast<float>(point.z)));
    }
  });
  if (marker->points.empty()) marker->action = visualization_msgs::Marker::DELETE;
  return marker;
}

}  // namespace pilothouse
