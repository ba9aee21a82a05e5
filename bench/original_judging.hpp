#pragma once

#include <string>

#include "bench/drive_record.hpp"
#include "sim/world.hpp"

namespace pilothouse::bench {

/// Outline of a model of the world, as the file has it, grown by `by` [m] (negative: shrunk).
/// @throws std::runtime_error where there is no such model.
std::vector<Eigen::Vector2d> outlineOf(const sim::World& world, const std::string& model,
                                       double by);

struct CellCount {
  int known = 0, floor = 0, obstacle = 0;
};
/// The moment's grid cells whose centres lie within the outline.
CellCount countCells(const DriveMoment& moment, const std::vector<Eigen::Vector2d>& outline);

/// The most that an object within the outline means; none there: kOther and `found` false.
struct Judged {
  Relevance relevance = Relevance::kOther;
  bool found = false;
};
Judged judgedWithin(const DriveMoment& moment, const std::vector<Eigen::Vector2d>& outline);
std::string nameOf(const Judged& judged);

}  // namespace pilothouse::bench
