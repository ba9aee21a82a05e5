#include "sim/world_xml.hpp"

#include <tinyxml2.h>

#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>

#include "core/cloud/quoted.hpp"
#include "sim/plain_numbers.hpp"
#include "sim/procedural_texture.hpp"
#include "sim/world_limits.hpp"

namespace pilothouse::sim {
namespace {

using tinyxml2::XMLElement;

/// A fault, with line and element.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string naming(const XMLElement& element) {
  std::string text = "line " + std::to_string(element.GetLineNum()) + ": <" + element.Name() + ">";
  for (const XMLElement* at = &element; at != nullptr;
       at = at->Parent() != nullptr ? at->Parent()->ToElement() : nullptr) {
    const char* name = at->Attribute("name");
    if (name == nullptr) continue;
    if (at == &element) return text + " " + quoted(name);
    return text + " of " + at->Name() + " " + quoted(name);
  }
  return text;
}

[[noreturn]] void refuse(const XMLElement& element, const std::string& what) {
  throw Fault(naming(element) + " " + what);
}

std::string textOf(const XMLElement& element) {
  const char* text = element.GetText();
  return text == nullptr ? "" : text;
}

std::vector<double> numbersOf(const XMLElement& element, std::size_t least, std::size_t most,
                              double low, double high, const std::string& expected) {
  const std::string text = textOf(element);
  const auto values = plainNumbers(text, most);
  bool good = values && values->size() >= least;
  for (std::size_t i = 0; good && i < values->size(); ++i)
    good = (*values)[i] >= low && (*values)[i] <= high;
  if (!good) refuse(element, "is " + quoted(text) + ", expected " + expected);
  return *values;
}

/// What an element's text must be.
struct NumberRule {
  const char* element;
  const char* parent;  ///< nullptr: any
  std::size_t least, most;
  double low, high;
  const char* expected;
};
constexpr double kFar = kFarthestPlace, kThin = kThinnest, kLarge = kLargest;
constexpr NumberRule kNumberRules[] = {
    {"pose", nullptr, 0, 6, -kFar, kFar, "six numbers up to 10000: x y z roll pitch yaw"},
    {"size", "box", 3, 3, kThin, kLarge, "three lengths from 0.0001 to 1000"},
    {"size", "plane", 2, 2, kThin, kLarge, "two lengths from 0.0001 to 1000"},
    {"radius", nullptr, 1, 1, kThin, kLarge, "one length from 0.0001 to 1000"},
    {"length", nullptr, 1, 1, kThin, kLarge, "one length from 0.0001 to 1000"},
    {"normal", "plane", 3, 3, -kLarge, kLarge, "three numbers up to 1000"},
    {"scale", "mesh", 3, 3, -kLarge, kLarge, "three numbers up to 1000"},
    {"time", "waypoint", 1, 1, 0.0, 1e6, "one number of seconds from 0 to 1000000"},
    {"delay_start", nullptr, 1, 1, 0.0, 1e6, "one number of seconds from 0 to 1000000"},
    {"diffuse", "material", 3, 4, 0.0, 1.0, "three or four numbers from 0 to 1"},
    {"ambient", "material", 3, 4, 0.0, 1.0, "three or four numbers from 0 to 1"},
    {"specular", "material", 3, 4, 0.0, 1.0, "three or four numbers from 0 to 1"},
    {"emissive", "material", 3, 4, 0.0, 1.0, "three or four numbers from 0 to 1"},
    {"transparency", nullptr, 1, 1, 0.0, 1.0, "one number from 0 to 1"},
};

bool isOneOf(const char* name, std::initializer_list<const char*> names) {
  for (const char* candidate : names)
    if (std::strcmp(name, candidate) == 0) return true;
  return false;
}

class XmlReader {
 public:
  WorldNotes read(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw Fault("line " + std::to_string(document.ErrorLineNum()) + ": not well-formed XML (" +
                  document.ErrorName() + ")");
    }
    const XMLElement* root = document.RootElement();
    if (std::strcmp(root->Name(), "sdf") != 0)
      refuse(*root, "is the outermost element, expected <sdf>");
    checkVersion(*root);
    const XMLElement* world = root->FirstChildElement("world");
    if (world == nullptr) refuse(*root, "holds no <world>");
    for (const auto* child = root->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (child != world) refuse(*child, "stands beside the <world>, expected one world alone");
    }
    walk(*world);
    return std::move(notes_);
  }

