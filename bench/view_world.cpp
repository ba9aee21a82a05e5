// Pictures of a world: what a robot's camera sees from a place, and the whole from above. See
// --help.

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sim/actor_path.hpp"
#include "sim/random_world.hpp"
#include "sim/world_camera.hpp"
#include "sim/world_file.hpp"

namespace pilothouse::bench {
namespace {

constexpr const char* kHelp =
    "usage: view_world [options] WORLD.sdf|SEED OUT.png\n"
    "Draws a world's file, or the random world of a seed, as one PNG: the robot's colour and "
    "depth\n"
    "picture, and the world from above with start (red), routes (blue) and people's ways "
    "(orange).\n"
    "  --at X Y DEG    where the robot stands (default: the world's start)\n"
    "  --height H      of the camera [m], 0.05..50 (default 0.65)\n"
    "  --pitch DEG     how far it looks down, -90..90 (default 26)\n"
    "  --time T        of the people [s], 0..1e6 (default 0)\n"
    "  --camera NAME   kinect, kinect_qvga, realsense or tof (default kinect)\n"
    "Ends with 2 on a wrong call or a world that is refused.\n";

struct Options {
  std::string world, out, camera = "kinect";
  std::optional<Pose2> at;
  double height = 0.65, pitch_deg = 26.0, time = 0.0;
};

[[noreturn]] void refuse(const std::string& message) {
  std::cerr << "view_world: " << message << "\n";
  std::exit(2);
}

double number(const std::string& option, const char* text, double low, double high) {
  if (text == nullptr) refuse(option + " needs a value");
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*text == '\0' || *end != '\0' || !(value >= low && value <= high)) {
    refuse(option + " is '" + text + "', expected a number from " + std::to_string(low) + " to " +
           std::to_string(high));
  }
  return value;
}

Options readOptions(int argc, char** argv) {
  Options options;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    const auto next = [&] { return i + 1 < argc ? argv[++i] : nullptr; };
    if (option == "--help" || option == "-h") {
      std::cout << kHelp;
      std::exit(0);
    } else if (option == "--at") {
      const double x = number(option, next(), -1e4, 1e4), y = number(option, next(), -1e4, 1e4);
      options.at = Pose2{x, y, number(option, next(), -1e4, 1e4) * M_PI / 180.0};
    } else if (option == "--height") {
      options.height = number(option, next(), 0.05, 50.0);
    } else if (option == "--pitch") {
      options.pitch_deg = number(option, next(), -90.0, 90.0);
    } else if (option == "--time") {
      options.time = number(option, next(), 0.0, 1e6);
    } else if (option == "--camera") {
      const char* name = next();
      options.camera = name == nullptr ? "" : name;
      if (!sim::cameraProfile(options.camera)) refuse("unknown camera '" + options.camera + "'");
    } else if (option.size() > 1 && option[0] == '-') {
      refuse("unknown option '" + option + "'");
    } else {
      files.push_back(option);
    }
  }
  if (files.size() != 2) refuse("expected a world and a picture's name; try --help");
  options.world = files[0];
  options.out = files[1];
  return options;
}

sim::World readWorld(const std::string& name) {
  if (name.find_first_not_of("0123456789") == std::string::npos) {
    return sim::randomWorld(std::strtoull(name.c_str(), nullptr, 10)).world;
  }
  const auto loaded = sim::loadWorld(name);
  if (!loaded) refuse(loaded.reason());
  for (const std::string& warning : loaded->warnings) std::cerr << name << ": " << warning << "\n";
  return loaded->world;
}

