#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// What `rosparam load` would put on the parameter server for a YAML file: bool, int, double and
/// text by their look, lists and structs. At most 1 MiB, 20 levels deep.
/// @return refused with file, line and reason.
Checked<XmlRpc::XmlRpcValue> readYaml(const std::string& path);

}  // namespace pilothouse
