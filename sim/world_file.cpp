#include "sim/world_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sdf/Actor.hh>
#include <sdf/Box.hh>
#include <sdf/Collision.hh>
#include <sdf/Console.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Mesh.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Plane.hh>
#include <sdf/Root.hh>
#include <sdf/Sphere.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <sstream>
#include <stdexcept>

#include "core/cloud/quoted.hpp"
#include "sim/mesh_file.hpp"
#include "sim/shapes.hpp"
#include "sim/world_limits.hpp"
#include "sim/world_materials.hpp"
#include "sim/world_xml.hpp"

namespace pilothouse::sim {
namespace {

struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string atLine(const sdf::ElementPtr& element) {
  const auto line = element ? element->LineNumber() : std::nullopt;
  return line ? "line " + std::to_string(*line) + ": " : "";
}

[[noreturn]] void refuse(const sdf::ElementPtr& element, const std::string& what) {
  const std::string tag = element ? "<" + element->GetName() + "> " : "";
  throw Fault(atLine(element) + tag + what);
}

Eigen::Isometry3d isometry(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z();
  T.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  return T;
}

template <class Thing>
Eigen::Isometry3d poseOf(const Thing& thing, const std::string& relative_to) {
  ignition::math::Pose3d pose;
  const sdf::Errors errors = thing.SemanticPose().Resolve(pose, relative_to);
  if (!errors.empty()) refuse(thing.Element(), "has no pose: " + errors.front().Message());
  return isometry(pose);
}

class WorldReader {
 public:
  WorldReader(std::string folder, const WorldNotes& notes)
      : folder_(std::move(folder)), materials_(folder_) {
    loaded_.warnings = notes.warnings;
    loaded_.world.start = notes.start;
    loaded_.world.routes = notes.routes;
    loaded_.world.sunlight = notes.sunlight;
  }

  LoadedWorld read(const std::string& text, const WorldNotes& notes) {
    sdf::Console::Instance()->SetQuiet(true);  // its errors come back below
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
    sdf::Root root;
    checkErrors(root.LoadSdfString(text, config));
    const sdf::World* world = root.WorldByIndex(0);
    if (world == nullptr) throw Fault("libsdformat finds no world in it");
    loaded_.world.name = world->Name();
    for (std::uint64_t i = 0; i < world->ModelCount(); ++i) readModel(*world->ModelByIndex(i));
    for (std::uint64_t i = 0; i < world->ActorCount(); ++i)
      readActor(*world->ActorByIndex(i), notes.courtesy);
    loaded_.world.textures = materials_.takeTextures();
    return std::move(loaded_);
  }

 private:
  void checkErrors(const sdf::Errors& errors) {
    for (const sdf::Error& error : errors) {
      std::string message = error.Message();
      while (!message.empty() && message.back() == '\n') message.pop_back();
      const auto line = error.LineNumber();
      if (line) message = "line " + std::to_string(*line) + ": " + message;
      // An element that SDF does not know is kept by libsdformat and means nothing to us.
      if (error.Code() != sdf::ErrorCode::ELEMENT_INCORRECT_TYPE) throw Fault(message);
      loaded_.warnings.push_back(message);
    }
  }

  void readModel(const sdf::Model& model) {
    Model out;
    out.name = model.Name();
    out.T_world_model = poseOf(model, "");
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const Eigen::Isometry3d T_model_link = poseOf(link, "__model__");
      for (std::uint64_t v = 0; v < link.VisualCount(); ++v)
        readVisual(link, *link.VisualByIndex(v), T_model_link, out);
      for (std::uint64_t c = 0; c < link.CollisionCount(); ++c) {
        const sdf::Collision& collision = *link.CollisionByIndex(c);
        Part part;
        part.name = collision.Name();
        part.visible = false;
        addShape(*collision.Geom(), collision.Element(),
                 T_model_link * poseOf(collision, link.Name()), part, out);
      }
    }
    if (out.parts.empty())
      refuse(model.Element(), pilothouse::quoted(model.Name()) + " has nothing to see");
    loaded_.world.models.push_back(std::move(out));
  }

  /// A link without collisions is as solid as it looks: a simulated robot may not drive through
  /// what it sees because a line was forgotten.
  void readVisual(const sdf::Link& link, const sdf::Visual& visual,
                  const Eigen::Isometry3d& T_model_link, Model& out) {
    Part part;
    part.name = visual.Name();
    part.solid = link.CollisionCount() == 0;
    const auto material = materials_.read(visual);
    if (!material)
      refuse(visual.Element(), pilothouse::quoted(visual.Name()) + ": " + material.reason());
    part.material = material->material;
    addShape(*visual.Geom(), visual.Element(), T_model_link * poseOf(visual, link.Name()), part,
             out);
    if (part.material.texture >= 0) scaleTexture(out.parts.back().mesh, material->texture_metres);
  }

  void addShape(const sdf::Geometry& geometry, const sdf::ElementPtr& element,
                const Eigen::Isometry3d& T_model_part, Part& part, Model& out) {
    part.mesh = moved(meshOf(geometry, element), T_model_part);
    triangles_ += part.mesh.triangles.size();
    if (triangles_ > kMostTriangles) {
      refuse(element,
             "brings the world to more than " + std::to_string(kMostTriangles) + " triangles");
    }
    out.parts.push_back(part);
  }