 private:
  static void checkVersion(const XMLElement& root) {
    const char* version = root.Attribute("version");
    if (version == nullptr) refuse(root, "has no version");
    if (!isOneOf(version, {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"}))
      refuse(root, "has version " + quoted(version) + ", expected 1.4 to 1.9");
  }

  void walk(const XMLElement& element) {
    if (++elements_ > kMostElements)
      refuse(element, "is one too many: more than " + std::to_string(kMostElements) + " elements");
    check(element);
    if (isOneOf(element.Name(), {"plugin", "sensor"})) return;  // whatever it holds
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
      walk(*child);
  }

  void check(const XMLElement& element) {
    const char* name = element.Name();
    if (std::strncmp(name, "pilothouse:", 11) == 0) return readOwn(element, name + 11);
    checkNumbers(element);
    const char* parent = element.Parent()->Value();
    if (isOneOf(name, {"include", "frame", "state", "population", "road"}))
      refuse(element, "is not read: write out what it stands for");
    if (isOneOf(name, {"world", "model", "actor", "link", "visual", "collision"}))
      checkName(element);
    if (std::strcmp(name, "model") == 0 && std::strcmp(parent, "world") != 0)
      refuse(element, "stands within another, expected within the <world>");
    if (isOneOf(name, {"visual", "collision"}) && element.FirstChildElement("geometry") == nullptr)
      refuse(element, "has no <geometry>");
    if (std::strcmp(name, "model") == 0 && element.FirstChildElement("link") == nullptr)
      refuse(element, "has no <link>");
    if (std::strcmp(name, "geometry") == 0) checkGeometry(element);
    if (std::strcmp(name, "trajectory") == 0) checkTrajectory(element);
    if (std::strcmp(name, "actor") == 0) checkActor(element);
    if (isOneOf(name, {"plugin", "sensor", "joint", "light", "audio_source", "projector"}))
      notes_.warnings.push_back(naming(element) + " is not simulated");
  }

  static void checkNumbers(const XMLElement& element) {
    for (const NumberRule& rule : kNumberRules) {
      if (std::strcmp(element.Name(), rule.element) != 0) continue;
      if (rule.parent && std::strcmp(element.Parent()->Value(), rule.parent) != 0) continue;
      const auto values =
          numbersOf(element, rule.least, rule.most, rule.low, rule.high, rule.expected);
      if (rule.most == 6 && !values.empty() && values.size() != 6)
        refuse(element, "is " + quoted(textOf(element)) + ", expected " + rule.expected);
      if (std::strcmp(rule.element, "normal") == 0 &&
          std::hypot(values[0], values[1], values[2]) < 1e-6)
        refuse(element, "is " + quoted(textOf(element)) + ", expected a direction");
      if (std::strcmp(rule.element, "scale") == 0 && values[0] * values[1] * values[2] == 0.0)
        refuse(element, "is " + quoted(textOf(element)) + ", expected numbers other than 0");
    }
  }

  void checkName(const XMLElement& element) {
    const char* name = element.Attribute("name");
    if (name == nullptr || *name == '\0') refuse(element, "has no name");
    const bool top = isOneOf(element.Name(), {"model", "actor"});
    if (top && !top_names_.insert(name).second)
      refuse(element, "has a name that another model or actor of the world has");
    if (top) return;
    for (const auto* other = element.PreviousSiblingElement(element.Name()); other != nullptr;
         other = other->PreviousSiblingElement(element.Name())) {
      const char* other_name = other->Attribute("name");
      if (other_name && std::strcmp(name, other_name) == 0)
        refuse(element, "has the name of the one at line " + std::to_string(other->GetLineNum()));
    }
  }

  static void checkGeometry(const XMLElement& geometry) {
    const XMLElement* shape = geometry.FirstChildElement();
    if (shape == nullptr) refuse(geometry, "is empty, expected a shape");
    if (shape->NextSiblingElement() != nullptr) refuse(geometry, "holds more than one shape");
    const auto need = [&](std::initializer_list<const char*> children) {
      for (const char* child : children)
        if (shape->FirstChildElement(child) == nullptr)
          refuse(*shape, "has no <" + std::string(child) + ">");
    };
    if (std::strcmp(shape->Name(), "box") == 0) return need({"size"});
    if (std::strcmp(shape->Name(), "cylinder") == 0) return need({"radius", "length"});
    if (std::strcmp(shape->Name(), "sphere") == 0) return need({"radius"});
    if (std::strcmp(shape->Name(), "plane") == 0) return need({"normal"});
    if (std::strcmp(shape->Name(), "mesh") == 0) return need({"uri"});
    refuse(*shape, "is no known shape, expected box, cylinder, sphere, plane or mesh");
  }

  static void checkTrajectory(const XMLElement& trajectory) {
    double last = -1.0;
    for (const auto* point = trajectory.FirstChildElement("waypoint"); point != nullptr;
         point = point->NextSiblingElement("waypoint")) {
      const XMLElement* time = point->FirstChildElement("time");
      if (time == nullptr) refuse(*point, "has no <time>");
      if (point->FirstChildElement("pose") == nullptr) refuse(*point, "has no <pose>");
      checkNumbers(*time);
      const double seconds = plainNumbers(textOf(*time), 1)->front();
      if (!(seconds > last))
        refuse(*time, "is " + quoted(textOf(*time)) + ", expected later than the one before");
      last = seconds;
    }
    if (last < 0.0) refuse(trajectory, "has no <waypoint>");
  }

  static void checkActor(const XMLElement& actor) {
    const XMLElement* script = actor.FirstChildElement("script");
    if (script == nullptr || script->FirstChildElement("trajectory") == nullptr)
      refuse(actor, "has no <script> with a <trajectory>");
    const XMLElement* first = script->FirstChildElement("trajectory");
    if (const auto* second = first->NextSiblingElement("trajectory"))
      refuse(*second, "is the second, expected one");
  }

  void readOwn(const XMLElement& element, const char* name) {
    const char* parent = element.Parent()->Value();
    const auto within = [&](const char* expected) {
      if (std::strcmp(parent, expected) != 0)
        refuse(element, "stands within <" + std::string(parent) + ">, expected within <" +
                            std::string(expected) + ">");
    };
    if (std::strcmp(name, "start") == 0) {
      within("world");
      const auto v = numbersOf(element, 3, 3, -kFar, kFar, "three numbers: x y heading");
      notes_.start = {v[0], v[1], v[2]};
    } else if (std::strcmp(name, "route") == 0) {
      within("world");
      readRoute(element);
    } else if (std::strcmp(name, "sunlight") == 0) {
      within("world");
      readSunlight(element);
    } else if (std::strcmp(name, "courtesy") == 0) {
      within("actor");
      const char* actor = element.Parent()->ToElement()->Attribute("name");
      notes_.courtesy[actor == nullptr ? "" : actor] =
          numbersOf(element, 1, 1, 0.0, 10.0, "one length from 0 to 10")[0];
    } else if (std::strcmp(name, "texture") == 0) {
      within("material");
      checkTexture(element);
    } else if (std::strcmp(name, "point") == 0) {
      within("pilothouse:route");
    } else if (isOneOf(name, {"low", "high"})) {
      within("pilothouse:sunlight");
    } else {
      refuse(element,
             "is unknown, expected pilothouse:start, :route, :point, :sunlight, :low, :high, "
             ":courtesy or :texture");
    }
  }

  static void checkTexture(const XMLElement& element) {
    std::string expected;
    for (const std::string& known : proceduralTextureNames()) {
      if (textOf(element) == known) return;
      expected += (expected.empty() ? "" : ", ") + known;
    }
    refuse(element, "is " + quoted(textOf(element)) + ", expected one of " + expected);
  }

  void readRoute(const XMLElement& route) {
    const char* name = route.Attribute("name");
    if (name == nullptr || *name == '\0') refuse(route, "has no name");
    std::vector<Eigen::Vector2d> points;
    for (const auto* point = route.FirstChildElement("pilothouse:point"); point != nullptr;
         point = point->NextSiblingElement("pilothouse:point")) {
      const auto v = numbersOf(*point, 2, 2, -kFar, kFar, "two numbers: x y");
      points.emplace_back(v[0], v[1]);
    }
    if (points.empty()) refuse(route, "has no <pilothouse:point>");
    if (!notes_.routes.emplace(name, std::move(points)).second)
      refuse(route, "has the name of another route");
  }

  void readSunlight(const XMLElement& sunlight) {
    const auto corner = [&](const char* name) {
      const XMLElement* element = sunlight.FirstChildElement(name);
      if (element == nullptr) refuse(sunlight, "has no <" + std::string(name) + ">");
      const auto v = numbersOf(*element, 3, 3, -kFar, kFar, "three numbers: x y z");
      return Eigen::Vector3d(v[0], v[1], v[2]);
    };
    const Eigen::AlignedBox3d box(corner("pilothouse:low"), corner("pilothouse:high"));
    if (box.isEmpty()) refuse(sunlight, "is empty: its low corner lies above its high one");
    notes_.sunlight.push_back(box);
  }

  WorldNotes notes_;
  std::set<std::string> top_names_;
  std::size_t elements_ = 0;
};

}  // namespace

Checked<WorldNotes> readWorldXml(const std::string& text) {
  try {
    return Checked<WorldNotes>::of(XmlReader().read(text));
  } catch (const Fault& fault) {
    return Checked<WorldNotes>::refused(fault.what());
  }
}

}  // namespace pilothouse::sim