cv::Mat colourOf(sim::WorldCamera& camera) {
  const auto& model = camera.profile().model;
  cv::Mat rgb(static_cast<int>(model.height), static_cast<int>(model.width), CV_8UC3), bgr;
  camera.colour(rgb.data);
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat depthOf(const sim::WorldCamera& camera) {
  const auto& model = camera.profile().model;
  cv::Mat depth(static_cast<int>(model.height), static_cast<int>(model.width), CV_16UC1);
  camera.depth(1, 0, depth.ptr<std::uint16_t>());
  cv::Mat grey, picture;
  depth.convertTo(grey, CV_8UC1, -255.0 / 6000.0, 255.0);
  cv::applyColorMap(grey, picture, cv::COLORMAP_TURBO);
  picture.setTo(cv::Scalar(0, 0, 0), depth == 0);
  return picture;
}

/// The world from above: a camera far up, so that walls hardly lean.
class TopView {
 public:
  static constexpr int kWide = 1280, kHigh = 900;
  static constexpr double kUp = 150.0;

  explicit TopView(const sim::World& world) {
    Eigen::AlignedBox2d bounds(world.start.position());
    for (const auto& model : world.models) {
      Eigen::AlignedBox2d box;
      for (const auto& part : model.parts)
        for (const auto& vertex : part.mesh.vertices)
          box.extend((model.T_world_model * vertex.cast<double>()).head<2>().eval());
      if (model.name != "garden") bounds.extend(box);  // that lies round it all
    }
    centre_ = bounds.center();
    scale_ = std::min(kWide / (bounds.sizes().x() + 1.0), kHigh / (bounds.sizes().y() + 1.0));
  }

  cv::Mat draw(const sim::World& world, const sim::WorldScene& scene) const {
    sim::CameraProfile profile;
    profile.model = {kWide, kHigh, {scale_ * kUp, scale_ * kUp, kWide / 2.0, kHigh / 2.0}};
    sim::WorldCamera camera(world, profile);
    Eigen::Isometry3d T_world_optical = Eigen::Isometry3d::Identity();
    T_world_optical.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    T_world_optical.translation() << centre_, kUp;
    camera.render(scene, T_world_optical);
    cv::Mat picture = colourOf(camera);
    for (const auto& model : world.models) {
      if (!model.path) continue;
      for (std::size_t i = 1; i < model.path->points.size(); ++i)
        line(picture, model.path->points[i - 1].pose.position(),
             model.path->points[i].pose.position(), cv::Scalar(0, 140, 255));
    }
    for (const auto& [name, points] : world.routes) {
      for (std::size_t i = 1; i < points.size(); ++i)
        line(picture, points[i - 1], points[i], cv::Scalar(220, 90, 30));
      for (const auto& point : points)
        cv::circle(picture, pixel(point), 4, cv::Scalar(220, 90, 30), cv::FILLED, cv::LINE_AA);
      cv::putText(picture, name, pixel(points.back()) + cv::Point(8, -8), cv::FONT_HERSHEY_SIMPLEX,
                  0.6, cv::Scalar(160, 40, 0), 2, cv::LINE_AA);
    }
    const std::vector<Eigen::Vector2d> robot = {{0.25, 0.2},  {-0.25, 0.2}, {-0.25, -0.2},
                                                {0.25, -0.2}, {0.25, 0.2},  {0.0, 0.0},
                                                {0.25, -0.2}};
    for (std::size_t i = 1; i < robot.size(); ++i)
      line(picture, world.start * robot[i - 1], world.start * robot[i], cv::Scalar(30, 30, 220));
    return picture;
  }

 private:
  cv::Point pixel(const Eigen::Vector2d& p) const {
    return {static_cast<int>(kWide / 2.0 + scale_ * (p.x() - centre_.x())),
            static_cast<int>(kHigh / 2.0 - scale_ * (p.y() - centre_.y()))};
  }
  void line(cv::Mat& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
            const cv::Scalar& colour) const {
    cv::line(picture, pixel(from), pixel(to), colour, 2, cv::LINE_AA);
  }

  Eigen::Vector2d centre_;
  double scale_;  ///< pixels a metre
};

int run(const Options& options) {
  const sim::World world = readWorld(options.world);
  sim::WorldScene scene(world);
  for (std::size_t m = 0; m < world.models.size(); ++m) {
    const sim::Model& model = world.models[m];
    if (model.path) scene.place(m, sim::actorPose(model, sim::poseAt(*model.path, options.time)));
  }
  scene.commit();

  const Pose2 at = options.at.value_or(world.start);
  const double ground = scene.groundBelow(at.position(), 1.0).value_or(0.0);
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  T_world_base.translation() << at.x, at.y, ground;
  T_world_base.linear() =
      Eigen::AngleAxisd(at.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const sim::Mounting mounting{options.height, options.pitch_deg * M_PI / 180.0, 0.0};
  sim::WorldCamera camera(world, *sim::cameraProfile(options.camera));
  camera.render(scene, T_world_base * mounting.T_base_optical());

  cv::Mat pictures[2] = {colourOf(camera), depthOf(camera)}, row, sheet;
  for (cv::Mat& picture : pictures)
    cv::resize(picture, picture, {640, 480}, 0, 0, cv::INTER_NEAREST);
  cv::hconcat(pictures[0], pictures[1], row);
  cv::vconcat(row, TopView(world).draw(world, scene), sheet);
  if (!cv::imwrite(options.out, sheet)) refuse("cannot write '" + options.out + "'");
  return 0;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  try {
    return pilothouse::bench::run(pilothouse::bench::readOptions(argc, argv));
  } catch (const std::exception& fault) {
    std::cerr << "view_world: " << fault.what() << "\n";
    return 2;
  }
}