  Mesh meshOf(const sdf::Geometry& geometry, const sdf::ElementPtr& element) {
    switch (geometry.Type()) {
      case sdf::GeometryType::BOX: {
        const auto size = geometry.BoxShape()->Size();
        return boxMesh({size.X(), size.Y(), size.Z()});
      }
      case sdf::GeometryType::CYLINDER:
        return cylinderMesh(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length());
      case sdf::GeometryType::SPHERE:
        return sphereMesh(geometry.SphereShape()->Radius());
      case sdf::GeometryType::PLANE: {
        const auto normal = geometry.PlaneShape()->Normal();
        const auto size = geometry.PlaneShape()->Size();
        return planeMesh({normal.X(), normal.Y(), normal.Z()}, {size.X(), size.Y()});
      }
      case sdf::GeometryType::MESH:
        return meshFrom(*geometry.MeshShape(), geometry.Element());
      default:
        refuse(element, "has a shape that is not read");
    }
  }

  Mesh meshFrom(const sdf::Mesh& shape, const sdf::ElementPtr& element) {
    const std::string& uri = shape.Uri();
    const auto path = fileOf(uri, folder_);
    if (!path) refuse(element, "names the mesh " + pilothouse::quoted(uri) + ": " + path.reason());
    const auto bytes = readFile(*path);
    if (!bytes)
      refuse(element, "names the mesh " + pilothouse::quoted(uri) + ": " + bytes.reason());
    const std::string ending = uri.substr(std::min(uri.rfind('.'), uri.size()));
    if (ending != ".obj" && ending != ".stl") {
      refuse(element,
             "names the mesh " + pilothouse::quoted(uri) + ", expected an .obj or .stl file");
    }
    const auto mesh = ending == ".obj" ? parseObj(*bytes) : parseStl(*bytes);
    if (!mesh) refuse(element, "names the mesh " + pilothouse::quoted(uri) + ": " + mesh.reason());
    Mesh scaled = *mesh;
    const Eigen::Vector3f scale(static_cast<float>(shape.Scale().X()),
                                static_cast<float>(shape.Scale().Y()),
                                static_cast<float>(shape.Scale().Z()));
    for (Eigen::Vector3f& vertex : scaled.vertices) vertex = vertex.cwiseProduct(scale);
    return scaled;
  }

  void readActor(const sdf::Actor& actor, const std::map<std::string, double>& courtesy) {
    static const Eigen::Vector3f kShirts[] = {
        {0.20F, 0.38F, 0.62F}, {0.74F, 0.30F, 0.22F}, {0.30F, 0.52F, 0.34F}, {0.78F, 0.62F, 0.24F}};
    static const Eigen::Vector3f kTrousers[] = {
        {0.18F, 0.20F, 0.26F}, {0.36F, 0.32F, 0.27F}, {0.22F, 0.26F, 0.38F}};
    Model out;
    out.name = actor.Name();
    out.parts = personParts(kShirts[people_ % 4], kTrousers[people_ % 3]);
    ++people_;
    for (const Part& part : out.parts) triangles_ += part.mesh.triangles.size();
    if (triangles_ > kMostTriangles)
      refuse(actor.Element(),
             "brings the world to more than " + std::to_string(kMostTriangles) + " triangles");
    const Eigen::Isometry3d T_world_actor = isometry(actor.RawPose());
    ActorPath path;
    path.loop = actor.ScriptLoop();
    const sdf::Trajectory& trajectory = *actor.TrajectoryByIndex(0);
    for (std::uint64_t i = 0; i < trajectory.WaypointCount(); ++i) {
      const sdf::Waypoint& point = *trajectory.WaypointByIndex(i);
      const Eigen::Isometry3d T = T_world_actor * isometry(point.Pose());
      const Eigen::Vector3d ahead = T.linear().col(0);
      if (i == 0) out.T_world_model.translation() = T.translation();
      path.points.push_back(
          {point.Time() + actor.ScriptDelayStart(),
           {T.translation().x(), T.translation().y(), std::atan2(ahead.y(), ahead.x())}});
    }
    out.T_world_model.linear() =
        Eigen::AngleAxisd(path.points.front().pose.heading, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    out.path = std::move(path);
    const auto found = courtesy.find(out.name);
    out.courtesy = found == courtesy.end() ? 0.0 : found->second;
    loaded_.world.models.push_back(std::move(out));
  }

  std::string folder_;
  WorldMaterials materials_;
  LoadedWorld loaded_;
  std::size_t triangles_ = 0;
  std::size_t people_ = 0;
};

}  // namespace

Checked<LoadedWorld> loadWorld(const std::string& path) {
  const auto refused = [&](const std::string& why) {
    return Checked<LoadedWorld>::refused(path + ": " + why);
  };
  const auto text = readFile(path);
  if (!text) return refused(text.reason());
  const auto notes = readWorldXml(*text);
  if (!notes) return refused(notes.reason());
  const auto slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash);
  try {
    return Checked<LoadedWorld>::of(WorldReader(folder, *notes).read(*text, *notes));
  } catch (const std::exception& fault) {
    return refused(fault.what());
  }
}

}  // namespace pilothouse::sim
