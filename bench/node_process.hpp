#pragma once

#include <sys/types.h>

#include <string>

namespace pilothouse::bench {

/// Process of a running node, asked of the node itself; 0: no such node, or it does not answer.
pid_t processOf(const std::string& node);

}  // namespace pilothouse::bench
