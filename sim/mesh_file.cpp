#include "sim/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "core/cloud/quoted.hpp"
#include "sim/plain_numbers.hpp"

namespace pilothouse::sim {
namespace {

constexpr std::size_t kMostVertices = 1000000;

bool reachable(double value) {
  return std::abs(value) <= kFarthestVertex;
}

std::string atLine(std::size_t line, const std::string& what) {
  return "line " + std::to_string(line) + ": " + what;
}

std::string tooMany() {
  return "more than " + std::to_string(kMostMeshTriangles) + " triangles";
}

/// Takes the next word off the front of a line.
std::string_view nextWord(std::string_view& line) {
  const auto begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return line = {};
  const auto end = std::min(line.find_first_of(" \t\r", begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view nextLine(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

class ObjReader {
 public:
  Checked<Mesh> read(std::string_view text) {
    for (std::size_t number = 1; !text.empty(); ++number) {
      const std::string fault = readLine(nextLine(text));
      if (!fault.empty()) return Checked<Mesh>::refused(atLine(number, fault));
    }
    if (mesh_.triangles.empty()) return Checked<Mesh>::refused("no faces");
    if (textures_.empty()) mesh_.texture_coordinates.clear();
    return Checked<Mesh>::of(std::move(mesh_));
  }

 private:
  std::string readLine(std::string_view line) {
    const std::string_view kind = nextWord(line);
    if (kind == "v") return readNumbers(line, "v", 3, points_);
    if (kind == "vt") return readNumbers(line, "vt", 2, textures_);
    if (kind == "f") return readFace(line);
    return "";
  }

  static std::string readNumbers(std::string_view line, const char* kind, std::size_t count,
                                 std::vector<Eigen::Vector3f>& out) {
    if (out.size() >= kMostVertices) return "more than a million vertices";
    Eigen::Vector3f values = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view word = nextWord(line);
      const auto value = plainNumber(word);
      if (!value || !reachable(*value)) {
        return std::string(kind) + " has " + quoted(word) + ", expected " + std::to_string(count) +
               " numbers up to 10000";
      }
      values[static_cast<Eigen::Index>(i)] = static_cast<float>(*value);
    }
    out.push_back(values);
    return "";
  }

  /// 1-based, or negative from the end, into a list of `size`; -1: no such entry.
  static long resolve(std::string_view word, std::size_t size) {
    const auto value = plainNumber(word);
    if (!value || *value != std::floor(*value) || std::abs(*value) > 1e9) return -1;
    const long index = static_cast<long>(*value);
    const long resolved = index > 0 ? index - 1 : static_cast<long>(size) + index;
    return index != 0 && resolved >= 0 && resolved < static_cast<long>(size) ? resolved : -1;
  }

  /// Adds the corner "v", "v/vt", "v//vn" or "v/vt/vn"; -1: it names what is not there.
  long addCorner(std::string_view word) {
    const auto slash = std::min(word.find('/'), word.size());
    const long point = resolve(word.substr(0, slash), points_.size());
    if (point < 0) return -1;
    long texture = -1;
    if (slash < word.size() && slash + 1 < word.size() && word[slash + 1] != '/') {
      const std::string_view rest = word.substr(slash + 1);
      texture = resolve(rest.substr(0, std::min(rest.find('/'), rest.size())), textures_.size());
      if (texture < 0) return -1;
    }
    const auto [entry, is_new] = corners_.try_emplace({point, texture}, mesh_.vertices.size());
    if (is_new) {
      mesh_.vertices.push_back(points_[static_cast<std::size_t>(point)]);
      const Eigen::Vector2f none = Eigen::Vector2f::Zero();
      mesh_.texture_coordinates.push_back(
          texture < 0 ? none : textures_[static_cast<std::size_t>(texture)].head<2>().eval());
    }
    return static_cast<long>(entry->second);
  }

  std::string readFace(std::string_view line) {
    long first = -1, last = -1;
    int count = 0;
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line), ++count) {
      const long corner = addCorner(word);
      if (corner < 0) return "f names " + quoted(word) + ", which is no vertex of the file";
      if (count >= 2) {
        if (mesh_.triangles.size() >= kMostMeshTriangles) return tooMany();
        mesh_.triangles.push_back({static_cast<std::uint32_t>(first),
                                   static_cast<std::uint32_t>(last),
                                   static_cast<std::uint32_t>(corner)});
      }
      if (count == 0) first = corner;
      last = corner;
    }
    return count < 3 ? "f has fewer than three corners" : "";
  }

  Mesh mesh_;
  std::vector<Eigen::Vector3f> points_, textures_;
  std::map<std::pair<long, long>, std::size_t> corners_;
};

/// Adds an STL triangle, whose corners are shared with those at the same place.
class StlJoiner {
 public:
  void add(const Eigen::Vector3f (&corners)[3]) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3f& p = corners[i];
      const auto [entry, is_new] =
          places_.try_emplace(std::make_tuple(p.x(), p.y(), p.z()), mesh.vertices.size());
      if (is_new) mesh.vertices.push_back(p);
      triangle[i] = static_cast<std::uint32_t>(entry->second);
    }
    mesh.triangles.push_back(triangle);
  }
  Mesh mesh;

