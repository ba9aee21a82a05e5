#include "doors/yaml_values.hpp"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <sstream>

namespace pilothouse {
namespace {

using XmlRpc::XmlRpcValue;

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr int kDeepest = 20;

XmlRpcValue scalar(const YAML::Node& node) {
  // A quoted scalar is text whatever it looks like.
  if (node.Tag() == "!") return XmlRpcValue(node.Scalar());
  int whole = 0;
  double number = 0.0;
  bool truth = false;
  if (YAML::convert<int>::decode(node, whole)) return XmlRpcValue(whole);
  if (YAML::convert<double>::decode(node, number)) return XmlRpcValue(number);
  if (YAML::convert<bool>::decode(node, truth)) return XmlRpcValue(truth);
  return XmlRpcValue(node.Scalar());
}

XmlRpcValue valueOf(const YAML::Node& node, int depth) {
  if (depth > kDeepest) {
    throw YAML::Exception(node.Mark(), "deeper than " + std::to_string(kDeepest) + " levels");
  }
  XmlRpcValue value;
  if (node.IsSequence()) {
    value.setSize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) {
      value[static_cast<int>(i)] = valueOf(node[i], depth + 1);
    }
  } else if (node.IsMap()) {
    for (const auto& entry : node) {
      value[entry.first.as<std::string>()] = valueOf(entry.second, depth + 1);
    }
  } else if (node.IsScalar()) {
    value = scalar(node);
  }
  return value;
}

}  // namespace

Checked<XmlRpcValue> readYaml(const std::string& path) {
  using Result = Checked<XmlRpcValue>;
  std::ifstream file(path, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  file.read(&text[0], static_cast<std::streamsize>(text.size()));
  if (!file.eof() || file.bad()) {
    return Result::refused(path + (file ? ": more than 1 MiB" : ": cannot be read"));
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  try {
    return Result::of(valueOf(YAML::Load(text), 0));
  } catch (const YAML::Exception& error) {
    return Result::refused(path + ": not YAML: " + error.what());
  }
}

}  // namespace pilothouse