 private:
  std::map<std::tuple<float, float, float>, std::size_t> places_;
};

Checked<Mesh> parseBinaryStl(std::string_view bytes, std::uint32_t count) {
  constexpr std::size_t kRecord = 50;
  StlJoiner joiner;
  for (std::uint32_t i = 0; i < count; ++i) {
    float values[12];
    std::memcpy(values, bytes.data() + 84 + i * kRecord, sizeof values);
    for (const float value : values) {
      if (!reachable(static_cast<double>(value))) {
        return Checked<Mesh>::refused("triangle " + std::to_string(i) +
                                      " has a coordinate that is not within 10000 m");
      }
    }
    const Eigen::Vector3f corners[3] = {{values[3], values[4], values[5]},
                                        {values[6], values[7], values[8]},
                                        {values[9], values[10], values[11]}};
    joiner.add(corners);
  }
  if (count == 0) return Checked<Mesh>::refused("no triangles");
  return Checked<Mesh>::of(std::move(joiner.mesh));
}

Checked<Mesh> parseAsciiStl(std::string_view text) {
  StlJoiner joiner;
  Eigen::Vector3f corners[3];
  int count = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = nextLine(text);
    const std::string_view kind = nextWord(line);
    if (kind == "facet" || kind == "endfacet") {
      if (kind == "endfacet" && count != 3)
        return Checked<Mesh>::refused(atLine(number, "a facet without three vertices"));
      if (kind == "endfacet") joiner.add(corners);
      if (joiner.mesh.triangles.size() > kMostMeshTriangles)
        return Checked<Mesh>::refused(atLine(number, tooMany()));
      count = 0;
    }
    if (kind != "vertex") continue;
    if (count >= 3)
      return Checked<Mesh>::refused(atLine(number, "a facet with more than three vertices"));
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = nextWord(line);
      const auto value = plainNumber(word);
      if (!value || !reachable(*value)) {
        return Checked<Mesh>::refused(
            atLine(number, "vertex has " + quoted(word) + ", expected 3 numbers up to 10000"));
      }
      corners[count][axis] = static_cast<float>(*value);
    }
    ++count;
  }
  if (joiner.mesh.triangles.empty()) return Checked<Mesh>::refused("no facets");
  return Checked<Mesh>::of(std::move(joiner.mesh));
}

}  // namespace

Checked<Mesh> parseObj(std::string_view text) {
  return ObjReader().read(text);
}

Checked<Mesh> parseStl(std::string_view bytes) {
  // Binary files may begin with "solid" too: their length tells.
  if (bytes.size() >= 84) {
    std::uint32_t count;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    if (bytes.size() == 84 + std::uint64_t{count} * 50) {
      if (count > kMostMeshTriangles) return Checked<Mesh>::refused(tooMany());
      return parseBinaryStl(bytes, count);
    }
  }
  if (bytes.substr(0, 5) != "solid") {
    return Checked<Mesh>::refused(
        "neither an ASCII STL nor a binary one of the length that its count says");
  }
  return parseAsciiStl(bytes);
}

}  // namespace pilothouse::sim
